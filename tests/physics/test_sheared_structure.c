// SPDX-License-Identifier: GPL-3.0-or-later
// What slow shear does to the pair distribution of a dilute suspension: of a single pair
//   g(r, theta) = 1 + Pe0 g_1(r) sin 2 theta,   g_1(r) = -(1/8) (d/r)^2,
// for 2 D0 times the Laplacian of it is 0 and no flux but the flow's enters at contact, where its
// stress is that of the viscosity phi^2/(2 pi) kT/D0 (Weysser, thesis, eqs. 5.58 and A.11).
#include "simulate.h"

static const double SIGMAS = 4;
static const double PECLET = 2;
// Shares of that law at this rate, from a program that solves the pair with its harmonics up to 8
// (they tend to 1 as the rate falls, the nearer the sooner). Others around the pair, of a packing
// fraction of 0.015, make contacts 2.5 % more frequent.
static const double KNOWN = 0.03, PRECISION = 0.08;
static const struct {
    const char *what;
    double first, last, share;
} ranges[] = {{"g_1 over -(1/8) (d/r)^2, from 1.06 to 1.5 d", 1.06, 1.5, 0.851},
              {"g_1 over -(1/8) (d/r)^2, from 1.5 to 2.2 d", 1.5, 2.2, 0.635}};

// What the measured harmonic is of the law over a range of distances: least squares, each bin by
// its pairs.
static double share_of_law(const double *harmonic, const ResultAxis *distance, double first,
                           double last) {
    double above = 0, below = 0;
    for (size_t k = 0; k < distance->count; k++) {
        const double r = distance->values[k], law = -PECLET / 8 / (r * r);
        if (r < first || r > last) continue;
        above += r * law * harmonic[k];
        below += r * law * law;
    }
    return above / below;
}

START_TEST(slow_shear_distorts_a_dilute_pair_as_theory_says) {
    enum { XY = 1 };
    Plan *plan = new_plan(system_of(2, 400, 0.015, 1), 0.05, 10, 200, 16);
    plan->stages[1].drive.flow.rate = PECLET;
    Settings *settings = observe(plan, &observable_angular_pair_distribution);
    set_number(settings, &observable_angular_pair_distribution.options, "looks", 2000);
    set_number(settings, &observable_angular_pair_distribution.options, "distances.last", 2.2);
    Results *results = simulate(plan);
    const ResultSeries *found = series_of(results, "measured", "pair_harmonics");
    const ResultAxis *distance = &found->axis[2];
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++) {
        for (size_t r = 0; r < results->replicas; r++) {
            const double *harmonic = found->values + r * found->size + XY * distance->count;
            results_put_scalar(results, "measured", "share", "", "", r,
                               share_of_law(harmonic, distance, ranges[k].first, ranges[k].last));
        }
        expect_within(ranges[k].what, measured(results, "share"), ranges[k].share, KNOWN, SIGMAS,
                      PRECISION);
    }
    results_free(results);
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("sheared structure");
    ADD_CASE(s, slow_shear_distorts_a_dilute_pair_as_theory_says, 1);
    return s;
}

int main(void) {
    return run_suite(suite());
}
