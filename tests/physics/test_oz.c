// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of hard discs and spheres against exact results and independent solutions.
#include "oz/oz.h"

#include <check.h>
#include <math.h>

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
    tcase_add_test(tests, what_cannot_be_is_refused);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
