// SPDX-License-Identifier: GPL-3.0-or-later
// Structure on the plane of flow and gradient: pictures and cuts of S(q), pair distributions by
// direction, against slow twins that go through all vectors, all particles and all pairs.
#include "observe.h"
#include "suite.h"

#include "base/constants.h"
#include "observables/labels.h"

#include <stdlib.h>

static const RngKey KEY = {.seed = 20261125, .replica = 7};
enum { PARTICLES = 60, TICKS = 12, STEP = 2 };

static System oblong_system(int dimension) {
    System system = system_of(dimension, PARTICLES, 0.3, 2);
    system.aspect = (OptionReals){.count = dimension, .values = {1, 1.3, 0.8}};
    return system;
}

static void scatter_at(State *state, int64_t tick) {
    scatter(state, KEY, (uint64_t)tick);
}

// Re rho_a* rho_b of pairs small-small, small-big, big-big, and of all particles.
static void slow_products(const State *state, const double q[3], double products[4]) {
    double real[2] = {0}, imaginary[2] = {0};
    for (size_t i = 0; i < state->count; i++) {
        const double phase = q[0] * state->position[0][i] + q[1] * state->position[1][i];
        real[state->species_of[i]] += cos(phase);
        imaginary[state->species_of[i]] += sin(phase);
    }
    products[0] = real[0] * real[0] + imaginary[0] * imaginary[0];
    products[1] = real[0] * real[1] + imaginary[0] * imaginary[1];
    products[2] = real[1] * real[1] + imaginary[1] * imaginary[1];
    products[3] = products[0] + 2 * products[1] + products[2];
}

typedef struct Twin {
    double sums[4], members;
} Twin;

// Whether q, or -q, is in the pixel or the bin of the cut that it is asked for.
typedef bool (*Inside)(const double q[3], const double *where);

static bool in_pixel(const double q[3], const double *where) {
    const double half = where[2] / 2;
    return fabs(q[0] - where[0]) < half && fabs(q[1] - where[1]) < half;
}

static bool in_cut(const double q[3], const double *where) {
    const double length = hypot(q[0], q[1]);
    if (length < where[2] || length >= where[3]) return false;
    return fabs(q[0] * where[0] + q[1] * where[1]) >= length * cos(PI / 18);
}

static Twin slow_twin(State *state, Inside inside, const double *where) {
    Twin twin = {{0}, 0};
    for (int64_t tick = STEP; tick <= TICKS; tick += STEP) {
        scatter_at(state, tick);
        for (int x = -12; x <= 12; x++) {
            for (int y = -15; y <= 15; y++) {
                const double q[3] = {2 * PI * x / state->box.edge[0],
                                     2 * PI * y / state->box.edge[1], 0};
                if ((x == 0 && y == 0) || !inside(q, where)) continue;
                double products[4];
                slow_products(state, q, products);
                for (int p = 0; p < 4; p++) twin.sums[p] += products[p];
                twin.members++;
            }
        }
    }
    return twin;
}

static void compare(const Twin *twin, const ResultSeries *series, size_t element) {
    const size_t stride = series->size / 4;
    for (size_t p = 0; p < 4; p++) {
        const double got = series->values[p * stride + element];
        const double slow = twin->sums[p] / twin->members / PARTICLES;
        ck_assert_msg(twin->members > 0 ? fabs(got - slow) < 1e-11 : isnan(got), "%.17g, not %.17g",
                      got, slow);
    }
}

static Results *measured(State *state, const System *system, double spacing) {
    const ObservableKind *kind = &observable_planar_structure_factor;
    const Clock clock = clock_of(TICKS, STEP);
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "wave_numbers.last", 5);
    set_number(&settings, &kind->options, "wave_numbers.spacing", spacing);
    set_number(&settings, &kind->options, "cuts.spacing", 0.7);
    ck_assert_msg(kind->check(&settings, system, &clock) == OK, "%s", status_sentence());
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, TICKS);
    Results *results = written(observer, state);
    kind->free(observer);
    return results;
}

// _i: dimension.
START_TEST(picture_agrees_with_its_slow_twin) {
    const System system = oblong_system(2 + _i);
    State *state = new_state(&system);
    const double spacing = 1.371; // no vector on an edge
    Results *results = measured(state, &system, spacing);
    const ResultSeries *s = series_of(results, "quiescent", "planar_structure_factor");
    ck_assert_uint_eq(s->axes, 3);
    const size_t side = s->axis[1].count;
    ck_assert_uint_eq(side, 7);
    for (size_t x = 0; x < side; x++) {
        ck_assert_double_eq_tol(s->axis[1].values[x], ((double)x - 3) * spacing, 1e-12);
        for (size_t y = 0; y < side; y++) {
            const double where[3] = {s->axis[1].values[x], s->axis[2].values[y], spacing};
            const Twin twin = slow_twin(state, in_pixel, where);
            compare(&twin, s, x * side + y);
        }
    }
    results_free(results);
    state_free(state);
}
END_TEST

// _i: dimension.
START_TEST(cuts_agree_with_their_slow_twin) {
    static const double ways[4][2] = {
        {1, 0}, {0, 1}, {M_SQRT1_2, M_SQRT1_2}, {M_SQRT1_2, -M_SQRT1_2}};
    const System system = oblong_system(2 + _i);
    State *state = new_state(&system);
    Results *results = measured(state, &system, 0);
    const ResultSeries *s = series_of(results, "quiescent", "structure_factor_cuts");
    const size_t bins = s->axis[2].count;
    ck_assert_uint_eq(bins, 8);
    for (size_t cut = 0; cut < 4; cut++) {
        for (size_t k = 0; k < bins; k++) {
            const double low = 0.7 * (double)k,
                         where[4] = {ways[cut][0], ways[cut][1], low, fmin(low + 0.7, 5)};
            const Twin twin = slow_twin(state, in_cut, where);
            compare(&twin, s, cut * bins + k);
        }
    }
    results_free(results);
    state_free(state);
}
END_TEST

// A pair and harmonic of species over shells, from all pairs and their nearest images by trial.
static double slow_harmonic(State *state, int harmonic, const size_t species[2], double low,
                            double high) {
    double sum = 0, looks = 0, pairs = 0;
    const int dimension = state->box.dimension;
    for (int64_t tick = STEP; tick <= TICKS; tick += STEP, looks++) {
        scatter_at(state, tick);
        pairs = 0;
        for (size_t i = 0; i < state->count; i++) {
            for (size_t j = 0; j < state->count; j++) {
                if (i == j || state->species_of[i] != species[0]) continue;
                if (state->species_of[j] != species[1]) continue;
                pairs++;
                double r[3] = {0, 0, 0};
                for (int a = 0; a < dimension; a++) {
                    r[a] = state->position[a][j] - state->position[a][i];
                    r[a] = remainder(r[a], state->box.edge[a]);
                }
                const double across = hypot(r[0], r[1]), length = hypot(across, r[2]);
                if (length < low || length >= high) continue;
                const double twice = 2 * atan2(r[1], r[0]), weight = pow(across / length, 2);
                sum += harmonic == 0   ? 1
                       : harmonic == 1 ? weight * sin(twice)
                                       : weight * cos(twice);
            }
        }
    }
    const double shell =
        dimension == 2 ? PI * (high * high - low * low) : 4 * PI / 3 * (pow(high, 3) - pow(low, 3));
    const double norm = harmonic == 0 ? 1 : dimension == 2 ? 0.5 : 4.0 / 15;
    return sum / (looks * pairs * shell / box_volume(&state->box)) / norm;
}

static Results *measured_angles(State *state, const System *system) {
    const ObservableKind *kind = &observable_angular_pair_distribution;
    const Clock clock = clock_of(TICKS, STEP);
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "distances.spacing", 0.3);
    set_number(&settings, &kind->options, "angles", 6);
    ck_assert_msg(kind->check(&settings, system, &clock) == OK, "%s", status_sentence());
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, TICKS);
    Results *results = written(observer, state);
    kind->free(observer);
    return results;
}

static const size_t SPECIES_PAIRS[3][2] = {{0, 0}, {0, 1}, {1, 1}};

// _i: dimension.
START_TEST(harmonics_of_pairs_agree_with_their_slow_twin) {
    const System system = oblong_system(2 + _i);
    State *state = new_state(&system);
    Results *results = measured_angles(state, &system);
    const ResultSeries *g = series_of(results, "quiescent", "pair_harmonics");
    const size_t bins = g->axis[2].count;
    ck_assert_uint_ge(bins, 6);
    for (size_t pair = 0; pair < 3; pair++) {
        for (int h = 0; h < 3; h++) {
            for (size_t k = 0; k < bins; k++) {
                const double low = 0.3 * (double)k, high = low + 0.3;
                const double slow = slow_harmonic(state, h, SPECIES_PAIRS[pair], low, high);
                const double got = g->values[(pair * 3 + (size_t)h) * bins + k];
                ck_assert_double_eq_tol(got, slow, 1e-9);
            }
        }
    }
    results_free(results);
    state_free(state);
}
END_TEST

START_TEST(angles_add_up_to_the_mean_over_directions) {
    const System system = oblong_system(2 + _i);
    State *state = new_state(&system);
    Results *results = measured_angles(state, &system);
    const ResultSeries *g = series_of(results, "quiescent", "angular_pair_distribution");
    const ResultSeries *mean = series_of(results, "quiescent", "pair_harmonics");
    const size_t bins = g->axis[1].count, angles = g->axis[2].count;
    ck_assert_uint_eq(angles, 6);
    ck_assert_double_eq_tol(g->axis[2].values[0], 15, 1e-12);
    for (size_t row = 0; row < 3 * bins; row++) {
        double sum = 0;
        for (size_t t = 0; t < angles; t++) sum += g->values[row * angles + t] / (double)angles;
        const size_t at = row / bins * 3 * bins + row % bins;
        ck_assert_double_eq_tol(sum, mean->values[at], 1e-11);
    }
    results_free(results);
    state_free(state);
}
END_TEST

static void lie_along_the_diagonal(State *state, int64_t tick) {
    (void)tick;
    for (size_t i = 0; i < state->count; i++) { // pairs, each far from all others
        const double column = (double)(i / 2 % 8), row = (double)(i / 16);
        const double step = i % 2 ? 1.03 * sqrt(0.5) : 0;
        state->position[0][i] = 4 * column + 3 - step;
        state->position[1][i] = 4 * row + 1 + step;
    }
}

START_TEST(pairs_along_the_falling_diagonal_are_seen_there) {
    System system = system_of(2, 32, 0.02, 1);
    State *state = new_state(&system);
    ck_assert_double_gt(state->box.edge[0], 33);
    const ObservableKind *kind = &observable_angular_pair_distribution;
    const Clock clock = clock_of(TICKS, STEP);
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, lie_along_the_diagonal, -1, TICKS);
    Results *results = written(observer, state);
    const ResultSeries *g = series_of(results, "quiescent", "pair_harmonics");
    const ResultSeries *angles = series_of(results, "quiescent", "angular_pair_distribution");
    const size_t bins = g->axis[2].count, bin = 51; // 1.03
    ck_assert_double_gt(g->values[bin], 0);
    ck_assert_double_eq_tol(g->values[bins + bin], -2 * g->values[bin], 1e-9); // sin(270) = -1
    ck_assert_double_eq_tol(g->values[2 * bins + bin], 0, 1e-9);
    for (size_t t = 0; t < 36; t++) { // 135 degrees is an edge of bins
        const bool there = t == 26 || t == 27;
        ck_assert(there || angles->values[bin * 36 + t] == 0);
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("planar_structure");
    TCase *tests = tcase_create("planar_structure");
    tcase_add_loop_test(tests, picture_agrees_with_its_slow_twin, 0, 2);
    tcase_add_loop_test(tests, cuts_agree_with_their_slow_twin, 0, 2);
    tcase_add_loop_test(tests, harmonics_of_pairs_agree_with_their_slow_twin, 0, 2);
    tcase_add_loop_test(tests, angles_add_up_to_the_mean_over_directions, 0, 2);
    tcase_add_test(tests, pairs_along_the_falling_diagonal_are_seen_there);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
