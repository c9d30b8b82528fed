// SPDX-License-Identifier: GPL-3.0-or-later
// What drives a stage out of equilibrium, as a plain value with its run-file keys: they stand in
// the stage itself. A further drive is a member of Drive, rows in drive.c, a bit of DriveKind that
// the methods which can do it set in `drives`, and what they make of it in their `drive`.
#pragma once

#include "base/option.h"
#include "base/status.h"

#include <stdbool.h>

// Shear: the flow v_x = rate(t) y. Rates are in D0/d^2, so that a rate is the bare Peclet number of
// the first species. At most one of the three is given.
typedef struct Flow {
    double rate; // steady; 0: none
    struct {
        double amplitude; // the strain is amplitude sin(frequency t)
        double frequency; // angular, in D0/d^2
    } oscillation;
    struct {
        OptionReals times;           // in d^2/D0 since the stage began
        OptionReals rates;           // on straight lines between, constant before and after
        char file[OPTION_TEXT_SIZE]; // that the run file names in their place; "" once it is read
    } table;
} Flow;

// How the time of a pulled particle's Monte Carlo trials is found (dmc/clock.h).
typedef enum PullClock { PULL_DRIFTED, PULL_EXACT_FORCE, PULL_FIRST_ORDER, PULL_CLOCKS } PullClock;

// A constant force on one particle, the tracer, all others being free (active microrheology).
typedef struct Pull {
    char species[OPTION_TEXT_SIZE]; // of which the tracer is the only particle; "": none is pulled
    double peclet;                  // force times the tracer's radius over kT
    int64_t axis;                   // 0, 1, 2
    int64_t clock;                  // PullClock
    double period, rest; // in d^2/D0: a trajectory begins every period, and ends `rest` before the
                         // next with the force switched off; 0: one trajectory
} Pull;

typedef struct Drive {
    Flow flow;
    Pull pull;
} Drive;

typedef enum DriveKind {
    DRIVE_FLOW = 1 << 0,
    DRIVE_PULL = 1 << 1,
} DriveKind;

extern const OptionTable drive_options; // keys of a stage, of a Drive

unsigned drive_kinds(const Drive *drive);  // those there are, of DriveKind; 0: the stage is at rest
bool drive_oscillates(const Drive *drive); // NULL does not

// BAD_DATA with a sentence that begins with the key, if the drive is not whole.
Status drive_check(const Drive *drive);

enum { FLOW_WORDS_SIZE = 288 };
// As in the run file, for sentences: "shear_rate = 0.02". A long table is shortened.
const char *flow_words(char words[FLOW_WORDS_SIZE], const Flow *flow);

enum { DRIVE_WORDS_SIZE = FLOW_WORDS_SIZE + OPTION_TEXT_SIZE };
// Likewise of whatever drives; "" at rest.
const char *drive_words(char words[DRIVE_WORDS_SIZE], const Drive *drive);

extern const char *const drive_pull_axes[],
    *const drive_pull_clocks[]; // words of the run file, NULL-ended

// Ticks of a trajectory's period, and of its first part, in which the force is on, in whole steps
// of so many ticks: INT64_MAX where there is one trajectory.
void drive_pull_ticks(const Pull *pull, double tick, int64_t per_step, int64_t *period,
                      int64_t *on);
double drive_pull_force(const Pull *pull, double diameter); // of the tracer: in kT/d

// Mean rate from one time of the stage to another, in d^2/D0: what the flow is kept at in between.
double flow_rate(const Flow *flow, double from, double to);
double flow_fastest(const Flow *flow);             // the largest |rate| there may be
double flow_strain(const Flow *flow, double time); // since the stage began
