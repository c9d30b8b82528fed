// SPDX-License-Identifier: GPL-3.0-or-later
// Each trajectory of a pulled tracer begins somewhere else: in place of another particle of the
// bath like it, or where there is room. Fixed seeds.
#include "dmc/dmc.h"
#include "edbd/edbd.h"
#include "observe.h"
#include "suite.h"
#include "propagator/tracer.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 20261126};

// Spheres or upright rods on a lattice, the last of them a spherical tracer.
static State *suspension(ShapeKind bath, double spacing, double tracer_diameter) {
    enum { EDGE = 5, LONG = 10, COUNT = EDGE * EDGE * LONG };
    System system = {.dimension = 3,
                     .particles = COUNT,
                     .number_density = 1 / (spacing * spacing * spacing),
                     .aspect = {3, {1, 1, 2}},
                     .species_count = 2};
    system.species[0] = (Species){.name = "bath",
                                  .shape = bath,
                                  .diameter = 1,
                                  .mass = 1,
                                  .fraction = 1 - 1.0 / COUNT,
                                  .length = bath == SHAPE_SPHEROCYLINDER ? 3 : 0};
    system.species[1] = (Species){.name = "tracer",
                                  .shape = SHAPE_SPHERE,
                                  .diameter = tracer_diameter,
                                  .mass = 1,
                                  .fraction = 1.0 / COUNT};
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < state->count; i++) {
        const size_t at[3] = {i % EDGE, i / EDGE % EDGE, i / EDGE / EDGE};
        for (int a = 0; a < 3; a++) state->position[a][i] = ((double)at[a] + 0.5) * spacing;
        state->diameter[i] = i + 1 == state->count ? tracer_diameter : 1;
        if (state->oriented) state->orientation[2][i] = 1;
    }
    return state;
}

static Settings settings_for(const PropagatorKind *kind) {
    Settings settings = settings_of(&kind->options);
    if (kind == &propagator_event_driven) return settings;
    set_number(&settings, &kind->options, "step", 0.02);
    set_number(&settings, &kind->options, "clock", 0); // acceptance-rescaling
    return settings;
}

// Of the tracer from one tick to the next: squares along each axis over what they are on average if
// it goes anywhere, edge^2/12.
static void see_jump(const State *state, const double from[3], double square[3]) {
    const size_t tracer = state->count - 1;
    double r[3];
    for (int a = 0; a < 3; a++) r[a] = state->position[a][tracer] - from[a];
    box_nearest_image(&state->box, r);
    for (int a = 0; a < 3; a++) {
        square[a] += 12 * r[a] * r[a] / (state->box.edge[a] * state->box.edge[a]);
    }
}

typedef struct Case {
    const PropagatorKind *kind;
    ShapeKind bath;
    double spacing, tracer_diameter;
} Case;

static const Case cases[] = {
    {&propagator_dynamic_monte_carlo, SHAPE_SPHERE, 1.15, 1}, // a packing fraction of 0.34
    {&propagator_dynamic_monte_carlo, SHAPE_SPHERE, 1.5, 1.2},
    {&propagator_dynamic_monte_carlo, SHAPE_SPHEROCYLINDER, 4.2, 1},
    {&propagator_event_driven, SHAPE_SPHERE, 1.15, 1},
    {&propagator_event_driven, SHAPE_SPHERE, 1.5, 1.2},
};

// Without a rest, so that one trajectory ends where the next begins.
START_TEST(each_trajectory_begins_somewhere_else) {
    enum { TRAJECTORIES = 400, TICKS = 3 };
    const Case *now = &cases[_i];
    State *state = suspension(now->bath, now->spacing, now->tracer_diameter);
    const Settings settings = settings_for(now->kind);
    const double tick = now->kind->tick(&settings, &state->system);
    const Drive drive = {.pull = {.species = "tracer", .peclet = 1, .period = TICKS * tick}};
    Propagator *propagator = NULL;
    ck_assert_int_eq(now->kind->create(&propagator, &settings, state, KEY), OK);
    ck_assert_int_eq(now->kind->drive(propagator, &drive, 0), OK);
    double square[3] = {0}, inside[3] = {0}, from[3], deepest = 0;
    Tally tally = {0};
    for (int k = 0; k < TRAJECTORIES; k++) {
        for (int a = 0; a < 3; a++) from[a] = state->position[a][state->count - 1];
        ck_assert_int_eq(now->kind->advance(propagator, TICKS - 1, &tally), OK);
        see_jump(state, from, inside);
        for (int a = 0; a < 3; a++) from[a] = state->position[a][state->count - 1];
        ck_assert_msg(now->kind->advance(propagator, 1, &tally) == OK, "%s", status_sentence());
        see_jump(state, from, square);
        ck_assert_int_eq(state_deepest_overlap(state, 0, &deepest, NULL), OK);
        ck_assert_double_lt(deepest, 1e-12);
    }
    // Squares of a uniform number are known to sqrt(4/5) each; a lattice of five is 4 % off.
    for (int a = 0; a < 3; a++) {
        printf(" %.3f", square[a] / TRAJECTORIES);
        ck_assert_double_eq_tol(square[a] / TRAJECTORIES, 1, 4 * sqrt(0.8 / TRAJECTORIES) + 0.04);
        ck_assert_double_lt(inside[a] / TRAJECTORIES, 0.01);
    }
    printf(" of 1\n");
    now->kind->free(propagator);
    state_free(state);
}
END_TEST

// Everything forgotten but the State and what is archived, after every tick.
START_TEST(resumes_change_no_bit_of_it) {
    enum { TICKS = 20 };
    const Case *now = &cases[_i];
    const Settings settings = settings_for(now->kind);
    State *whole = suspension(now->bath, now->spacing, now->tracer_diameter);
    State *sliced = suspension(now->bath, now->spacing, now->tracer_diameter);
    const double tick = now->kind->tick(&settings, &whole->system);
    const Drive drive = {
        .pull = {.species = "tracer", .peclet = 1, .period = 3 * tick, .rest = tick}};
    Propagator *propagator = NULL;
    Tally tally = {0};
    ck_assert_int_eq(now->kind->create(&propagator, &settings, whole, KEY), OK);
    ck_assert_int_eq(now->kind->drive(propagator, &drive, 0), OK);
    ck_assert_int_eq(now->kind->advance(propagator, TICKS, &tally), OK);
    now->kind->free(propagator);
    Archive saved = archive_writer();
    for (int64_t t = 0; t < TICKS; t++) {
        ck_assert_int_eq(now->kind->create(&propagator, &settings, sliced, KEY), OK);
        ck_assert_int_eq(now->kind->drive(propagator, &drive, t), OK);
        Archive loading = archive_reader(saved.bytes, saved.size);
        if (t > 0 && now->kind->archive) now->kind->archive(propagator, &loading);
        ck_assert_int_eq(now->kind->advance(propagator, 1, &tally), OK);
        archive_free(&saved);
        saved = archive_writer();
        if (now->kind->archive) now->kind->archive(propagator, &saved);
        now->kind->free(propagator);
    }
    archive_free(&saved);
    for (int a = 0; a < 3; a++) {
        ck_assert_mem_eq(whole->position[a], sliced->position[a], whole->count * sizeof(double));
        ck_assert_mem_eq(whole->image[a], sliced->image[a], whole->count * sizeof(int32_t));
    }
    state_free(whole);
    state_free(sliced);
}
END_TEST

START_TEST(no_room_is_told) {
    State *state = suspension(SHAPE_SPHERE, 1.05, 1.2);
    ck_assert_int_eq(tracer_take_another_place(state, state->count - 1, KEY), UNHEALTHY);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "leave out the period"));
    state_free(state);
}
END_TEST

// Carnahan and Starling's chemical potential of equal spheres is 2 % below scaled-particle theory's
// at 0.3; discs at 0.4 by hand; a point goes wherever no sphere is.
START_TEST(chance_of_room_is_that_of_theory) {
    System system = {.dimension = 3,
                     .particles = 1000000,
                     .packing_fraction = 0.3,
                     .aspect = {3, {1, 1, 1}},
                     .species_count = 2,
                     .species = {{.name = "bath", .shape = SHAPE_SPHERE, .diameter = 1},
                                 {.name = "tracer", .shape = SHAPE_SPHERE, .diameter = 1}}};
    system.species[0].fraction = 1 - 1e-6;
    system.species[1].fraction = 1e-6;
    const Pull pull = {.species = "tracer", .peclet = 1};
    ck_assert(tracer_has_alike(&pull, &system));
    const double work = -log(tracer_chance_of_room(&pull, &system));
    ck_assert_double_eq_tol(work, (2.4 - 0.81 + 0.081) / 0.343, 0.025 * work);
    system.species[1].diameter = 1e-3;
    ck_assert(!tracer_has_alike(&pull, &system));
    ck_assert_double_eq_tol(tracer_chance_of_room(&pull, &system), 0.7, 0.002);
    system.species[1].diameter = 3;
    ck_assert_double_lt(tracer_chance_of_room(&pull, &system), 1e-20);
    system.species[0].spread = SPREAD_GAUSSIAN;
    ck_assert_double_lt(tracer_chance_of_room(&pull, &system), 0);
    system.species[0].spread = SPREAD_NONE;
    system.species[0].shape = system.species[1].shape = SHAPE_DISC;
    system.species[1].diameter = 1;
    system.dimension = 2;
    system.packing_fraction = 0.4;
    ck_assert_double_eq_tol(tracer_chance_of_room(&pull, &system),
                            0.6 * exp(-0.8 / 0.6 - 0.4 / 0.36), 1e-4);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("next trajectory");
    TCase *unit = tcase_create("next trajectory");
    const int count = (int)(sizeof cases / sizeof *cases);
    tcase_set_timeout(unit, 120);
    tcase_add_loop_test(unit, each_trajectory_begins_somewhere_else, 0, count);
    tcase_add_loop_test(unit, resumes_change_no_bit_of_it, 0, count);
    tcase_add_test(unit, no_room_is_told);
    tcase_add_test(unit, chance_of_room_is_that_of_theory);
    suite_add_tcase(suite, unit);
    return run_suite(suite);
}
