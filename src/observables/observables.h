// SPDX-License-Identifier: GPL-3.0-or-later
// What is measured while time advances. An observer says when it wants to look, looks at the
// State and the Tally, and at the end gives its replica's numbers. It never changes a State.
#pragma once

#include "base/archive.h"
#include "base/text.h"
#include "propagator/propagator.h"
#include "results/results.h"
#include "state/state.h"
#include "state/tally.h"

// The stage's time axis.
typedef struct Clock {
    double tick;        // in `unit`
    double flight_time; // of a tick, in d sqrt(m/kT); NaN where nothing flies
    int64_t ticks;      // in the stage
    int64_t ticks_per_step;
    const char *unit;   // "d^2/D0" or "d sqrt(m/kT)"
    const char *stage;  // its name, for the results
    bool flies;         // there are velocities and collisions
    bool thermostatted; // velocities are redrawn: positions diffuse
    const Drive *drive; // of the stage, borrowed; NULL: at rest
    const Flow *before; // of the stage before, which this one goes on from; NULL: at rest
    bool whole_steps;   // there are configurations at whole steps only: those of a trajectory
} Clock;

typedef struct ObservableKind ObservableKind;

// The first member of each observer's own struct.
typedef struct Observer {
    const ObservableKind *kind;
    Clock clock;
    int64_t period; // ticks between its looks, where they are evenly spaced (looks.h)
} Observer;

struct ObservableKind {
    const char *name;
    const char *about; // one sentence: what it is, its source
    bool of_motion;    // needs velocities or the Tally, which no stored configuration has
    OptionTable options;
    // BAD_DATA with a sentence that ends "...; do this", before anything runs. May be NULL.
    Status (*check)(const Settings *settings, const System *system, const Clock *clock);
    Status (*create)(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock);
    int64_t (*next)(const Observer *observer, int64_t after); // first tick > after to look at;
                                                              // -1 asks for tick 0 as well;
                                                              // INT64_MAX: no more
    Status (*see)(Observer *observer, int64_t tick, const State *state, const Tally *tally);
    void (*archive)(Observer *observer, Archive *archive);
    Status (*write)(const Observer *observer, const State *state, Results *results, size_t replica);
    // Standard error of its main number so far, over the number, from stretches of the time so far;
    // infinite where that is too little to tell. NULL where a stage cannot end by it (`until`).
    double (*relative_error)(const Observer *observer);
    void (*free)(Observer *observer);
    size_t (*memory)(const Settings *settings, const System *system, const Clock *clock); // bytes
    // What `perrin check` says of it alone, a line each. May be NULL.
    Status (*describe)(const Settings *settings, const System *system, Text *lines);
};

// Becomes: extern const ObservableKind observable_mean_squared_displacement; ...
#define OBSERVABLE(id) extern const ObservableKind observable_##id;
#include "observables/observables.def"
#undef OBSERVABLE

extern const ObservableKind *const observable_kinds[]; // NULL-ended
const ObservableKind *observable_kind_named(const char *name);

// What `perrin check` says of it in this stage, a line each.
Status observable_describe(const ObservableKind *kind, const Settings *settings,
                           const System *system, const Clock *clock, Text *lines);
