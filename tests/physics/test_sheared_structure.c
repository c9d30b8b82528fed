// SPDX-License-Identifier: GPL-3.0-or-later
// What slow shear does to the pair distribution of a dilute suspension: of a single pair
//   g(r, theta) = 1 + Pe0 g_1(r) sin 2 theta,   g_1(r) = -(1/8) (d/r)^2,
// for 2 D0 times the Laplacian of it is 0 and no flux but the flow's enters at contact, where its
// stress is that of the viscosity phi^2/(2 pi) kT/D0 (Weysser, thesis, eqs. 5.58 and A.11). And of
// a dense one: at any density and rate the stress of equal discs is carried by what stands before
// sin 2 theta at contact alone, so that the viscosity is -(pi/4) (rho d)^2 g_1(d) kT/D0.
#include "simulate.h"

#include "base/constants.h"
#include "numerics/fit.h"

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

static const struct {
    const char *what;
    double packing_fraction, rate, strain;
} dense[] = {{"g_1 at contact over the stress of collisions, 0.30", 0.30, 2, 60},
             {"g_1 at contact over the stress of collisions, 0.50", 0.50, 1, 40}};

// What the harmonic before sin 2 theta extrapolates to at contact, of a replica of equal discs.
static double at_contact(const ResultSeries *harmonics, size_t replica) {
    enum { XY = 1, CUBIC = 3 };
    static const double WIDTH = 0.12; // over which it is smooth, in d
    const ResultAxis *distance = &harmonics->axis[2];
    size_t first = 0, bins = 0;
    while (distance->values[first] < 1) first++;
    while (distance->values[first + bins] < 1 + WIDTH) bins++;
    double contact = NAN;
    const double *row =
        harmonics->values + replica * harmonics->size + XY * distance->count + first;
    ck_assert_int_eq(fit_value_at_edge(row, bins, CUBIC, &contact), OK);
    return contact;
}

// The stress of collisions, which no pair distribution enters. Of n discs the pairs are n (n -
// 1)/2. What flights within an interval carry is one per cent (see test_shear_stress.c).
START_TEST(dense_pairs_in_contact_carry_the_stress) {
    enum { DISCS = 100 };
    const System system = system_of(2, DISCS, dense[_i].packing_fraction, 1);
    Plan *plan = new_plan(system, 0.01, 30, 0, 8);
    plan->stage_count = 3;
    plan->stages[2] = plan->stages[1];
    for (size_t s = 1; s < 3; s++) plan->stages[s].drive.flow.rate = dense[_i].rate;
    strcpy(plan->stages[1].name, "start");
    plan->stages[1].strain = 3;
    plan->stages[2].strain = dense[_i].strain;
    observe(plan, &observable_stress);
    Settings *settings = observe(plan, &observable_angular_pair_distribution);
    set_number(settings, &observable_angular_pair_distribution.options, "looks", 8000);
    set_number(settings, &observable_angular_pair_distribution.options, "distances.last", 1.3);
    set_number(settings, &observable_angular_pair_distribution.options, "distances.spacing", 0.005);
    Results *results = simulate(plan);
    const double density = 4 / PI * dense[_i].packing_fraction;
    const double factor = -PI / 4 * density * density * (DISCS - 1) / DISCS;
    for (size_t r = 0; r < results->replicas; r++) {
        const double stress = results_find_scalar(results, "measured", "shear_stress")->values[r];
        const double contact = at_contact(series_of(results, "measured", "pair_harmonics"), r);
        results_put_scalar(results, "measured", "ratio", "", "", r, factor * contact / stress);
    }
    expect_within(dense[_i].what, measured(results, "ratio"), 1, 0.015, SIGMAS, 0.05);
    results_free(results);
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("sheared structure");
    ADD_CASE(s, slow_shear_distorts_a_dilute_pair_as_theory_says, 1);
    ADD_CASE(s, dense_pairs_in_contact_carry_the_stress, sizeof dense / sizeof *dense);
    return s;
}

int main(void) {
    return run_suite(suite());
}
