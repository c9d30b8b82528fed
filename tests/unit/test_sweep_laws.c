// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of a sweep over packing fractions from tables whose law is known.
#include "analysis/analysis.h"
#include "observe.h"
#include "suite.h"
#include "rng/rng.h"

#include <stdio.h>

enum { REPLICAS = 8, STATES = 6, ROWS = 40, SCALED = 5 };
static const double CRITICAL = 0.7948, GAMMA = 2.5;
static const double packing[STATES] = {0.77, 0.775, 0.78, 0.785, 0.7875, 0.79};

static Results *new_results(void) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    return results;
}

// [packing fraction][wave number]
static void put(Results *results, const char *name, double values[REPLICAS][STATES][ROWS],
                const double phi[STATES]) {
    double waves[ROWS];
    for (int row = 0; row < ROWS; row++) waves[row] = row + 1;
    ResultSeries shape = {
        .stage = "quiescent",
        .axes = 2,
        .axis = {{.name = "packing_fraction", .unit = "", .count = STATES, .values = phi},
                 {.name = "wave_number", .unit = "1/d", .count = ROWS, .values = waves}}};
    snprintf(shape.observable, sizeof shape.observable, "%s", name);
    for (size_t r = 0; r < REPLICAS; r++) {
        ck_assert_int_eq(results_put_series(results, &shape, r, &values[r][0][0]), OK);
    }
}

// Relaxation times with noise of each state and replica: `noise` of their size.
static Results *power_laws(double noise) {
    static double tau[REPLICAS][STATES][ROWS];
    Rng rng = rng_open((RngKey){.seed = 5}, STREAM_PACKING, 0, 0);
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int s = 0; s < STATES; s++) {
            for (int row = 0; row < ROWS; row++) {
                tau[r][s][row] =
                    (row + 1) * pow(CRITICAL - packing[s], -GAMMA) * (1 + noise * rng_normal(&rng));
            }
        }
    }
    Results *results = new_results();
    put(results, "self_scattering_relaxation_time", tau, packing);
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    return results;
}

static Estimate found(const Results *results, const char *quantity, size_t element) {
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "self_scattering_%s", quantity);
    return results_series_estimate(results, series_of(results, "quiescent", name), element);
}

START_TEST(a_power_law_is_found) {
    enum { EXPONENTS = 21, GIVEN = 5 };
    Results *results = power_laws(0);
    ck_assert_double_eq_tol(found(results, "critical_packing_fraction", 7).value, CRITICAL, 1e-7);
    ck_assert_double_eq_tol(found(results, "critical_exponent", 7).value, GAMMA, 1e-4);
    ck_assert_double_lt(found(results, "critical_misfit", 7).value, 1e-5);
    const ResultSeries *given =
        series_of(results, "quiescent", "self_scattering_critical_packing_fraction_at");
    ck_assert_uint_eq(given->axis[1].count, EXPONENTS);
    ck_assert_double_eq_tol(given->axis[1].values[GIVEN], GAMMA, 1e-12);
    const size_t row = 7 * EXPONENTS;
    ck_assert_double_eq_tol(results_series_estimate(results, given, row + GIVEN).value, CRITICAL,
                            1e-7);
    // A larger exponent puts the transition further off.
    ck_assert_double_gt(results_series_estimate(results, given, row + GIVEN + 1).value,
                        CRITICAL + 1e-4);
    for (size_t s = 0; s + 4 <= STATES; s++)
        ck_assert_double_eq_tol(found(results, "critical_scan", 7 * STATES + s).value, CRITICAL,
                                1e-6);
    ck_assert(isnan(found(results, "critical_scan", 7 * STATES + STATES - 3).value));
    expect_told_sentences(results);
    results_free(results);
}
END_TEST

// Deviations over their errors, squared: 7/5 in the mean for errors of eight values each.
START_TEST(errors_are_what_they_say) {
    Results *results = power_laws(0.05);
    double free = 0, given = 0;
    for (size_t row = 0; row < ROWS; row++) {
        const Estimate one = found(results, "critical_packing_fraction", row);
        const Estimate other = found(results, "critical_packing_fraction_at", row * 21 + 5);
        free += pow((one.value - CRITICAL) / one.error, 2) / ROWS;
        given += pow((other.value - CRITICAL) / other.error, 2) / ROWS;
        ck_assert_double_lt(other.error, one.error); // what is known need not be found
        ck_assert_double_lt(one.error, 0.003);
    }
    ck_assert_msg(free > 0.6 && free < 2.8, "%g", free);
    ck_assert_msg(given > 0.6 && given < 2.8, "%g", given);
    results_free(results);
}
END_TEST

START_TEST(no_transition_is_seen_where_there_is_none) {
    static double tau[REPLICAS][STATES][ROWS];
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int s = 0; s < STATES; s++) {
            for (int row = 0; row < ROWS; row++) tau[r][s][row] = exp(10 * packing[s]);
        }
    }
    Results *results = new_results();
    put(results, "self_scattering_relaxation_time", tau, packing);
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    ck_assert(isnan(found(results, "critical_packing_fraction", 0).value));
    results_free(results);
}
END_TEST

// A flow makes a glass relax: what comes of that says nothing of the transition.
START_TEST(no_transition_is_told_of_a_flow) {
    static double tau[REPLICAS][STATES][ROWS], rate[REPLICAS][STATES][ROWS];
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int s = 0; s < STATES; s++) {
            for (int row = 0; row < ROWS; row++) {
                tau[r][s][row] = pow(CRITICAL - packing[s], -GAMMA);
                rate[r][s][row] = 0.1;
            }
        }
    }
    Results *results = new_results();
    put(results, "self_scattering_relaxation_time", tau, packing);
    put(results, "shear_rate", rate, packing);
    const size_t given = results->series_count;
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    ck_assert_uint_eq(results->series_count, given);
    results_free(results);
}
END_TEST

// Where the plateau is below 1/e the function falls to it before its last decay.
START_TEST(times_before_the_plateau_are_left_alone) {
    static double tau[REPLICAS][STATES][ROWS], plateau[REPLICAS][STATES][ROWS];
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int s = 0; s < STATES; s++) {
            for (int row = 0; row < ROWS; row++) {
                tau[r][s][row] = pow(CRITICAL - packing[s], -GAMMA);
                plateau[r][s][row] = s < 3 ? (double)NAN : row == 0 ? 0.3 : 0.6;
            }
        }
    }
    Results *results = new_results();
    put(results, "self_scattering_relaxation_time", tau, packing);
    put(results, "self_scattering_plateau", plateau, packing);
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    ck_assert(isnan(found(results, "critical_packing_fraction", 0).value));
    ck_assert_double_eq_tol(found(results, "critical_packing_fraction", 1).value, CRITICAL, 1e-7);
    results_free(results);
}
END_TEST

// The lower four states relax, the others have plateaus above f_c. At the second wave number the
// plateau is low, and 1/e is passed before it.
START_TEST(plateaus_of_a_glass_rise_as_a_square_root) {
    enum { RELAX = 4, ALL = 7, WAVES = 2 };
    static const double phi[ALL] = {0.77, 0.775, 0.78, 0.785, 0.80, 0.81, 0.82};
    static const double waves[WAVES] = {6, 10}, critical[WAVES] = {0.59, 0.32},
                        amplitude[WAVES] = {1.2, 1.786};
    Results *results = new_results();
    ResultSeries shape = {
        .stage = "quiescent",
        .axes = 2,
        .axis = {{.name = "packing_fraction", .unit = "", .count = ALL, .values = phi},
                 {.name = "wave_number", .unit = "1/d", .count = WAVES, .values = waves}}};
    double tau[ALL][WAVES], f[ALL][WAVES];
    for (int s = 0; s < ALL; s++) {
        tau[s][0] = s < RELAX ? pow(CRITICAL - phi[s], -GAMMA) : (double)NAN;
        tau[s][1] = 1;
        for (int q = 0; q < WAVES; q++)
            f[s][q] = s < RELAX ? 0.3 : critical[q] + amplitude[q] * sqrt(phi[s] / CRITICAL - 1);
    }
    for (size_t r = 0; r < REPLICAS; r++) {
        strcpy(shape.observable, "self_scattering_relaxation_time");
        ck_assert_int_eq(results_put_series(results, &shape, r, &tau[0][0]), OK);
        strcpy(shape.observable, "self_scattering_plateau");
        ck_assert_int_eq(results_put_series(results, &shape, r, &f[0][0]), OK);
    }
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    for (size_t q = 0; q < WAVES; q++) {
        ck_assert_double_eq_tol(found(results, "plateau_critical", q).value, critical[q], 1e-5);
        ck_assert_double_eq_tol(found(results, "plateau_amplitude", q).value, amplitude[q], 1e-4);
    }
    expect_told_sentences(results);
    results_free(results);
}
END_TEST

START_TEST(one_master_curve_has_no_spread) {
    static const double times[SCALED] = {0.01, 0.1, 1, 2, 10};
    Results *results = new_results();
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering_scaled",
        .axes = 2,
        .axis = {{.name = "packing_fraction", .unit = "", .count = STATES, .values = packing},
                 {.name = "scaled_time", .unit = "", .count = SCALED, .values = times}}};
    for (size_t r = 0; r < REPLICAS; r++) {
        double f[STATES][SCALED];
        for (int s = 0; s < STATES; s++) {
            for (int k = 0; k < SCALED; k++)
                f[s][k] = exp(-times[k]) + (k == 0 ? 0.1 * (s % 2) : 0);
        }
        ck_assert_int_eq(results_put_series(results, &shape, r, &f[0][0]), OK);
    }
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    ck_assert_double_eq_tol(found(results, "scaled_spread", 0).value, 0.05, 1e-12);
    for (size_t k = 1; k < SCALED; k++)
        ck_assert_double_lt(found(results, "scaled_spread", k).value, 1e-12);
    results_free(results);
}
END_TEST

// A liquid without and a glass with a yield stress; `noise` in stress. Unless the rates are the
// stage's `own`, those of another stage are swept, and its own is 0.1.
static Results *flow_curves(double noise, bool own) {
    enum { GLASSES = 2, RATES = 6 };
    static const double phi[GLASSES] = {0.70, 0.80}, yield[GLASSES] = {0, 0.3},
                        exponent[GLASSES] = {1, 0.45};
    static const double rates[RATES] = {0.001, 0.01, 0.05, 0.2, 1, 5};
    Results *results = new_results();
    Rng rng = rng_open((RngKey){.seed = 6}, STREAM_PACKING, 0, 0);
    ResultSeries shape = {
        .stage = "flow",
        .observable = "shear_stress",
        .unit = "kT/d^2",
        .axes = 2,
        .axis = {{.name = "packing_fraction", .unit = "", .count = GLASSES, .values = phi},
                 {.name = "shear_rate", .unit = "D0/d^2", .count = RATES, .values = rates}}};
    for (size_t r = 0; r < REPLICAS; r++) {
        double stress[GLASSES][RATES], viscosity[GLASSES][RATES];
        for (int s = 0; s < GLASSES; s++) {
            for (int k = 0; k < RATES; k++) {
                stress[s][k] = yield[s] + 2 * pow(rates[k], exponent[s]);
                stress[s][k] += noise * rng_normal(&rng);
                viscosity[s][k] = stress[s][k] / (own ? rates[k] : 0.1);
            }
        }
        strcpy(shape.observable, "shear_stress");
        ck_assert_int_eq(results_put_series(results, &shape, r, &stress[0][0]), OK);
        strcpy(shape.observable, "shear_viscosity");
        ck_assert_int_eq(results_put_series(results, &shape, r, &viscosity[0][0]), OK);
    }
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    return results;
}

static Estimate flow_found(const Results *results, const char *quantity, size_t element) {
    return results_series_estimate(results, series_of(results, "flow", quantity), element);
}

START_TEST(a_yield_stress_is_found_and_its_absence) {
    Results *results = flow_curves(1e-9, true);
    ck_assert_double_eq_tol(flow_found(results, "yield_stress", 0).value, 0, 1e-6);
    ck_assert_double_eq_tol(flow_found(results, "yield_stress", 1).value, 0.3, 1e-6);
    ck_assert_double_eq_tol(flow_found(results, "flow_curve_amplitude", 1).value, 2, 1e-6);
    ck_assert_double_eq_tol(flow_found(results, "flow_curve_exponent", 0).value, 1, 1e-6);
    ck_assert_double_eq_tol(flow_found(results, "flow_curve_exponent", 1).value, 0.45, 1e-6);
    const ResultSeries *given = series_of(results, "flow", "yield_stress_at");
    ck_assert_uint_eq(given->axis[1].count, 10);
    ck_assert_double_eq_tol(results_series_estimate(results, given, 9).value, 0, 1e-6);
    ck_assert_double_gt(results_series_estimate(results, given, 15).value, 0.31); // 0.6: too steep
    ck_assert_str_eq(given->unit, "kT/d^2");
    ck_assert_str_eq(given->about, result_series_meaning("yield_stress_at")->about);
    ck_assert_str_eq(series_of(results, "flow", "flow_curve_exponent")->about,
                     result_meaning("flow_curve_exponent")->about);
    ck_assert_str_eq(series_of(results, "flow", "yield_stress")->about,
                     result_meaning("yield_stress")->about);
    results_free(results);
}
END_TEST

START_TEST(a_yield_stress_has_the_error_it_says) {
    Results *results = flow_curves(0.02, true);
    const Estimate yield = flow_found(results, "yield_stress", 1);
    ck_assert_double_gt(yield.error, 0.004); // that of a single stress is 0.007
    ck_assert_double_lt(yield.error, 0.04);
    ck_assert_double_eq_tol(yield.value, 0.3, 4 * yield.error);
    results_free(results);
}
END_TEST

// A swept exponent, of soft spheres for one, beside the given ones of the law.
START_TEST(a_swept_exponent_is_not_that_of_a_law) {
    static const double exponents[] = {12, 36};
    double tau[2][STATES];
    Results *results = new_results();
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering_relaxation_time",
        .axes = 2,
        .axis = {{.name = "exponent", .unit = "", .count = 2, .values = exponents},
                 {.name = "packing_fraction", .unit = "", .count = STATES, .values = packing}}};
    for (int s = 0; s < STATES; s++) tau[0][s] = tau[1][s] = pow(CRITICAL - packing[s], -GAMMA);
    for (size_t r = 0; r < REPLICAS; r++)
        ck_assert_int_eq(results_put_series(results, &shape, r, &tau[0][0]), OK);
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    const ResultSeries *found_at =
        series_of(results, "quiescent", "self_scattering_critical_exponent");
    ck_assert_double_eq_tol(results_series_estimate(results, found_at, 1).value, GAMMA, 1e-3);
    ck_assert_ptr_null(
        results_find_series(results, "quiescent", "self_scattering_critical_packing_fraction_at"));
    results_free(results);
}
END_TEST

START_TEST(no_yield_stress_is_told_by_the_rates_of_another_stage) {
    Results *results = flow_curves(1e-9, false);
    ck_assert_uint_eq(results->series_count, 2);
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("sweep_laws");
    TCase *c = tcase_create("sweep_laws");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, a_power_law_is_found);
    tcase_add_test(c, errors_are_what_they_say);
    tcase_add_test(c, no_transition_is_seen_where_there_is_none);
    tcase_add_test(c, no_transition_is_told_of_a_flow);
    tcase_add_test(c, times_before_the_plateau_are_left_alone);
    tcase_add_test(c, plateaus_of_a_glass_rise_as_a_square_root);
    tcase_add_test(c, one_master_curve_has_no_spread);
    tcase_add_test(c, a_yield_stress_is_found_and_its_absence);
    tcase_add_test(c, a_yield_stress_has_the_error_it_says);
    tcase_add_test(c, a_swept_exponent_is_not_that_of_a_law);
    tcase_add_test(c, no_yield_stress_is_told_by_the_rates_of_another_stage);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
