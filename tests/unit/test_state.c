// SPDX-License-Identifier: GPL-3.0-or-later
// What a State promises of bodies: axes of length 1 that a checkpoint carries, overlaps that the
// health check finds as all pairs do.
#include "observe.h"
#include "suite.h"
#include "shapes/overlap.h"

static const RngKey KEY = {.seed = 11};

static System bodies(const Species *species, size_t count, int64_t particles, double density) {
    System system = {
        .dimension = 3, .particles = particles, .number_density = density, .species_count = count};
    for (size_t s = 0; s < count; s++) {
        system.species[s] = species[s];
        system.species[s].mass = 1;
        system.species[s].fraction = 1 / (double)count;
    }
    return system;
}

static const Species ROD = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 1, .length = 3};
static const Species SPHERE = {.shape = SHAPE_SPHERE, .diameter = 1.5};
static const Species PLATELET = {.shape = SHAPE_PLATELET, .diameter = 1};
static const Species SOFT = {.shape = SHAPE_SOFT_SPHERE, .diameter = 1, .exponent = 36};

// Random places and axes, as an ideal gas of bodies has them.
static State *gas(const System *system) {
    State *state = new_state(system);
    scatter(state, KEY, 0);
    Rng rng = rng_open(KEY, STREAM_ORIENTING, 0, 0);
    for (size_t i = 0; state->oriented && i < state->count; i++) {
        double u[3], square = 0;
        for (int a = 0; a < 3; a++) {
            u[a] = rng_normal(&rng);
            square += u[a] * u[a];
        }
        for (int a = 0; a < 3; a++) state->orientation[a][i] = u[a] / sqrt(square);
    }
    return state;
}

START_TEST(a_body_axis_must_keep_its_length) {
    const System system = bodies(&ROD, 1, 20, 0.01);
    State *state = gas(&system);
    ck_assert_int_eq(state_validate(state), OK);
    ck_assert_double_lt(state_orientation_drift(state), 1e-15);
    for (int a = 0; a < 3; a++) state->orientation[a][7] *= 1 + 5e-10;
    ck_assert_int_eq(state_validate(state), OK);
    ck_assert_double_eq_tol(state_orientation_drift(state), 5e-10, 1e-14);
    for (int a = 0; a < 3; a++) state->orientation[a][7] *= 1 + 1e-9;
    ck_assert_int_eq(state_validate(state), UNHEALTHY);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "particle 7"));
    state->orientation[1][7] = NAN;
    ck_assert_int_eq(state_validate(state), UNHEALTHY);
    state_free(state);
}
END_TEST

START_TEST(what_has_no_axis_does_not_drift) {
    const System system = bodies(&SPHERE, 1, 20, 0.01);
    State *state = gas(&system);
    ck_assert_double_eq(state_orientation_drift(state), 0);
    ck_assert_int_eq(state_validate(state), OK);
    state_free(state);
}
END_TEST

START_TEST(a_checkpoint_carries_the_axes_to_the_bit) {
    const Species species[2] = {ROD, SPHERE};
    const System system = bodies(species, 2, 40, 0.01);
    State *saved = gas(&system), *loaded = NULL;
    Archive writer = archive_writer();
    state_archive(saved, &writer);
    ck_assert_int_eq(state_create(&loaded, &system), OK);
    Archive reader = archive_reader(writer.bytes, writer.size);
    state_archive(loaded, &reader);
    ck_assert_int_eq(archive_status(&reader, true), OK);
    for (int a = 0; a < 3; a++) {
        ck_assert_mem_eq(saved->orientation[a], loaded->orientation[a], 40 * sizeof(double));
    }
    saved->orientation[2][3] += 1e-3;
    Archive poison = archive_writer();
    state_archive(saved, &poison);
    Archive bad = archive_reader(poison.bytes, poison.size);
    state_archive(loaded, &bad);
    ck_assert_int_eq(archive_status(&bad, true), BAD_DATA);
    archive_free(&writer);
    archive_free(&poison);
    state_free(saved);
    state_free(loaded);
}
END_TEST

START_TEST(soft_spheres_have_no_overlaps) {
    const System system = bodies(&SOFT, 1, 50, 2);
    State *state = gas(&system);
    double deepest = -1;
    uint64_t pairs = 99;
    ck_assert_int_eq(state_deepest_overlap(state, 0, &deepest, &pairs), OK);
    ck_assert_double_eq(deepest, 0);
    ck_assert_uint_eq(pairs, 0);
    state_free(state);
}
END_TEST

static double depth_of(System *system, double x, double z, const double axis[3], uint64_t *pairs) {
    State *state = new_state(system);
    for (int a = 0; a < 3; a++) state->position[a][0] = state->position[a][1] = 1;
    state->position[0][1] += x;
    state->position[2][1] += z;
    for (int a = 0; a < 3; a++) state->orientation[a][1] = axis[a];
    double deepest = -1;
    ck_assert_int_eq(state_deepest_overlap(state, 0.01, &deepest, pairs), OK);
    state_free(state);
    return deepest;
}

// Rods along z beside and above each other, crossed; platelets that cut each other at right angles.
START_TEST(depths_of_bodies_are_what_they_are_said_to_be) {
    static const double Z[3] = {0, 0, 1}, X[3] = {1, 0, 0};
    uint64_t pairs;
    System rods = bodies(&ROD, 1, 2, 1e-4);
    ck_assert_double_eq_tol(depth_of(&rods, 0.9, 2, Z, &pairs), 0.1, 1e-12);
    ck_assert_uint_eq(pairs, 1);
    ck_assert_double_eq_tol(depth_of(&rods, 0, 3.75, Z, &pairs), 0.25, 1e-12);
    ck_assert_double_eq_tol(depth_of(&rods, 0, 2.3, X, &pairs), 0.2, 1e-12);
    ck_assert_double_eq(depth_of(&rods, 0, 2.6, X, &pairs), 0);
    ck_assert_uint_eq(pairs, 0);
    System platelets = bodies(&PLATELET, 1, 2, 1e-3);
    // Half chords 0.5 of the first and 0.3 of the second, 0.4 below its middle: 0.6 shared.
    ck_assert_double_eq_tol(depth_of(&platelets, 0, 0.4, X, &pairs), 0.6, 1e-12);
    ck_assert_double_eq_tol(depth_of(&platelets, 0.8, 0, Z, &pairs), 0.2, 1e-12); // coplanar
    ck_assert_double_eq(depth_of(&platelets, 0.1, 0.01, Z, &pairs), 0);
    const Species both[2] = {PLATELET, SPHERE};
    System mixture = bodies(both, 2, 2, 1e-3);
    ck_assert_double_eq_tol(depth_of(&mixture, 0, 0.6, Z, &pairs), 0.2, 1e-12);
    ck_assert_double_eq_tol(depth_of(&mixture, 1.1, 0, Z, &pairs), 0.2, 1e-12);
}
END_TEST

// The slow twin: every pair, by the rule that the engines use.
static uint64_t overlapping_pairs(const State *state) {
    uint64_t pairs = 0;
    for (size_t i = 0; i < state->count; i++) {
        for (size_t j = i + 1; j < state->count; j++) {
            const Body a = species_body(&state->system.species[state->species_of[i]]);
            const Body b = species_body(&state->system.species[state->species_of[j]]);
            double r[3], u[3], v[3];
            for (int k = 0; k < 3; k++) {
                r[k] = state->position[k][j] - state->position[k][i];
                u[k] = state->orientation[k][i];
                v[k] = state->orientation[k][j];
            }
            box_nearest_image(&state->box, r);
            pairs += overlap_of(&a, u, &b, v, r);
        }
    }
    return pairs;
}

START_TEST(cells_find_the_bodies_that_overlap) {
    const Species pairs_of_species[3][2] = {
        {ROD, SPHERE}, {PLATELET, SPHERE}, {PLATELET, PLATELET}};
    const System system = bodies(pairs_of_species[_i], 2, 600, _i ? 0.5 : 0.05);
    State *state = gas(&system);
    double deepest = 0;
    uint64_t pairs = 0;
    ck_assert_int_eq(state_deepest_overlap(state, 0, &deepest, &pairs), OK);
    ck_assert_uint_gt(pairs, 20);
    ck_assert_uint_eq(pairs, overlapping_pairs(state));
    ck_assert_double_gt(deepest, 0.5);
    state_free(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("state");
    TCase *state = tcase_create("state");
    tcase_add_test(state, a_body_axis_must_keep_its_length);
    tcase_add_test(state, what_has_no_axis_does_not_drift);
    tcase_add_test(state, a_checkpoint_carries_the_axes_to_the_bit);
    tcase_add_test(state, soft_spheres_have_no_overlaps);
    tcase_add_test(state, depths_of_bodies_are_what_they_are_said_to_be);
    tcase_add_loop_test(state, cells_find_the_bodies_that_overlap, 0, 3);
    suite_add_tcase(suite, state);
    return run_suite(suite);
}
