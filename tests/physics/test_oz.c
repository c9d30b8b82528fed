// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of hard discs and spheres against exact results and independent solutions.
#include "suite.h"

#include "base/patience.h"
#include "oz/inside.h"
#include "oz/oz.h"

#include <check.h>
#include <math.h>
#include <string.h>

static const Mixture DISCS = {2, 1, {1}, {1}};
static const Mixture SPHERES = {3, 1, {1}, {1}};

// Solves at one packing fraction for wave numbers q.
static Oz *solved(Closure closure, const Mixture *mixture, double packing_fraction, const double *q,
                  size_t count, const Structure **structure) {
    Oz *oz = NULL;
    ck_assert_msg(oz_create(&oz, closure, mixture, q, count) == OK, "%s", status_sentence());
    ck_assert_msg(oz_solve(oz, packing_fraction, structure) == OK, "%s", status_sentence());
    return oz;
}

START_TEST(percus_yevick_spheres_have_their_closed_compressibility_and_contact_value) {
    static const double densities[] = {0.1, 0.3, 0.5};
    const double q = 1e-4;
    for (int i = 0; i < 3; i++) {
        const double f = densities[i];
        const Structure *s = NULL;
        Oz *oz = solved(CLOSURE_PERCUS_YEVICK, &SPHERES, f, &q, 1, &s);
        ck_assert_double_eq_tol(1 / s->factor[0] * pow(1 - f, 4) / pow(1 + 2 * f, 2), 1, 1e-6);
        ck_assert_double_eq_tol(s->contact[0], (1 + f / 2) / pow(1 - f, 2), 1e-12);
        oz_free(oz);
    }
}
END_TEST

// To first order in density g(1) = 1 + (overlap of two discs at contact) rho: 1 + 1.564009 phi.
START_TEST(percus_yevick_discs_are_exact_to_first_order) {
    const double f = 1e-4, q = 1, overlap = 2 * M_PI / 3 - sqrt(3) / 2;
    const Structure *s = NULL;
    Oz *oz = solved(CLOSURE_PERCUS_YEVICK, &DISCS, f, &q, 1, &s);
    const double slope = 4 / M_PI * overlap;
    ck_assert_double_eq_tol((s->contact[0] - 1) / f, slope, 5 * f);
    oz_free(oz);
}
END_TEST

// Contact value and peak from an independent solution by Hankel transforms with extrapolated
// spacing; six digits of it are trusted.
START_TEST(percus_yevick_discs_agree_with_another_solver) {
    const double q = 6.357;
    const Structure *s = NULL;
    Oz *oz = solved(CLOSURE_PERCUS_YEVICK, &DISCS, 0.69, &q, 1, &s);
    ck_assert_double_eq_tol(s->contact[0], 6.14516, 5e-6);
    ck_assert(oz_effort(oz).residual < 1e-9);
    oz_free(oz);
}
END_TEST

// The virial contact value (Z - 1)/(2 phi) to third order in density: PY is exact through b3.
START_TEST(percus_yevick_discs_have_the_third_virial_coefficient) {
    const double f = 0.01, q = 1;
    const Structure *s = NULL;
    Oz *oz = solved(CLOSURE_PERCUS_YEVICK, &DISCS, f, &q, 1, &s);
    const double z = 1 + 2 * f * s->contact[0];
    ck_assert_double_eq_tol((z - 1 - 2 * f) / (f * f), 3.128018, 5 * f);
    oz_free(oz);
}
END_TEST

static void expect_equals_are_pure(const Mixture *pure, double f) {
    static const double q[] = {0.3, 3, 6.4, 11, 33};
    Mixture twins = {pure->dimension, 2, {1, 1}, {0.3, 0.7}};
    const Structure *one = NULL, *two = NULL;
    Oz *a = solved(CLOSURE_PERCUS_YEVICK, pure, f, q, 5, &one);
    Oz *b = solved(CLOSURE_PERCUS_YEVICK, &twins, f, q, 5, &two);
    for (size_t i = 0; i < 5; i++) {
        const double sum = two->factor[i] + 2 * two->factor[5 + i] + two->factor[10 + i];
        ck_assert_double_eq_tol(sum, one->factor[i], 1e-8 * one->factor[i]);
    }
    ck_assert_double_eq_tol(two->contact[1], one->contact[0], 1e-8);
    oz_free(a);
    oz_free(b);
}

START_TEST(a_mixture_of_equals_is_the_pure_fluid) {
    expect_equals_are_pure(&DISCS, 0.69);
    expect_equals_are_pure(&SPHERES, 0.5);
}
END_TEST

// A scale of lengths changes no structure.
START_TEST(lengths_have_no_scale) {
    static const double q[] = {6.4, 3.2};
    const Mixture small = {2, 2, {1, 1.4}, {0.5, 0.5}}, large = {2, 2, {2, 2.8}, {0.5, 0.5}};
    const Structure *a = NULL, *b = NULL;
    Oz *first = solved(CLOSURE_PERCUS_YEVICK, &small, 0.6, q, 2, &a);
    Oz *second = solved(CLOSURE_PERCUS_YEVICK, &large, 0.6, q, 2, &b);
    for (size_t pair = 0; pair < 3; pair++) {
        ck_assert_double_eq_tol(a->contact[pair], b->contact[pair], 1e-7);
        ck_assert_double_eq_tol(a->factor[2 * pair], b->factor[2 * pair + 1], 1e-7);
    }
    oz_free(first);
    oz_free(second);
}
END_TEST

START_TEST(closed_forms_of_discs_reproduce_their_numbers) {
    const double q[] = {1e-3, 6.3562, 6.3566, 6.357, 6.3574, 6.3578}, f = 0.69;
    double peak = 0;
    const Structure *s = NULL;
    Oz *oz = solved(CLOSURE_FUNDAMENTAL, &DISCS, f, q, 1, &s);
    ck_assert_double_eq_tol(s->direct[0], -M_PI / 4 * (4 - 3 * f + f * f) / pow(1 - f, 3), 2e-5);
    oz_free(oz);
    oz = solved(CLOSURE_BAUS_COLOT, &DISCS, f, q, 6, &s);
    for (size_t i = 1; i < 6; i++) peak = fmax(peak, s->factor[i]);
    ck_assert_double_eq_tol(peak, 3.83019, 5e-5); // read off a grid of wave numbers
    oz_free(oz);
    oz = solved(CLOSURE_BAUS_COLOT, &DISCS, 0.5, q, 1, &s);
    ck_assert_double_eq_tol(s->contact[0], (4.107000 - 1) / (2 * 0.5), 1e-6);
    ck_assert_double_eq_tol(1 / s->factor[0], 12.48031, 2e-5);
    oz_free(oz);
}
END_TEST

// To second order in density every closure is exact: b3 of discs and b3 = 10 of spheres. The next
// order tells them apart.
START_TEST(closures_have_the_third_virial_coefficient) {
    static const Closure closures[] = {CLOSURE_HYPERNETTED_CHAIN, CLOSURE_MODIFIED_VERLET,
                                       CLOSURE_ROGERS_YOUNG};
    const double f = 0.01, q = 1;
    for (int i = 0; i < 6; i++) {
        const bool discs = i < 3;
        const Structure *s = NULL;
        Oz *oz = solved(closures[i % 3], discs ? &DISCS : &SPHERES, f, &q, 1, &s);
        const double b2 = discs ? 2 : 4, b3 = discs ? 3.128018 : 10;
        const double z = 1 + b2 * f * s->contact[0];
        ck_assert_double_eq_tol((z - 1 - b2 * f) / (f * f * b3), 1, 5 * f);
        oz_free(oz);
    }
}
END_TEST

// (Z - 1 - 4 f - 10 f^2)/f^3 of spheres by the contact value.
static double fourth_virial(Closure closure, double f) {
    const double q = 1;
    const Structure *s = NULL;
    Oz *oz = solved(closure, &SPHERES, f, &q, 1, &s);
    const double z = 1 + 4 * f * s->contact[0];
    oz_free(oz);
    return (z - 1 - 4 * f - 10 * f * f) / pow(f, 3);
}

// B4/b^3 by pressure is 0.2500 in Percus-Yevick and 0.4453 in the hypernetted chain, b = 4 f/rho
// (Hansen & McDonald, Theory of Simple Liquids, table 4.2). Rogers and Young lie between, below the
// exact 0.28695.
START_TEST(closures_have_their_own_fourth_virial_coefficient) {
    double b4[3];
    static const Closure closures[] = {CLOSURE_PERCUS_YEVICK, CLOSURE_HYPERNETTED_CHAIN,
                                       CLOSURE_ROGERS_YOUNG};
    for (int i = 0; i < 3; i++)
        b4[i] = (2 * fourth_virial(closures[i], 0.02) - fourth_virial(closures[i], 0.04)) / 64;
    ck_assert_double_eq_tol(b4[0], 0.25, 0.004);
    ck_assert_double_eq_tol(b4[1], 0.4453, 0.01);
    ck_assert(b4[2] > 0.27 && b4[2] < 0.287);
}
END_TEST

// Pressure and compressibility of Rogers and Young agree, but for the mixing's own change with
// density, which is small.
START_TEST(rogers_and_young_agree_with_themselves) {
    static const double densities[] = {0.396, 0.4, 0.404};
    const double q = 1e-3;
    double pressure[3], stiffness = 0;
    Oz *oz = NULL;
    ck_assert_int_eq(oz_create(&oz, CLOSURE_ROGERS_YOUNG, &SPHERES, &q, 1), OK);
    for (int i = 0; i < 3; i++) {
        const Structure *s = NULL;
        ck_assert_msg(oz_solve(oz, densities[i], &s) == OK, "%s", status_sentence());
        pressure[i] = densities[i] * (1 + 4 * densities[i] * s->contact[0]);
        if (i == 1) stiffness = 1 / s->factor[0];
    }
    ck_assert_double_eq_tol((pressure[2] - pressure[0]) / 0.008 / stiffness, 1, 0.03);
    oz_free(oz);
}
END_TEST

// The hypernetted chain of discs has no solution at 0.75, and its values at 0.69 lie between
// others.
START_TEST(where_a_closure_has_no_solution_it_says_so) {
    const double q = 6;
    const Structure *s = NULL;
    Oz *oz = NULL;
    ck_assert_int_eq(oz_create(&oz, CLOSURE_HYPERNETTED_CHAIN, &DISCS, &q, 1), OK);
    ck_assert_int_eq(oz_solve(oz, 0.75, &s), UNHEALTHY);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "hypernetted-chain"));
    const char *const reached =
        strstr(status_sentence(), "to packing fraction 0.75 it was solved up to 0.7");
    ck_assert_ptr_nonnull(reached);
    ck_assert(oz_effort(oz).reached > 0.7 && oz_effort(oz).reached < oz_effort(oz).at);
    ck_assert(oz_effort(oz).residual > 1e-9 && oz_effort(oz).iterations > 0);
    ck_assert_int_eq(oz_solve(oz, 0.6, &s), OK);
    ck_assert(oz_effort(oz).residual < 1e-9);
    oz_free(oz);
}
END_TEST

START_TEST(closures_of_equals_are_those_of_the_pure_fluid) {
    const Mixture twins = {2, 2, {1, 1}, {0.3, 0.7}};
    const double q = 6.4;
    const Structure *one = NULL, *two = NULL;
    Oz *a = solved(CLOSURE_MODIFIED_VERLET, &DISCS, 0.6, &q, 1, &one);
    Oz *b = solved(CLOSURE_MODIFIED_VERLET, &twins, 0.6, &q, 1, &two);
    ck_assert_double_eq_tol(two->factor[0] + 2 * two->factor[1] + two->factor[2], one->factor[0],
                            1e-7);
    ck_assert_double_eq_tol(two->contact[1], one->contact[0], 1e-7);
    oz_free(a);
    oz_free(b);
}
END_TEST

// Percus-Yevick on grids, which shares nothing with the other ways to it but the equations.
static void expect_grids_agree(const Mixture *mixture, double f, double error) {
    enum { WAVES = 6 };
    static const double q[WAVES] = {0.3, 1, 3, 5, 7, 10};
    const size_t pairs = mixture_pairs(mixture);
    const Structure *other = NULL;
    Oz *oz = solved(CLOSURE_PERCUS_YEVICK, mixture, f, q, WAVES, &other);
    Closures *closures = NULL;
    OzEffort effort;
    double direct[3 * WAVES];
    Structure s = *other;
    s.direct = direct;
    ck_assert_int_eq(closures_create(&closures, CLOSURE_PERCUS_YEVICK, mixture, q, WAVES), OK);
    ck_assert_int_eq(closures_solve(closures, &s, &effort), OK);
    for (size_t pair = 0; pair < pairs; pair++) {
        ck_assert_double_eq_tol(s.contact[pair] / other->contact[pair], 1, error);
        for (size_t i = 0; i < WAVES; i++)
            ck_assert_double_eq_tol(direct[pair * WAVES + i], other->direct[pair * WAVES + i],
                                    error * fabs(other->direct[pair * WAVES]));
    }
    closures_free(closures);
    oz_free(oz);
}

START_TEST(grids_agree_with_closed_forms_and_collocation) {
    const Mixture spheres = {3, 2, {1, 1.6}, {0.4, 0.6}}, discs = {2, 2, {1, 1.4}, {0.3, 0.7}};
    expect_grids_agree(&SPHERES, 0.45, 1e-5);
    expect_grids_agree(&spheres, 0.4, 1e-5);
    expect_grids_agree(&DISCS, 0.69, 1e-4);
    expect_grids_agree(&discs, 0.65, 1e-4);
}
END_TEST

START_TEST(what_cannot_be_is_refused) {
    Oz *oz = NULL;
    const Structure *s = NULL;
    const double q = 1;
    const Mixture pair = {2, 2, {1, 1.4}, {0.5, 0.5}}, wrong = {2, 1, {1}, {0.5}};
    ck_assert_int_eq(oz_create(&oz, CLOSURE_VERLET_WEIS, &DISCS, &q, 1), BAD_DATA);
    ck_assert_int_eq(oz_create(&oz, CLOSURE_FUNDAMENTAL, &pair, &q, 1), BAD_DATA);
    ck_assert_int_eq(oz_create(&oz, CLOSURE_PERCUS_YEVICK, &wrong, &q, 1), BAD_DATA);
    ck_assert_int_eq(oz_create(&oz, CLOSURE_PERCUS_YEVICK, &DISCS, &q, 1), OK);
    ck_assert_int_eq(oz_solve(oz, 1.2, &s), BAD_DATA);
    ck_assert_int_ne(oz_solve(oz, 0.95, &s), OK);
    ck_assert_int_eq(oz_solve(oz, 0.6, &s), OK); // a failure leaves it usable
    oz_free(oz);
}
END_TEST

// Some solutions take minutes: who is told to stop within one says so, does not try again, and is
// none the worse.
START_TEST(a_solution_is_left_where_it_is_no_longer_wanted) {
    static const Closure closures[] = {CLOSURE_PERCUS_YEVICK, CLOSURE_HYPERNETTED_CHAIN,
                                       CLOSURE_ROGERS_YOUNG};
    atomic_int stop = 1;
    const double q = 6;
    for (int i = 0; i < 3; i++) {
        const Structure *s = NULL;
        Oz *oz = NULL;
        ck_assert_int_eq(oz_create(&oz, closures[i], &DISCS, &q, 1), OK);
        patience_set(&stop);
        ck_assert_int_eq(oz_solve(oz, 0.3, &s), INTERRUPTED);
        ck_assert_uint_eq(oz_effort(oz).iterations, 0);
        patience_set(NULL);
        ck_assert_int_eq(oz_solve(oz, 0.3, &s), OK);
        oz_free(oz);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("oz");
    TCase *tests = tcase_create("structure");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests,
                   percus_yevick_spheres_have_their_closed_compressibility_and_contact_value);
    tcase_add_test(tests, percus_yevick_discs_are_exact_to_first_order);
    tcase_add_test(tests, percus_yevick_discs_have_the_third_virial_coefficient);
    tcase_add_test(tests, percus_yevick_discs_agree_with_another_solver);
    tcase_add_test(tests, a_mixture_of_equals_is_the_pure_fluid);
    tcase_add_test(tests, lengths_have_no_scale);
    tcase_add_test(tests, closed_forms_of_discs_reproduce_their_numbers);
    tcase_add_test(tests, closures_have_the_third_virial_coefficient);
    tcase_add_test(tests, closures_have_their_own_fourth_virial_coefficient);
    tcase_add_test(tests, rogers_and_young_agree_with_themselves);
    tcase_add_test(tests, where_a_closure_has_no_solution_it_says_so);
    tcase_add_test(tests, closures_of_equals_are_those_of_the_pure_fluid);
    tcase_add_test(tests, grids_agree_with_closed_forms_and_collocation);
    tcase_add_test(tests, what_cannot_be_is_refused);
    tcase_add_test(tests, a_solution_is_left_where_it_is_no_longer_wanted);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
