// SPDX-License-Identifier: GPL-3.0-or-later
// Structure on the plane of flow and gradient: the picture of S(q) and its cuts against a slow twin
// that goes through all vectors and all particles.
#include "observe.h"

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

int main(void) {
    Suite *suite = suite_create("planar_structure");
    TCase *tests = tcase_create("planar_structure");
    tcase_add_loop_test(tests, picture_agrees_with_its_slow_twin, 0, 2);
    tcase_add_loop_test(tests, cuts_agree_with_their_slow_twin, 0, 2);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
