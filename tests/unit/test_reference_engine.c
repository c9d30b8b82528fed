// SPDX-License-Identifier: GPL-3.0-or-later
// The slow twin as physics, before anything is measured by it: exact collisions, conservation laws,
// no overlap, its two ways of searching against each other, and the equation of state.
#include "reference_engine.h"
#include "suite.h"

#include "base/constants.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 11};

static System system_of(int dimension, int particles, double packing_fraction) {
    System system = {.dimension = dimension,
                     .particles = particles,
                     .packing_fraction = packing_fraction,
                     .species_count = 1};
    system.species[0] = (Species){.name = "one",
                                  .shape = dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE,
                                  .diameter = 1,
                                  .mass = 1,
                                  .fraction = 1};
    return system;
}

// Equal numbers of diameters 1 and 1.4, masses 1 and 2.
static System mixture_of(int dimension, int particles, double packing_fraction) {
    System system = system_of(dimension, particles, packing_fraction);
    system.species_count = 2;
    system.species[1] = system.species[0];
    system.species[0].fraction = system.species[1].fraction = 0.5;
    system.species[1].diameter = 1.4;
    system.species[1].mass = 2;
    return system;
}

// On a square or cubic lattice, side^dimension = particles, large and small taking turns.
static State *lattice(const System *system) {
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, system), OK);
    const double root =
        system->dimension == 2 ? sqrt((double)system->particles) : cbrt((double)system->particles);
    const size_t side = (size_t)lround(root), species = system->species_count;
    for (size_t i = 0; i < state->count; i++) {
        size_t site = i * species % state->count + i * species / state->count;
        state->diameter[i] = system->species[state->species_of[i]].diameter;
        for (int a = 0; a < state->box.dimension; a++, site /= side) {
            state->position[a][i] =
                ((double)(site % side) + 0.5) * state->box.edge[a] / (double)side;
        }
    }
    return state;
}

static void draw_velocities(State *state) {
    Rng rng = rng_open(KEY, STREAM_VELOCITY, 0, 0);
    for (size_t i = 0; i < state->count; i++) {
        for (int a = 0; a < state->box.dimension; a++) {
            state->velocity[a][i] = rng_normal(&rng) / sqrt(state->mass[i]);
        }
    }
}

static State *copy_of(const State *state) {
    State *copy = NULL;
    ck_assert_int_eq(state_create(&copy, &state->system), OK);
    memcpy(copy->diameter, state->diameter, state->count * sizeof(double));
    for (int a = 0; a < 3; a++) {
        memcpy(copy->position[a], state->position[a], state->count * sizeof(double));
        memcpy(copy->velocity[a], state->velocity[a], state->count * sizeof(double));
        memcpy(copy->image[a], state->image[a], state->count * sizeof(int32_t));
    }
    copy->step = state->step;
    return copy;
}

static Reference *reference_of(State *state, double interval, bool thermostatted, bool all_pairs) {
    Reference *reference = NULL;
    ck_assert_int_eq(reference_create(&reference, state, KEY, interval, thermostatted, all_pairs),
                     OK);
    return reference;
}

static double energy(const State *state) {
    double sum = 0;
    for (size_t i = 0; i < state->count; i++) {
        for (int a = 0; a < state->box.dimension; a++) {
            sum += state->mass[i] * state->velocity[a][i] * state->velocity[a][i] / 2;
        }
    }
    return sum;
}

static double momentum(const State *state, int axis) {
    double sum = 0;
    for (size_t i = 0; i < state->count; i++) sum += state->mass[i] * state->velocity[axis][i];
    return sum;
}

static void place(State *state, size_t i, double x, double y, double vx, double vy) {
    state->diameter[i] = 1;
    state->position[0][i] = x;
    state->position[1][i] = y;
    state->velocity[0][i] = vx;
    state->velocity[1][i] = vy;
}

// r = (0,0), (3,1/2); v = (1,0), (-1,0): t = (6 - sqrt 3)/4, v' = -+(1/2, sqrt(3)/2). Here across
// the edge of the box, where it must be the same.
static void check_two_discs(bool all_pairs) {
    const System system = system_of(2, 2, 0.015);
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    const double edge = state->box.edge[0];
    place(state, 0, edge - 0.25, edge - 0.25, 1, 0);
    place(state, 1, 2.75, 0.25, -1, 0);
    ReferenceCollision first;
    ReferenceLog log = {.records = &first, .capacity = 1};
    Tally tally = {0};
    Reference *reference = reference_of(state, 2, false, all_pairs);
    reference_record(reference, &log);
    reference_advance(reference, 1, &tally);
    const double time = (6 - sqrt(3)) / 4;
    ck_assert_uint_eq(log.count, 1);
    ck_assert_double_eq_tol(first.time, time, 1e-12);
    ck_assert_double_eq_tol(state->velocity[0][0], -0.5, 1e-12);
    ck_assert_double_eq_tol(state->velocity[1][0], -sqrt(0.75), 1e-12);
    ck_assert_double_eq_tol(state->velocity[0][1], 0.5, 1e-12);
    ck_assert_double_eq_tol(state->velocity[1][1], sqrt(0.75), 1e-12);
    ck_assert_double_eq_tol(state_unfolded(state, 0, 0), edge - 0.25 + time - 0.5 * (2 - time),
                            1e-12);
    // r_a (dp)_b: r = (2 t - 3, -1/2), dp = (-3/2, -sqrt(3)/2).
    ck_assert_double_eq_tol(tally.exchange[0][0], -1.5 * (2 * time - 3), 1e-12);
    ck_assert_double_eq_tol(tally.exchange[0][1], -sqrt(0.75) * (2 * time - 3), 1e-12);
    ck_assert_double_eq_tol(tally.exchange[1][1], 0.5 * sqrt(0.75), 1e-12);
    reference_free(reference);
    state_free(state);
}

START_TEST(two_discs_collide_when_and_as_they_should) {
    check_two_discs(false);
    check_two_discs(true);
}
END_TEST

START_TEST(four_discs_may_meet_at_once) {
    const System system = system_of(2, 4, 0.05);
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < 4; i++) {
        const double x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1;
        place(state, i, 4 + x, 4 + y, -x, -y);
    }
    Tally tally = {0};
    Reference *reference = reference_of(state, 1, false, false);
    reference_advance(reference, 1, &tally);
    ck_assert_uint_ge(tally.collisions, 4);
    ck_assert_double_eq_tol(energy(state), 4, 1e-14);
    for (int a = 0; a < 2; a++) ck_assert_double_eq_tol(momentum(state, a), 0, 1e-14);
    for (size_t i = 0; i < 4; i++) { // all go back the way they came
        ck_assert_double_eq_tol(state->velocity[0][i], i & 1 ? 1 : -1, 1e-14);
        ck_assert_double_eq_tol(state->velocity[1][i], i & 2 ? 1 : -1, 1e-14);
    }
    reference_free(reference);
    state_free(state);
}
END_TEST

START_TEST(energy_and_momentum_are_conserved_and_nothing_overlaps) {
    for (int dimension = 2; dimension <= 3; dimension++) {
        const System system = mixture_of(dimension, dimension == 2 ? 144 : 216, 0.35);
        State *state = lattice(&system);
        draw_velocities(state);
        const double before = energy(state);
        double drift[3] = {momentum(state, 0), momentum(state, 1), momentum(state, 2)};
        Tally tally = {0};
        Reference *reference = reference_of(state, 0.5, false, false);
        for (int k = 0; k < 60; k++) {
            double deepest = 0;
            reference_advance(reference, 1, &tally);
            ck_assert_int_eq(state_validate(state), OK);
            ck_assert_int_eq(state_deepest_overlap(state, 1e-12, &deepest, NULL), OK);
            ck_assert_double_le(deepest, 1e-12);
        }
        ck_assert_uint_gt(tally.collisions, 4000);
        ck_assert_double_le(tally.deepest_contact, 1e-12);
        ck_assert_double_eq_tol(energy(state) / before, 1, 1e-12);
        for (int a = 0; a < dimension; a++) {
            ck_assert_double_eq_tol(momentum(state, a), drift[a], 1e-11);
        }
        ck_assert_int_eq(state->step, 60);
        reference_free(reference);
        state_free(state);
    }
}
END_TEST

enum { LOG_SIZE = 4096 };

static void check_same(const ReferenceLog *one, const ReferenceLog *other) {
    ck_assert_uint_eq(one->count, other->count);
    ck_assert_uint_le(one->count, LOG_SIZE);
    for (size_t k = 0; k < one->count; k++) {
        ck_assert_uint_eq(one->records[k].low, other->records[k].low);
        ck_assert_uint_eq(one->records[k].high, other->records[k].high);
        ck_assert_int_eq(one->records[k].step, other->records[k].step);
        ck_assert_double_eq_tol(one->records[k].time, other->records[k].time, 1e-10);
    }
}

// Interval by interval from the same state, so that chaos does not part the two.
static void check_cells_against_all_pairs(const System *system, bool thermostatted) {
    static ReferenceCollision records[2][LOG_SIZE];
    ReferenceLog cells = {.records = records[0], .capacity = LOG_SIZE};
    ReferenceLog pairs = {.records = records[1], .capacity = LOG_SIZE};
    State *state = lattice(system);
    draw_velocities(state);
    Tally tally = {0};
    for (int k = 0; k < 200; k++) {
        State *copy = copy_of(state);
        Reference *by_cells = reference_of(state, 0.1, thermostatted, false);
        Reference *by_pairs = reference_of(copy, 0.1, thermostatted, true);
        reference_record(by_cells, &cells);
        reference_record(by_pairs, &pairs);
        reference_advance(by_cells, 1, &tally);
        reference_advance(by_pairs, 1, &tally);
        check_same(&cells, &pairs);
        cells.count = pairs.count = 0;
        reference_free(by_cells);
        reference_free(by_pairs);
        state_free(copy);
    }
    ck_assert_uint_gt(tally.collisions, 2000);
    state_free(state);
}

START_TEST(cells_find_the_collisions_that_all_pairs_find) {
    const System discs = mixture_of(2, 64, 0.5), spheres = mixture_of(3, 64, 0.35);
    check_cells_against_all_pairs(&discs, true);
    check_cells_against_all_pairs(&discs, false);
    check_cells_against_all_pairs(&spheres, true);
}
END_TEST

// Z = 1 + tr(exchange)/(dimension N kT t), and the collision rate, each counted for both partners:
// (2 dimension/sqrt pi)(Z - 1) for equal particles. The error is that of twenty blocks; the effect
// of a finite number of particles, of order (Z - 1)/N, is below the tolerance.
static void check_pressure(const System *system, double expected, double tolerance) {
    enum { BLOCKS = 20, INTERVALS = 20 };
    const double interval = 0.25, time = BLOCKS * INTERVALS * interval;
    State *state = lattice(system);
    const double count = (double)state->count;
    const int dimension = state->box.dimension;
    Tally melting = {0}, tally = {0};
    Reference *reference = reference_of(state, interval, true, false);
    reference_advance(reference, 60, &melting);
    double sum = 0, square = 0;
    for (int block = 0; block < BLOCKS; block++) {
        Tally part = {0};
        reference_advance(reference, INTERVALS, &part);
        double trace = 0;
        for (int a = 0; a < dimension; a++) trace += part.exchange[a][a];
        const double z = 1 + trace / (dimension * count * INTERVALS * interval);
        sum += z;
        square += z * z;
        tally_add(&tally, &part);
    }
    const double mean = sum / BLOCKS;
    const double error = sqrt((square / BLOCKS - mean * mean) / (BLOCKS - 1));
    const double rate = 2 * (double)tally.collisions / (count * time);
    const double from_rate = 1 + rate * sqrt(PI) / (2 * dimension);
    ck_assert_double_le(error, tolerance / 3);
    ck_assert_double_eq_tol(mean, expected, tolerance);
    ck_assert_double_eq_tol(from_rate, expected, tolerance);
    reference_free(reference);
    state_free(state);
}

// Discs at 0.4: 2.8293, spheres at 0.3: 3.9842, resummed virial series (Clisby and McCoy 2006).
START_TEST(the_pressure_is_that_of_the_equation_of_state) {
    const System discs = system_of(2, 784, 0.4), spheres = system_of(3, 512, 0.3);
    check_pressure(&discs, 2.8293, 0.03);
    check_pressure(&spheres, 3.9842, 0.04);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("reference engine");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 120);
    tcase_add_test(all, two_discs_collide_when_and_as_they_should);
    tcase_add_test(all, four_discs_may_meet_at_once);
    tcase_add_test(all, energy_and_momentum_are_conserved_and_nothing_overlaps);
    tcase_add_test(all, cells_find_the_collisions_that_all_pairs_find);
    tcase_add_test(all, the_pressure_is_that_of_the_equation_of_state);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
