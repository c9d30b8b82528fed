// SPDX-License-Identifier: GPL-3.0-or-later
// The isotropically sheared model: at rest and at small rates it is the theory at rest, a glass
// yields, slow flow at the transition is beta scaling, and numbers converge with the grid.
#include "suite.h"

#include "mct/sheared.h"

#include "mct/beta.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "mct/forms.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

typedef struct Fluid {
    Grid *grid;
    Oz *oz;
    const Structure *structure;
} Fluid;

static Fluid fluid_new(int dimension, double packing_fraction, size_t count, double last) {
    const Mixture mixture = {dimension, 1, {1}, {1}};
    Fluid f;
    ck_assert_int_eq(grid_create(&f.grid, dimension, count, last), OK);
    ck_assert_int_eq(oz_create(&f.oz, CLOSURE_PERCUS_YEVICK, &mixture, f.grid->wave_number, count),
                     OK);
    ck_assert_int_eq(oz_solve(f.oz, packing_fraction, &f.structure), OK);
    return f;
}

static void fluid_free(Fluid *f) {
    oz_free(f->oz);
    grid_free(f->grid);
}

static double flow_stress(const Fluid *f, double rate, size_t block, double *peak) {
    Sheared *sheared = NULL;
    ck_assert_int_eq(sheared_create(&sheared, f->grid, f->structure, rate, block), OK);
    *peak = 0;
    while (!sheared_has_decayed(sheared)) {
        ck_assert_msg(sheared_advance(sheared) == OK, "%s", status_sentence());
        *peak = fmax(*peak, sheared_stress(sheared));
    }
    const double stress = sheared_stress(sheared);
    sheared_free(sheared);
    return stress;
}

START_TEST(at_rest_it_is_the_theory_at_rest) {
    Fluid f = fluid_new(3, 0.5, 60, 25);
    Sheared *slow = NULL;
    Correlators *rest = NULL;
    ck_assert_int_eq(sheared_create(&slow, f.grid, f.structure, 1e-12, 64), OK);
    ck_assert_int_eq(correlators_create(&rest, f.grid, f.structure,
                                        &(CorrelatorSettings){.block = 64, .diffusion = {1}}),
                     OK);
    while (sheared_time(slow) < 100) {
        ck_assert_int_eq(sheared_advance(slow), OK);
        ck_assert_int_eq(correlators_advance(rest), OK);
        for (size_t m = 0; m < f.grid->count; m++)
            ck_assert_double_eq_tol(sheared_correlator(slow)[m], correlators_collective(rest)[m],
                                    1e-8);
    }
    sheared_free(slow);
    correlators_free(rest);
    fluid_free(&f);
}
END_TEST

// The stress of small rates is the viscosity at rest times the rate.
START_TEST(a_fluid_is_newtonian_at_small_rates) {
    for (int dimension = 2; dimension <= 3; dimension++) {
        Fluid f = fluid_new(dimension, dimension == 2 ? 0.65 : 0.48, 60, 25);
        Sheared *rest = NULL;
        double viscosity = 0, before = 0, time = 0, peak;
        ck_assert_int_eq(sheared_create(&rest, f.grid, f.structure, 0, 64), OK);
        while (!sheared_has_decayed(rest)) {
            before = sheared_modulus(rest);
            ck_assert_int_eq(sheared_advance(rest), OK);
            viscosity += (sheared_time(rest) - time) * (before + sheared_modulus(rest)) / 2;
            time = sheared_time(rest);
        }
        ck_assert_double_eq_tol(flow_stress(&f, 1e-5, 64, &peak) / (1e-5 * viscosity), 1, 1e-6);
        ck_assert(flow_stress(&f, 1, 64, &peak) < 0.9 * viscosity);
        sheared_free(rest);
        fluid_free(&f);
    }
}
END_TEST

// Beyond the cutoff of the spline c(q) goes on as contact has it: what a larger cutoff knows.
START_TEST(the_stress_converges_with_the_cutoff) {
    double stress[2], peak;
    for (int fine = 0; fine < 2; fine++) {
        Fluid f = fluid_new(3, 0.53, fine ? 150 : 100, fine ? 60 : 40);
        stress[fine] = flow_stress(&f, 1e-4, 64, &peak);
        fluid_free(&f);
    }
    ck_assert_double_eq_tol(stress[0] / stress[1], 1, 0.01);
}
END_TEST

// Above the transition at 0.5158 the stress does not go to 0 with the rate, and overshoots.
START_TEST(a_glass_yields) {
    Fluid f = fluid_new(3, 0.53, 60, 25);
    double peak;
    const double fast = flow_stress(&f, 1, 64, &peak), slow = flow_stress(&f, 1e-6, 64, &peak);
    const double slower = flow_stress(&f, 1e-8, 64, &peak);
    ck_assert(slow < 0.99 * fast);
    ck_assert_double_eq_tol(slower / slow, 1, 1e-3);
    ck_assert(peak > 1.05 * slower);
    ck_assert_double_eq_tol(flow_stress(&f, 1e-8, 128, &peak) / slower, 1, 1e-3);
    fluid_free(&f);
}
END_TEST

// t0 of the critical decay, F + H (t/t0)^-a at long times, of the wave number m.
static double critical_time(const Fluid *f, const CriticalPoint *point, size_t m) {
    Correlators *rest = NULL;
    const CorrelatorSettings settings = {.block = 256, .diffusion = {1}};
    ck_assert_int_eq(correlators_create(&rest, f->grid, f->structure, &settings), OK);
    while (correlators_time(rest) < 1e8) ck_assert_int_eq(correlators_advance(rest), OK);
    const double g = (correlators_collective(rest)[m] - point->form[m]) / point->amplitude[m];
    const double time = correlators_time(rest) * pow(g, 1 / point->exponents.a);
    correlators_free(rest);
    return time;
}

// At the transition the correlators of slow flow are the scaling function with the coefficient of
// shear that the critical point has, up to the next order in G: nothing is fitted.
START_TEST(slow_flow_at_the_transition_is_beta_scaling) {
    static const double RATE = 1e-10;
    const int dimension = 2 + _i;
    const size_t count = 60, m = dimension == 2 ? 14 : 16; // near the peak of S
    const double last = 25;
    CriticalPoint *point = NULL;
    const CriticalSearch search = {.mixture = {dimension, 1, {1}, {1}},
                                   .closure = CLOSURE_PERCUS_YEVICK,
                                   .count = count,
                                   .last = last,
                                   .low = dimension == 2 ? 0.6 : 0.45,
                                   .high = dimension == 2 ? 0.74 : 0.57};
    ck_assert_msg(critical_find(&point, &search) == OK, "%s", status_sentence());
    Fluid f = fluid_new(dimension, point->packing_fraction, count, last);
    const double t0 = critical_time(&f, point, m);
    const BetaSettings scaling = {.lambda = point->exponents.lambda,
                                  .shear = point->shear * pow(RATE * t0, 2),
                                  .last = 1e12 / t0};
    BetaFunction *beta = NULL;
    Sheared *flow = NULL;
    ck_assert_int_eq(beta_create(&beta, &scaling), OK);
    ck_assert_int_eq(sheared_create(&flow, f.grid, f.structure, RATE, 256), OK);
    double next = 1e5, least = 0;
    for (size_t i = 0; sheared_time(flow) < 1e9;) {
        ck_assert_int_eq(sheared_advance(flow), OK);
        const double time = sheared_time(flow) / t0;
        if (time * t0 < next) continue;
        next *= 1.3;
        while (i + 2 < beta->count && beta->time[i + 1] < time) i++;
        const double part = (time - beta->time[i]) / (beta->time[i + 1] - beta->time[i]);
        const double g = beta->value[i] + part * (beta->value[i + 1] - beta->value[i]);
        const double found = (sheared_correlator(flow)[m] - point->form[m]) / point->amplitude[m];
        ck_assert_double_eq_tol(found, g, 1.5 * g * g + 2e-3 * fabs(g) + 4e-6);
        least = fmin(least, g);
    }
    ck_assert(least < -0.02);
    sheared_free(flow);
    beta_free(beta);
    critical_free(point);
    fluid_free(&f);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("sheared theory");
    TCase *tests = tcase_create("isotropically sheared model");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, at_rest_it_is_the_theory_at_rest);
    tcase_add_test(tests, a_fluid_is_newtonian_at_small_rates);
    tcase_add_test(tests, the_stress_converges_with_the_cutoff);
    tcase_add_test(tests, a_glass_yields);
    tcase_add_loop_test(tests, slow_flow_at_the_transition_is_beta_scaling, 0, 2);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
