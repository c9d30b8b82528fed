// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the tests that measure: settings filled with defaults, states made by hand, results
// read by name.
#pragma once

#include "observables/observables.h"

#include <check.h>
#include <math.h>
#include <string.h>

// What a series is stands in series.def, and nowhere else.
static inline void expect_told_sentences(const Results *results) {
    for (size_t i = 0; i < results->series_count; i++) {
        const ResultSeries *series = &results->series[i];
        const ResultMeaning *meaning = result_series_meaning(series->observable);
        ck_assert_msg(meaning != NULL, "%s is not told", series->observable);
        ck_assert_str_eq(series->about, meaning->about);
    }
}

// A real or integer of a settings struct, by the name of its option.
static inline void set_number(Settings *settings, const OptionTable *options, const char *name,
                              double value) {
    for (size_t i = 0; i < options->count; i++) {
        const Option *row = &options->rows[i];
        if (strcmp(row->name, name) != 0) continue;
        const int64_t whole = (int64_t)value;
        const void *bytes = row->type == OPTION_REAL ? (const void *)&value : &whole;
        memcpy(settings->bytes + row->offset, bytes, sizeof value);
        return;
    }
    ck_abort_msg("no option '%s'", name);
}

static inline Settings settings_of(const OptionTable *options) {
    Settings settings = {{0}};
    for (size_t i = 0; i < options->count; i++) {
        set_number(&settings, options, options->rows[i].name, options->rows[i].fallback);
    }
    return settings;
}

// `species` discs or spheres of diameters 1, 1.4, ... in equal numbers.
static inline System system_of(int dimension, int64_t particles, double packing_fraction,
                               size_t species) {
    static const char *const names[] = {"small", "big", "bigger"};
    System system = {.dimension = dimension,
                     .particles = particles,
                     .packing_fraction = packing_fraction,
                     .species_count = species};
    for (size_t s = 0; s < species; s++) {
        system.species[s] = (Species){.shape = dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE,
                                      .diameter = 1 + 0.4 * (double)s,
                                      .mass = 1,
                                      .fraction = 1 / (double)species};
        strcpy(system.species[s].name, names[s]);
    }
    return system;
}

// Rods and platelets in equal numbers, or one of them alone.
static inline System oriented_system(int64_t particles, size_t species) {
    System system = {.dimension = 3,
                     .particles = particles,
                     .number_density = 0.1,
                     .species_count = species,
                     .species = {{.name = "plate",
                                  .shape = SHAPE_PLATELET,
                                  .diameter = 1,
                                  .mass = 1,
                                  .fraction = 1 / (double)species},
                                 {.name = "rod",
                                  .shape = SHAPE_SPHEROCYLINDER,
                                  .diameter = 1,
                                  .length = 5,
                                  .mass = 1,
                                  .fraction = 0.5}}};
    return system;
}

static inline System soft_system(int64_t particles, double exponent) {
    System system = system_of(3, particles, 0.3, 1);
    system.species[0].shape = SHAPE_SOFT_SPHERE;
    system.species[0].exponent = exponent;
    return system;
}

static inline State *new_state(const System *system) {
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, system), OK);
    for (size_t i = 0; i < state->count; i++) {
        state->diameter[i] = system->species[state->species_of[i]].diameter;
    }
    return state;
}

static inline void set_axis(State *state, size_t i, const double u[3]) {
    const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int a = 0; a < 3; a++) state->orientation[a][i] = u[a] / length;
}

// Uniformly random places, and axes: an ideal gas.
static inline void scatter(State *state, RngKey key, uint64_t step) {
    Rng rng = rng_open(key, STREAM_PACKING, step, 0);
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            state->position[a][i] = rng_uniform(&rng) * state->box.edge[a];
        }
    }
    for (size_t i = 0; state->oriented && i < state->count; i++) {
        const double u[3] = {rng_normal(&rng), rng_normal(&rng), rng_normal(&rng)};
        set_axis(state, i, u);
    }
}

static inline Observer *new_observer(const ObservableKind *kind, const Settings *settings,
                                     const State *state, const Clock *clock) {
    Observer *observer = NULL;
    ck_assert_int_eq(kind->create(&observer, settings, state, clock), OK);
    return observer;
}

static inline Results *written(const Observer *observer, const State *state) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(observer->kind->write(observer, state, results, 0), OK);
    return results;
}

static inline double scalar_of(const Results *results, const char *stage, const char *quantity) {
    const ResultScalar *scalar = results_find_scalar(results, stage, quantity);
    ck_assert_msg(scalar != NULL, "no scalar '%s/%s'", stage, quantity);
    return results_scalar_estimate(results, scalar).value;
}

static inline double error_of(const Results *results, const char *stage, const char *quantity) {
    const ResultScalar *scalar = results_find_scalar(results, stage, quantity);
    ck_assert_msg(scalar != NULL, "no scalar '%s/%s'", stage, quantity);
    return results_scalar_estimate(results, scalar).error;
}

static inline const ResultSeries *series_of(const Results *results, const char *stage,
                                            const char *observable) {
    const ResultSeries *series = results_find_series(results, stage, observable);
    ck_assert_msg(series != NULL, "no series '%s/%s'", stage, observable);
    return series;
}

static inline Clock clock_of(int64_t ticks, int64_t per_step) {
    return (Clock){.tick = 0.5,
                   .flight_time = 0.25,
                   .ticks = ticks,
                   .ticks_per_step = per_step,
                   .unit = "d^2/D0",
                   .stage = "quiescent",
                   .thermostatted = true};
}

// Moves every particle to where it is at a tick.
typedef void (*Mover)(State *state, int64_t tick);

// Lets the observer look whenever it wants to within (from, to]; from -1 the start is included.
static inline void watch(Observer *observer, State *state, Mover mover, int64_t from, int64_t to) {
    const Tally none = {0};
    for (int64_t tick = observer->kind->next(observer, from); tick <= to;
         tick = observer->kind->next(observer, tick)) {
        mover(state, tick);
        ck_assert_int_eq(observer->kind->see(observer, tick, state, &none), OK);
    }
}

static inline void fold(State *state, int axis, size_t i, double unfolded) {
    const double turns = floor(unfolded / state->box.edge[axis]);
    state->image[axis][i] = (int32_t)turns;
    state->position[axis][i] = unfolded - turns * state->box.edge[axis];
}
