// SPDX-License-Identifier: GPL-3.0-or-later
// Packings: dense enough, without overlap, of the right sizes, forgetful of the lattice they began
// on, and a pure function of system and key.
#include "packing/lattice.h"
#include "packing/packing.h"

#include "base/constants.h"
#include "observe.h"
#include "suite.h"

static const RngKey KEY = {.seed = 3};

static State *packed(const System *system, RngKey key, PackingReport *report) {
    State *state = NULL;
    ck_assert_msg(packing_create(&state, system, key, NULL, report) == OK, "%s", status_sentence());
    return state;
}

static void check_valid(const State *state) {
    double deepest = 1;
    ck_assert_int_eq(state_validate(state), OK);
    ck_assert_int_eq(state_deepest_overlap(state, 0, &deepest, NULL), OK);
    ck_assert(deepest <= 0);
    ck_assert_double_eq_tol(state_packing_fraction(state), system_packing_fraction(&state->system),
                            1e-12);
    ck_assert_int_eq(state->step, 0);
}

static System polydisperse_spheres(int64_t spread, double width, double packing_fraction) {
    System system = system_of(3, 400, packing_fraction, 1);
    system.species[0].spread = spread;
    system.species[0].spread_width = width;
    return system;
}

START_TEST(dense_mixtures_and_polydisperse_spheres_are_reached) {
    const System systems[] = {
        system_of(2, 1000, 0.81, 2), polydisperse_spheres(SPREAD_GAUSSIAN, 0.1, 0.58),
        system_of(3, 400, 0.50, 1), system_of(2, 400, 0.10, 2), system_of(2, 12, 0.70, 1)};
    PackingReport report;
    State *state = packed(&systems[_i], KEY, &report);
    check_valid(state);
    ck_assert_int_gt(report.windows, 0);
    ck_assert_double_gt(report.seconds, 0);
    for (size_t i = 0; i < state->count; i++) {
        const Species *species = &systems[_i].species[state->species_of[i]];
        if (species->spread == SPREAD_NONE)
            ck_assert_double_eq(state->diameter[i], species->diameter);
    }
    state_free(state);
}
END_TEST

START_TEST(sizes_have_the_spread_that_was_asked_for) {
    const int64_t spread = _i ? SPREAD_GAUSSIAN : SPREAD_UNIFORM;
    State *state = packed(&(System){.dimension = 2,
                                    .particles = 4000,
                                    .packing_fraction = 0.05,
                                    .species_count = 1,
                                    .species = {{.shape = SHAPE_DISC,
                                                 .diameter = 2,
                                                 .mass = 1,
                                                 .fraction = 1,
                                                 .spread = spread,
                                                 .spread_width = 0.1}}},
                          KEY, NULL);
    double mean = 0, variance = 0;
    for (size_t i = 0; i < state->count; i++) mean += state->diameter[i] / 4000;
    for (size_t i = 0; i < state->count; i++) {
        const double deviation = state->diameter[i] / mean - 1;
        variance += deviation * deviation / 4000;
        ck_assert_double_le(fabs(deviation), 0.31);
    }
    // Cutting a Gaussian at three widths takes 1.3 % of its width.
    ck_assert_double_eq_tol(mean, 2, 5 * 0.2 / sqrt(4000));
    ck_assert_double_eq_tol(sqrt(variance), _i ? 0.0987 : 0.1, 5 * 0.1 / sqrt(2 * 4000));
    check_valid(state);
    state_free(state);
}
END_TEST

START_TEST(equal_keys_give_equal_packings_and_others_do_not) {
    const System system = system_of(2, 200, 0.7, 2);
    State *one = packed(&system, KEY, NULL), *same = packed(&system, KEY, NULL);
    State *other = packed(&system, (RngKey){.seed = 3, .replica = 1}, NULL);
    for (int a = 0; a < 2; a++) {
        ck_assert_mem_eq(one->position[a], same->position[a], 200 * sizeof(double));
        ck_assert_mem_ne(one->position[a], other->position[a], 200 * sizeof(double));
    }
    state_free(one);
    state_free(same);
    state_free(other);
}
END_TEST

// |rho(q)|^2/N at a reciprocal vector of the lattice the packing began on: N in the crystal, of
// order S(q) < 3 in the fluid; an exponential of mean S exceeds 15 S with probability 3e-7.
START_TEST(masses_do_not_matter) {
    System system = system_of(2, 100, 0.6, 2);
    State *equal = packed(&system, KEY, NULL);
    system.species[0].mass = 1e4;
    system.species[1].mass = 0.01;
    State *unequal = packed(&system, KEY, NULL);
    for (size_t i = 0; i < equal->count; i++) {
        ck_assert_double_eq(equal->position[0][i], unequal->position[0][i]);
        ck_assert_double_eq(equal->position[1][i], unequal->position[1][i]);
        ck_assert_double_eq(unequal->mass[i], unequal->species_of[i] ? 0.01 : 1e4);
    }
    state_free(equal);
    state_free(unequal);
}
END_TEST

START_TEST(the_lattice_is_forgotten) {
    System system = system_of(2, 400, 0.5, 1);
    system.species[0].diameter = _i ? 50 : 1;
    State *state = packed(&system, KEY, NULL);
    const Lattice lattice = lattice_best(&state->box, state->count);
    for (int a = 0; a < 2; a++) {
        const double q = 2 * PI / lattice.cell[a] * lattice.basis;
        double re = 0, im = 0;
        for (size_t i = 0; i < state->count; i++) {
            re += cos(q * state->position[a][i]);
            im += sin(q * state->position[a][i]);
        }
        ck_assert_double_le((re * re + im * im) / 400, 45);
    }
    state_free(state);
}
END_TEST

START_TEST(a_lattice_has_room_for_all_and_its_nearest_distance) {
    static const double aspects[][3] = {{1, 1, 1}, {4, 1, 1}, {1, 2, 5}};
    static const size_t counts[] = {1, 2, 12, 100, 1000};
    for (int dimension = 2; dimension <= 3; dimension++) {
        const Box box = box_of_volume(dimension, (double)counts[_i], aspects[_i % 3]);
        const Lattice lattice = lattice_best(&box, counts[_i]);
        const size_t sites = lattice_sites(&lattice);
        ck_assert_uint_ge(sites, counts[_i]);
        double nearest = INFINITY;
        for (size_t p = 0; p < sites; p++) {
            double at[3], to[3], r[3];
            lattice_site(&lattice, p, at);
            for (int a = 0; a < dimension; a++) ck_assert(at[a] >= 0 && at[a] < box.edge[a]);
            for (size_t q = 0; q < p; q++) {
                lattice_site(&lattice, q, to);
                double r2 = 0;
                for (int a = 0; a < 3; a++) r[a] = at[a] - to[a];
                box_nearest_image(&box, r);
                for (int a = 0; a < dimension; a++) r2 += r[a] * r[a];
                nearest = fmin(nearest, sqrt(r2));
            }
        }
        ck_assert_double_le(lattice.nearest, nearest * (1 + 1e-12));
        if (counts[_i] >= 12) ck_assert_double_ge(lattice.nearest, 0.8); // of 1.07 to 1.12
    }
}
END_TEST

START_TEST(impossible_densities_are_refused) {
    System system = system_of(2, 1000, 0.9, 2);
    ck_assert_int_eq(packing_check(&system), BAD_DATA);
    system = system_of(3, 1000, 0.7, 1);
    ck_assert_int_eq(packing_check(&system), BAD_DATA);
    system = system_of(3, 1000, 0.5, 1);
    ck_assert_int_eq(packing_check(&system), OK);
}
END_TEST

// Equal discs at 0.86 must order: with this key the first growth jams, the second does not.
START_TEST(growth_that_jams_is_repeated_more_slowly) {
    const System system = system_of(2, 1000, 0.86, 1);
    PackingReport report;
    State *state = packed(&system, (RngKey){.seed = 2}, &report);
    check_valid(state);
    ck_assert_int_gt(report.windows, 10000); // once takes 5000
    state_free(state);
}
END_TEST

START_TEST(packing_stops_when_asked) {
    const System system = system_of(2, 1000, 0.7, 2);
    const atomic_int stop = 1;
    State *state = NULL;
    ck_assert_int_eq(packing_create(&state, &system, KEY, &stop, NULL), INTERRUPTED);
    ck_assert_ptr_null(state);
}
END_TEST

static const Species ROD = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 1, .length = 3};
static const Species BALL = {.shape = SHAPE_SPHERE, .diameter = 1.5};
static const Species PLATELET = {.shape = SHAPE_PLATELET, .diameter = 1};
static const Species SOFT = {.shape = SHAPE_SOFT_SPHERE, .diameter = 1, .exponent = 36};

// Equal numbers of one or two species, in three dimensions.
static System bodies(int64_t particles, Species one, const Species *other) {
    System system = {.dimension = 3, .particles = particles, .species_count = other ? 2 : 1};
    system.species[0] = one;
    if (other) system.species[1] = *other;
    for (size_t s = 0; s < system.species_count; s++) {
        system.species[s].mass = 1;
        system.species[s].fraction = 1 / (double)system.species_count;
    }
    return system;
}

static double order_along(const State *state, int axis) {
    double sum = 0;
    for (size_t i = 0; i < state->count; i++) {
        const double u = state->orientation[axis][i];
        sum += (3 * u * u - 1) / 2 / (double)state->count;
    }
    return sum;
}

// Isotropic: <P2> along a given axis is 0 within 1/sqrt(5 N) of independent bodies; correlations
// below the transition widen it.
START_TEST(rods_are_compressed_in_disorder) {
    System system = bodies(200, ROD, NULL);
    system.packing_fraction = 0.2;
    PackingReport report;
    State *state = packed(&system, KEY, &report);
    check_valid(state);
    ck_assert_double_lt(report.lattice_scale, 0.7);
    for (int a = 0; a < 3; a++) ck_assert_double_lt(fabs(order_along(state, a)), 5 * 0.0316 * 1.5);
    state_free(state);
}
END_TEST

START_TEST(platelets_and_mixtures_with_spheres_are_compressed) {
    System systems[] = {bodies(200, PLATELET, NULL), bodies(150, ROD, &BALL),
                        bodies(100, PLATELET, &BALL)};
    systems[0].number_density = 3;
    systems[1].packing_fraction = 0.3;
    systems[2].number_density = 0.15;
    State *state = packed(&systems[_i], KEY, NULL);
    State *same = packed(&systems[_i], KEY, NULL);
    check_valid(state);
    for (int a = 0; a < 3; a++) {
        const size_t bytes = state->count * sizeof(double);
        ck_assert_mem_eq(state->position[a], same->position[a], bytes);
        ck_assert_mem_eq(state->orientation[a], same->orientation[a], bytes);
        for (size_t i = 0; i < state->count; i++) ck_assert_int_eq(state->image[a][i], 0);
    }
    state_free(state);
    state_free(same);
}
END_TEST

START_TEST(crystals_stand_upright_and_do_not_overlap) {
    System systems[] = {bodies(400, ROD, NULL),       bodies(400, ROD, NULL),
                        bodies(1000, PLATELET, NULL), bodies(200, ROD, &BALL),
                        bodies(500, SOFT, NULL),      bodies(256, BALL, NULL)};
    const double packing_fractions[] = {0.2, 0.6, 0, 0.15, 0.7, 0.7};
    systems[_i].packing_fraction = packing_fractions[_i];
    if (_i == 2) systems[_i].number_density = 100;
    systems[_i].start = START_CRYSTAL;
    State *state = packed(&systems[_i], KEY, NULL);
    check_valid(state);
    for (size_t i = 0; state->oriented && i < state->count; i++) {
        ck_assert_double_eq(state->orientation[2][i], 1);
    }
    state_free(state);
}
END_TEST

// As hard spheres of 0.5 they do not come nearer than cbrt(0.5/0.7).
START_TEST(soft_spheres_begin_apart) {
    System system = bodies(500, SOFT, NULL);
    system.packing_fraction = 0.7;
    State *state = packed(&system, KEY, NULL);
    check_valid(state);
    double nearest2 = INFINITY;
    for (size_t i = 0; i < state->count; i++) {
        ck_assert_double_eq(state->diameter[i], 1);
        for (size_t j = 0; j < i; j++) {
            double r[3], r2 = 0;
            for (int a = 0; a < 3; a++) r[a] = state->position[a][i] - state->position[a][j];
            box_nearest_image(&state->box, r);
            for (int a = 0; a < 3; a++) r2 += r[a] * r[a];
            nearest2 = fmin(nearest2, r2);
        }
    }
    ck_assert_double_ge(sqrt(nearest2), cbrt(0.5 / 0.7));
    state_free(state);
}
END_TEST

START_TEST(bodies_that_cannot_be_packed_are_refused_in_a_sentence) {
    System system = bodies(400, ROD, NULL);
    system.packing_fraction = 0.6;
    ck_assert_int_eq(packing_check(&system), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "crystal"));
    system.packing_fraction = 0.9;
    system.start = START_CRYSTAL;
    ck_assert_int_eq(packing_check(&system), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "layers"));
    system = bodies(1000, PLATELET, NULL);
    system.number_density = 20;
    ck_assert_int_eq(packing_check(&system), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "platelets"));
    const atomic_int stop = 1;
    State *state = NULL;
    system.number_density = 1;
    ck_assert_int_eq(packing_create(&state, &system, KEY, &stop, NULL), INTERRUPTED);
    ck_assert_ptr_null(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("packing");
    TCase *packing = tcase_create("packing");
    tcase_set_timeout(packing, 120);
    tcase_add_loop_test(packing, dense_mixtures_and_polydisperse_spheres_are_reached, 0, 5);
    tcase_add_loop_test(packing, sizes_have_the_spread_that_was_asked_for, 0, 2);
    tcase_add_test(packing, equal_keys_give_equal_packings_and_others_do_not);
    tcase_add_test(packing, masses_do_not_matter);
    tcase_add_loop_test(packing, the_lattice_is_forgotten, 0, 2);
    tcase_add_loop_test(packing, a_lattice_has_room_for_all_and_its_nearest_distance, 0, 5);
    tcase_add_test(packing, impossible_densities_are_refused);
    tcase_add_test(packing, growth_that_jams_is_repeated_more_slowly);
    tcase_add_test(packing, packing_stops_when_asked);
    tcase_add_test(packing, rods_are_compressed_in_disorder);
    tcase_add_loop_test(packing, platelets_and_mixtures_with_spheres_are_compressed, 0, 3);
    tcase_add_loop_test(packing, crystals_stand_upright_and_do_not_overlap, 0, 6);
    tcase_add_test(packing, soft_spheres_begin_apart);
    tcase_add_test(packing, bodies_that_cannot_be_packed_are_refused_in_a_sentence);
    suite_add_tcase(suite, packing);
    return run_suite(suite);
}
