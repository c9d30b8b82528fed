// SPDX-License-Identifier: GPL-3.0-or-later
// Motion and structure under shear: free particles by Taylor's dispersion, exactly, and hard discs,
// whose pairs are pressed together where the flow compresses.
#include "simulate.h"

#include "observables/lags.h"

static const double SIGMAS = 5; // p = 6e-7 for each comparison
static const double RATE = 2, INTERVAL = 0.1;

// Random walks of n whole intervals tau, each of which carries x along by rate tau y as y is at its
// beginning: Taylor's 2t, (2/3) rate^2 t^3 and -rate t^2 with what a finite n adds.
typedef struct Dispersion {
    double xx, yy, xy;
} Dispersion;

static Dispersion dispersion(double time, double n) {
    const double rate = RATE;
    return (Dispersion){.xx = 2 * time + 2.0 / 3 * rate * rate * time * time * time * (1 + 1 / n) *
                                             (1 + 1 / (2 * n)),
                        .yy = 2 * time,
                        .xy = -rate * time * time * (1 + 1 / n)};
}

static Plan *free_plan(int dimension) {
    System system = system_of(dimension, 2000, dimension == 2 ? 1e-5 : 1e-6, 1);
    Plan *plan = new_plan(system, INTERVAL, 0.1, 1.5, 6);
    plan->stages[1].drive.flow.rate = RATE;
    return plan;
}

static double whole_intervals(double time) {
    return rint(time / (INTERVAL * INTERVAL / 2));
}

// _i: dimension.
START_TEST(free_particles_disperse_as_taylor_says) {
    Plan *plan = free_plan(2 + _i);
    observe(plan, &observable_non_affine_displacement);
    Results *results = simulate(plan);
    const ResultSeries *f = series_of(results, "measured", "non_affine_displacement");
    const size_t lags = f->axis[2].count, components = f->axis[1].count;
    size_t checked = 0;
    for (size_t k = 0; k < lags; k++) {
        const double time = f->axis[2].values[k], n = whole_intervals(time);
        if (n < 1 || fabs(n * INTERVAL * INTERVAL / 2 - time) > 1e-9 * time) continue;
        const Dispersion expected = dispersion(time, n);
        if (k % 4 != 0 && k + 1 < lags) continue;
        checked++;
        expect_within("<dx^2>", measured_at(results, "non_affine_displacement", k), expected.xx, 0,
                      SIGMAS, 0.05);
        expect_within("<dy^2>", measured_at(results, "non_affine_displacement", lags + k),
                      expected.yy, 0, SIGMAS, 0.05);
        if (n < 5) continue; // too small beside its noise
        expect_within("<dx dy>",
                      measured_at(results, "non_affine_displacement", (components - 1) * lags + k),
                      expected.xy, 0, SIGMAS, 0.5);
    }
    ck_assert_uint_ge(checked, 4);
    results_free(results);
}
END_TEST

// <exp(i(q(t).r(t) - q.r(0)))> = exp(-(q_x^2 dx^2 + 2 q_x q_y dx dy + q_y^2 dy^2)/2).
START_TEST(free_particles_scatter_as_taylor_says) {
    static const double ways[4][2] = {
        {1, 0}, {0, 1}, {M_SQRT1_2, M_SQRT1_2}, {M_SQRT1_2, -M_SQRT1_2}};
    Plan *plan = free_plan(2);
    Settings *settings = observe(plan, &observable_self_scattering);
    const OptionReals number = {1, {1.5}};
    memcpy(settings->bytes, &number, sizeof number); // wave_numbers come first
    Results *results = simulate(plan);
    const ResultSeries *f = series_of(results, "measured", "self_scattering");
    ck_assert_double_eq(f->axis[2].values[0], 1.5);
    const size_t lags = f->axis[3].count;
    for (size_t d = 0; d < 4; d++) {
        for (size_t k = 3; k < lags; k += 5) {
            const double time = f->axis[3].values[k], n = whole_intervals(time);
            if (n < 1 || fabs(n * INTERVAL * INTERVAL / 2 - time) > 1e-9 * time) continue;
            const Dispersion moved = dispersion(time, n);
            const double x = 1.5 * ways[d][0], y = 1.5 * ways[d][1];
            const double expected =
                exp(-(x * x * moved.xx + 2 * x * y * moved.xy + y * y * moved.yy) / 2);
            if (expected < 0.05) continue;
            expect_within(f->axis[1].labels[d],
                          measured_at(results, "self_scattering", d * lags + k), expected, 0,
                          SIGMAS, 0.2);
        }
    }
    results_free(results);
}
END_TEST

static Plan *dense_plan(double rate) {
    Plan *plan = new_plan(system_of(2, 500, 0.6, 1), 0.05, 20, 1, 8);
    plan->stages[1].drive.flow.rate = rate;
    return plan;
}

// Mean over the first fifth of d beyond contact of one harmonic of g.
static Estimate near_contact(Results *results, size_t harmonic) {
    const ResultSeries *g = series_of(results, "measured", "pair_harmonics");
    const size_t bins = g->axis[2].count;
    for (size_t r = 0; r < results->replicas; r++) {
        double sum = 0;
        for (size_t k = 50; k < 60; k++) sum += g->values[r * g->size + harmonic * bins + k] / 10;
        results_put_scalar(results, "measured", "near", "", "", r, sum);
    }
    return measured(results, "near");
}

static Results *dense_results(double rate) {
    Plan *plan = dense_plan(rate);
    observe(plan, &observable_angular_pair_distribution);
    observe(plan, &observable_planar_structure_factor);
    return simulate(plan);
}

START_TEST(pairs_at_rest_have_no_direction) {
    Results *results = dense_results(0);
    const Estimate mean = near_contact(results, 0);
    for (size_t h = 1; h < 3; h++) {
        const Estimate harmonic = near_contact(results, h);
        printf("harmonic %zu at rest: %g +- %g of %g\n", h, harmonic.value, harmonic.error,
               mean.value);
        ck_assert_double_lt(fabs(harmonic.value), SIGMAS * harmonic.error);
        ck_assert_double_lt(harmonic.error, 0.03 * mean.value);
    }
    results_free(results);
}
END_TEST

// By the strain that has come first and by its sign.
START_TEST(flow_presses_pairs_together_along_the_falling_diagonal) {
    Results *results[2] = {dense_results(1), dense_results(-1)};
    const Estimate one = near_contact(results[0], 1), other = near_contact(results[1], 1);
    const double error = hypot(one.error, other.error);
    printf("g_xy near contact at rates 1 and -1: %g +- %g, %g +- %g\n", one.value, one.error,
           other.value, other.error);
    ck_assert_double_lt(one.value, -5 * one.error);
    ck_assert_double_lt(fabs(one.value + other.value), SIGMAS * error);
    const Estimate mean = near_contact(results[0], 0);
    ck_assert_double_gt(one.value, -mean.value);
    for (int k = 0; k < 2; k++) results_free(results[k]);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("shear_motion");
    ADD_CASE(suite, free_particles_disperse_as_taylor_says, 2);
    ADD_CASE(suite, free_particles_scatter_as_taylor_says, 1);
    ADD_CASE(suite, pairs_at_rest_have_no_direction, 1);
    ADD_CASE(suite, flow_presses_pairs_together_along_the_falling_diagonal, 1);
    return run_suite(suite);
}
