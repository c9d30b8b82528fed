// SPDX-License-Identifier: GPL-3.0-or-later
// Structure of hard discs and spheres against thermodynamics and integral-equation theory, and
// velocities against Maxwell.
#include "simulate.h"

#include "packing/packing.h"

#include "state/equation_of_state.h"
#include "base/constants.h"
#include "numerics/fit.h"

static const double SIGMAS = 4;

static double osmotic(int dimension, double eta) {
    const System system = system_of(dimension, 1000, eta, 1);
    return eta * equation_of_state(&system).compressibility_factor;
}

// S(0) kT = 1/(dP/drho), from the equation of state.
static double compressibility(int dimension, double eta) {
    const double h = 1e-3 * eta;
    return 2 * h / (osmotic(dimension, eta + h) - osmotic(dimension, eta - h));
}

// The intercept of S against q^2, for q below `last`: S is even in q.
static double intercept(const ResultSeries *s, size_t replica, double last) {
    const double *values = s->values + replica * s->size;
    double x[100], y[100], weights[100];
    size_t count = 0;
    for (size_t k = 0; k < s->axis[1].count && s->axis[1].values[k] < last; k++) {
        x[count] = s->axis[1].values[k] * s->axis[1].values[k];
        y[count] = values[k];
        weights[count] = s->axis[1].values[k]; // as the vectors in a shell
        count++;
    }
    return fit_line(x, y, weights, count).intercept;
}

// _i: dimension.
START_TEST(long_waves_scatter_as_the_compressibility_says) {
    const int dimension = 2 + _i;
    const double eta = _i == 0 ? 0.4 : 0.25;
    Plan *plan = new_plan(system_of(dimension, 1000, eta, 1), 0.1, 20, 5, 8);
    Settings *settings = observe(plan, &observable_structure_factor);
    const OptionTable *options = &observable_structure_factor.options;
    set_number(settings, options, "wave_numbers.last", 3);
    set_number(settings, options, "wave_numbers.vectors", 0);
    set_number(settings, options, "looks", 400);
    Results *results = simulate(plan);
    const ResultSeries *s = series_of(results, "measured", "structure_factor");
    for (size_t r = 0; r < results->replicas; r++) {
        results_put_scalar(results, "measured", "S0", "", "", r, intercept(s, r, 2));
    }
    const double expected = compressibility(dimension, eta);
    expect_within(_i == 0 ? "S(q -> 0), discs 0.40" : "S(q -> 0), spheres 0.25",
                  measured(results, "S0"), expected, 0.01 * expected, SIGMAS, 0.05);
    results_free(results);
}
END_TEST

START_TEST(structure_factor_peaks_where_percus_and_yevick_say) {
    // Percus-Yevick for discs at 0.5: maximum 1.938 at q d = 5.787; it is good to a few per cent.
    Plan *plan = new_plan(system_of(2, 1000, 0.5, 1), 0.05, 20, 2.5, 4);
    Settings *settings = observe(plan, &observable_structure_factor);
    set_number(settings, &observable_structure_factor.options, "looks", 200);
    Results *results = simulate(plan);
    const ResultSeries *s = series_of(results, "measured", "structure_factor");
    size_t peak = 0;
    for (size_t k = 0; k < s->axis[1].count; k++) {
        if (results_series_estimate(results, s, k).value >
            results_series_estimate(results, s, peak).value) {
            peak = k;
        }
    }
    expect_within("S at its peak, discs 0.50", results_series_estimate(results, s, peak), 1.938,
                  0.04, SIGMAS, 0.05);
    ck_assert_double_eq_tol(s->axis[1].values[peak], 5.787, 0.2);
    results_free(results);
}
END_TEST

START_TEST(pairs_beyond_the_first_shells_are_uncorrelated) {
    Plan *plan = new_plan(system_of(3, 1000, 0.2, 1), 0.1, 20, 2.5, 8);
    observe(plan, &observable_pair_distribution);
    Results *results = simulate(plan);
    const ResultSeries *g = series_of(results, "measured", "pair_distribution");
    const size_t bins = g->axis[1].count;
    for (size_t k = 0; g->axis[1].values[k] < 0.98; k++) {
        ck_assert_double_eq(results_series_estimate(results, g, k).value, 0);
    }
    for (size_t r = 0; r < results->replicas; r++) {
        double sum = 0, count = 0;
        for (size_t k = bins / 2; k < bins; k++, count++) sum += g->values[r * g->size + k];
        results_put_scalar(results, "measured", "far", "", "", r, sum / count);
    }
    // With N fixed g tends to 1 - S(0)/N + 1/N where pairs are counted over N (N - 1).
    const double s0 = compressibility(3, 0.2);
    expect_within("g far away, spheres 0.20", measured(results, "far"), 1 + (1 - s0) / 1000, 3e-4,
                  SIGMAS, 0.002);
    results_free(results);
}
END_TEST

// All with the same speed, in directions that add to zero: collisions alone must make Maxwell of
// it.
START_TEST(collisions_make_maxwellian_velocities) {
    const int dimension = 2 + _i;
    System system = system_of(dimension, 1000, dimension == 2 ? 0.5 : 0.4, 2);
    system.species[1].mass = 3;
    const RngKey key = {.seed = 20261125, .replica = (uint64_t)_i};
    PackingReport report;
    State *state = NULL;
    ck_assert_int_eq(packing_create(&state, &system, key, NULL, &report), OK);
    for (size_t i = 0; i < state->count; i++) {
        const double speed = sqrt(dimension / state->mass[i]) * (i % 2 ? 1 : -1);
        for (int a = 0; a < 3; a++) state->velocity[a][i] = 0;
        state->velocity[i / 2 % (size_t)dimension][i] = speed;
    }
    Settings settings = settings_of(&propagator_newtonian.options);
    Propagator *newtonian = NULL;
    Tally tally = {0};
    ck_assert_int_eq(propagator_newtonian.create(&newtonian, &settings, state, key), OK);
    propagator_newtonian.advance(newtonian, 2000, &tally); // 20 d sqrt(m/kT): many collisions each
    double counts[2][2][30] = {{{0}}};
    enum { LOOKS = 100 };
    for (int look = 0; look < LOOKS; look++) {
        propagator_newtonian.advance(newtonian, 100, &tally);
        for (size_t i = 0; i < state->count; i++) {
            for (int a = 0; a < dimension; a++) {
                const double u = state->velocity[a][i] * sqrt(state->mass[i]);
                const double bin = fmin(fabs(u) / 0.1, 29);
                counts[state->species_of[i]][u > 0][(int)bin]++;
            }
        }
    }
    propagator_newtonian.free(newtonian);
    for (int s = 0; s < 2; s++) {
        double chi = 0;
        for (int k = 0; k < 30; k++) {
            const double beyond = k == 29 ? 1 : erf((k + 1) * 0.1 / sqrt(2));
            const double expected = 500 * dimension * LOOKS * (beyond - erf(k * 0.1 / sqrt(2))) / 2;
            for (int sign = 0; sign < 2; sign++) {
                const double difference = counts[s][sign][k] - expected;
                chi += difference * difference / expected;
            }
        }
        printf("%-58s %10.3f  expected 59 +- 11\n", "chi^2 of velocities, species", chi);
        ck_assert_double_lt(fabs(chi - 59), SIGMAS * sqrt(2 * 59));
    }
    state_free(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("structure");
    ADD_CASE(suite, long_waves_scatter_as_the_compressibility_says, 2);
    ADD_CASE(suite, structure_factor_peaks_where_percus_and_yevick_say, 1);
    ADD_CASE(suite, pairs_beyond_the_first_shells_are_uncorrelated, 1);
    ADD_CASE(suite, collisions_make_maxwellian_velocities, 2);
    return run_suite(suite);
}
