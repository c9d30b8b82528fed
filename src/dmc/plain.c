// SPDX-License-Identifier: GPL-3.0-or-later
// Plain Monte Carlo at constant volume, for equilibration: steps are tuned to an acceptance before
// the stage begins, then frozen, so that the stage samples the equilibrium exactly. Its time is
// cycles.
#include "dmc/clock.h"
#include "dmc/dmc.h"
#include "dmc/predict.h"

#include "base/memory.h"

#include <math.h>

static const int TUNINGS = 20;       // adjustments of the steps
static const double GAIN = 1.5;      // of an adjustment: d ln A/d ln step is -1 or less
static const double STEP_MOST = 0.5; // in d, and in edges of the box

typedef struct Plain {
    double acceptance;
    int64_t tuning; // cycles
} Plain;

static const Option rows[] = {
    {.name = "acceptance",
     .type = OPTION_REAL,
     .offset = offsetof(Plain, acceptance),
     .fallback = 0.4,
     .least = 0.05,
     .most = 0.95,
     .unit = "",
     .about = "Fraction of the trials to be accepted, for which the steps are tuned."},
    {.name = "tuning",
     .type = OPTION_INTEGER,
     .offset = offsetof(Plain, tuning),
     .fallback = 400,
     .least = 40,
     .most = 1e9,
     .unit = "cycles",
     .about = "Cycles before the stage begins, in which the steps are tuned."},
};

typedef struct PlainPropagator {
    Propagator base;
    State *state;
    Plain set;
    ChainClock *clock;
} PlainPropagator;

static const ChainSettings chain = {.stream = STREAM_TRIALS, .rotation = ROTATION_TANGENT};

static const Plain *plain(const Settings *settings) {
    return (const Plain *)settings->bytes;
}

static PlainPropagator *own(Propagator *propagator) {
    return (PlainPropagator *)propagator;
}

static Status check(const Settings *settings, const System *system) {
    const double acceptance = plain(settings)->acceptance;
    if (!(acceptance > 0 && acceptance < 1))
        return status_fail(BAD_DATA, "acceptance = %g must be above 0 and below 1", acceptance);
    return chain_check(system);
}

static double tick(const Settings *settings, const System *system) {
    (void)settings;
    (void)system;
    return 1;
}

static int64_t one(const Settings *settings) {
    (void)settings;
    return 1;
}

static double seconds(const Settings *settings, const System *system) {
    (void)settings;
    return chain_seconds_per_trial(system);
}

static double bounded_step(const System *system, double step) {
    const Box box = system_box(system);
    double most = STEP_MOST;
    for (int a = 0; a < box.dimension; a++) most = fmin(most, STEP_MOST * box.edge[a]);
    return fmin(fmax(step, 1e-6), most);
}

static void describe(const Settings *settings, const System *system, const Drive *drive,
                     double time, Text *lines) {
    (void)drive;
    (void)time;
    const double acceptance = plain(settings)->acceptance;
    for (size_t s = 0; s < system->species_count; s++) {
        const double step = predict_step(system, s, acceptance, &chain);
        text_add(lines, "%s: step about %.2g d\n", system->species[s].name,
                 bounded_step(system, step));
    }
}

static void release(Propagator *propagator) {
    if (!propagator) return;
    clock_free(own(propagator)->clock);
    memory_free(propagator);
}

static Status create(Propagator **out, const Settings *settings, State *state, RngKey key) {
    PlainPropagator *made = NULL;
    TRY(NEW(made));
    made->base.kind = &propagator_monte_carlo;
    made->state = state;
    made->set = *plain(settings);
    const ClockSettings clock = {.chain = chain, .kind = CLOCK_ACCEPTANCE};
    const Status status = clock_create(&made->clock, &clock, state, key);
    if (status != OK) {
        release(&made->base);
        return status;
    }
    *out = &made->base;
    return OK;
}

// A power of two, so that the last digits of the C library reach no trajectory.
static double first_step(const PlainPropagator *made, size_t species) {
    const System *system = &made->state->system;
    const double step = predict_step(system, species, made->set.acceptance, &chain);
    return bounded_step(system, exp2(floor(log2(step))));
}

static void tune(PlainPropagator *made, size_t species) {
    const double off = clock_acceptance(made->clock, species) - made->set.acceptance;
    if (isnan(off)) return; // no trial yet
    const double factor = fmin(fmax(1 + GAIN * off, 0.5), 2);
    const double step = clock_step(made->clock, species) * factor;
    clock_set_step(made->clock, species, bounded_step(&made->state->system, step));
}

static Status prepare(Propagator *propagator) {
    PlainPropagator *made = own(propagator);
    const size_t species = made->state->system.species_count;
    const int64_t trials = made->set.tuning * (int64_t)made->state->count / TUNINGS;
    for (size_t s = 0; s < species; s++) clock_set_step(made->clock, s, first_step(made, s));
    for (int k = 0; k < TUNINGS; k++) {
        clock_restart(made->clock);
        TRY(clock_run(made->clock, trials, NULL));
        for (size_t s = 0; s < species; s++) tune(made, s);
    }
    clock_restart(made->clock);
    clock_publish(made->clock);
    return OK;
}

static Status advance(Propagator *propagator, int64_t ticks, Tally *tally) {
    PlainPropagator *made = own(propagator);
    for (int64_t t = 0; t < ticks; t++) {
        TRY(clock_run(made->clock, (int64_t)made->state->count, tally));
    }
    clock_publish(made->clock);
    return OK;
}

static void archive(Propagator *propagator, Archive *archive) {
    clock_archive(own(propagator)->clock, archive);
}

const PropagatorKind propagator_monte_carlo = {
    .name = "monte-carlo",
    .about = "Monte Carlo of single-particle moves without a clock, for equilibration; steps are "
             "tuned to an acceptance before the stage begins.",
    .time_unit = "cycles",
    .time_meaning = "A cycle is as many trials as there are particles.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(Plain)},
    .check = check,
    .tick = tick,
    .ticks_per_step = one,
    .seconds_per_particle_tick = seconds,
    .memory = clock_memory,
    .describe = describe,
    .create = create,
    .prepare = prepare,
    .advance = advance,
    .archive = archive,
    .free = release,
};
