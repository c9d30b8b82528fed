// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of equilibrium, from results made by hand.
#include "analysis/analysis.h"
#include "config/config.h"
#include "observe.h"
#include "suite.h"

#include "base/memory.h"

enum { REPLICAS = 4, LAGS = 21, BLOCKS = 8 };

static const char RUN[] = "system:\n"
                          "  dimension: 2\n"
                          "  particles: 100\n"
                          "  packing_fraction: 0.5\n"
                          "  species: {disc: {shape: disc, diameter: 1, fraction: 1}}\n"
                          "dynamics: {method: newtonian}\n"
                          "protocol: [{stage: quiescent, time: 50}]\n"
                          "ensemble: {replicas: 4, seed: 1}\n";

static Plan *plan_new(void) {
    Plan *plan = NULL;
    ck_assert_msg(config_read_text(&plan, "run.yaml", RUN, strlen(RUN), NULL) == OK, "%s",
                  status_sentence());
    return plan;
}

static void put_decay(Results *results, double tau) {
    static const double waves[1] = {6};
    double times[LAGS], values[LAGS];
    for (int k = 0; k < LAGS; k++) {
        times[k] = 0.1 * pow(10, 0.1 * k); // up to 10
        values[k] = exp(-times[k] / tau);
    }
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = 1, .values = waves},
                 {.name = "time", .unit = "d sqrt(m/kT)", .count = LAGS, .values = times}}};
    for (size_t r = 0; r < REPLICAS; r++)
        ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
}

// Local order 0.8; that of all together as given, and `drift` higher in the second half.
static void put_order(Results *results, double global, double drift) {
    static const char *const kinds[2] = {"local", "global"};
    double times[BLOCKS], values[2][BLOCKS];
    for (int k = 0; k < BLOCKS; k++) times[k] = 10 * (k + 1);
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "bond_order",
        .axes = 2,
        .axis = {{.name = "kind", .unit = "", .count = 2, .labels = kinds},
                 {.name = "time", .unit = "d sqrt(m/kT)", .count = BLOCKS, .values = times}}};
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int k = 0; k < BLOCKS; k++) {
            values[0][k] = 0.8;
            values[1][k] = global + drift * (k >= BLOCKS / 2) + 1e-3 * (double)r * (k % 2 + k / 4);
        }
        ck_assert_int_eq(results_put_series(results, &shape, r, &values[0][0]), OK);
    }
}

static void assert_says(double tau, double global, double drift, const char *words) {
    Results *results = NULL;
    Plan *plan = plan_new();
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    put_decay(results, tau);
    put_order(results, global, drift);
    ck_assert_int_eq(analysis_derive(results, &plan->system), OK);
    ck_assert_int_eq(analysis_judge(results, plan), OK);
    const char *said = results_find_fact(results, "equilibrium of quiescent");
    ck_assert_ptr_nonnull(said);
    ck_assert_msg(strstr(said, words), "'%s' lacks '%s'", said, words);
    results_free(results);
    memory_free(plan);
}

START_TEST(relaxations_are_counted) {
    assert_says(2, 0.1, 0, "it lasts 25 times its longest relaxation time, 2 d");
    assert_says(9, 0.1, 0, "d sqrt(m/kT), not the ten it should;");
    assert_says(100, 0.1, 0, "has not relaxed");
}
END_TEST

START_TEST(halves_are_compared) {
    assert_says(2, 0.1, 0, "its halves agree");
    assert_says(2, 0.1, 0.1, "its halves differ: bond_order_global_drift");
}
END_TEST

START_TEST(crystals_are_seen) {
    assert_says(2, 0.1, 0, "no crystal");
    assert_says(2, 0.8, 0, "it crystallises");
}
END_TEST

// S(q) with a peak at its second wave number, of height 3, `rise` higher in the second half.
static void put_peak(Results *results, double rise) {
    static const double waves[3] = {4, 6, 8}, heights[3] = {1, 3, 2};
    double times[BLOCKS], values[3][BLOCKS];
    for (int k = 0; k < BLOCKS; k++) times[k] = 10 * (k + 1);
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "structure_factor_stretches",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = 3, .values = waves},
                 {.name = "time", .unit = "d sqrt(m/kT)", .count = BLOCKS, .values = times}}};
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int q = 0; q < 3; q++) {
            for (int k = 0; k < BLOCKS; k++)
                values[q][k] = heights[q] + 0.01 * ((double)r - 1.5) * (k % 2 - 0.5) +
                               (q == 1 && k >= BLOCKS / 2 ? rise : 0);
        }
        ck_assert_int_eq(results_put_series(results, &shape, r, &values[0][0]), OK);
    }
}

START_TEST(the_peak_of_the_structure_factor_is_watched) {
    Results *results = NULL;
    Plan *plan = plan_new();
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    put_peak(results, 0.3);
    ck_assert_int_eq(analysis_derive(results, &plan->system), OK);
    ck_assert_int_eq(analysis_judge(results, plan), OK);
    const char *said = results_find_fact(results, "equilibrium of quiescent");
    ck_assert_ptr_nonnull(said);
    ck_assert_msg(strstr(said, "peaks at 3.15, q = 6 d^-1, and rises by 9.5 %"), "'%s'", said);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "structure_peak_drift"), 0.3, 1e-12);
    ck_assert_uint_eq(results->health_count, 1);
    ck_assert_str_eq(results->health[0].name, "structure_peak_rise_of_quiescent");
    ck_assert_double_eq_tol(results->health[0].value, 0.3 / 3.15, 1e-12);
    results_free(results);
    memory_free(plan);
}
END_TEST

// A glass of 100 discs whose centre of mass alone moves: D0/100.
START_TEST(a_drifting_glass_stands_still_about_its_centre) {
    static const char BROWNIAN[] = "system:\n"
                                   "  dimension: 2\n"
                                   "  particles: 100\n"
                                   "  packing_fraction: 0.5\n"
                                   "  species: {disc: {shape: disc, diameter: 1, fraction: 1}}\n"
                                   "dynamics: {method: event-driven}\n"
                                   "protocol: [{stage: quiescent, time: 100}]\n";
    static const double waves[2] = {3, 6};
    double times[LAGS], values[2][LAGS];
    Results *results = NULL;
    Plan *plan = NULL;
    ck_assert_msg(config_read_text(&plan, "run.yaml", BROWNIAN, strlen(BROWNIAN), NULL) == OK, "%s",
                  status_sentence());
    ck_assert_int_eq(results_create(&results, 1), OK);
    for (int k = 0; k < LAGS; k++) {
        times[k] = 0.1 * pow(10, 0.1 * k);
        for (int q = 0; q < 2; q++) values[q][k] = 0.8 * exp(-waves[q] * waves[q] * times[k] / 100);
    }
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = 2, .values = waves},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    ck_assert_int_eq(results_put_series(results, &shape, 0, &values[0][0]), OK);
    ck_assert_int_eq(analysis_derive(results, &plan->system), OK);
    ck_assert_int_eq(analysis_centre(results, plan), OK);
    const ResultSeries *still = series_of(results, "quiescent", "self_scattering_centred");
    for (size_t i = 0; i < still->size; i++) ck_assert_double_eq_tol(still->values[i], 0.8, 1e-12);
    results_free(results);
    memory_free(plan);
}
END_TEST

START_TEST(without_measurements_nothing_is_said) {
    Results *results = NULL;
    Plan *plan = plan_new();
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    ck_assert_int_eq(analysis_judge(results, plan), OK);
    ck_assert_ptr_null(results_find_fact(results, "equilibrium of quiescent"));
    results_free(results);
    memory_free(plan);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("equilibrium");
    TCase *c = tcase_create("equilibrium");
    tcase_add_test(c, relaxations_are_counted);
    tcase_add_test(c, halves_are_compared);
    tcase_add_test(c, crystals_are_seen);
    tcase_add_test(c, the_peak_of_the_structure_factor_is_watched);
    tcase_add_test(c, a_drifting_glass_stands_still_about_its_centre);
    tcase_add_test(c, without_measurements_nothing_is_said);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
