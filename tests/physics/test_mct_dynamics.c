// SPDX-License-Identifier: GPL-3.0-or-later
// Mode-coupling theory in time: the memory integral against an exact solution, limits of long and
// short times, and the scaling functions near a transition.
#include "suite.h"

#include "mct/beta.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "mct/glass.h"
#include "mct/history.h"

#include "base/memory.h"

#include <gsl/gsl_sf_bessel.h>

#include <check.h>
#include <math.h>
#include <string.h>

static const Mixture SPHERES = {3, 1, {1}, {1}};

// The model F1, phi' + phi + int m phi' = 0 with m = phi, has phi = exp(-2t) (I0(2t) + I1(2t)) at
// its coupling 1. The largest error up to t = 100.
static double f1_error(size_t block) {
    enum { LINE = 8 };
    History h;
    double step = 1e-5 / (double)block, error = 0;
    ck_assert_int_eq(history_create(&h, block, LINE, LINE, LINE), OK);
    for (size_t i = 0; i <= block / 2; i++) {
        const double t = (double)i * step;
        *history_f(&h, i) = *history_m(&h, i) = 1 - t + t * t;
        if (i > 0) history_average(&h, i);
    }
    while (step * (double)block < 100) {
        for (size_t i = block / 2 + 1; i <= block; i++) {
            _Alignas(MEMORY_ALIGNMENT) double known[LINE] = {0};
            history_known(&h, i, 0, 0, known);
            const double past =
                (4 * *history_f(&h, i - 1) - *history_f(&h, i - 2)) / (2 * step) - known[0];
            double phi = *history_f(&h, i - 1);
            for (int k = 0; k < 200; k++)
                phi = (past + phi * (1 - h.f_mean[LINE])) / (1.5 / step + 1 + h.m_mean[LINE]);
            *history_f(&h, i) = *history_m(&h, i) = phi;
            history_average(&h, i);
            const double x = 2 * (double)i * step;
            const double exact = gsl_sf_bessel_I0_scaled(x) + gsl_sf_bessel_I1_scaled(x);
            error = fmax(error, fabs(phi - exact));
        }
        history_decimate(&h);
        step *= 2;
    }
    history_free(&h);
    return error;
}

START_TEST(the_memory_integral_solves_f1_to_second_order) {
    const double coarse = f1_error(64), middle = f1_error(128), fine = f1_error(256);
    ck_assert(coarse < 5e-5);
    ck_assert_double_eq_tol(coarse / middle, 4, 0.4);
    ck_assert_double_eq_tol(middle / fine, 4, 0.4);
}
END_TEST

typedef struct Run {
    Grid *grid;
    Oz *oz;
    const Structure *structure;
    Correlators *correlators;
} Run;

static Run run_new(const Mixture *mixture, double phi, size_t count, double last, size_t block) {
    Run run;
    ck_assert_int_eq(grid_create(&run.grid, mixture->dimension, count, last), OK);
    ck_assert_int_eq(
        oz_create(&run.oz, CLOSURE_PERCUS_YEVICK, mixture, run.grid->wave_number, count), OK);
    ck_assert_int_eq(oz_solve(run.oz, phi, &run.structure), OK);
    const CorrelatorSettings settings = {block, {1, 1}, true};
    ck_assert_msg(correlators_create(&run.correlators, run.grid, run.structure, &settings) == OK,
                  "%s", status_sentence());
    return run;
}

static void run_until(Run *run, double time) {
    while (correlators_time(run->correlators) < time * (1 - 1e-9))
        ck_assert_msg(correlators_advance(run->correlators) == OK, "%s", status_sentence());
}

static void run_free(Run *run) {
    correlators_free(run->correlators);
    oz_free(run->oz);
    grid_free(run->grid);
}

// Tagged kernels in the long-time limit of a glass, from collective and tagged form factors.
static void tagged_form(Model *model, const double *form, double *self, double *localisation) {
    Radial radial;
    double *memory = NULL;
    ck_assert_int_eq(radial_create(&radial, model), OK);
    ck_assert_int_eq(NEW_ARRAY(memory, model->grid->stride), OK);
    model_transform(model, form, &radial);
    for (size_t m = 0; m < model->grid->count; m++) self[m] = 1;
    for (int k = 0; k < 2000; k++) {
        model_tagged(model, &radial, self, memory);
        for (size_t m = 0; m < model->grid->count; m++) self[m] = memory[m] / (1 + memory[m]);
    }
    model_displacement(model, self, localisation);
    radial_free(&radial);
    memory_free(memory);
}

START_TEST(a_glass_stops_at_its_form_factors) {
    Run run = run_new(&SPHERES, 0.53, 100, 40, 64);
    Model *model = NULL;
    double *form = NULL, *self = NULL, localisation;
    bool glass;
    ck_assert_int_eq(model_create(&model, run.grid, run.structure), OK);
    ck_assert_int_eq(NEW_ARRAY(form, model->size), OK);
    ck_assert_int_eq(NEW_ARRAY(self, model->size), OK);
    memcpy(form, model->factor, model->size * sizeof *form);
    ck_assert_int_eq(glass_form_factors(model, form, &glass), OK);
    ck_assert(glass);
    tagged_form(model, form, self, &localisation);
    run_until(&run, 1e9);
    for (size_t m = 0; m < run.grid->count; m++) {
        ck_assert_double_eq_tol(correlators_collective(run.correlators)[m], form[m], 2e-6);
        ck_assert_double_eq_tol(correlators_self(run.correlators)[m], self[m], 2e-6);
    }
    // dr^2 -> 2 d r_l^2 with r_l^2 = 1/m
    ck_assert_double_eq_tol(correlators_displacement(run.correlators)[0] * localisation / 6, 1,
                            1e-4);
    memory_free(form);
    memory_free(self);
    model_free(model);
    run_free(&run);
}
END_TEST

START_TEST(short_times_are_free_diffusion) {
    Run run = run_new(&SPHERES, 0.5, 60, 25, 64);
    run_until(&run, 1e-7);
    const double t = correlators_time(run.correlators);
    const double *phi = correlators_collective(run.correlators);
    const double *self = correlators_self(run.correlators);
    for (size_t m = 0; m < run.grid->count; m++) {
        const double q = run.grid->wave_number[m], factor = run.structure->factor[m];
        ck_assert_double_eq_tol(phi[m], factor - q * q * t, 1e-4 * q * q * t);
        ck_assert_double_eq_tol(self[m], 1 - q * q * t, 1e-3 * q * q * t);
    }
    ck_assert_double_eq_tol(correlators_displacement(run.correlators)[0] / (6 * t), 1, 1e-3);
    run_free(&run);
}
END_TEST

// Halving the spacing of time makes the error a quarter.
START_TEST(correlators_converge_to_second_order_in_the_block) {
    double phi[3], self[3], displacement[3];
    for (size_t i = 0; i < 3; i++) {
        Run run = run_new(&SPHERES, 0.51, 60, 25, (size_t)64 << i);
        // A time of the coarsest grid, and so of all.
        const double first = 1e-3 / (pow(run.grid->wave_number[59], 2) * 32);
        run_until(&run, 40 * ldexp(first, 26));
        phi[i] = correlators_collective(run.correlators)[16];
        self[i] = correlators_self(run.correlators)[16];
        displacement[i] = correlators_displacement(run.correlators)[0];
        run_free(&run);
    }
    ck_assert_double_eq_tol((phi[0] - phi[1]) / (phi[1] - phi[2]), 4, 1);
    ck_assert(fabs(phi[1] - phi[2]) < 1e-3);
    ck_assert_double_eq_tol((self[0] - self[1]) / (self[1] - self[2]), 4, 1);
    ck_assert_double_eq_tol(
        (displacement[0] - displacement[1]) / (displacement[1] - displacement[2]), 4, 1);
}
END_TEST

START_TEST(a_mixture_of_equals_moves_like_the_pure_fluid) {
    const Mixture twins = {3, 2, {1, 1}, {0.3, 0.7}};
    Run one = run_new(&SPHERES, 0.5, 40, 20, 64), two = run_new(&twins, 0.5, 40, 20, 64);
    run_until(&one, 3);
    run_until(&two, 3);
    const double *pure = correlators_collective(one.correlators);
    const double *mixed = correlators_collective(two.correlators);
    const size_t stride = one.grid->stride;
    for (size_t m = 0; m < 40; m++) {
        const double sum = mixed[m] + 2 * mixed[stride + m] + mixed[2 * stride + m];
        ck_assert_double_eq_tol(sum, pure[m], 1e-7);
        const double self = correlators_self(one.correlators)[m];
        ck_assert_double_eq_tol(correlators_self(two.correlators)[m], self, 1e-7);
        ck_assert_double_eq_tol(correlators_self(two.correlators)[stride + m], self, 1e-7);
    }
    ck_assert_double_eq_tol(correlators_displacement(two.correlators)[1] /
                                correlators_displacement(one.correlators)[0],
                            1, 1e-7);
    run_free(&one);
    run_free(&two);
}
END_TEST

// Computed with another program, 4096 points per block; 1024 points here. Per lambda: the amplitude
// B, the zero of the fluid's function, and under shear, c = 3, -G/(rate t sqrt(c/(lambda - 1/2)))
// at rate t = 30, on its slow way to 1. NAN: the other program gave none.
static const struct {
    double lambda, amplitude, zero, shear;
} scaling[] = {
    {0.6, 0.39315, NAN, NAN},
    {0.65, 0.51561, NAN, NAN},
    {0.7, 0.6814164, 0.8502399, 0.9821406},
    {0.707107, 0.7097316, 0.8209222, 0.9835149},
    {0.735, 0.8357962, 0.7040119, 0.9876834},
    {0.74, 0.86128, NAN, 0.98826},
    {0.74213, 0.87244, NAN, NAN},
    {0.8, 1.26605, NAN, NAN},
};
enum { SCALING = sizeof scaling / sizeof *scaling };

START_TEST(the_beta_function_has_its_amplitude_and_its_zero) {
    const double lambda = scaling[_i].lambda, zero = scaling[_i].zero;
    BetaFunction *beta = NULL;
    double amplitude;
    ck_assert_int_eq(beta_von_schweidler(lambda, &amplitude), OK);
    ck_assert_double_eq_tol(amplitude, scaling[_i].amplitude, 1.5e-4 * amplitude);
    if (isnan(zero)) return;
    ck_assert_int_eq(
        beta_create(&beta, &(BetaSettings){.lambda = lambda, .sigma = -1, .last = 1e3}), OK);
    size_t i = 0;
    while (beta->value[i] > 0) i++;
    const double part = beta->value[i - 1] / (beta->value[i - 1] - beta->value[i]);
    ck_assert_double_eq_tol(beta->time[i - 1] + part * (beta->time[i] - beta->time[i - 1]), zero,
                            3e-4);
    beta_free(beta);
}
END_TEST

// A glass stops at 1/sqrt(1 - lambda); under shear G -> -rate t sqrt(c/(lambda - 1/2)), slowly.
START_TEST(the_beta_function_has_its_limits) {
    const double lambda = scaling[_i].lambda;
    BetaFunction *beta = NULL;
    ck_assert_int_eq(beta_create(&beta, &(BetaSettings){.lambda = lambda, .sigma = 1, .last = 1e9}),
                     OK);
    ck_assert_double_eq_tol(beta->value[beta->count - 1], 1 / sqrt(1 - lambda), 1e-6);
    beta_free(beta);
    if (isnan(scaling[_i].shear)) return;
    ck_assert_int_eq(
        beta_create(&beta, &(BetaSettings){.lambda = lambda, .shear = 3e-12, .last = 3e7}), OK);
    const size_t end = beta->count - 1;
    ck_assert_double_eq_tol(-beta->value[end] / (1e-6 * beta->time[end] * sqrt(3 / (lambda - 0.5))),
                            scaling[_i].shear, 1e-4);
    beta_free(beta);
}
END_TEST

// The time at which the correlator passes `level`, between the points of the grid; the value at the
// last point before is kept.
static double passage(Correlators *correlators, size_t m, double level) {
    double before = INFINITY, earlier = 0;
    for (;;) {
        ck_assert_msg(correlators_advance(correlators) == OK, "%s", status_sentence());
        const double now = correlators_collective(correlators)[m];
        const double time = correlators_time(correlators);
        if (now < level) return earlier + (time - earlier) * (before - level) / (before - now);
        before = now;
        earlier = time;
    }
}

// Just below the transition the final decay has the shape of the master curve: two times of it
// have the same ratio.
START_TEST(the_final_decay_is_the_master_curve) {
    CriticalPoint *point = NULL;
    ck_assert_int_eq(critical_find(&point, &(CriticalSearch){SPHERES, CLOSURE_PERCUS_YEVICK, 100,
                                                             40, 0.45, 0.6}),
                     OK);
    const size_t m = 17; // near the peak of S
    Run run = run_new(&SPHERES, point->packing_fraction * (1 - 1e-5), 100, 40, 128);
    const double form = point->form[m];
    double ratios[2];
    ratios[0] = passage(run.correlators, m, 0.7 * form);
    ratios[0] = passage(run.correlators, m, 0.2 * form) / ratios[0];
    run_free(&run);
    run = run_new(&SPHERES, point->packing_fraction, 100, 40, 128);
    Correlators *master = NULL;
    ck_assert_msg(correlators_create_master(&master, run.grid, run.structure, point->form,
                                            point->amplitude, point->exponents.b) == OK,
                  "%s", status_sentence());
    ratios[1] = passage(master, m, 0.7 * form);
    ratios[1] = passage(master, m, 0.2 * form) / ratios[1];
    ck_assert_double_eq_tol(ratios[0] / ratios[1], 1, 0.02);
    correlators_free(master);
    run_free(&run);
    critical_free(point);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("mct_dynamics");
    TCase *tests = tcase_create("time");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, the_memory_integral_solves_f1_to_second_order);
    tcase_add_test(tests, a_glass_stops_at_its_form_factors);
    tcase_add_test(tests, short_times_are_free_diffusion);
    tcase_add_test(tests, correlators_converge_to_second_order_in_the_block);
    tcase_add_test(tests, a_mixture_of_equals_moves_like_the_pure_fluid);
    tcase_add_loop_test(tests, the_beta_function_has_its_amplitude_and_its_zero, 0, SCALING);
    tcase_add_loop_test(tests, the_beta_function_has_its_limits, 0, SCALING);
    tcase_add_test(tests, the_final_decay_is_the_master_curve);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
