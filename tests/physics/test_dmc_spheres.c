// SPDX-License-Identifier: GPL-3.0-or-later
// Monte Carlo of balls as physics: acceptances and displacements of dense and dilute hard spheres
// against independent values, the exact small-step slope, free walks, contact values and so the
// pressure, a pair of soft spheres against quadrature. Fixed seeds.
#include "suite.h"

#include "dmc/chain.h"
#include "packing/packing.h"
#include "state/equation_of_state.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 20261125};
static const double PI_HERE = 3.14159265358979323846;

static System spheres(int64_t particles, double packing_fraction) {
    System system = {.dimension = 3,
                     .particles = particles,
                     .packing_fraction = packing_fraction,
                     .species_count = 1};
    system.species[0] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 1};
    return system;
}

static State *packed(const System *system) {
    State *state = NULL;
    PackingReport report;
    ck_assert_int_eq(packing_create(&state, system, KEY, NULL, &report), OK);
    return state;
}

static Chain *chain_on(State *state, double step, int gaussian) {
    Chain *chain = NULL;
    const ChainSettings settings = {.stream = STREAM_TRIALS, .gaussian = gaussian};
    ck_assert_int_eq(chain_create(&chain, &settings, state, KEY), OK);
    chain_set_amplitude(chain, 0, &(Amplitude){.parallel = step});
    return chain;
}

static MoveTally run(Chain *chain, double trials) {
    Tally tally = {0};
    ck_assert_int_eq(chain_run(chain, (int64_t)trials, &tally), OK);
    return tally.moves[0];
}

static double acceptance(const MoveTally *moves) {
    return (double)moves->accepted / (double)moves->trials;
}

// What is left of the mean squared displacement beyond the acceptance: 1 without correlation of
// step and rejection.
static double matching_ratio(const MoveTally *moves, double step) {
    return (moves->parallel + moves->perpendicular) / ((double)moves->accepted * step * step);
}

// Jabbari-Farouji and Trizac 2012, fig. 2, and a plain Monte Carlo program with cells, N = 1024;
// tolerances are theirs and the slow fluctuations of a short run together. NAN: no value.
START_TEST(acceptances_are_those_of_the_paper) {
    static const struct {
        double density, step, acceptance, tolerance, ratio, ratio_tolerance;
    } known[] = {
        {0.5, 0.01, 0.844552, 0.003, 0.975, 0.002}, {0.5, 0.07, 0.317, 0.003, 0.8207, 0.003},
        {0.5, 0.1, 0.202, 0.003, NAN, 0},           {0.1, 0.1, 0.92784, 0.0015, NAN, 0},
        {0.2, 0.1, NAN, 0, 0.97015, 0.0015},        {0.3, 0.1, 0.65571, 0.0025, NAN, 0},
        {0.4, 0.1, NAN, 0, 0.87348, 0.003},         {0.3, 0.2, 0.437601, 0.002, NAN, 0}};
    const System system = spheres(1024, known[_i].density);
    State *state = packed(&system);
    Chain *chain = chain_on(state, 0.1, 0);
    run(chain, 2e7); // forgets the packing: 2e4 cycles, some 13 d^2/D_L at 0.5
    chain_set_amplitude(chain, 0, &(Amplitude){.parallel = known[_i].step});
    MoveTally sum = {0};
    for (int part = 0; part < 8; part++) {
        chain_set_amplitude(chain, 0, &(Amplitude){.parallel = known[_i].step});
        const MoveTally moves = run(chain, 1.5e6);
        sum.trials += moves.trials, sum.accepted += moves.accepted;
        sum.parallel += moves.parallel, sum.perpendicular += moves.perpendicular;
        chain_set_amplitude(chain, 0, &(Amplitude){.parallel = 0.1});
        run(chain, 3e6);
    }
    printf("packing fraction %g, step %g: acceptance %.5f, ratio %.5f\n", known[_i].density,
           known[_i].step, acceptance(&sum), matching_ratio(&sum, known[_i].step));
    if (!isnan(known[_i].acceptance)) {
        ck_assert_double_eq_tol(acceptance(&sum), known[_i].acceptance, known[_i].tolerance);
    }
    if (!isnan(known[_i].ratio)) {
        ck_assert_double_eq_tol(matching_ratio(&sum, known[_i].step), known[_i].ratio,
                                known[_i].ratio_tolerance);
    }
    chain_free(chain);
    state_free(state);
}
END_TEST

// 1 - A = 6 phi g(d) <|step|> for steps -> 0, <|step|> = 0.9605919565 for a cube of half-width 1;
// g(d) = (Z - 1)/(4 phi) from Kolafa's equation of state: a measurement of the pressure. Two small
// steps extrapolate away the second order; many short looks, for the same pairs stay near contact.
START_TEST(small_steps_are_rejected_as_the_pressure_says) {
    enum { PARTS = 800 };
    static const double density[] = {0.2, 0.4, 0.5};
    const double phi = density[_i], finer = 0.002;
    const System system = spheres(1024, phi);
    State *state = packed(&system);
    Chain *chain = chain_on(state, 0.1, 0);
    double mean = 0, square = 0;
    run(chain, 2e7);
    for (int part = 0; part < PARTS; part++) {
        double slope[2];
        for (int k = 0; k < 2; k++) {
            const double step = (k + 1) * finer;
            chain_set_amplitude(chain, 0, &(Amplitude){.parallel = step});
            const MoveTally moves = run(chain, 4e4);
            slope[k] = (1 - acceptance(&moves)) / step;
        }
        const double limit = 2 * slope[0] - slope[1];
        mean += limit / PARTS, square += limit * limit / PARTS;
        chain_set_amplitude(chain, 0, &(Amplitude){.parallel = 0.1});
        run(chain, 4e4);
    }
    const double sigma = sqrt((square - mean * mean) / (PARTS - 1));
    const double expected = 1.5 * (equation_kolafa(phi) - 1) * 0.9605919565;
    printf("packing fraction %g: slope %.4f(%.4f), expected %.4f\n", phi, mean, sigma, expected);
    ck_assert_double_eq_tol(mean, expected, 5 * sigma);
    ck_assert_double_lt(sigma, 0.02 * expected);
    chain_free(chain);
    state_free(state);
}
END_TEST

// Two spheres in a huge box: everything is accepted, and each of the squares is that of a free walk
// of (trials) steps of variance step^2/3 per axis, uniform or normal, to 5 standard errors.
START_TEST(free_walks_have_their_variance) {
    System system = spheres(2, 0);
    system.number_density = 1e-9;
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    const double trials = 2e6, step = 0.3;
    for (size_t i = 0; i < 2; i++) {
        state->diameter[i] = 1;
        for (int a = 0; a < 3; a++)
            state->position[a][i] = state->box.edge[a] / 4 * (double)(i + 1);
    }
    Chain *chain = chain_on(state, step, _i);
    const MoveTally moves = run(chain, trials);
    ck_assert_uint_eq(moves.accepted, moves.trials);
    const double kurtosis = _i ? 3 : 1.8, mean = trials * step * step / 3;
    const double sigma = mean * sqrt((kurtosis - 1) / trials);
    ck_assert_double_eq_tol(moves.parallel, mean, 5 * sigma);
    ck_assert_double_eq_tol(moves.perpendicular, 2 * mean, 5 * sqrt(2) * sigma);
    chain_free(chain);
    state_free(state);
}
END_TEST

// The same as displacements: unfolded positions of walks of 100 cycles across a small box, over
// many walks.
START_TEST(unfolded_positions_walk_freely) {
    System system = spheres(2, 0);
    system.number_density = 2.0 / (4 * 4 * 4);
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < 2; i++) {
        state->diameter[i] = 1e-3; // hardly ever in the way
        for (int a = 0; a < 3; a++) state->position[a][i] = 1 + 2 * (double)i;
    }
    enum { WALKS = 4000, CYCLES = 100 };
    const double step = 0.9;
    Chain *chain = chain_on(state, step, 0);
    double sum = 0, before[3][2];
    for (int walk = 0; walk < WALKS; walk++) {
        chain_publish(chain);
        for (int k = 0; k < 6; k++)
            before[k / 2][k % 2] = state_unfolded(state, k / 2, (size_t)k % 2);
        run(chain, 2 * CYCLES);
        chain_publish(chain);
        for (int k = 0; k < 6; k++) {
            const double moved = state_unfolded(state, k / 2, (size_t)k % 2) - before[k / 2][k % 2];
            sum += moved * moved / (2 * WALKS);
        }
    }
    const double expected = CYCLES * step * step; // |dr|^2 of one particle
    ck_assert_double_eq_tol(sum / expected, 1, 5 * sqrt(2.0 / (6 * WALKS)));
    chain_free(chain);
    state_free(state);
}
END_TEST

// Two soft spheres in a box: <U> and the share of separations within a radius, by quadrature over
// the sphere and the rest of the box, where U is below 1e-7.
START_TEST(a_pair_of_soft_spheres_has_its_mean_energy) {
    static const double exponents[] = {12, 36, 13};
    const double n = exponents[_i], edge = 2.2 * exp2(21 / n);
    System system = spheres(2, 0);
    system.number_density = 2 / (edge * edge * edge);
    system.species[0].shape = SHAPE_SOFT_SPHERE;
    system.species[0].exponent = n;
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < 2; i++) {
        state->diameter[i] = 1;
        for (int a = 0; a < 3; a++) state->position[a][i] = edge / 2 * (double)i;
    }
    double weight = 0, energy = 0, core = 0;
    const double width = 1e-4, outer = edge / 2;
    for (double r = 0.5 * width; r < outer; r += width) {
        const double u = pow(r, -n), shell = 4 * PI_HERE * r * r * width * exp(-u);
        weight += shell;
        energy += shell * u;
        core += r < 1.05 ? shell : 0;
    }
    weight += edge * edge * edge - 4 * PI_HERE / 3 * outer * outer * outer;
    Chain *chain = chain_on(state, 0.4, 0);
    enum { PARTS = 20, LOOKS = 20000 };
    double mean[2] = {0, 0}, square[2] = {0, 0};
    for (int part = 0; part < PARTS; part++) {
        double sum[2] = {0, 0};
        for (int look = 0; look < LOOKS; look++) {
            double r[3], r2 = 0;
            run(chain, 20);
            chain_publish(chain);
            for (int a = 0; a < 3; a++) r[a] = state->position[a][0] - state->position[a][1];
            box_nearest_image(&state->box, r);
            for (int a = 0; a < 3; a++) r2 += r[a] * r[a];
            sum[0] += pow(r2, -n / 2) / LOOKS;
            sum[1] += (r2 < 1.05 * 1.05) / (double)LOOKS;
        }
        for (int k = 0; k < 2; k++) mean[k] += sum[k] / PARTS, square[k] += sum[k] * sum[k] / PARTS;
    }
    const double expected[2] = {energy / weight, core / weight};
    for (int k = 0; k < 2; k++) {
        const double sigma = sqrt((square[k] - mean[k] * mean[k]) / (PARTS - 1));
        printf("n = %g: %.6f(%.6f), expected %.6f\n", n, mean[k], sigma, expected[k]);
        ck_assert_double_eq_tol(mean[k], expected[k], 5 * sigma);
        ck_assert_double_lt(sigma, 0.06 * expected[k]);
    }
    chain_free(chain);
    state_free(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("dmc_spheres");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 300);
    tcase_add_loop_test(all, acceptances_are_those_of_the_paper, 0, 8);
    tcase_add_loop_test(all, small_steps_are_rejected_as_the_pressure_says, 0, 3);
    tcase_add_loop_test(all, free_walks_have_their_variance, 0, 2);
    tcase_add_test(all, unfolded_positions_walk_freely);
    tcase_add_loop_test(all, a_pair_of_soft_spheres_has_its_mean_energy, 0, 3);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
