// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature, small matrices and fixed points against exact values.
#include "suite.h"

#include "numerics/anderson.h"
#include "numerics/quadrature.h"
#include "numerics/small.h"

#include <check.h>
#include <math.h>

START_TEST(five_points_integrate_the_ninth_power_exactly) {
    double x[5], w[5], sum = 0;
    quadrature_legendre(5, 1, 3, x, w);
    for (int i = 0; i < 5; i++) sum += w[i] * pow(x[i], 9);
    ck_assert_double_eq_tol(sum, (pow(3, 10) - 1) / 10, 1e-9);
}
END_TEST

START_TEST(a_matrix_times_its_inverse_is_one) {
    SmallMatrix a = {{0, 2, 1}, {2, 5, -1}, {1, -1, 3}}, inverse, product;
    ck_assert(small_invert(3, a, inverse)); // needs a change of rows
    small_multiply(3, a, inverse, product);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) ck_assert_double_eq_tol(product[i][j], i == j, 1e-14);
    }
    SmallMatrix singular = {{1, 2}, {2, 4}};
    ck_assert(!small_invert(2, singular, inverse));
}
END_TEST

START_TEST(positive_matrices_are_known_by_their_eigenvalues) {
    SmallMatrix positive = {{2, -1}, {-1, 2}}, negative = {{1, 2}, {2, 1}};
    ck_assert(small_is_positive(2, positive));
    ck_assert(!small_is_positive(2, negative));
}
END_TEST

// x = A x + b with eigenvalues -3, 0.9 and 0.99: simple iteration would diverge; four mixings solve
// what is linear in three dimensions.
START_TEST(mixing_solves_what_iteration_cannot) {
    static const double slope[] = {-3, 0.9, 0.99};
    double x[] = {0, 0, 0}, image[3];
    Anderson *anderson = NULL;
    ck_assert_int_eq(anderson_create(&anderson, 3, 5), OK);
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < 3; i++) image[i] = slope[i] * x[i] + 1;
        anderson_mix(anderson, x, image);
    }
    for (int i = 0; i < 3; i++) ck_assert_double_eq_tol(x[i] * (1 - slope[i]), 1, 1e-6);
    anderson_free(anderson);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("recipes");
    TCase *tests = tcase_create("numerics");
    tcase_add_test(tests, five_points_integrate_the_ninth_power_exactly);
    tcase_add_test(tests, a_matrix_times_its_inverse_is_one);
    tcase_add_test(tests, positive_matrices_are_known_by_their_eigenvalues);
    tcase_add_test(tests, mixing_solves_what_iteration_cannot);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
