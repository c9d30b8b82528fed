// SPDX-License-Identifier: GPL-3.0-or-later
// Plateaus and factorisation of scattering functions: of functions that factorise by construction,
// and of those of mode-coupling theory, whose plateaus are known.
#include "analysis/analysis.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "observe.h"
#include "suite.h"
#include "rng/rng.h"

#include <stdio.h>

enum { REPLICAS = 16, WAVES = 5, LAGS = 161 };
static const double NOISE = 1e-3;

// [wave][lag] with noise of each replica's own, analysed.
static Results *analysed(const double *waves, const double *times, double values[WAVES][LAGS],
                         double noise) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = WAVES, .values = waves},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    Rng rng = rng_open((RngKey){.seed = 11}, STREAM_PACKING, 0, 0);
    double noisy[WAVES][LAGS];
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int q = 0; q < WAVES; q++) {
            for (int k = 0; k < LAGS; k++) noisy[q][k] = values[q][k] + noise * rng_normal(&rng);
        }
        ck_assert_int_eq(results_put_series(results, &shape, r, &noisy[0][0]), OK);
    }
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    return results;
}

static Estimate found(const Results *results, const char *quantity, size_t element) {
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "self_scattering_%s", quantity);
    return results_series_estimate(results, series_of(results, "quiescent", name), element);
}

// 10 a decade from 1e-6 on.
static void fill_times(double times[LAGS]) {
    for (int k = 0; k < LAGS; k++) times[k] = 1e-6 * pow(10, 0.1 * k);
}

// A step down to f, one down from it: of each wave number as much as f and h say, with the same
// course of time. `stretch` gives each wave number its own second step.
static void two_steps(const double *times, double stretch, double values[WAVES][LAGS],
                      double height[WAVES]) {
    for (int q = 0; q < WAVES; q++) {
        const double h = 0.06 * (q + 1);
        height[q] = 1 - 2 * h;
        for (int k = 0; k < LAGS; k++) {
            const double early = exp(-sqrt(times[k] / 1e-4));
            const double late = exp(-pow(times[k] / 1e5, 0.6 - stretch * q));
            values[q][k] = 1 - 2 * h + 2 * h * early - h * (1 - late);
        }
    }
}

START_TEST(what_factorises_is_one_curve) {
    static const double waves[WAVES] = {2, 4, 6, 8, 10};
    double times[LAGS], values[WAVES][LAGS], height[WAVES];
    fill_times(times);
    two_steps(times, 0, values, height);
    Results *results = analysed(waves, times, values, 0);
    for (size_t k = 0; k < LAGS; k++) {
        ck_assert_double_lt(found(results, "factorisation_spread", k).value, 1e-6);
        for (size_t q = 1; q < WAVES; q++) {
            const size_t at = q * LAGS + k;
            const double size = 1 + fabs(found(results, "factorisation_Y", k).value);
            ck_assert_double_eq_tol(found(results, "factorisation_X", at).value,
                                    found(results, "factorisation_X", k).value, 1e-8 * size);
            ck_assert_double_eq_tol(found(results, "factorisation_Y", at).value,
                                    found(results, "factorisation_Y", k).value, 1e-8 * size);
        }
    }
    ck_assert_double_eq_tol(found(results, "factorisation_window", 0).value, times[0], 1e-12);
    ck_assert_double_eq_tol(found(results, "factorisation_window", 2).value, times[LAGS - 1], 1e-3);
    for (size_t q = 0; q < WAVES; q++) // the second step has begun: a few hundredths of it
        ck_assert_double_eq_tol(found(results, "plateau", q).value, height[q],
                                0.005 * (double)(q + 1));
    results_free(results);
}
END_TEST

START_TEST(the_window_ends_where_the_functions_part) {
    static const double waves[WAVES] = {2, 4, 6, 8, 10};
    double times[LAGS], values[WAVES][LAGS], height[WAVES];
    fill_times(times);
    two_steps(times, 0.05, values, height);
    Results *results = analysed(waves, times, values, 0);
    const double first = found(results, "factorisation_window", 0).value,
                 plateau = found(results, "factorisation_window", 1).value,
                 last = found(results, "factorisation_window", 2).value;
    ck_assert(first < plateau && plateau < last);
    ck_assert_double_lt(last, 1e6);
    results_free(results);
}
END_TEST

static void a_single_step(const double *times, double values[WAVES][LAGS]) {
    for (int q = 0; q < WAVES; q++) {
        for (int k = 0; k < LAGS; k++) values[q][k] = exp(-times[k] * (q + 1));
    }
}

START_TEST(what_decays_at_once_has_no_plateau) {
    static const double waves[WAVES] = {2, 4, 6, 8, 10};
    double times[LAGS], values[WAVES][LAGS];
    fill_times(times);
    a_single_step(times, values);
    Results *results = analysed(waves, times, values, NOISE);
    ck_assert_ptr_null(results_find_series(results, "quiescent", "self_scattering_plateau"));
    ck_assert_ptr_null(
        results_find_series(results, "quiescent", "self_scattering_factorisation_window"));
    results_free(results);
}
END_TEST

START_TEST(a_glass_has_its_plateau_at_the_end) {
    static const double waves[WAVES] = {2, 4, 6, 8, 10};
    double times[LAGS], values[WAVES][LAGS];
    fill_times(times);
    for (int q = 0; q < WAVES; q++) {
        for (int k = 0; k < LAGS; k++)
            values[q][k] = 0.9 - 0.1 * q + 0.1 * (q + 1) * exp(-times[k]);
    }
    Results *results = analysed(waves, times, values, NOISE);
    for (size_t q = 0; q < WAVES; q++) {
        const Estimate plateau = found(results, "plateau", q);
        ck_assert_double_eq_tol(plateau.value, 0.9 - 0.1 * (double)q, 4 * NOISE / sqrt(REPLICAS));
        // 16 values give their error to a fifth.
        ck_assert_double_eq_tol(plateau.error * sqrt(REPLICAS) / NOISE, 1, 0.75);
    }
    results_free(results);
}
END_TEST

// Values at log-spaced times, by straight lines in log t between those of the grid.
static void correlators_of(double packing_fraction, const Grid *grid, const size_t *at,
                           const double *times, double values[WAVES][LAGS]) {
    const Mixture spheres = {3, 1, {1}, {1}};
    const Structure *structure = NULL;
    Oz *oz = NULL;
    Correlators *c = NULL;
    ck_assert_int_eq(
        oz_create(&oz, CLOSURE_PERCUS_YEVICK, &spheres, grid->wave_number, grid->count), OK);
    ck_assert_int_eq(oz_solve(oz, packing_fraction, &structure), OK);
    const CorrelatorSettings settings = {64, {1}, false};
    ck_assert_int_eq(correlators_create(&c, grid, structure, &settings), OK);
    double time = 0, before[WAVES], now[WAVES];
    for (size_t q = 0; q < WAVES; q++) before[q] = 1;
    for (size_t k = 0; k < LAGS;) {
        ck_assert_int_eq(correlators_advance(c), OK);
        const double later = correlators_time(c);
        for (size_t q = 0; q < WAVES; q++)
            now[q] = correlators_collective(c)[at[q]] / structure->factor[at[q]];
        for (; k < LAGS && times[k] <= later; k++) {
            const double share = (times[k] - time) / (later - time);
            for (size_t q = 0; q < WAVES; q++)
                values[q][k] = before[q] + share * (now[q] - before[q]);
        }
        time = later;
        memcpy(before, now, sizeof now);
    }
    correlators_free(c);
    oz_free(oz);
}

// A thousandth below the transition of hard spheres. The corrections to f + h G are of second order
// in G, which grows away from the plateau; at the minimum of the fall G is small, but not zero.
START_TEST(theory_factorises_around_its_plateaus) {
    static const double wanted[WAVES] = {4, 7, 10, 12.5, 16};
    const CriticalSearch search = {.mixture = {3, 1, {1}, {1}},
                                   .closure = CLOSURE_PERCUS_YEVICK,
                                   .count = 100,
                                   .last = 40,
                                   .low = 0.4,
                                   .high = 0.6};
    CriticalPoint *point = NULL;
    Grid *grid = NULL;
    ck_assert_int_eq(critical_find(&point, &search), OK);
    ck_assert_int_eq(grid_create(&grid, 3, search.count, search.last), OK);
    double times[LAGS], waves[WAVES], values[WAVES][LAGS];
    size_t at[WAVES];
    fill_times(times);
    for (size_t q = 0; q < WAVES; q++) {
        for (at[q] = 0; grid->wave_number[at[q]] < wanted[q];) at[q]++;
        waves[q] = grid->wave_number[at[q]];
    }
    correlators_of(0.999 * point->packing_fraction, grid, at, times, values);
    Results *results = analysed(waves, times, values, NOISE);
    for (size_t q = 0; q < WAVES; q++) {
        const double form = point->form[at[q]] / point->factor[at[q]];
        const double amplitude = point->amplitude[at[q]] / point->factor[at[q]];
        const Estimate plateau = found(results, "plateau", q);
        ck_assert_double_eq_tol(plateau.value, form, 0.05 * amplitude + 4 * plateau.error);
    }
    const double first = found(results, "factorisation_window", 0).value,
                 plateau = found(results, "factorisation_window", 1).value,
                 last = found(results, "factorisation_window", 2).value;
    ck_assert_double_gt(plateau / first, 10);
    ck_assert_double_gt(last / plateau, 10);
    results_free(results);
    grid_free(grid);
    critical_free(point);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("factorisation");
    TCase *c = tcase_create("factorisation");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, what_factorises_is_one_curve);
    tcase_add_test(c, the_window_ends_where_the_functions_part);
    tcase_add_test(c, what_decays_at_once_has_no_plateau);
    tcase_add_test(c, a_glass_has_its_plateau_at_the_end);
    tcase_add_test(c, theory_factorises_around_its_plateaus);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
