// SPDX-License-Identifier: GPL-3.0-or-later
// The shared mathematics against exact values.
#include "suite.h"

#include "numerics/fit.h"
#include "numerics/pade.h"
#include "numerics/symmetric.h"
#include "numerics/turn.h"

#include <check.h>
#include <math.h>

START_TEST(turns_are_cosines_and_sines_to_the_last_digits) {
    for (int k = -4000; k <= 4000; k++) {
        Lanes fraction, c, s, versine;
        for (int lane = 0; lane < LANES; lane++) fraction[lane] = (k + lane / 8.0) / 1777.0;
        turn_cosine_sine(&fraction, &c, &s);
        turn_versine(&fraction, &versine);
        for (int lane = 0; lane < LANES; lane++) {
            const long double angle =
                2 * 3.14159265358979323846264338L * (long double)fraction[lane];
            ck_assert_double_eq_tol(c[lane], (double)cosl(angle), 3e-16);
            ck_assert_double_eq_tol(s[lane], (double)sinl(angle), 3e-16);
            ck_assert_double_eq_tol(versine[lane], 1 - (double)cosl(angle), 1.2e-15);
        }
    }
}
END_TEST

START_TEST(a_small_turn_loses_its_square_to_full_precision) {
    const Lanes fraction = {1e-9, -1e-6, 1e-3};
    Lanes versine;
    turn_versine(&fraction, &versine);
    for (int lane = 0; lane < 3; lane++) {
        const double half = sin(3.14159265358979323846 * fraction[lane]);
        ck_assert_double_eq_tol(versine[lane] / (2 * half * half), 1, 1e-15);
    }
    ck_assert_double_eq(versine[3], 0);
}
END_TEST

START_TEST(quarter_turns_are_exact) {
    const Lanes fraction = {0.75, -0.5};
    Lanes c, s;
    turn_cosine_sine(&fraction, &c, &s);
    ck_assert_double_eq(c[0], 0);
    ck_assert_double_eq(s[0], -1);
    ck_assert_double_eq(c[1], -1);
    ck_assert_double_eq(s[1], 0);
}
END_TEST

START_TEST(pade_of_a_rational_function_is_itself) {
    // (1 + 2 x)/(1 - x - x^2) = 1 + 3 x + 4 x^2 + 7 x^3 + 11 x^4 + ... (Lucas numbers)
    static const double series[] = {1, 3, 4, 7, 11};
    ck_assert_double_eq_tol(pade(series, 1, 2, 0.3), 1.6 / (1 - 0.3 - 0.09), 1e-13);
}
END_TEST

START_TEST(pade_sums_a_slow_series) {
    // ln(1 + x)/x at x = 3, far outside the circle of convergence.
    double series[10];
    for (int k = 0; k < 10; k++) series[k] = (k % 2 ? -1.0 : 1.0) / (k + 1);
    ck_assert_double_eq_tol(pade(series, 4, 5, 3), log(4) / 3, 1e-4);
}
END_TEST

START_TEST(a_straight_line_is_exact) {
    static const double x[] = {1, 2, 4, 8}, y[] = {5, 8, 14, 26}, w[] = {1, 0.25, 0.0625, 0.015625};
    const Line line = fit_line(x, y, w, 4);
    ck_assert_double_eq_tol(line.slope, 3, 1e-13);
    ck_assert_double_eq_tol(line.intercept, 2, 1e-13);
    ck_assert_double_eq_tol(line.misfit, 0, 1e-20);
}
END_TEST

START_TEST(what_a_straight_line_leaves_is_known) {
    static const double x[] = {0, 1, 2}, y[] = {0, 3, 0}, w[] = {1, 2, 1};
    ck_assert_double_eq_tol(fit_line(x, y, NULL, 3).intercept, 1, 1e-14);
    ck_assert_double_eq_tol(fit_line(x, y, NULL, 3).misfit, 6, 1e-13);
    ck_assert_double_eq_tol(fit_line(x, y, w, 3).intercept, 1.5, 1e-14);
    ck_assert_double_eq_tol(fit_line(x, y, w, 3).misfit, 9, 1e-13);
}
END_TEST

static double two_valleys(double at, const void *depth) {
    if (at > 3.9) return (double)NAN;
    return at < 1 ? fabs(at - 0.5) : pow(at - 2.7, 2) - *(const double *)depth;
}

START_TEST(the_deepest_valley_is_found) {
    const double shallow = -1, deep = 1;
    double at = 0;
    ck_assert(fit_least(two_valleys, &deep, 0, 4, 50, &at));
    ck_assert_double_eq_tol(at, 2.7, 1e-7);
    ck_assert(fit_least(two_valleys, &shallow, 0, 4, 50, &at));
    ck_assert_double_eq_tol(at, 0.5, 1e-7);
    ck_assert(!fit_least(two_valleys, &deep, 1, 2.5, 50, &at));     // falls to the end
    ck_assert(fit_least(two_valleys, &deep, 2.2, 3.2, 2 * 3, &at)); // two places are as low
    ck_assert_double_eq_tol(at, 2.7, 0.11);
}
END_TEST

START_TEST(edge_of_a_cubic_is_found_from_its_averages) {
    // Averages of 7 - 5 u + 4 u^2 - 2 u^3 over ten bins of width 0.1.
    double y[10], value = 0;
    for (int k = 0; k < 10; k++) {
        double integral[2];
        for (int e = 0; e < 2; e++) {
            const double u = (k + e) / 10.0;
            integral[e] = 7 * u - 5 * u * u / 2 + 4 * u * u * u / 3 - u * u * u * u / 2;
        }
        y[k] = (integral[1] - integral[0]) * 10;
    }
    ck_assert_int_eq(fit_value_at_edge(y, 10, 3, &value), OK);
    ck_assert_double_eq_tol(value, 7, 1e-11);
    ck_assert_int_eq(fit_value_at_edge(y, 3, 3, &value), BAD_DATA);
}
END_TEST

static double determinant(double v[3][3]) {
    return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
           v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

// m v = value v for three unit vectors, values ascending.
static void expect_eigen(const double m[3][3]) {
    double values[3], vectors[3][3], size = 0;
    symmetric_eigen(m, values, vectors);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) size += fabs(m[i][j]);
    }
    for (int k = 0; k < 3; k++) {
        if (k > 0) ck_assert_double_le(values[k - 1], values[k]);
        for (int i = 0; i < 3; i++) {
            double product = 0;
            for (int j = 0; j < 3; j++) product += m[i][j] * vectors[k][j];
            ck_assert_double_eq_tol(product, values[k] * vectors[k][i], 2e-15 * size + 1e-300);
        }
    }
    ck_assert_double_eq_tol(fabs(determinant(vectors)), 1, 1e-14); // they are orthonormal
}

START_TEST(eigenvectors_of_symmetric_matrices_are_found) {
    for (int k = 1; k < 2000; k++) { // of any size, near to diagonal or far from it
        const double off = pow(10, -(k % 21)), scale = pow(10, k % 13 - 6);
        const double xx = sin(k), yy = sin(3 * k), zz = k % 3 ? sin(5 * k) : yy;
        const double xy = off * sin(7 * k), xz = off * sin(11 * k), yz = off * off * sin(13 * k);
        const double m[3][3] = {{scale * xx, scale * xy, scale * xz},
                                {scale * xy, scale * yy, scale * yz},
                                {scale * xz, scale * yz, scale * zz}};
        expect_eigen(m);
    }
}
END_TEST

START_TEST(eigenvalues_known_beforehand_are_found) {
    static const double ones[3][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, none[3][3] = {{0}};
    double values[3], vectors[3][3];
    symmetric_eigen(ones, values, vectors);
    ck_assert_double_eq_tol(values[0], 0, 1e-15);
    ck_assert_double_eq_tol(values[1], 0, 1e-15);
    ck_assert_double_eq_tol(values[2], 3, 1e-15);
    for (int a = 0; a < 3; a++) ck_assert_double_eq_tol(fabs(vectors[2][a]), sqrt(1 / 3.0), 1e-15);
    expect_eigen(none);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("numerics");
    TCase *c = tcase_create("numerics");
    tcase_add_test(c, turns_are_cosines_and_sines_to_the_last_digits);
    tcase_add_test(c, a_small_turn_loses_its_square_to_full_precision);
    tcase_add_test(c, quarter_turns_are_exact);
    tcase_add_test(c, pade_of_a_rational_function_is_itself);
    tcase_add_test(c, pade_sums_a_slow_series);
    tcase_add_test(c, a_straight_line_is_exact);
    tcase_add_test(c, what_a_straight_line_leaves_is_known);
    tcase_add_test(c, the_deepest_valley_is_found);
    tcase_add_test(c, edge_of_a_cubic_is_found_from_its_averages);
    tcase_add_test(c, eigenvectors_of_symmetric_matrices_are_found);
    tcase_add_test(c, eigenvalues_known_beforehand_are_found);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
