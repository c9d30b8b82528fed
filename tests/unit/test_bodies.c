// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of bodies: no overlaps, the same bits whatever is stopped and resumed, whatever lists
// and instructions find them, proposals that are what they say, sentences for what it cannot do.
#include "bodies_scenes.h"
#include "reference_bodies.h"
#include "suite.h"

#include "base/constants.h"
#include "dmc/bodies_move.h"
#include "packing/packing.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 5};

static const ChainSettings MIXED = {.stream = STREAM_TRIALS, .rotation = ROTATION_MIXED};
static const ChainSettings TANGENT = {.stream = STREAM_TRIALS, .rotation = ROTATION_TANGENT};
static const ChainSettings NORMAL = {.stream = STREAM_TRIALS, .gaussian = 1};

static Amplitude amplitude_of(double step) {
    return (Amplitude){.parallel = step, .perpendicular = 1.2 * step, .rotation = step};
}

static Chain *chain_on(State *state, const ChainSettings *settings, double step) {
    Chain *chain = NULL;
    ck_assert_msg(chain_create(&chain, settings, state, KEY) == OK, "%s", status_sentence());
    for (size_t s = 0; s < state->system.species_count; s++) {
        const Amplitude amplitude = amplitude_of(step);
        chain_set_amplitude(chain, s, &amplitude);
    }
    return chain;
}

static void run(Chain *chain, int64_t trials, Tally *tally) {
    ck_assert_msg(chain_run(chain, trials, tally) == OK, "%s", status_sentence());
}

// Rods with spheres of another size, and platelets with spheres.
static System mixture(ShapeKind shape, int64_t particles, double number_density) {
    System system =
        bodies_system(shape, shape == SHAPE_PLATELET ? 0 : 3, particles, number_density);
    system.species_count = 3;
    system.species[0].fraction = 0.5;
    system.species[1] = system.species[0];
    system.species[1].diameter = 0.6;
    system.species[1].fraction = 0.3;
    system.species[2] =
        (Species){.shape = SHAPE_SPHERE, .diameter = 0.8, .mass = 1, .fraction = 0.2};
    return system;
}

static State *packed(const System *system) {
    State *state = NULL;
    ck_assert_msg(packing_create(&state, system, KEY, NULL, NULL) == OK, "%s", status_sentence());
    return state;
}

static void check_same(const State *a, const State *b) {
    ck_assert_int_eq(a->step, b->step);
    for (int c = 0; c < 3; c++) {
        ck_assert_mem_eq(a->position[c], b->position[c], a->count * sizeof(double));
        ck_assert_mem_eq(a->orientation[c], b->orientation[c], a->count * sizeof(double));
        ck_assert_mem_eq(a->image[c], b->image[c], a->count * sizeof(int32_t));
    }
}

// Each pair is looked at, ten times on the way.
static void check_no_overlap(const System *system, const ChainSettings *settings, double step) {
    enum { PARTS = 10, TRIALS_EACH = 100000 };
    State *state = packed(system);
    Chain *chain = chain_on(state, settings, step);
    Tally tally = {0};
    for (int part = 0; part < PARTS; part++) {
        run(chain, TRIALS_EACH, &tally);
        chain_publish(chain);
        ck_assert_uint_eq(bodies_overlaps(state, 1), 0);
    }
    ck_assert_msg(state_validate(state) == OK, "%s", status_sentence());
    uint64_t trials = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        trials += tally.moves[s].trials;
        ck_assert_uint_gt(tally.moves[s].accepted, 0);
        ck_assert_uint_lt(tally.moves[s].accepted, tally.moves[s].trials);
    }
    ck_assert_uint_eq(trials, PARTS * TRIALS_EACH);
    chain_free(chain);
    state_free(state);
}

START_TEST(nothing_ever_overlaps) {
    const System rods = bodies_system(SHAPE_SPHEROCYLINDER, 5, 250, 0.085);
    const System platelets = bodies_system(SHAPE_PLATELET, 0, 200, 4);
    const System with_rods = mixture(SHAPE_SPHEROCYLINDER, 300, 0.12);
    const System with_platelets = mixture(SHAPE_PLATELET, 200, 0.5);
    check_no_overlap(&rods, &MIXED, 0.1);
    check_no_overlap(&platelets, &TANGENT, 0.05);
    check_no_overlap(&with_rods, &NORMAL, 0.1);
    check_no_overlap(&with_platelets, &MIXED, 0.2);
}
END_TEST

static void check_resumed(const System *system, const ChainSettings *settings) {
    State *whole = bodies_state(system, KEY, 1), *parts = bodies_state(system, KEY, 1);
    check_same(whole, parts);
    Tally tally_whole = {0}, tally_parts = {0};
    Chain *chain = chain_on(whole, settings, 0.1);
    run(chain, 20000, &tally_whole);
    chain_publish(chain);
    chain_free(chain);

    chain = chain_on(parts, settings, 0.1);
    run(chain, 1, &tally_parts);
    run(chain, 777, &tally_parts);
    chain_publish(chain);
    run(chain, 8000, &tally_parts);
    chain_publish(chain);
    chain_free(chain);
    chain = chain_on(parts, settings, 0.1); // anew, from what was published
    run(chain, 20000 - 8778, &tally_parts);
    chain_publish(chain);
    check_same(whole, parts);
    ck_assert_mem_eq(tally_whole.moves, tally_parts.moves, sizeof tally_whole.moves);
    chain_free(chain);
    state_free(whole);
    state_free(parts);
}

START_TEST(stopped_and_resumed_has_the_bits_of_never_stopped) {
    const System rods = mixture(SHAPE_SPHEROCYLINDER, 200, 0.06);
    const System platelets = bodies_system(SHAPE_PLATELET, 0, 100, 1);
    check_resumed(&rods, &MIXED);
    check_resumed(&rods, &NORMAL);
    check_resumed(&platelets, &TANGENT);
}
END_TEST

// From `start`, half of the trials with one step and half with the other.
static void run_plain(const System *system, const ChainSettings *settings, const double steps[2],
                      int64_t trials, State *state, Tally *tally) {
    ReferenceBodies *reference = NULL;
    ck_assert_int_eq(reference_bodies_create(&reference, settings, state, KEY), OK);
    for (int half = 0; half < 2; half++) {
        const Amplitude amplitude = amplitude_of(steps[half]);
        for (size_t s = 0; s < system->species_count; s++) {
            reference_bodies_set_amplitude(reference, s, &amplitude);
        }
        reference_bodies_run(reference, trials / 2, tally);
    }
    reference_bodies_free(reference);
}

static void run_fast(const System *system, const ChainSettings *settings, const double steps[2],
                     int64_t trials, State *state, Tally *tally) {
    Chain *chain = chain_on(state, settings, 0);
    for (int half = 0; half < 2; half++) {
        const Amplitude amplitude = amplitude_of(steps[half]);
        for (size_t s = 0; s < system->species_count; s++) {
            chain_set_amplitude(chain, s, &amplitude);
        }
        run(chain, trials / 2, tally);
    }
    chain_publish(chain);
    chain_free(chain);
}

static State *copied(const State *state) {
    State *copy = NULL;
    ck_assert_int_eq(state_create(&copy, &state->system), OK);
    memcpy(copy->diameter, state->diameter, state->count * sizeof(double));
    for (int a = 0; a < 3; a++) {
        memcpy(copy->position[a], state->position[a], state->count * sizeof(double));
        memcpy(copy->orientation[a], state->orientation[a], state->count * sizeof(double));
    }
    return copy;
}

// On every instruction set.
static void check_against_reference(const State *start, const ChainSettings *settings,
                                    const double steps[2]) {
    enum { RUN = 30000 };
    State *plain = copied(start);
    Tally expected = {0};
    run_plain(&start->system, settings, steps, RUN, plain, &expected);
    const CpuPath best = cpu_path();
    for (int path = 0; path <= (int)best; path++) {
        setenv("PERRIN_CPU", cpu_path_name((CpuPath)path), 1);
        State *state = copied(start);
        Tally tally = {0};
        run_fast(&start->system, settings, steps, RUN, state, &tally);
        check_same(plain, state);
        ck_assert_mem_eq(tally.moves, expected.moves, sizeof tally.moves);
        state_free(state);
        unsetenv("PERRIN_CPU");
    }
    state_free(plain);
}

// Steps from small to such that no list covers them.
START_TEST(lists_and_bounds_give_the_bits_of_the_plain_chain) {
    const System systems[] = {
        bodies_system(SHAPE_SPHEROCYLINDER, 5, 250, 0.025),
        bodies_system(SHAPE_PLATELET, 0, 150, 1), mixture(SHAPE_SPHEROCYLINDER, 200, 0.06),
        mixture(SHAPE_PLATELET, 150, 0.5),
        bodies_system(SHAPE_SPHEROCYLINDER, 5, 24, 0.012)}; // no room for lists
    static const double steps[][2] = {{0.02, 0.15}, {0.15, 0.45}, {0.45, 2}};
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        State *start = bodies_state(&systems[k], KEY, 1);
        check_against_reference(start, &MIXED, steps[k % 3]);
        check_against_reference(start, &NORMAL, steps[(k + 1) % 3]);
        check_against_reference(start, &TANGENT, steps[(k + 2) % 3]);
        state_free(start);
    }
}
END_TEST

START_TEST(also_where_it_is_dense) {
    const System systems[] = {bodies_system(SHAPE_SPHEROCYLINDER, 5, 250, 0.085),
                              bodies_system(SHAPE_PLATELET, 0, 200, 5),
                              mixture(SHAPE_SPHEROCYLINDER, 250, 0.12)};
    static const double steps[2] = {0.02, 0.1};
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        State *start = packed(&systems[k]);
        check_against_reference(start, &MIXED, steps);
        check_against_reference(start, &TANGENT, steps);
        state_free(start);
    }
}
END_TEST

enum { POINTS = 24 };

// Along the segment of a rod or round the rim of a platelet, where it is anchored.
static void core_points(const Bodies *bodies, size_t i, double points[POINTS][3]) {
    const BodyRow *row = &bodies->lists.anchor[i];
    const double axis[3] = {row->axis[0], row->axis[1], row->axis[2]};
    double e[2][3];
    bodies_frame(axis, e);
    for (int k = 0; k < POINTS; k++) {
        const double along = row->core * (2.0 * k / (POINTS - 1) - 1), angle = 2 * PI * k / POINTS;
        for (int a = 0; a < 3; a++) {
            const double rim = row->radius * (cos(angle) * e[0][a] + sin(angle) * e[1][a]);
            points[k][a] = bodies->flat ? rim : along * axis[a];
        }
    }
}

// Of the points of the cores.
static double nearest_points(const Bodies *bodies, size_t i, size_t j) {
    double of_i[POINTS][3], of_j[POINTS][3], r[3], nearest2 = INFINITY;
    core_points(bodies, i, of_i);
    core_points(bodies, j, of_j);
    for (int a = 0; a < 3; a++) {
        const uint32_t apart =
            (uint32_t)bodies->lists.anchor[j].place[a] - (uint32_t)bodies->lists.anchor[i].place[a];
        r[a] = (double)(int32_t)apart * bodies->unit[a];
    }
    for (int k = 0; k < POINTS * POINTS; k++) {
        double r2 = 0;
        for (int a = 0; a < 3; a++) {
            r2 += bodies_squared(r[a] + of_j[k % POINTS][a] - of_i[k / POINTS][a]);
        }
        nearest2 = fmin(nearest2, r2);
    }
    return sqrt(nearest2);
}

static bool is_listed(const BodyLists *lists, size_t i, size_t j) {
    for (size_t k = 0; k < lists->held[i]; k++) {
        if (lists->near[i * lists->room + k] == j) return true;
    }
    return false;
}

// At any moment of a run.
START_TEST(all_whose_cores_are_nearer_than_the_skin_are_on_the_lists) {
    const System systems[] = {bodies_system(SHAPE_SPHEROCYLINDER, 5, 250, 0.05),
                              bodies_system(SHAPE_PLATELET, 0, 200, 2)};
    static const double steps[] = {0.02, 0.1};
    for (int k = 0; k < 4; k++) {
        State *state = packed(&systems[k % 2]);
        Chain *chain = chain_on(state, &MIXED, steps[k / 2]);
        Tally tally = {0};
        run(chain, 50000, &tally);
        const Bodies *bodies = (const Bodies *)chain;
        const double skin = bodies->lists.skin + (bodies->flat ? 0 : 1); // and contact
        size_t near = 0;
        ck_assert(bodies->lists.skin > 0);
        for (size_t i = 0; i < bodies->count; i++) {
            for (size_t j = 0; j < bodies->count; j++) {
                if (i == j || nearest_points(bodies, i, j) >= skin) continue;
                ck_assert(is_listed(&bodies->lists, i, j));
                near++;
            }
        }
        ck_assert_uint_gt(near, bodies->count);
        chain_free(chain);
        state_free(state);
    }
}
END_TEST

// Upright, so that rods without length are offered the displacements of spheres: their chances are
// those of the chain of balls. Sigma of a share of N trials: less than 1/(2 sqrt(N)), and twice
// that for what successive ones have in common.
START_TEST(rods_without_length_are_spheres) {
    enum { RUN = 1000000 };
    System system = {.dimension = 3, .particles = 256, .packing_fraction = 0.5};
    system.species_count = 1;
    system.species[0] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 1};
    const Amplitude amplitude = {.parallel = 0.07, .perpendicular = 0.07};
    double accepted[2];
    for (int rods = 0; rods < 2; rods++) {
        system.species[0].shape = SHAPE_SPHERE;
        State *balls = packed(&system), *state = balls;
        if (rods) {
            system.species[0].shape = SHAPE_SPHEROCYLINDER;
            ck_assert_int_eq(state_create(&state, &system), OK);
            for (int a = 0; a < 3; a++) {
                memcpy(state->position[a], balls->position[a], balls->count * sizeof(double));
            }
            memcpy(state->diameter, balls->diameter, balls->count * sizeof(double));
            state_free(balls);
        }
        Chain *chain = chain_on(state, &MIXED, 0);
        chain_set_amplitude(chain, 0, &amplitude);
        Tally tally = {0}, settling = {0};
        run(chain, RUN / 4, &settling);
        run(chain, RUN, &tally);
        accepted[rods] = (double)tally.moves[0].accepted / RUN;
        chain_free(chain);
        state_free(state);
    }
    ck_assert_double_eq_tol(accepted[0], 0.317, 0.01); // Jabbari-Farouji and Trizac
    ck_assert_double_eq_tol(accepted[0], accepted[1], 4 * sqrt(2) / sqrt(RUN));
}
END_TEST

START_TEST(growing_bodies_push_each_other_aside) {
    const System systems[] = {bodies_system(SHAPE_SPHEROCYLINDER, 5, 250, 0.05),
                              bodies_system(SHAPE_PLATELET, 0, 150, 2),
                              mixture(SHAPE_PLATELET, 150, 0.5)};
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        State *state = bodies_state(&systems[k], KEY, 0.8);
        ChainSettings settings = MIXED;
        settings.scale = 0.8;
        Chain *chain = chain_on(state, &settings, 0.1);
        ck_assert_uint_gt(bodies_overlaps(state, 0.82), 0);
        ck_assert(!chain_rescale(chain, 0.82));
        ck_assert(chain_squeeze(chain, 0.82));
        chain_publish(chain);
        ck_assert_uint_eq(bodies_overlaps(state, 0.82), 0);
        ck_assert(!chain_squeeze(chain, 2)); // no room, and nothing has changed:
        Tally tally = {0};
        run(chain, 10000, &tally);
        chain_publish(chain);
        ck_assert_uint_eq(bodies_overlaps(state, 0.82), 0);
        chain_free(chain);
        state_free(state);
    }
}
END_TEST

// A free body: what is proposed is accepted, so the tally has the moments of the proposals.
typedef struct Moments {
    double trials, parallel, perpendicular, rotational;
} Moments;

static Moments free_moments(const ChainSettings *settings, const Amplitude *amplitude,
                            int64_t trials) {
    const System system = bodies_system(SHAPE_PLATELET, 0, 1, 0.01);
    State *state = bodies_state(&system, KEY, 1);
    Chain *chain = chain_on(state, settings, 0);
    chain_set_amplitude(chain, 0, amplitude);
    Tally tally = {0};
    run(chain, trials, &tally);
    ck_assert_uint_eq(tally.moves[0].accepted, (uint64_t)trials);
    chain_free(chain);
    state_free(state);
    const double n = (double)trials;
    return (Moments){.trials = n,
                     .parallel = tally.moves[0].parallel / n,
                     .perpendicular = tally.moves[0].perpendicular / n,
                     .rotational = tally.moves[0].rotational / n};
}

// <x^2> = l^2/3, with variance (1/5 - 1/9) l^4 uniform and 2/9 l^4 normal; and <u'.u> = F(a) by
// Jabbari-Farouji and Trizac, eq. 6: 0.995011427 at 0.109, 0.8518518519 at 0.4.
START_TEST(a_free_body_moves_as_its_amplitudes_say) {
    static const double alpha[2] = {0.109, 0.4}, remains[2] = {0.995011427, 0.8518518519};
    const int64_t trials = 1000000;
    for (int k = 0; k < 2; k++) {
        const Amplitude amplitude = {.parallel = 0.3, .perpendicular = 0.2, .rotation = alpha[k]};
        const Moments m = free_moments(&MIXED, &amplitude, trials);
        const double sigma = sqrt((1.0 / 5 - 1.0 / 9) / m.trials);
        ck_assert_double_eq_tol(m.parallel, 0.03, 4 * sigma * 0.09);
        ck_assert_double_eq_tol(m.perpendicular, 0.08 / 3, 4 * sigma * sqrt(2) * 0.04);
        const double mean = 1 - remains[k];
        ck_assert_double_eq_tol(m.rotational, mean, 4 * mean / sqrt(m.trials)); // it varies less
    }
    const Amplitude amplitude = {.parallel = 0.3, .perpendicular = 0.2, .rotation = 0.05};
    const Moments m = free_moments(&NORMAL, &amplitude, trials);
    const double sigma = sqrt(2.0 / 9 / m.trials);
    ck_assert_double_eq_tol(m.parallel, 0.03, 4 * sigma * 0.09);
    ck_assert_double_eq_tol(m.perpendicular, 0.08 / 3, 4 * sigma * sqrt(2) * 0.04);
}
END_TEST

START_TEST(what_cannot_be_done_is_said) {
    System system = bodies_system(SHAPE_SPHEROCYLINDER, 5, 10, 0.1);
    ck_assert_int_eq(chain_check(&system), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "half of an edge"));
    system = mixture(SHAPE_SPHEROCYLINDER, 500, 0.1);
    ck_assert_int_eq(chain_check(&system), OK);
    system.species[1].shape = SHAPE_PLATELET;
    ck_assert_int_eq(chain_check(&system), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "overlap"));
}
END_TEST

START_TEST(a_start_that_overlaps_is_refused) {
    const System systems[] = {bodies_system(SHAPE_SPHEROCYLINDER, 5, 250, 0.025),
                              bodies_system(SHAPE_PLATELET, 0, 150, 1)};
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        State *state = bodies_state(&systems[k], KEY, 1);
        for (int a = 0; a < 3; a++) {
            state->position[a][149] = state->position[a][7] + (a == 0 ? 1e-6 : 0);
            state->orientation[a][149] = a == 0; // discs in one place share no plane
        }
        ck_assert_uint_gt(bodies_overlaps(state, 1), 0);
        Chain *chain = NULL;
        ck_assert_int_eq(chain_create(&chain, &MIXED, state, KEY), UNHEALTHY);
        ck_assert_ptr_null(chain);
        ck_assert_ptr_nonnull(strstr(status_sentence(), "particle 7 overlaps"));
        state_free(state);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("bodies");
    TCase *cases = tcase_create("chain");
    tcase_set_timeout(cases, 600);
    tcase_add_test(cases, nothing_ever_overlaps);
    tcase_add_test(cases, stopped_and_resumed_has_the_bits_of_never_stopped);
    tcase_add_test(cases, lists_and_bounds_give_the_bits_of_the_plain_chain);
    tcase_add_test(cases, also_where_it_is_dense);
    tcase_add_test(cases, all_whose_cores_are_nearer_than_the_skin_are_on_the_lists);
    tcase_add_test(cases, rods_without_length_are_spheres);
    tcase_add_test(cases, growing_bodies_push_each_other_aside);
    tcase_add_test(cases, a_start_that_overlaps_is_refused);
    tcase_add_test(cases, a_free_body_moves_as_its_amplitudes_say);
    tcase_add_test(cases, what_cannot_be_done_is_said);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
