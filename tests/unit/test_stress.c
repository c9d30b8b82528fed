// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses from tallies made by hand.
#include "analysis/analysis.h"
#include "analysis/derive.h"
#include "base/constants.h"
#include "observe.h"
#include "suite.h"

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

// One relaxation time: G(t) = exp(-t), G' = w^2/(1 + w^2), G'' = w/(1 + w^2).
START_TEST(moduli_follow_from_the_wandering) {
    enum { LAGS = 51 };
    const System system = system_of(2, 50, 0.3, 1);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    double times[LAGS], values[LAGS];
    for (int k = 0; k < LAGS; k++) {
        times[k] = pow(10, -3 + 0.1 * k);
        values[k] = times[k] - (1 - exp(-times[k]));
    }
    const ResultSeries shape = {
        .stage = "rest",
        .observable = "stress_wandering",
        .axes = 1,
        .axis = {{.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    ck_assert_int_eq(results_put_series(results, &shape, 0, values), OK);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const ResultSeries *moduli = series_of(results, "rest", "moduli_at_rest");
    const ResultAxis *frequency = &moduli->axis[1];
    ck_assert_double_eq_tol(frequency->values[0], 0.01, 1e-12); // the inverse of the last lag
    ck_assert_double_eq_tol(frequency->values[frequency->count - 1], 1000, 1e-9);
    for (size_t k = 0; k < frequency->count; k++) {
        const double w = frequency->values[k], elastic = w * w / (1 + w * w), viscous = elastic / w;
        const double size = hypot(elastic, viscous);
        ck_assert_double_eq_tol(moduli->values[k], elastic, 0.005 * size + 0.0005 * w);
        ck_assert_double_eq_tol(moduli->values[frequency->count + k], viscous,
                                0.005 * size + 0.0005 * w);
    }
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
    ck_assert_str_eq(directions->axis[1].unit, "rad");
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

// Stresses that bend on the way to contact, by their values there. In the plane there is no zz.
START_TEST(normal_stress_differences_are_those_at_contact) {
    enum { BINS = 40, ELEMENTS = 3 };
    static const char *const LABELS[] = {"xx", "yy", "zz"};
    static const double AT_CONTACT[] = {-5, -6, -6.5};
    double distances[BINS], values[ELEMENTS * BINS];
    for (size_t k = 0; k < BINS; k++) {
        distances[k] = 1 + 0.002 * ((double)k + 0.5);
        for (size_t e = 0; e < ELEMENTS; e++)
            values[e * BINS + k] = AT_CONTACT[e] * (1 - 3 * (distances[k] - 1));
    }
    for (int dimension = 2; dimension <= 3; dimension++) {
        const size_t elements = (size_t)dimension;
        const ResultSeries shape = {
            .stage = "flow",
            .observable = "contact_stress",
            .unit = "kT/d^3",
            .axes = 2,
            .axis = {{.name = "element", .unit = "", .count = elements, .labels = LABELS},
                     {.name = "scaled_distance", .unit = "", .count = BINS, .values = distances}}};
        const System system = system_of(dimension, 100, 0.3, 1);
        Results *results = NULL;
        ck_assert_int_eq(results_create(&results, 1), OK);
        results_put_series(results, &shape, 0, values);
        ck_assert_int_eq(analysis_derive(results, &system), OK);
        ck_assert_double_eq_tol(scalar_of(results, "flow", "normal_stress_difference_contact"), 1,
                                1e-9);
        const char *second = "second_normal_stress_difference_contact";
        if (dimension == 3)
            ck_assert_double_eq_tol(scalar_of(results, "flow", second), 0.5, 1e-9);
        else
            ck_assert_ptr_null(results_find_scalar(results, "flow", second));
        results_free(results);
    }
}
END_TEST

// Lets an observer look whenever it wants to at what `exchanged` says was exchanged by then.
static void tell(Observer *observer, const State *state, double (*exchanged)(double time)) {
    const ObservableKind *kind = observer->kind;
    const Clock *clock = &observer->clock;
    for (int64_t tick = kind->next(observer, -1); tick <= clock->ticks;
         tick = kind->next(observer, tick)) {
        const double xy = -exchanged((double)tick * clock->tick) * box_volume(&state->box) *
                          clock->flight_time / clock->tick;
        const Tally tally = {.exchange = {{3 * xy, xy}, {xy, xy}}};
        ck_assert_int_eq(kind->see(observer, tick, state, &tally), OK);
    }
}

// A stress that overshoots, and its integral over time.
static const double RATE = 0.1;
static double overshooting(double g) {
    return 2 * (1 - exp(-20 * g)) + 30 * g * exp(-10 * g);
}
static double start_up(double time) {
    const double g = RATE * time;
    const double rise = 2 * (g - (1 - exp(-20 * g)) / 20);
    const double hump = 30 * ((1 - exp(-10 * g)) / 100 - g * exp(-10 * g) / 10);
    return (rise + hump) / RATE;
}

enum { WINDOWS = 40 };

// What analysis makes of these stresses in windows of a strain `width`.
static Results *derived(size_t replicas, const double stress[][WINDOWS], double width) {
    static const char *const component[] = {"xy"};
    double strain[WINDOWS];
    for (int k = 0; k < WINDOWS; k++) strain[k] = width * (k + 0.5);
    const ResultSeries shape = {
        .stage = "shear",
        .observable = "stress",
        .axes = 2,
        .axis = {{.name = "component", .unit = "", .count = 1, .labels = component},
                 {.name = "strain", .unit = "", .count = WINDOWS, .values = strain}}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, replicas), OK);
    for (size_t r = 0; r < replicas; r++)
        ck_assert_int_eq(results_put_series(results, &shape, r, stress[r]), OK);
    ck_assert_int_eq(derive_start_up(results, results_find_series(results, "shear", "stress")), OK);
    return results;
}

// Two replicas whose mean has its top in the seventh window, and which lean either way; the stress
// rises to it from `first`.
static Results *leaning(double lean, double first) {
    double stress[2][WINDOWS];
    for (int k = 0; k < WINDOWS; k++) {
        const double off = k - 7, top = 1 - 0.007 * off * off;
        for (int r = 0; r < 2; r++) {
            const double leaned = top + (r == 0 ? lean : -lean) * off;
            stress[r][k] = k < 4 ? first + (0.8 - first) * k / 4 : k < 11 ? leaned : 0.5;
        }
    }
    return derived(2, stress, 0.05);
}

// Where the parabola of one replica left out has no top among its windows, nothing is said of it.
START_TEST(an_overshoot_that_cannot_be_placed_is_not_told) {
    Results *results = leaning(0.01, 0);
    const ResultScalar *place = results_find_scalar(results, "shear", "overshoot_strain");
    ck_assert_ptr_nonnull(place);
    ck_assert_double_eq_tol((place->values[0] + place->values[1]) / 2, 0.05 * 7.5, 1e-9);
    results_free(results);
    results = leaning(0.08, 0);
    ck_assert_ptr_null(results_find_scalar(results, "shear", "overshoot_strain"));
    ck_assert_ptr_null(results_find_scalar(results, "shear", "overshoot_height"));
    results_free(results);
}
END_TEST

// A top so sharp that few windows are within 7 % of the highest is told from the five round it.
START_TEST(a_sharp_overshoot_is_told) {
    double stress[1][WINDOWS];
    for (int k = 0; k < WINDOWS; k++) {
        const double off = k - 7.2;
        stress[0][k] = k < 4 ? 0.1 * k : fmax(0.5, 1 - 0.05 * off * off);
    }
    Results *results = derived(1, stress, 0.005);
    ck_assert_double_eq_tol(scalar_of(results, "shear", "overshoot_strain"), 0.005 * 7.7, 1e-9);
    ck_assert_double_eq_tol(scalar_of(results, "shear", "overshoot_height"), 1, 1e-9);
    results_free(results);
}
END_TEST

// A stage that goes on with a flow has highest windows, by chance, and no overshoot.
START_TEST(what_flowed_before_has_no_overshoot) {
    Results *results = leaning(0.01, 0.7);
    ck_assert_ptr_null(results_find_scalar(results, "shear", "overshoot_strain"));
    results_free(results);
}
END_TEST

// Ends where its error is said to be as wished: over samples it must be so. Windows of a hundredth
// of a strain, correlated over a tenth; the mean is 1, known as wished after a strain of some 16.
static double mean_at_the_end(Rng *rng, const State *state, const Clock *clock,
                              const Settings *settings, double wish) {
    const double kept = exp(-0.1), deviation = wish * sqrt(1600 * (1 - kept) / (1 + kept));
    const double unit = -box_volume(&state->box) * clock->flight_time;
    Observer *observer = new_observer(&observable_stress, settings, state, clock);
    double wander = rng_normal(rng), sum = 0;
    int64_t windows = 0;
    do {
        wander = kept * wander + sqrt(1 - kept * kept) * rng_normal(rng);
        sum += 1 + deviation * wander;
        const Tally tally = {.exchange = {{0, unit * sum}, {unit * sum, 0}}};
        const Status status = observer->kind->see(observer, ++windows, state, &tally);
        if (status != OK || windows == clock->ticks) ck_abort_msg("it does not end");
    } while (observer->kind->relative_error(observer) > wish);
    observer->kind->free(observer);
    return sum / (double)windows;
}

START_TEST(a_stress_that_ends_a_stage_is_as_good_as_wished) {
    enum { SAMPLES = 600 };
    static const double WISH = 0.06;
    static const Drive steady = {.flow = {.rate = 0.1}};
    System system = system_of(2, 50, 0.3, 1);
    State *state = new_state(&system);
    Clock clock = flying_clock(20000);
    clock.ticks_per_step = 1;
    clock.tick = 0.1; // windows of a hundredth of a strain
    clock.drive = &steady;
    Settings settings = settings_of(&observable_stress.options);
    set_number(&settings, &observable_stress.options, "windows", 20000);
    Rng rng = rng_open(KEY, STREAM_PACKING, 1, 0);
    double squares = 0;
    for (int k = 0; k < SAMPLES; k++) {
        const double off = mean_at_the_end(&rng, state, &clock, &settings, WISH) - 1;
        squares += off * off;
    }
    const double error = sqrt(squares / SAMPLES);
    printf("mean error at the end over that wished for: %.3f\n", error / WISH);
    ck_assert_double_lt(error, 1.1 * WISH);
    ck_assert_double_gt(error, 0.7 * WISH); // nor does it run much longer than it must
    state_free(state);
}
END_TEST

START_TEST(start_up_shows_its_overshoot) {
    static const Drive steady = {.flow = {.rate = 0.1}};
    System system = system_of(2, 50, 0.3, 1);
    State *state = new_state(&system);
    Clock clock = flying_clock(40000);
    clock.tick = 0.0005;
    clock.drive = &steady;
    Settings settings = settings_of(&observable_stress.options);
    set_number(&settings, &observable_stress.options, "windows", 400);
    set_number(&settings, &observable_stress.options, "average_from", 1);
    Observer *observer = new_observer(&observable_stress, &settings, state, &clock);
    tell(observer, state, start_up);
    Results *results = written(observer, state);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const double mean = (start_up(20) - start_up(10)) / 10; // from a strain of 1 to one of 2
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "shear_stress") / mean, 1, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "shear_viscosity") * RATE / mean, 1,
                            1e-12);
    // sigma_xx = 3 sigma_xy, sigma_yy = sigma_xy, as it was told.
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "normal_stress_difference") / mean, 2,
                            1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "mean_pressure"),
                            system_number_density(&system) - 2 * mean, 1e-9);
    double top = 0;
    for (double g = 0; g < 1; g += 1e-4) {
        if (overshooting(g) > overshooting(top)) top = g;
    }
    // The curve is steeper before its top than after it, the parabola is not.
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "overshoot_strain"), top, 0.01);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "overshoot_stress"), overshooting(top),
                            0.03);
    double later = 0; // windows of the later half
    for (double g = 1.0025; g < 2; g += 0.005) later += overshooting(g) / 200;
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "overshoot_height"),
                            overshooting(top) / later - 1, 0.01);
    results_free(results);
    observer->kind->free(observer);
    state_free(state);
}
END_TEST

// 0.1 (5 sin wt + 2 cos wt + 0.7 sin 3wt - 0.2 cos 5wt), integrated.
static const double FREQUENCY = 0.3;
static double oscillation(double time) {
    const double w = FREQUENCY, p = w * time;
    return 0.1 / w * (-5 * cos(p) + 2 * sin(p) - 0.7 / 3 * cos(3 * p) - 0.2 / 5 * sin(5 * p));
}

START_TEST(harmonics_of_an_oscillation_are_found) {
    static const Drive oscillating = {.flow = {.oscillation = {0.1, 0.3}}};
    System system = system_of(2, 50, 0.3, 1);
    State *state = new_state(&system);
    Clock clock = flying_clock(300000);
    clock.tick = 0.0005;
    clock.drive = &oscillating;
    const Settings settings = settings_of(&observable_oscillatory_stress.options);
    ck_assert_int_eq(observable_oscillatory_stress.check(&settings, &system, &clock), OK);
    Observer *observer = new_observer(&observable_oscillatory_stress, &settings, state, &clock);
    tell(observer, state, oscillation);
    Results *results = written(observer, state);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "storage_modulus"), 5, 0.01);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "loss_modulus"), 2, 0.01);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "third_harmonic"), 0.7 / sqrt(29),
                            0.002);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "fifth_harmonic"), 0.2 / sqrt(29),
                            0.002);
    const ResultSeries *cycle = series_of(results, "quiescent", "stress_cycle");
    for (size_t k = 0; k < cycle->size; k++) {
        const double p = 2 * PI * cycle->axis[0].values[k];
        const double stress = 0.1 * (5 * sin(p) + 2 * cos(p) + 0.7 * sin(3 * p) - 0.2 * cos(5 * p));
        // Of a few cycles the windows are not centred on the phases: by half of one at most.
        ck_assert_double_eq_tol(cycle->values[k], stress, 0.7 * PI / 64);
    }
    results_free(results);
    observer->kind->free(observer);
    state_free(state);
}
END_TEST

// By both routes: what is odd in the strain averages out, pressures and normal stresses do not.
START_TEST(over_an_oscillation_the_shear_stress_has_no_mean) {
    static const Drive oscillating = {.flow = {.oscillation = {0.1, 0.3}}};
    static const struct {
        const ObservableKind *kind;
        const char *none, *some;
    } routes[] = {
        {&observable_stress, "shear_stress", "normal_stress_difference"},
        {&observable_contact_stress, "shear_stress_contact", "normal_stress_difference_contact"}};
    System system = system_of(2, 400, 0.3, 1);
    State *state = new_state(&system);
    scatter(state, KEY, 0);
    Clock clock = flying_clock(1000);
    for (size_t k = 0; k < 2; k++) {
        for (int oscillates = 0; oscillates < 2; oscillates++) {
            clock.drive = oscillates ? &oscillating : NULL;
            const Settings settings = settings_of(&routes[k].kind->options);
            Observer *observer = new_observer(routes[k].kind, &settings, state, &clock);
            tell(observer, state, oscillation);
            Results *results = written(observer, state);
            ck_assert_int_eq(analysis_derive(results, &system), OK);
            const void *mean = results_find_scalar(results, "quiescent", routes[k].none);
            ck_assert_int_eq(mean == NULL, oscillates);
            ck_assert_ptr_nonnull(results_find_scalar(results, "quiescent", routes[k].some));
            results_free(results);
            observer->kind->free(observer);
        }
    }
    state_free(state);
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("stress");
    TCase *c = tcase_create("stress");
    tcase_add_test(c, steady_stress_wanders_as_the_square_of_time);
    tcase_add_test(c, viscosity_is_the_slope_of_the_wandering);
    tcase_add_test(c, moduli_follow_from_the_wandering);
    tcase_add_loop_test(c, pairs_press_along_the_line_between_them, 0, 8);
    tcase_add_test(c, normal_stress_differences_are_those_at_contact);
    tcase_add_test(c, start_up_shows_its_overshoot);
    tcase_add_test(c, an_overshoot_that_cannot_be_placed_is_not_told);
    tcase_add_test(c, a_sharp_overshoot_is_told);
    tcase_add_test(c, what_flowed_before_has_no_overshoot);
    tcase_add_test(c, a_stress_that_ends_a_stage_is_as_good_as_wished);
    tcase_add_test(c, harmonics_of_an_oscillation_are_found);
    tcase_add_test(c, over_an_oscillation_the_shear_stress_has_no_mean);
    suite_add_tcase(s, c);
    return s;
}

int main(void) {
    return run_suite(suite());
}
