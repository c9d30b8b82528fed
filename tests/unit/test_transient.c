// SPDX-License-Identifier: GPL-3.0-or-later
// Analysis of correlators under shear on functions whose answer is known: the relation between
// transient and waiting functions, compressed exponentials, effective exponents, diffusion across
// the flow.
#include "analysis/analysis.h"
#include "observe.h"
#include "suite.h"

enum { REPLICAS = 4, LAGS = 101, WAITS = 3 };
static const double RATE = 0.1;
static const double STRAINS[WAITS] = {0, 0.01, 0.5}; // of the last the s is 0.03 instead
static const double BEST_STRAIN[WAITS] = {0, 0.01, 0.03};

static double at_rest(double t) {
    return exp(-pow(t / 50, 0.6));
}

// Transient over quiescent function, and its derivative.
static double ratio(double t) {
    return exp(-pow(RATE * t / 0.1, 1.5));
}
static double ratio_slope(double t) {
    return -1.5 * RATE / 0.1 * sqrt(RATE * t / 0.1) * ratio(t);
}

// The same of displacements: their difference.
static double displacement_at_rest(double t) {
    return 2 * t / (1 + t);
}
static double difference(double t) {
    return 0.5 * t * t / (1 + t);
}
static double difference_slope(double t) {
    return 0.5 * (t * t + 2 * t) / ((1 + t) * (1 + t));
}

static double waited(double t, double strain, bool displacements) {
    const double s = strain / RATE;
    return displacements ? displacement_at_rest(t) + difference(t) + s * difference_slope(t)
                         : at_rest(t) * (ratio(t) + s * ratio_slope(t));
}

// A stage at rest (or one that only seems so, as `rate` says) and a sheared one (or one that goes
// on from a flow) with waiting strains, every replica alike but for a factor.
static Results *related(const char *observable, bool displacements, const char *stage,
                        const char *rate) {
    static const char *const directions[] = {"y"}, *const species[] = {"small"};
    double times[LAGS], values[WAITS][LAGS];
    for (int k = 0; k < LAGS; k++) times[k] = 1e-3 * pow(10, 0.05 * k);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    ResultSeries shape = {
        .stage = "rest",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = 1, .labels = species},
                 {.name = "direction", .unit = "", .count = 1, .labels = directions},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    strcpy(shape.observable, observable);
    ResultSeries sheared = shape;
    strcpy(sheared.stage, "shear");
    sheared.axes = 4;
    sheared.axis[3] = shape.axis[2];
    sheared.axis[2] =
        (ResultAxis){.name = "waiting_strain", .unit = "", .count = WAITS, .values = STRAINS};
    for (size_t r = 0; r < REPLICAS; r++) {
        const double factor = 1 + 0.01 * ((double)r - 1.5);
        for (int k = 0; k < LAGS; k++)
            values[0][k] =
                factor * (displacements ? displacement_at_rest(times[k]) : at_rest(times[k]));
        ck_assert_int_eq(results_put_series(results, &shape, r, values[0]), OK);
        for (int w = 0; w < WAITS; w++) {
            for (int k = 0; k < LAGS; k++)
                values[w][k] = factor * waited(times[k], BEST_STRAIN[w], displacements);
        }
        ck_assert_int_eq(results_put_series(results, &sheared, r, &values[0][0]), OK);
        results_put_scalar(results, "shear", "shear_rate", "", "", r, RATE);
        if (stage) results_put_scalar(results, stage, rate, "", "", r, RATE);
    }
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    return results;
}

static Results *relaxed(const char *observable, bool displacements) {
    return related(observable, displacements, NULL, NULL);
}

static double element(const Results *results, const char *name, size_t at) {
    return results_series_estimate(results, series_of(results, "shear", name), at).value;
}

static double of_relation(const Results *results, const char *observable, const char *what,
                          size_t at) {
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "%s_relation%s", observable, what);
    return element(results, name, at);
}

// Seen from the centre of mass as well.
static const char *const scattering[] = {"self_scattering", "self_scattering_centred"};
static const char *const displacement[] = {"non_affine_displacement",
                                           "non_affine_displacement_centred"};

START_TEST(the_transient_follows_from_what_has_waited) {
    const char *name = scattering[_i];
    Results *results = relaxed(name, false);
    ck_assert_double_eq(of_relation(results, name, "_strain", 0), 0);
    for (size_t w = 1; w < WAITS; w++) {
        ck_assert_double_eq_tol(of_relation(results, name, "_strain", w), BEST_STRAIN[w],
                                0.02 * BEST_STRAIN[w]);
    }
    double off = 0;
    for (size_t k = 0; k < LAGS; k++) {
        const double expected = element(results, name, k);
        const size_t one = LAGS + k, last = 2 * LAGS + k;
        ck_assert_double_eq_tol(of_relation(results, name, "", k), expected, 1e-12);
        ck_assert_double_eq_tol(of_relation(results, name, "", one), expected, 2e-3);
        ck_assert_double_eq_tol(of_relation(results, name, "_fitted", last), expected, 2e-3);
        off = fmax(off, fabs(of_relation(results, name, "", last) - expected));
    }
    ck_assert_double_gt(off, 0.1); // the waiting time itself does not serve where it is long
    results_free(results);
}
END_TEST

// The stage at rest looks at other wave numbers as well, and in another order; or at as many
// others.
static Results *at_other_waves(bool the_same_too) {
    static const double rest_waves[2][2] = {{9, 3}, {9, 6}}, waves[2] = {6, 7};
    const size_t sheared_waves = the_same_too ? 1 : 2;
    double times[LAGS], rest[2][LAGS], flow[2][WAITS][LAGS];
    for (int k = 0; k < LAGS; k++) {
        times[k] = 1e-3 * pow(10, 0.05 * k);
        rest[0][k] = 1;
        rest[1][k] = at_rest(times[k]);
        for (int w = 0; w < WAITS; w++)
            flow[0][w][k] = flow[1][w][k] = waited(times[k], BEST_STRAIN[w], false);
    }
    const ResultAxis time = {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times};
    ResultAxis wave = {.name = "wave_number", .unit = "1/d", .count = 2};
    wave.values = rest_waves[the_same_too];
    ResultSeries shape = {
        .stage = "rest", .observable = "self_scattering", .axes = 2, .axis = {wave, time}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(results_put_series(results, &shape, 0, rest[0]), OK);
    strcpy(shape.stage, "shear");
    shape.axes = 3;
    shape.axis[0].count = sheared_waves;
    shape.axis[0].values = waves;
    shape.axis[1] =
        (ResultAxis){.name = "waiting_strain", .unit = "", .count = WAITS, .values = STRAINS};
    shape.axis[2] = time;
    ck_assert_int_eq(results_put_series(results, &shape, 0, flow[0][0]), OK);
    results_put_scalar(results, "shear", "shear_rate", "", "", 0, RATE);
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    return results;
}

START_TEST(functions_are_related_at_the_same_wave_number_only) {
    Results *results = at_other_waves(true);
    for (size_t k = 0; k < LAGS; k++) {
        ck_assert_double_eq_tol(element(results, "self_scattering_relation", LAGS + k),
                                element(results, "self_scattering", k), 2e-3);
    }
    results_free(results);
    results = at_other_waves(false);
    ck_assert_ptr_null(results_find_series(results, "shear", "self_scattering_relation"));
    results_free(results);
}
END_TEST

START_TEST(so_do_displacements) {
    const char *name = displacement[_i];
    Results *results = relaxed(name, true);
    for (size_t w = 1; w < WAITS; w++) {
        ck_assert_double_eq_tol(of_relation(results, name, "_strain", w), BEST_STRAIN[w],
                                0.02 * BEST_STRAIN[w]);
    }
    for (size_t k = 0; k < LAGS; k++) {
        const double expected = element(results, name, k);
        ck_assert_double_eq_tol(of_relation(results, name, "", LAGS + k) / expected, 1, 3e-3);
    }
    results_free(results);
}
END_TEST

static Results *single(const char *observable, double (*function)(double)) {
    static const char *const species[] = {"small"}, *const directions[] = {"x", "y", "xy"};
    double times[LAGS], values[3 * LAGS];
    for (int k = 0; k < LAGS; k++) times[k] = 1e-3 * pow(10, 0.05 * k);
    ResultSeries shape = {
        .stage = "shear",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = 1, .labels = species},
                 {.name = "direction", .unit = "", .count = 3, .labels = directions},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    strcpy(shape.observable, observable);
    for (int k = 0; k < 3 * LAGS; k++) values[k] = function(times[k % LAGS]);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    for (size_t r = 0; r < 2; r++) results_put_series(results, &shape, r, values);
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    return results;
}

static double power(double t) {
    return 3 * pow(t, 1.7);
}

START_TEST(a_power_law_has_its_exponent) {
    Results *results = single("non_affine_displacement", power);
    for (size_t k = 1; k + 1 < LAGS; k++) {
        ck_assert_double_eq_tol(element(results, "non_affine_displacement_exponent", k), 1.7, 1e-9);
    }
    ck_assert(isnan(element(results, "non_affine_displacement_exponent", 0)));
    results_free(results);
}
END_TEST

static double caged(double t) {
    return 0.05 * (1 - exp(-t / 0.1)) + 2 * 0.03 * t;
}

START_TEST(diffusion_across_the_flow_is_a_slope) {
    Results *results = single("non_affine_displacement", caged);
    ck_assert_double_eq_tol(scalar_of(results, "shear", "long_time_diffusion_y"), 0.03, 1e-4);
    ck_assert_ptr_null(results_find_scalar(results, "shear", "long_time_diffusion_x"));
    ck_assert_ptr_null(results_find_scalar(results, "shear", "long_time_diffusion_xy"));
    results_free(results);
}
END_TEST

// Where there are waiting strains, after the last of them.
START_TEST(diffusion_across_the_flow_is_that_of_what_has_waited_longest) {
    Results *results = relaxed("non_affine_displacement", true);
    const double last = waited(100, BEST_STRAIN[WAITS - 1], true);
    const double before = waited(50, BEST_STRAIN[WAITS - 1], true);
    const double slope = scalar_of(results, "shear", "long_time_diffusion_y");
    ck_assert_double_eq_tol(slope, (last - before) / (2 * 50), 2e-3);
    results_free(results);
}
END_TEST

// Of a stage whose flow is not steady, as correlators say themselves.
START_TEST(an_unsteady_flow_has_no_long_time_diffusion) {
    static const Drive oscillating = {.flow = {.oscillation = {0.1, 0.05}}};
    System system = system_of(2, 50, 0.3, 1);
    State *state = new_state(&system);
    Clock clock = clock_of(1000, 1);
    const Settings settings = settings_of(&observable_non_affine_displacement.options);
    for (int oscillates = 0; oscillates < 2; oscillates++) {
        clock.drive = oscillates ? &oscillating : NULL;
        Observer *observer =
            new_observer(&observable_non_affine_displacement, &settings, state, &clock);
        Results *results = written(observer, state);
        ck_assert_int_eq(analysis_derive(results, &system), OK);
        const void *found = results_find_scalar(results, "quiescent", "long_time_diffusion_y");
        ck_assert_int_eq(found == NULL, oscillates);
        results_free(results);
        observer->kind->free(observer);
    }
    state_free(state);
}
END_TEST

// Nor does it stand in for the stage at rest; nor is what begins within a flow a transient.
START_TEST(a_flow_is_not_taken_for_rest) {
    static const char *const flows[][2] = {{"rest", "largest_shear_rate"},
                                           {"shear", "shear_rate_before"}};
    for (size_t i = 0; i < 2; i++) {
        Results *results = related("self_scattering", false, flows[i][0], flows[i][1]);
        ck_assert_ptr_null(results_find_series(results, "shear", "self_scattering_relation"));
        results_free(results);
    }
}
END_TEST

START_TEST(a_flow_tells_from_which_it_goes_on) {
    static const Drive drive = {.flow = {.rate = 0.1}};
    static const Flow before = {.rate = -0.3};
    System system = system_of(2, 50, 0.3, 1);
    State *state = new_state(&system);
    Clock clock = clock_of(1000, 1);
    const Settings settings = settings_of(&observable_non_affine_displacement.options);
    clock.drive = &drive;
    for (int goes_on = 0; goes_on < 2; goes_on++) {
        clock.before = goes_on ? &before : NULL;
        Observer *observer =
            new_observer(&observable_non_affine_displacement, &settings, state, &clock);
        Results *results = written(observer, state);
        ck_assert_double_eq(scalar_of(results, "quiescent", "shear_rate"), 0.1);
        if (goes_on)
            ck_assert_double_eq(scalar_of(results, "quiescent", "shear_rate_before"), 0.3);
        else
            ck_assert_ptr_null(results_find_scalar(results, "quiescent", "shear_rate_before"));
        results_free(results);
        observer->kind->free(observer);
    }
    state_free(state);
}
END_TEST

// The transient of this file is a function of strain alone but for what it does at rest; between
// lags a twentieth of a decade apart values are on straight lines in log t.
START_TEST(a_steady_flow_has_its_functions_against_strain) {
    Results *results = relaxed("self_scattering", false);
    const ResultSeries *series = series_of(results, "shear", "self_scattering_against_strain");
    const ResultAxis *strain = &series->axis[series->axes - 1];
    ck_assert_str_eq(strain->name, "strain");
    size_t compared = 0;
    for (size_t i = 0; i < strain->count; i++) {
        const double value = results_series_estimate(results, series, i).value;
        if (isnan(value)) continue;
        ck_assert_double_eq_tol(value, waited(strain->values[i] / RATE, 0, false), 2e-3);
        compared++;
    }
    ck_assert_uint_ge(compared, 40);
    ck_assert_ptr_null(results_find_series(results, "rest", "self_scattering_against_strain"));
    results_free(results);
}
END_TEST

// As strain melts a glass: faster than exponentially.
static double compressed(double t) {
    return 0.2 * exp(-t / 0.01) + 0.8 * exp(-pow(t / 20, 1.5));
}

START_TEST(a_compressed_exponential_is_found) {
    Results *results = single("self_scattering", compressed);
    ck_assert_double_eq_tol(element(results, "self_scattering_kohlrausch_exponent", 0), 1.5, 2e-3);
    ck_assert_double_eq_tol(element(results, "self_scattering_kohlrausch_time", 0), 20, 0.02);
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("transient");
    TCase *tests = tcase_create("transient");
    tcase_set_timeout(tests, 60);
    tcase_add_loop_test(tests, the_transient_follows_from_what_has_waited, 0, 2);
    tcase_add_test(tests, functions_are_related_at_the_same_wave_number_only);
    tcase_add_loop_test(tests, so_do_displacements, 0, 2);
    tcase_add_test(tests, a_power_law_has_its_exponent);
    tcase_add_test(tests, diffusion_across_the_flow_is_a_slope);
    tcase_add_test(tests, diffusion_across_the_flow_is_that_of_what_has_waited_longest);
    tcase_add_test(tests, an_unsteady_flow_has_no_long_time_diffusion);
    tcase_add_test(tests, a_flow_is_not_taken_for_rest);
    tcase_add_test(tests, a_flow_tells_from_which_it_goes_on);
    tcase_add_test(tests, a_steady_flow_has_its_functions_against_strain);
    tcase_add_test(tests, a_compressed_exponential_is_found);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
