// SPDX-License-Identifier: GPL-3.0-or-later
// What a Monte Carlo cycle (N trials) is worth in time.
//
// A free body diffuses in a cycle as in the time parallel^2/(6 D_par). Interactions slow that down:
// by the acceptance A (acceptance-rescaling, "VA"), or to what is left of the mean squared
// displacement, per attempt or after a whole cycle (diffusion-matching, "VD"); [JT]. Measured while
// the chain runs, from the trials since clock_restart.
#pragma once

#include "dmc/amplitude.h"
#include "propagator/propagator.h"

#include <stdbool.h>

typedef enum ClockKind { CLOCK_ACCEPTANCE, CLOCK_MATCHING, CLOCKS } ClockKind;

// What diffusion is matched; a body without an axis has one, that of all directions.
typedef enum MatchedMotion {
    MATCH_PARALLEL,
    MATCH_PERPENDICULAR,
    MATCH_ROTATIONAL,
    MATCHES
} MatchedMotion;

// The displacement after one whole cycle contains back-scattering and is the letter of the paper.
typedef enum MatchedSpan { MATCH_PER_CYCLE, MATCH_PER_ATTEMPT, SPANS } MatchedSpan;

typedef struct ClockSettings {
    ChainSettings chain;
    ClockKind kind;
    MatchedMotion motion;
    MatchedSpan span;
} ClockSettings;

// A force on the only particle of a species. The time of its trials is of its own kind: it goes by
// acceptance, and by the force.
typedef struct ClockPull {
    size_t species;
    int axis;
    double force; // in kT/d
    PullClock kind;
} ClockPull;

// Runs a chain and keeps its time.
typedef struct ChainClock ChainClock;

// Borrows the state until free.
Status clock_create(ChainClock **out, const ClockSettings *settings, State *state, RngKey key);
void clock_free(ChainClock *clock);

// Amplitudes of a species from that along its axis.
void clock_set_step(ChainClock *clock, size_t species, double parallel);
double clock_step(const ChainClock *clock, size_t species);

// Pulls from now on; NULL: no more. Where it rests the trials stay what they are, without force.
void clock_pull(ChainClock *clock, const ClockPull *pull);
void clock_pull_rests(ChainClock *clock, bool rests);
double clock_pull_work(const ChainClock *clock); // f: force times half-width of a trial, in kT
// Time of a free tracer's trial goes with this power of its step: 2, and 1 where it gives way to
// the force in every trial.
double clock_pull_power(const ChainClock *clock);

// Begins to count afresh.
void clock_restart(ChainClock *clock);

// Trials are counted for the clock and, if it is not NULL, in the tally. run(a), run(b) counts and
// moves as run(a + b), but for the rounding of sums.
Status clock_run(ChainClock *clock, int64_t trials, Tally *tally);
void clock_publish(ChainClock *clock);   // see chain_publish
Status clock_take_in(ChainClock *clock); // the published State, which somebody has changed since

// While it calibrates, many more whole cycles are measured. Between whole cycles only.
void clock_calibrate(ChainClock *clock, bool calibrating);

double clock_acceptance(const ChainClock *clock, size_t species); // NaN before its first trial
uint64_t clock_trials(const ChainClock *clock, size_t species);
double clock_cycle_of(const ChainClock *clock, size_t species); // a cycle, in d^2/D0, by what
                                                                // this species does
double clock_cycle(const ChainClock *clock); // mean over particles, but for a pulled one

// Runs trials worth `time`, in d^2/D0, by the measurement so far; what is left of a trial is
// carried to the next call.
Status clock_advance(ChainClock *clock, double time, Tally *tally);

void clock_archive(ChainClock *clock, Archive *archive);
size_t clock_memory(const System *system); // bytes, chain included
