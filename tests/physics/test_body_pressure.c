// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure of hard bodies from virtual compressions: pair by pair against a slow twin, then of
// spheres and rods in equilibrium against their virial series and equations of state.
// Fixed seeds.
#include "shapes/overlap.h"
#include "simulate.h"
#include "state/equation_of_state.h"

#include <check.h>
#include <math.h>

static const RngKey KEY = {.seed = 20261125};

static System bodies(ShapeKind shape, int64_t particles, double number_density) {
    System system = {.dimension = 3,
                     .particles = particles,
                     .number_density = number_density,
                     .species_count = 1};
    system.species[0] = (Species){.name = "body",
                                  .shape = shape,
                                  .diameter = 1,
                                  .length = shape == SHAPE_SPHEROCYLINDER ? 5 : 0,
                                  .mass = 1,
                                  .fraction = 1};
    return system;
}

static System rods_and_spheres(int64_t particles, double number_density) {
    System system = bodies(SHAPE_SPHEROCYLINDER, particles, number_density);
    system.species[1] = bodies(SHAPE_SPHERE, 1, 1).species[0];
    system.species[1].diameter = 2;
    system.species_count = 2;
    system.species[0].fraction = system.species[1].fraction = 0.5;
    return system;
}

// Pairs that overlap when the whole configuration, box and all, is shrunk by `scale`: every one of
// the images around looked at, none searched for.
static double overlaps_at(const State *state, double scale) {
    double overlaps = 0;
    for (size_t i = 0; i < state->count; i++) {
        for (size_t j = 0; j < i; j++) {
            const Body first = species_body(&state->system.species[state->species_of[i]]);
            const Body second = species_body(&state->system.species[state->species_of[j]]);
            bool overlap = false;
            for (int n = 0; n < 27; n++) {
                const int shift[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
                double r[3], u[3] = {0, 0, 1}, v[3] = {0, 0, 1};
                for (int a = 0; a < 3; a++) {
                    const double x = state->position[a][j] - state->position[a][i];
                    r[a] = (x + shift[a] * state->box.edge[a]) / scale;
                    if (state->oriented) {
                        u[a] = state->orientation[a][i];
                        v[a] = state->orientation[a][j];
                    }
                }
                overlap |= overlap_of(&first, u, &second, v, r);
            }
            overlaps += overlap;
        }
    }
    return overlaps;
}

START_TEST(pairs_that_meet_are_those_of_the_twin) {
    enum { BINS = 20 };
    const System systems[] = {bodies(SHAPE_SPHERE, 200, 0.3), bodies(SHAPE_PLATELET, 200, 1.5),
                              bodies(SHAPE_SPHEROCYLINDER, 200, 0.05), rods_and_spheres(200, 0.05)};
    State *state = new_state(&systems[_i]);
    scatter(state, KEY, (uint64_t)_i);
    const ObservableKind *kind = &observable_virtual_compression;
    const Clock clock = {
        .tick = 1, .ticks = 1, .ticks_per_step = 1, .unit = "cycles", .stage = "one"};
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "scales.last", 1.2);
    set_number(&settings, &kind->options, "scales.spacing", 0.2 / BINS);
    ck_assert_int_eq(kind->check(&settings, &state->system, &clock), OK);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    const Tally none = {0};
    ck_assert_int_eq(kind->see(observer, 1, state, &none), OK);
    Results *results = written(observer, state);
    const ResultSeries *series = series_of(results, "one", "virtual_compression");
    ck_assert_uint_eq(series->size, BINS);
    double sum = 0;
    for (int k = 0; k < BINS; k++) {
        const double low = 1 + k * 0.2 / BINS, high = 1 + (k + 1) * 0.2 / BINS;
        sum += series->values[k] * 200 * (pow(high, 3) - pow(low, 3));
        ck_assert_double_eq_tol(sum, overlaps_at(state, high), 1e-6);
    }
    ck_assert_double_gt(sum, overlaps_at(state, 1) + 10); // or it tested little
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

static Estimate compressibility(System system, double settle, double looks) {
    Plan *plan = new_plan(system, 0.01, settle, 2 * looks, 6);
    for (size_t s = 0; s < 2; s++) {
        plan->stages[s].dynamics.kind = &propagator_monte_carlo;
        plan->stages[s].dynamics.settings = settings_of(&propagator_monte_carlo.options);
    }
    Settings *settings = observe(plan, &observable_virtual_compression);
    set_number(settings, &observable_virtual_compression.options, "looks", looks);
    Results *results = simulate(plan);
    const Estimate found = measured(results, "compressibility_factor_compression");
    results_free(results);
    return found;
}

START_TEST(spheres_have_the_pressure_of_spheres) {
    System system = bodies(SHAPE_SPHERE, 500, 0);
    system.packing_fraction = 0.3;
    expect_within("spheres at 0.3", compressibility(system, 200, 1500), equation_kolafa(0.3), 0.002,
                  4, 0.004);
}
END_TEST

// Z = 1 + x + b3 x^2 + b4 x^3 + b5 x^4 with x = B2 rho and b_n = B_n/B2^(n-1). Of rods L = 5 the
// coefficients of Dennison, Dijkstra & van Roij, Phys. Rev. Lett. 106, 208302 (2011), and data
// published with later work of the first; that of the next, some 0.005 x^5, is not known well.
static double virial_series(double x, const double b[3]) {
    return 1 + x * (1 + x * (b[0] + x * (b[1] + x * b[2])));
}

START_TEST(dilute_rods_have_the_pressure_of_their_virial_series) {
    static const double b[3] = {0.41946, 0.05275, 0.01108};
    System system = bodies(SHAPE_SPHEROCYLINDER, 300, 0);
    system.packing_fraction = _i == 0 ? 0.05 : 0.1;
    const Body body = species_body(&system.species[0]);
    const double x = shape_second_virial(&body, &body) * system_number_density(&system);
    expect_within("dilute rods", compressibility(system, 300, 800), virial_series(x, b),
                  0.005 * pow(x, 5), 4, 0.006);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("body_pressure");
    ADD_CASE(suite, pairs_that_meet_are_those_of_the_twin, 4);
    ADD_CASE(suite, spheres_have_the_pressure_of_spheres, 1);
    ADD_CASE(suite, dilute_rods_have_the_pressure_of_their_virial_series, 2);
    return run_suite(suite);
}
