// SPDX-License-Identifier: GPL-3.0-or-later
// Results: named numbers and arrays, one slot per replica, with mean and standard error.
#include "suite.h"

#include "results/results.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static Results *new_results(size_t replicas) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, replicas), OK);
    return results;
}

static ResultSeries msd_shape(void) {
    static const double times[3] = {0.1, 1, 10};
    static const char *const species[2] = {"small", "big"};
    return (ResultSeries){
        .stage = "quiescent",
        .observable = "mean_squared_displacement",
        .unit = "d^2",
        .about = "how far",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = 2, .labels = species},
                 {.name = "time", .unit = "d^2/D0", .count = 3, .values = times}},
    };
}

START_TEST(error_is_deviation_over_root_n) {
    Results *results = new_results(4);
    const double values[4] = {1, 2, 3, 4}; // s^2 = 5/3, error = sqrt(5/12)
    for (size_t r = 0; r < 4; r++) {
        ck_assert_int_eq(results_put_scalar(results, "s", "q", "", "", r, values[r]), OK);
    }
    const Estimate e = results_scalar_estimate(results, results_find_scalar(results, "s", "q"));
    ck_assert_double_eq(e.value, 2.5);
    ck_assert_double_eq_tol(e.error, sqrt(5.0 / 12), 1e-15);
    ck_assert_uint_eq(e.n, 4);
    results_free(results);
}
END_TEST

START_TEST(close_values_keep_their_digits) {
    Results *results = new_results(2);
    results_put_scalar(results, "s", "q", "", "", 0, 1e9);
    results_put_scalar(results, "s", "q", "", "", 1, 1e9 + 1e-3);
    const Estimate e = results_scalar_estimate(results, results_find_scalar(results, "s", "q"));
    ck_assert_double_eq_tol(e.error, 5e-4, 1e-7);
    results_free(results);
}
END_TEST

START_TEST(one_replica_has_no_error_and_none_no_value) {
    Results *results = new_results(3);
    results_put_scalar(results, "s", "q", "", "", 1, 7);
    Estimate e = results_scalar_estimate(results, results_find_scalar(results, "s", "q"));
    ck_assert_double_eq(e.value, 7);
    ck_assert(isnan(e.error));
    ck_assert_uint_eq(e.n, 1);
    results_put_scalar(results, "s", "q", "", "", 1, NAN);
    e = results_scalar_estimate(results, results_find_scalar(results, "s", "q"));
    ck_assert(isnan(e.value));
    ck_assert_uint_eq(e.n, 0);
    results_free(results);
}
END_TEST

START_TEST(series_keep_copies_of_axes_and_estimate_per_element) {
    Results *results = new_results(2);
    char label[] = "small";
    double time = 0.5;
    const char *labels[1] = {label};
    const ResultSeries shape = {
        .stage = "s",
        .observable = "o",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = 1, .labels = labels},
                 {.name = "time", .unit = "", .count = 1, .values = &time}},
    };
    double value = 3;
    ck_assert_int_eq(results_put_series(results, &shape, 1, &value), OK);
    label[0] = 'X';
    time = value = 99;
    const ResultSeries *series = results_find_series(results, "s", "o");
    ck_assert_str_eq(series->axis[0].labels[0], "small");
    ck_assert_double_eq(series->axis[1].values[0], 0.5);
    ck_assert(isnan(series->values[0]));
    ck_assert_double_eq(results_series_estimate(results, series, 0).value, 3);
    results_free(results);
}
END_TEST

START_TEST(replicas_lie_one_after_another) {
    Results *results = new_results(2);
    const ResultSeries shape = msd_shape();
    for (size_t r = 0; r < 2; r++) {
        double values[6];
        for (size_t i = 0; i < 6; i++) values[i] = (double)(10 * r + i);
        ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
    }
    const ResultSeries *series = results_find_series(results, shape.stage, shape.observable);
    ck_assert_uint_eq(series->size, 6);
    ck_assert_double_eq(series->values[6 + 4], 14);
    ck_assert_double_eq(results_series_estimate(results, series, 4).value, 9);
    results_free(results);
}
END_TEST

START_TEST(other_axes_under_the_same_name_are_refused) {
    Results *results = new_results(2);
    ResultSeries shape = msd_shape();
    const double values[6] = {0};
    ck_assert_int_eq(results_put_series(results, &shape, 0, values), OK);
    shape.axis[1].count = 2;
    ck_assert_int_eq(results_put_series(results, &shape, 1, values), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "quiescent/mean_squared_displacement"));
    results_free(results);
}
END_TEST

START_TEST(names_that_would_be_paths_or_too_long_are_refused) {
    Results *results = new_results(1);
    char name[RESULT_NAME + 1];
    memset(name, 'a', RESULT_NAME);
    name[RESULT_NAME] = '\0';
    ck_assert_int_eq(results_put_scalar(results, "s", name, "", "", 0, 1), BAD_DATA);
    ck_assert_int_eq(results_put_scalar(results, "s/t", "q", "", "", 0, 1), BAD_DATA);
    ck_assert_int_eq(results_put_scalar(results, "", "q", "", "", 0, 1), BAD_DATA);
    ck_assert_uint_eq(results->scalar_count, 0);
    results_free(results);
}
END_TEST

START_TEST(facts_and_health_are_replaced_by_name) {
    Results *results = new_results(1);
    results_put_fact(results, "host", "a");
    results_put_fact(results, "host", "b");
    results_put_health(results, "overlaps", "pairs", 0, 1);
    results_put_health(results, "overlaps", "pairs", 0, 2);
    ck_assert_str_eq(results_find_fact(results, "host"), "b");
    ck_assert_ptr_null(results_find_fact(results, "seed"));
    ck_assert_uint_eq(results->fact_count, 1);
    ck_assert_uint_eq(results->health_count, 1);
    ck_assert_double_eq(results->health[0].value, 2);
    results_free(results);
}
END_TEST

START_TEST(what_is_above_its_limit_or_no_number_is_not_healthy) {
    Results *results = new_results(1);
    results_put_health(results, "collisions", "a number to know", NAN, 1e9);
    results_put_health(results, "depth", "at its limit", 1e-12, 1e-12);
    ck_assert_ptr_null(results_broken_limit(results));
    results_put_health(results, "drift", "no number", 1, NAN);
    ck_assert_str_eq(results_broken_limit(results)->name, "drift");
    results_put_health(results, "depth", "above its limit", 1e-12, 2e-12);
    ck_assert_str_eq(results_broken_limit(results)->name, "depth");
    results_free(results);
}
END_TEST

// ---- Jackknife ----------------------------------------------------------------------------------

enum { GROUPS = 4 };

// Of all four values and without each of them: their mean, and a curve of it over these axes.
static Results *mean_without(size_t omitted, const ResultAxis *axis) {
    static const double values[GROUPS] = {1, 2.5, 3, 4.25};
    Results *results = new_results(1);
    double sum = 0;
    size_t count = 0;
    for (size_t g = 0; g < GROUPS; g++) {
        if (g == omitted) continue;
        sum += values[g];
        count++;
    }
    const double mean = sum / (double)count, curve[2] = {mean, -mean};
    const ResultSeries shape = {.stage = "s", .observable = "curve", .axes = 1, .axis = {*axis}};
    ck_assert_int_eq(results_put_scalar(results, "s", "mean", "kT", "about", 0, mean), OK);
    ck_assert_int_eq(results_put_scalar(results, "s", "set", "", "", 0, 0.7), OK);
    ck_assert_int_eq(results_put_scalar(results, "s", "flag", "", "", 0, omitted == 1), OK);
    ck_assert_int_eq(results_put_series(results, &shape, 0, curve), OK);
    ck_assert_int_eq(results_put_health(results, "depth", "", 1, mean), OK);
    return results;
}

static Results *jackknife(Results *passes[1 + GROUPS]) {
    Results *results = new_results(GROUPS + 1); // more room than groups
    ck_assert_int_eq(results_jackknife(results, passes, GROUPS), OK);
    for (size_t p = 0; p <= GROUPS; p++) results_free(passes[p]);
    return results;
}

static Estimate scalar(const Results *results, const char *name) {
    return results_scalar_estimate(results, results_find_scalar(results, "s", name));
}

static Estimate element(const Results *results, size_t i) {
    return results_series_estimate(results, results_find_series(results, "s", "curve"), i);
}

START_TEST(the_jackknife_of_a_mean_is_the_error_of_the_mean) {
    const ResultAxis axis = {"time", "", 2, (const double[]){1, 2}, NULL};
    const double mean = 2.6875,
                 error =
                     sqrt((1.6875 * 1.6875 + 0.1875 * 0.1875 + 0.3125 * 0.3125 + 1.5625 * 1.5625) /
                          (GROUPS * (GROUPS - 1)));
    Results *passes[1 + GROUPS];
    passes[0] = mean_without(GROUPS, &axis);
    for (size_t g = 0; g < GROUPS; g++) passes[g + 1] = mean_without(g, &axis);
    Results *results = jackknife(passes);
    ck_assert_double_eq_tol(scalar(results, "mean").value, mean, 1e-14);
    ck_assert_double_eq_tol(scalar(results, "mean").error, error, 1e-14);
    ck_assert_uint_eq(scalar(results, "mean").n, GROUPS);
    ck_assert_str_eq(results_find_scalar(results, "s", "mean")->unit, "kT");
    ck_assert_double_eq_tol(element(results, 1).value, -mean, 1e-14);
    ck_assert_double_eq_tol(element(results, 1).error, error, 1e-14);
    // A number that is set has none, and a flag is that of all, not a mean.
    ck_assert_double_eq(scalar(results, "set").value, 0.7);
    ck_assert_uint_eq(scalar(results, "set").n, 1);
    ck_assert_double_eq(scalar(results, "flag").value, 0);
    ck_assert_uint_eq(scalar(results, "flag").n, 1);
    ck_assert_double_eq(results->health[0].value, mean);
    results_free(results);
}
END_TEST

START_TEST(what_not_all_passes_have_has_no_error) {
    const ResultAxis axis = {"time", "", 2, (const double[]){1, 2}, NULL};
    const ResultAxis other = {"time", "", 2, (const double[]){1, 3}, NULL};
    const double alone[2] = {NAN, INFINITY};
    Results *passes[1 + GROUPS];
    passes[0] = mean_without(GROUPS, &axis);
    ck_assert_int_eq(results_put_scalar(passes[0], "s", "alone", "", "", 0, 0.3), OK);
    for (size_t g = 0; g < GROUPS; g++) {
        passes[g + 1] = mean_without(g, g == 2 ? &other : &axis);
        ck_assert_int_eq(results_put_scalar(passes[g + 1], "s", "mean", "kT", "about", 0,
                                            g < 2 ? alone[g] : 0.5),
                         OK);
    }
    Results *results = jackknife(passes);
    ck_assert_double_eq(scalar(results, "alone").value, 0.3);
    ck_assert_double_eq(scalar(results, "mean").value, 2.6875);
    ck_assert_double_eq(element(results, 0).value, 2.6875);
    ck_assert(isnan(scalar(results, "alone").error) && isnan(scalar(results, "mean").error));
    ck_assert(isnan(element(results, 0).error));
    results_free(results);
}
END_TEST

int main(void) {
    TCase *tests = tcase_create("results");
    tcase_add_test(tests, error_is_deviation_over_root_n);
    tcase_add_test(tests, close_values_keep_their_digits);
    tcase_add_test(tests, one_replica_has_no_error_and_none_no_value);
    tcase_add_test(tests, series_keep_copies_of_axes_and_estimate_per_element);
    tcase_add_test(tests, replicas_lie_one_after_another);
    tcase_add_test(tests, other_axes_under_the_same_name_are_refused);
    tcase_add_test(tests, names_that_would_be_paths_or_too_long_are_refused);
    tcase_add_test(tests, facts_and_health_are_replaced_by_name);
    tcase_add_test(tests, the_jackknife_of_a_mean_is_the_error_of_the_mean);
    tcase_add_test(tests, what_not_all_passes_have_has_no_error);
    tcase_add_test(tests, what_is_above_its_limit_or_no_number_is_not_healthy);
    Suite *suite = suite_create("results");
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
