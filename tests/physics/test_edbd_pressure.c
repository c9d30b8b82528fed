// SPDX-License-Identifier: GPL-3.0-or-later
// The engine against the equations of state: the pressure from momentum exchanged in collisions,
// and the number of collisions, which the redraw of velocities leaves at its equilibrium value for
// every thermostat interval. Fixed seeds; bounds are five standard errors from blocks, plus the
// uncertainty of the reference and the finite-size term (Z - 1)/N.
#include "edbd/edbd.h"
#include "packing/packing.h"

#include "base/constants.h"
#include "observe.h"
#include "suite.h"

enum { BLOCKS = 16 };
static const RngKey KEY = {.seed = 11};

typedef struct Case {
    const char *name;
    int dimension;
    double packing_fraction;
    size_t species;
    double pressure, tolerance; // compressibility factor Z and the uncertainty of the reference
    double interval;
    int64_t steps; // in a block
} Case;

// Discs: virial series to B10, resummed (Clisby and McCoy 2006). Spheres: Kolafa, Labik and
// Malijevsky 2004. The mixture (1.4, equal numbers): Santos, Yuste and Lopez de Haro 1999 on the
// same series.
static const Case CASES[] = {
    {"discs, 0.40", 2, 0.40, 1, 2.82933, 1e-4, 0.01, 1500},
    {"discs, 0.40, short interval", 2, 0.40, 1, 2.82933, 1e-4, 0.005, 4000},
    {"discs, 0.60, long interval", 2, 0.60, 1, 6.45693, 5e-3, 0.1, 200},
    {"spheres, 0.30", 3, 0.30, 1, 3.9842, 5e-4, 0.01, 1200},
    {"mixture, 0.40", 2, 0.40, 2, 2.7979, 2e-3, 0.01, 1500},
};
enum { CASES_COUNT = sizeof CASES / sizeof *CASES };

typedef struct Blocks {
    double pressure[BLOCKS], rate[BLOCKS]; // Z, collisions per particle and unit time, both counted
} Blocks;

static void measure(const Case *test, Blocks *blocks) {
    const PropagatorKind *kind = &propagator_event_driven;
    const System system = system_of(test->dimension, 1000, test->packing_fraction, test->species);
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "thermostat_interval", test->interval);
    State *state = NULL;
    Propagator *propagator = NULL;
    ck_assert_int_eq(packing_create(&state, &system, KEY, NULL, NULL), OK);
    ck_assert_int_eq(kind->create(&propagator, &settings, state, KEY), OK);
    const int64_t ticks = test->steps * kind->ticks_per_step(&settings);
    const double time = (double)test->steps * test->interval, count = (double)state->count;
    Tally tally = {0};
    ck_assert_int_eq(kind->advance(propagator, ticks, &tally), OK);
    for (int block = 0; block < BLOCKS; block++) {
        Tally now = {0};
        ck_assert_int_eq(kind->advance(propagator, ticks, &now), OK);
        double virial = 0;
        for (int a = 0; a < test->dimension; a++) virial += now.exchange[a][a];
        blocks->pressure[block] = 1 + virial / (test->dimension * count * time);
        blocks->rate[block] = 2 * (double)now.collisions / (count * time);
    }
    kind->free(propagator);
    state_free(state);
}

static void check_mean(const char *what, const double values[BLOCKS], double expected,
                       double tolerance) {
    double mean = 0, variance = 0;
    for (int b = 0; b < BLOCKS; b++) mean += values[b] / BLOCKS;
    for (int b = 0; b < BLOCKS; b++) variance += (values[b] - mean) * (values[b] - mean);
    const double error = sqrt(variance / (BLOCKS * (BLOCKS - 1)));
    ck_assert_msg(fabs(mean - expected) < 5 * error + tolerance && error < 0.01 * expected,
                  "%s: %.5f, expected %.5f, standard error %.5f", what, mean, expected, error);
}

START_TEST(pressure_and_collision_rate_are_those_of_the_equation_of_state) {
    const Case *test = &CASES[_i];
    Blocks blocks;
    measure(test, &blocks);
    const double excess = test->pressure - 1, finite = excess / 1000;
    check_mean(test->name, blocks.pressure, test->pressure, test->tolerance + finite);
    if (test->species > 1) return; // unequal pairs: each its own rate
    // Each collision counted for both: 4/sqrt(pi) (Z - 1) for discs, 6/sqrt(pi) for spheres.
    const double per_excess = 2 * test->dimension / sqrt(PI);
    check_mean(test->name, blocks.rate, per_excess * excess,
               per_excess * (test->tolerance + finite));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("edbd_pressure");
    TCase *physics = tcase_create("physics");
    tcase_set_timeout(physics, 120);
    tcase_add_loop_test(physics, pressure_and_collision_rate_are_those_of_the_equation_of_state, 0,
                        CASES_COUNT);
    suite_add_tcase(suite, physics);
    return run_suite(suite);
}
