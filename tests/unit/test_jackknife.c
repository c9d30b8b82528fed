// SPDX-License-Identifier: GPL-3.0-or-later
// The errors of fits against a slow twin: each number found anew from the means without each one of
// a few replicas, by other methods than the analysis has, and the jackknife's error written down
// as Efron has it, from the spread of what was found.
#include "analysis/analysis.h"
#include "observe.h"
#include "suite.h"
#include "rng/rng.h"

enum { REPLICAS = 5, LAGS = 61, WAVES = 2, STATES = 6, NOBODY = -1 };

typedef double Found(int without, const void *data);

// The bias-free value and its error: with the number of all replicas and those without each.
static Estimate jackknife(Found *found, const void *data) {
    const double n = REPLICAS, all = found(NOBODY, data);
    double rest[REPLICAS], mean = 0, squares = 0;
    for (int r = 0; r < REPLICAS; r++) mean += rest[r] = found(r, data);
    mean /= n;
    for (int r = 0; r < REPLICAS; r++) squares += pow(rest[r] - mean, 2);
    return (Estimate){.value = n * all - (n - 1) * mean, .error = sqrt((n - 1) / n * squares)};
}

// `closeness`, of the error, is what the analysis' own methods stop at.
static void expect_same(Estimate estimate, Estimate twin, double closeness) {
    ck_assert_double_gt(twin.error, 1e-4 * fabs(twin.value)); // there is something to compare
    ck_assert_double_eq_tol(estimate.value, twin.value, closeness * twin.error);
    ck_assert_double_eq_tol(estimate.error, twin.error, closeness * twin.error);
}

// Decays in two steps, with a plateau and a time of each replica's own.
typedef struct Decays {
    double times[LAGS], values[REPLICAS][WAVES][LAGS];
    Results *results;
} Decays;

static Decays *decays_make(void) {
    static Decays d;
    static const double waves[WAVES] = {3, 6};
    Rng rng = rng_open((RngKey){.seed = 11}, STREAM_PACKING, 0, 0);
    for (int k = 0; k < LAGS; k++) d.times[k] = 1e-3 * pow(10, k / 10.0);
    for (int r = 0; r < REPLICAS; r++) {
        const double scale = 50 * (1 + 0.1 * rng_normal(&rng)), f = 0.7 + 0.01 * rng_normal(&rng);
        for (int q = 0; q < WAVES; q++) {
            for (int k = 0; k < LAGS; k++) {
                const double t = d.times[k], late = f * exp(-pow(t / scale, 0.6));
                const double value = (1 - f) * exp(-t / 0.01) + late + 1e-4 * rng_normal(&rng);
                d.values[r][q][k] = q == 0 ? value : value * value;
            }
        }
    }
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = WAVES, .values = waves},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = d.times}}};
    ck_assert_int_eq(results_create(&d.results, REPLICAS), OK);
    for (size_t r = 0; r < REPLICAS; r++)
        ck_assert_int_eq(results_put_series(d.results, &shape, r, &d.values[r][0][0]), OK);
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(d.results, &system), OK);
    return &d;
}

static Estimate estimate_of(const Results *results, const char *name, size_t element) {
    return results_series_estimate(results, series_of(results, "quiescent", name), element);
}

static double mean_of(const Decays *d, int without, int q, int k) {
    double sum = 0, n = 0;
    for (int r = 0; r < REPLICAS; r++) {
        if (r == without) continue;
        sum += d->values[r][q][k];
        n++;
    }
    return sum / n;
}

static int lag_at(const Decays *d, double time) {
    int nearest = 0;
    for (int k = 1; k < LAGS; k++) {
        if (fabs(log(d->times[k] / time)) < fabs(log(d->times[nearest] / time))) nearest = k;
    }
    return nearest;
}

// One of A, tau and beta of a wave number, over the lags that were chosen with all replicas.
typedef struct Asked {
    const Decays *decays;
    int q, begin, end, number;
} Asked;

// x of the three equations m x = y, by Cramer's rule.
static double determinant(double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static void solve(double m[3][3], const double y[3], double x[3]) {
    for (int column = 0; column < 3; column++) {
        double with[3][3];
        memcpy(with, m, sizeof with);
        for (int row = 0; row < 3; row++) with[row][column] = y[row];
        x[column] = determinant(with) / determinant(m);
    }
}

// Gauss and Newton's method with derivatives by hand, in A, tau and beta themselves.
static double kohlrausch(int without, const void *data) {
    const Asked *asked = data;
    // Of the square of a law of Kohlrausch the time is shorter by 2^(1/beta).
    double number[3] = {asked->q ? 0.49 : 0.7, asked->q ? 16 : 50, 0.6}, step[3];
    for (int turn = 0; turn < 200; turn++) {
        double m[3][3] = {{0}}, y[3] = {0};
        for (int k = asked->begin; k < asked->end; k++) {
            const double t = asked->decays->times[k], power = pow(t / number[1], number[2]);
            const double law = number[0] * exp(-power);
            const double slope[3] = {law / number[0], law * power * number[2] / number[1],
                                     -law * power * log(t / number[1])};
            const double off = mean_of(asked->decays, without, asked->q, k) - law;
            for (int i = 0; i < 3; i++) {
                y[i] += slope[i] * off;
                for (int j = 0; j < 3; j++) m[i][j] += slope[i] * slope[j];
            }
        }
        solve(m, y, step);
        for (int i = 0; i < 3; i++) number[i] += step[i];
    }
    ck_assert_double_lt(fabs(step[1]), 1e-10 * number[1]);
    return number[asked->number];
}

START_TEST(errors_of_kohlrausch_law_are_those_of_a_slow_twin) {
    static const char *const names[] = {"self_scattering_kohlrausch_amplitude",
                                        "self_scattering_kohlrausch_time",
                                        "self_scattering_kohlrausch_exponent"};
    const Decays *d = decays_make();
    for (int q = 0; q < WAVES; q++) {
        const Estimate begin =
            estimate_of(d->results, "self_scattering_kohlrausch_window", (size_t)q);
        Asked asked = {.decays = d, .q = q, .begin = lag_at(d, begin.value)};
        while (asked.end < LAGS && mean_of(d, NOBODY, q, asked.end) > 0.02) asked.end++;
        for (asked.number = 0; asked.number < 3; asked.number++)
            expect_same(estimate_of(d->results, names[asked.number], (size_t)q),
                        jackknife(kohlrausch, &asked), 1e-5);
    }
    results_free(d->results);
}
END_TEST

// Where the mean falls to 1/e, by halving intervals in log t.
static double relaxation(int without, const void *data) {
    const Asked *asked = data;
    int k = 1;
    while (mean_of(asked->decays, without, asked->q, k) >= exp(-1)) k++;
    const double above = mean_of(asked->decays, without, asked->q, k - 1),
                 below = mean_of(asked->decays, without, asked->q, k);
    double from = 0, to = 1;
    for (int turn = 0; turn < 60; turn++) {
        const double middle = (from + to) / 2;
        *(above + middle * (below - above) > exp(-1) ? &from : &to) = middle;
    }
    return asked->decays->times[k - 1] * pow(10, from / 10); // ten lags in a decade
}

// X at a lag, the plateau passed at `begin`.
static double factorised(int without, const void *data) {
    const Asked *asked = data;
    const int before = asked->begin - 5, after = asked->begin + 5; // half a decade
    const double f = mean_of(asked->decays, without, asked->q, before);
    return (mean_of(asked->decays, without, asked->q, asked->number) - f) /
           (f - mean_of(asked->decays, without, asked->q, after));
}

static double height(int without, const void *data) {
    const Asked *asked = data;
    return mean_of(asked->decays, without, asked->q, asked->begin);
}

START_TEST(errors_of_a_plateau_are_those_of_a_slow_twin) {
    const Decays *d = decays_make();
    enum { PLATEAU = 1 }; // among the borders of the window
    const Estimate at = estimate_of(d->results, "self_scattering_factorisation_window", PLATEAU);
    for (int q = 0; q < WAVES; q++) {
        const size_t row = (size_t)q;
        Asked asked = {.decays = d, .q = q, .begin = lag_at(d, at.value)};
        expect_same(estimate_of(d->results, "self_scattering_plateau", row),
                    jackknife(height, &asked), 1e-9);
        expect_same(estimate_of(d->results, "self_scattering_relaxation_time", row),
                    jackknife(relaxation, &asked), 1e-9);
        asked.number = asked.begin + 12;
        expect_same(estimate_of(d->results, "self_scattering_factorisation_X",
                                row * LAGS + (size_t)asked.number),
                    jackknife(factorised, &asked), 1e-9);
    }
    results_free(d->results);
}
END_TEST

// Relaxation times of a sweep; replica r of every state is left out at once.
typedef struct Times {
    double tau[REPLICAS][STATES];
    bool exponent;
} Times;

static const double packing[STATES] = {0.77, 0.775, 0.78, 0.785, 0.7875, 0.79};

// Of a straight line of ln tau through -ln(phi_c - phi): its slope, and what is left of each state.
static double line(const double log_tau[STATES], double critical, double left[STATES]) {
    double x[STATES], mean_x = 0, mean_y = 0, xy = 0, xx = 0;
    for (int s = 0; s < STATES; s++) {
        x[s] = -log(critical - packing[s]);
        mean_x += x[s] / STATES;
        mean_y += log_tau[s] / STATES;
    }
    for (int s = 0; s < STATES; s++) {
        xy += (x[s] - mean_x) * (log_tau[s] - mean_y);
        xx += (x[s] - mean_x) * (x[s] - mean_x);
    }
    for (int s = 0; s < STATES; s++) left[s] = log_tau[s] - mean_y - xy / xx * (x[s] - mean_x);
    return xy / xx;
}

// Half the derivative of the sum of squares with respect to phi_c, over the exponent.
static double derivative(const double log_tau[STATES], double critical) {
    double left[STATES], sum = 0;
    line(log_tau, critical, left);
    for (int s = 0; s < STATES; s++) sum += left[s] / (critical - packing[s]);
    return sum;
}

// phi_c where the derivative is none, by halving intervals; or gamma there.
static double power_law(int without, const void *data) {
    const Times *times = data;
    double log_tau[STATES], left[STATES];
    for (int s = 0; s < STATES; s++) {
        double sum = 0, n = 0;
        for (int r = 0; r < REPLICAS; r++) {
            if (r == without) continue;
            sum += times->tau[r][s];
            n++;
        }
        log_tau[s] = log(sum / n);
    }
    double from = 0.7915, to = 0.80;
    const double sign = derivative(log_tau, from);
    ck_assert(sign * derivative(log_tau, to) < 0);
    for (int turn = 0; turn < 60; turn++) {
        const double middle = (from + to) / 2;
        *(sign * derivative(log_tau, middle) > 0 ? &from : &to) = middle;
    }
    return times->exponent ? line(log_tau, from, left) : from;
}

START_TEST(errors_of_the_power_law_are_those_of_a_slow_twin) {
    Times times;
    Results *results = NULL;
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "self_scattering_relaxation_time",
        .axes = 2,
        .axis = {{.name = "packing_fraction", .unit = "", .count = STATES, .values = packing},
                 {.name = "wave_number", .unit = "1/d", .count = 1, .values = (double[]){4.5}}}};
    Rng rng = rng_open((RngKey){.seed = 12}, STREAM_PACKING, 0, 0);
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    for (size_t r = 0; r < REPLICAS; r++) {
        for (int s = 0; s < STATES; s++)
            times.tau[r][s] = pow(0.7948 - packing[s], -2.5) * (1 + 0.05 * rng_normal(&rng));
        ck_assert_int_eq(results_put_series(results, &shape, r, times.tau[r]), OK);
    }
    ck_assert_int_eq(analysis_derive_sweep(results), OK);
    times.exponent = false;
    expect_same(estimate_of(results, "self_scattering_critical_packing_fraction", 0),
                jackknife(power_law, &times), 1e-5);
    times.exponent = true;
    expect_same(estimate_of(results, "self_scattering_critical_exponent", 0),
                jackknife(power_law, &times), 1e-5);
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("jackknife");
    TCase *c = tcase_create("jackknife");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, errors_of_kohlrausch_law_are_those_of_a_slow_twin);
    tcase_add_test(c, errors_of_a_plateau_are_those_of_a_slow_twin);
    tcase_add_test(c, errors_of_the_power_law_are_those_of_a_slow_twin);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
