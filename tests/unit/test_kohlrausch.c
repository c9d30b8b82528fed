// SPDX-License-Identifier: GPL-3.0-or-later
// Relaxation times and Kohlrausch's law from decays whose law is known.
#include "analysis/analysis.h"
#include "observe.h"
#include "suite.h"

#include "rng/rng.h"

#include <stdio.h>

enum { REPLICAS = 8, LAGS = 61, WAVES = 2 };

typedef double Decay(double t, double scale);

// A plateau of 0.7 that is reached early and left by Kohlrausch's law.
static double glassy(double t, double scale) {
    return 0.3 * exp(-t / 0.01) + 0.7 * exp(-pow(t / (50 * scale), 0.6));
}

// Where it is 1/e: 0.7 exp(-(t/50)^0.6) there.
static const double GLASSY_TIME = 50 * 0.479421; // log(0.7 e)^(1/0.6)

static double exponential(double t, double scale) {
    return exp(-t / scale);
}

static double frozen(double t, double scale) {
    return 0.8 + 0.2 * exp(-t / (0.01 * scale));
}

// Of tau = 3000 no lag of WIDE is, of the other wave number's 750 there are.
static double slow(double t, double scale) {
    return 0.3 * exp(-t / 0.01) + 0.7 * exp(-pow(t / (3000 * scale), 0.6));
}

// It is 1/e at the last lag of WIDE, or in some replicas beyond.
static double just(double t, double scale) {
    return exp(-t / (1030 * scale));
}

// Lags from `first` on, so many to a factor of ten.
typedef struct Grid {
    double first, per_decade;
} Grid;

static const Grid WIDE = {1e-3, 10}; // up to 1e3

// Every replica with a time scale of its own, `spread` about 1; the second wave number relaxes four
// times as fast.
static Results *decays_on(Grid grid, Decay *decay, double spread, double noise) {
    static const double waves[WAVES] = {3, 6};
    double times[LAGS], values[WAVES][LAGS];
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    for (int k = 0; k < LAGS; k++) times[k] = grid.first * pow(10, k / grid.per_decade);
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = WAVES, .values = waves},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    Rng rng = rng_open((RngKey){.seed = 3}, STREAM_PACKING, 0, 0);
    for (size_t r = 0; r < REPLICAS; r++) {
        const double scale = 1 + spread * rng_normal(&rng);
        for (int k = 0; k < LAGS; k++) {
            for (int q = 0; q < WAVES; q++) {
                values[q][k] = decay(times[k] * (q == 0 ? 1 : 4), scale) + noise * rng_normal(&rng);
            }
        }
        ck_assert_int_eq(results_put_series(results, &shape, r, &values[0][0]), OK);
    }
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    return results;
}

static Results *decays(Decay *decay, double spread, double noise) {
    return decays_on(WIDE, decay, spread, noise);
}

static Estimate found(const Results *results, const char *quantity, size_t wave) {
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "self_scattering_%s", quantity);
    return results_series_estimate(results, series_of(results, "quiescent", name), wave);
}

START_TEST(kohlrausch_law_is_found_behind_the_plateau) {
    Results *results = decays(glassy, 0, 0);
    for (size_t q = 0; q < WAVES; q++) {
        const double faster = q == 0 ? 1 : 4;
        ck_assert_double_eq_tol(found(results, "kohlrausch_amplitude", q).value, 0.7, 1e-3);
        ck_assert_double_eq_tol(found(results, "kohlrausch_exponent", q).value, 0.6, 1e-3);
        ck_assert_double_eq_tol(found(results, "kohlrausch_time", q).value * faster / 50, 1, 2e-3);
        ck_assert_double_gt(found(results, "kohlrausch_window", q).value * faster, 0.03);
        // From a time in the plateau on the law holds; from the first lags on, it is off by ten
        // times that tolerance at least.
        ck_assert_double_eq_tol(found(results, "kohlrausch_scan", q * LAGS + 25).value, 0.6, 1e-3);
        ck_assert_double_gt(fabs(found(results, "kohlrausch_scan", q * LAGS + 5).value - 0.6),
                            0.01);
        ck_assert_double_eq_tol(found(results, "relaxation_time", q).value * faster / GLASSY_TIME,
                                1, 2e-3);
    }
    results_free(results);
}
END_TEST

// One that misses the first step and begins at 0.67 or 0.56, with twice as many lags a decade.
START_TEST(another_grid_of_lags_tells_the_same) {
    static const Grid late = {1, 20};
    static const char *const quantities[] = {"relaxation_time", "kohlrausch_time",
                                             "kohlrausch_exponent", "kohlrausch_amplitude"};
    Results *wide = decays_on(WIDE, glassy, 0.1, 1e-3),
            *narrow = decays_on(late, glassy, 0.1, 1e-3);
    for (size_t n = 0; n < sizeof quantities / sizeof *quantities; n++) {
        for (size_t q = 0; q < WAVES; q++) {
            const Estimate a = found(wide, quantities[n], q), b = found(narrow, quantities[n], q);
            ck_assert_double_eq_tol(a.value, b.value, 3 * hypot(a.error, b.error));
        }
    }
    results_free(wide);
    results_free(narrow);
    wide = decays(glassy, 0, 0);
    narrow = decays_on(late, glassy, 0, 0);
    for (size_t q = 0; q < WAVES; q++) {
        ck_assert_double_eq_tol(found(narrow, "relaxation_time", q).value /
                                    found(wide, "relaxation_time", q).value,
                                1, 2e-3);
    }
    results_free(wide);
    results_free(narrow);
}
END_TEST

START_TEST(what_is_made_of_a_function_has_its_sentence) {
    Results *results = decays(glassy, 0.1, 1e-3);
    ck_assert_uint_ge(results->series_count, 14);
    expect_told_sentences(results);
    results_free(results);
}
END_TEST

START_TEST(a_free_particle_decays_exponentially) {
    Results *results = decays(exponential, 0, 0);
    ck_assert_double_eq_tol(found(results, "kohlrausch_exponent", 0).value, 1, 1e-6);
    ck_assert_double_eq_tol(found(results, "kohlrausch_amplitude", 0).value, 1, 1e-6);
    ck_assert_double_eq_tol(found(results, "kohlrausch_time", 1).value, 0.25, 1e-6);
    results_free(results);
}
END_TEST

// Replicas that differ by a tenth in their time: the error is that of their mean.
START_TEST(errors_are_those_of_the_replicas) {
    Results *results = decays(glassy, 0.1, 1e-3);
    const Estimate time = found(results, "kohlrausch_time", 0);
    ck_assert_double_eq_tol(time.value / 50, 1, 4 * 0.1 / sqrt(REPLICAS));
    // The standard error of 8 values is itself known to a quarter.
    ck_assert_double_eq_tol(time.error / (50 * 0.1 / sqrt(REPLICAS)), 1, 4 * 0.27);
    ck_assert_double_gt(time.error, 0.2 * 50 * 0.1 / sqrt(REPLICAS));
    const Estimate exponent = found(results, "kohlrausch_exponent", 0);
    ck_assert_double_eq_tol(exponent.value, 0.6, fmax(4 * exponent.error, 0.02));
    results_free(results);
}
END_TEST

START_TEST(what_has_not_relaxed_has_no_time) {
    Results *results = decays(frozen, 0, 0);
    ck_assert(isnan(found(results, "relaxation_time", 0).value));
    results_free(results);
}
END_TEST

// The mean of all replicas falls to 1/e, that without some of them does not: what the others tell
// of is not the mean of all.
START_TEST(a_time_that_some_replicas_lack_is_not_told) {
    static const char *const numbers[] = {"relaxation_time", "scaled"};
    static const size_t sizes[] = {1, 51};
    Results *results = decays(just, 0.1, 0);
    const ResultSeries *series = series_of(results, "quiescent", "self_scattering");
    double last = 0;
    for (size_t r = 0; r < REPLICAS; r++)
        last += series->values[r * series->size + LAGS - 1] / REPLICAS;
    ck_assert_double_lt(last, exp(-1));
    for (size_t n = 0; n < 2; n++) {
        const size_t at = sizes[n] * 2 / 3; // of scaled: 0.25 tau
        ck_assert_uint_eq(found(results, numbers[n], at).n, 0);
        ck_assert_uint_eq(found(results, numbers[n], sizes[n] + at).n, REPLICAS);
    }
    results_free(results);
}
END_TEST

// It falls to a half within the lags, so that a fit there is, and has numbers.
START_TEST(a_law_beyond_the_lags_is_not_told) {
    static const char *const numbers[] = {"kohlrausch_amplitude", "kohlrausch_time",
                                          "kohlrausch_exponent", "kohlrausch_window"};
    Results *results = decays(slow, 0.01, 1e-3);
    ck_assert(!isnan(found(results, "kohlrausch_scan", 40).value));
    for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++) {
        ck_assert(isnan(found(results, numbers[n], 0).value));
        ck_assert(!isnan(found(results, numbers[n], 1).value));
    }
    results_free(results);
}
END_TEST

// Two stages with the same decay, whose times differ by a factor and a unit.
static const double FACTOR = 0.0155;
static Results *in_two_units(double newtonian_wave, double brownian_wave) {
    const double waves[2] = {newtonian_wave, brownian_wave};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    Rng rng = rng_open((RngKey){.seed = 9}, STREAM_PACKING, 0, 0);
    for (int stage = 0; stage < 2; stage++) {
        double times[LAGS], values[LAGS];
        const double factor = stage == 0 ? 1 : FACTOR;
        for (int k = 0; k < LAGS; k++) times[k] = 1e-3 * pow(10, 0.1 * k) * (stage ? 0.01 : 1);
        const ResultSeries shape = {
            .stage = "",
            .observable = "self_scattering",
            .axes = 2,
            .axis = {{.name = "wave_number", .unit = "1/d", .count = 1, .values = &waves[stage]},
                     {.name = "time",
                      .unit = stage ? "d^2/D0" : "d sqrt(m/kT)",
                      .count = LAGS,
                      .values = times}}};
        ResultSeries named = shape;
        strcpy(named.stage, stage ? "brownian" : "newtonian");
        for (size_t r = 0; r < REPLICAS; r++) {
            const double scale = factor * (1 + 0.1 * rng_normal(&rng));
            for (int k = 0; k < LAGS; k++) values[k] = glassy(times[k] / scale, 1);
            ck_assert_int_eq(results_put_series(results, &named, r, values), OK);
        }
    }
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    return results;
}

START_TEST(a_factor_of_time_is_found) {
    Results *results = in_two_units(6, 6);
    ck_assert_ptr_null(results_find_series(results, "newtonian", "self_scattering_time_shift"));
    const ResultSeries *shift = series_of(results, "brownian", "self_scattering_time_shift");
    for (size_t level = 0; level < 9; level++) {
        const Estimate one = results_series_estimate(results, shift, level);
        // Both times are uncertain by a tenth over sqrt(8).
        ck_assert_double_eq_tol(one.value / FACTOR, 1, 4 * 0.05);
        ck_assert_double_eq_tol(one.error / FACTOR, 0.05, 0.04);
    }
    results_free(results);
}
END_TEST

START_TEST(times_are_compared_at_the_same_wave_number_only) {
    Results *results = in_two_units(4, 6);
    ck_assert_ptr_null(results_find_series(results, "brownian", "self_scattering_time_shift"));
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("kohlrausch");
    TCase *c = tcase_create("kohlrausch");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, kohlrausch_law_is_found_behind_the_plateau);
    tcase_add_test(c, another_grid_of_lags_tells_the_same);
    tcase_add_test(c, what_is_made_of_a_function_has_its_sentence);
    tcase_add_test(c, a_free_particle_decays_exponentially);
    tcase_add_test(c, errors_are_those_of_the_replicas);
    tcase_add_test(c, what_has_not_relaxed_has_no_time);
    tcase_add_test(c, a_time_that_some_replicas_lack_is_not_told);
    tcase_add_test(c, a_law_beyond_the_lags_is_not_told);
    tcase_add_test(c, a_factor_of_time_is_found);
    tcase_add_test(c, times_are_compared_at_the_same_wave_number_only);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
