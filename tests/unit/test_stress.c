// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses from tallies made by hand.
#include "analysis/analysis.h"
#include "base/constants.h"
#include "observe.h"

static const RngKey KEY = {.seed = 5};

static Clock flying_clock(int64_t ticks) {
    Clock clock = clock_of(ticks, 2);
    clock.flies = true;
    return clock;
}

// An xy exchange that grows evenly: V S^2/(2 kT) of a steady stress, halved where the other shear
// stress, (xx - yy)/2, is 0.
START_TEST(steady_stress_wanders_as_the_square_of_time) {
    const double per_tick = 0.3;
    System system = system_of(2, 50, 0.3, 1);
    State *state = new_state(&system);
    const Clock clock = flying_clock(600);
    const Settings settings = settings_of(&observable_viscosity.options);
    Observer *observer = new_observer(&observable_viscosity, &settings, state, &clock);
    const ObservableKind *kind = observer->kind;
    for (int64_t tick = kind->next(observer, -1); tick <= clock.ticks;
         tick = kind->next(observer, tick)) {
        const double sum = per_tick * (double)tick;
        const Tally tally = {.exchange = {{0.1 * (double)tick, sum}, {sum, 0.1 * (double)tick}}};
        ck_assert_int_eq(kind->see(observer, tick, state, &tally), OK);
    }
    Results *results = written(observer, state);
    const ResultSeries *wandering = series_of(results, "quiescent", "stress_wandering");
    for (size_t k = 0; k < wandering->size; k++) {
        const double time = wandering->axis[0].values[k];
        const double stress = per_tick / clock.flight_time / box_volume(&state->box);
        ck_assert_double_eq_tol(wandering->values[k] /
                                    (box_volume(&state->box) * stress * stress * time * time / 4),
                                1, 1e-12);
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

// G(t) = eta t - c (1 - exp(-t)): the slope between lags grows to eta, and so says the window.
START_TEST(viscosity_is_the_slope_of_the_wandering) {
    enum { REPLICAS = 16, LAGS = 41 };
    const System system = system_of(2, 50, 0.3, 1);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    Rng rng = rng_open(KEY, STREAM_PACKING, 0, 0);
    double times[LAGS], values[LAGS];
    for (int k = 0; k < LAGS; k++) times[k] = pow(10, -2 + 0.1 * k);
    for (size_t r = 0; r < REPLICAS; r++) {
        const double eta = 3 * (1 + 0.02 * rng_normal(&rng));
        for (int k = 0; k < LAGS; k++) values[k] = eta * (times[k] - (1 - exp(-times[k])));
        const ResultSeries shape = {
            .stage = "rest",
            .observable = "stress_wandering",
            .axes = 1,
            .axis = {{.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
        ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
    }
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_double_eq_tol(scalar_of(results, "rest", "zero_shear_viscosity"), 3, 0.06);
    const ResultSeries *eta = series_of(results, "rest", "viscosity");
    ck_assert_uint_eq(eta->size, LAGS - 1);
    ck_assert_double_eq_tol(results_series_estimate(results, eta, 0).value, 3 * 0.0112, 3 * 0.0005);
    results_free(results);
}
END_TEST

// Two discs that all but touch, across the edge of the box, in a direction: the stress they carry,
// and the sector that they are counted in.
START_TEST(pairs_press_along_the_line_between_them) {
    const double angle = PI / 7 + PI / 4 * _i, spacing = 0.002, r = 1 + spacing / 2;
    System system = system_of(2, 2, 0.05, 1);
    State *state = new_state(&system);
    state->position[0][0] = state->position[1][0] = 0.01;
    fold(state, 0, 1, 0.01 + r * cos(angle));
    fold(state, 1, 1, 0.01 - r * sin(angle));
    const Clock clock = clock_of(10, 1);
    const Settings settings = settings_of(&observable_contact_stress.options);
    Observer *observer = new_observer(&observable_contact_stress, &settings, state, &clock);
    const Tally none = {0};
    ck_assert_int_eq(observer->kind->see(observer, 1, state, &none), OK);
    Results *results = written(observer, state);
    const ResultSeries *stress = series_of(results, "quiescent", "contact_stress");
    const size_t bins = stress->axis[1].count;
    const double one = -1 / (box_volume(&state->box) * spacing * r);
    ck_assert_double_eq_tol(stress->values[0], one * cos(angle) * cos(angle), 1e-9);
    ck_assert_double_eq_tol(stress->values[bins], one * sin(angle) * sin(angle), 1e-9);
    ck_assert_double_eq_tol(stress->values[2 * bins], -one * cos(angle) * sin(angle), 1e-9);
    const ResultSeries *directions = series_of(results, "quiescent", "contact_directions");
    const size_t sectors = directions->axis[1].count;
    const double turned = angle < PI ? PI - angle : 2 * PI - angle; // y is mirrored
    for (size_t k = 0; k < sectors; k++) {
        const bool there = k == (size_t)(turned / PI * (double)sectors);
        ck_assert(there == (directions->values[k * bins] > 0));
    }
    results_free(results);
    observer->kind->free(observer);
    state_free(state);
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("stress");
    TCase *c = tcase_create("stress");
    tcase_add_test(c, steady_stress_wanders_as_the_square_of_time);
    tcase_add_test(c, viscosity_is_the_slope_of_the_wandering);
    tcase_add_loop_test(c, pairs_press_along_the_line_between_them, 0, 8);
    suite_add_tcase(s, c);
    return s;
}

int main(void) {
    SRunner *runner = srunner_create(suite());
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
