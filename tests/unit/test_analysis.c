// SPDX-License-Identifier: GPL-3.0-or-later
// Derived numbers from series whose answer is known, and equations of state against their values.
#include "analysis/analysis.h"
#include "state/equation_of_state.h"
#include "base/constants.h"
#include "observe.h"
#include "suite.h"

#include <stdlib.h>

enum { REPLICAS = 16, LAGS = 41, BINS = 200 };
static const RngKey KEY = {.seed = 7, .replica = 0};
static const double NO_SPREAD[4] = {1, 1, 1, 1};

// Values computed by another program from the virial coefficients of Clisby & McCoy (2006), by
// hand from the printed formulae, and, for the mixture, by the rule of Santos et al.
START_TEST(equations_of_state_have_their_known_values) {
    ck_assert_double_eq_tol(equation_discs_resummed(0.1), 1.23614, 1e-5);
    ck_assert_double_eq_tol(equation_discs_resummed(0.4), 2.82933, 1e-4);
    ck_assert_double_eq_tol(equation_discs_resummed(0.6), 6.45693, 0.005);
    ck_assert_double_eq_tol(equation_baus_colot(0.2), 1.57037, 1e-5);
    ck_assert_double_eq_tol(equation_baus_colot(0.4), 2.8294, 1e-5);
    ck_assert_double_eq_tol(equation_baus_colot(0.66), 8.96704, 1e-5);
    ck_assert_double_eq_tol(equation_kolafa(0.1), 1.52165, 1e-4);
    ck_assert_double_eq_tol(equation_kolafa(0.3), 3.9842, 5e-4);
    ck_assert_double_eq_tol(equation_kolafa(0.45), 9.405, 0.005);
    ck_assert_double_eq_tol(equation_carnahan_starling(0.3), 1.363 / 0.343, 1e-12);
}
END_TEST

START_TEST(binary_discs_have_their_known_values) {
    const double moment[4] = {1, 1.2, 1.48, 0};
    ck_assert_double_eq_tol(equation_jenkins_mancini(0.4, moment), 2.8018, 1e-4);
    ck_assert_double_eq_tol(equation_jenkins_mancini(0.7, moment), 11.56306, 1e-5);
    ck_assert_double_eq_tol(equation_disc_mixture(0.4, moment, equation_discs_resummed(0.4)),
                            2.7979, 0.002);
    ck_assert_double_eq_tol(equation_disc_mixture(0.7, moment, equation_discs_resummed(0.7)), 11.28,
                            0.1);
    const System system = system_of(2, 1000, 0.7, 2);
    ck_assert_double_eq_tol((equation_second_virial(&system) - 1) / system_number_density(&system),
                            2.2933627, 1e-7);
}
END_TEST

START_TEST(mixtures_of_equals_are_pure) {
    for (double eta = 0.05; eta < 0.5; eta += 0.05) {
        ck_assert_double_eq_tol(equation_sphere_mixture(eta, NO_SPREAD),
                                equation_carnahan_starling(eta), 1e-12);
        ck_assert_double_eq_tol(equation_jenkins_mancini(eta, NO_SPREAD), equation_henderson(eta),
                                1e-12);
    }
}
END_TEST

// _i: dimension, number of species.
START_TEST(dilute_limit_is_the_second_virial_coefficient) {
    const System system = system_of(2 + _i % 2, 1000, 1e-4, 1 + (size_t)_i / 2);
    const double virial = equation_second_virial(&system) - 1;
    ck_assert_double_eq_tol((equation_of_state(&system).compressibility_factor - 1) / virial, 1,
                            1e-3);
}
END_TEST

// Kinetic theory: 2 sqrt(pi) rho d of discs, 4 sqrt(pi) rho d^2 of spheres, times sqrt(kT/m).
// _i: dimension - 2.
START_TEST(a_dilute_gas_collides_as_kinetic_theory_says) {
    const System system = system_of(2 + _i, 1000, 1e-4, 1);
    const double rate = (_i == 0 ? 2 : 4) * sqrt(PI) * system_number_density(&system);
    ck_assert_double_eq_tol(equation_collision_rate(&system) / rate, 1, 1e-3);
}
END_TEST

// Mean squared displacements in two dimensions, [species][direction][lag].
static ResultSeries displacement_shape(const char *stage, const char *const *species, size_t count,
                                       const double *times, size_t lags, const char *unit) {
    static const char *const directions[] = {"x", "y", "total"};
    ResultSeries shape = {
        .observable = "mean_squared_displacement",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = count, .labels = species},
                 {.name = "direction", .unit = "", .count = 3, .labels = directions},
                 {.name = "time", .unit = unit, .count = lags, .values = times}}};
    snprintf(shape.stage, sizeof shape.stage, "%s", stage);
    return shape;
}

// Those of one replica.
static Results *displacements_of(const char *stage, const char *const *species, const double *times,
                                 size_t lags, const double *values) {
    const ResultSeries shape = displacement_shape(stage, species, 3, times, lags, "d^2/D0");
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(results_put_series(results, &shape, 0, values), OK);
    return results;
}

// <r^2> of the kind of a colloid in a cage: 4 D t + c (1 - exp(-t/cage)), noise per replica.
static Results *displacements(double diffusion, double cage_size, double cage_time, double noise,
                              const char *unit) {
    static const char *const species[] = {"disc"};
    double times[LAGS], values[3 * LAGS];
    for (int k = 0; k < LAGS; k++) times[k] = 1e-3 * pow(10, k / 10.0);
    const ResultSeries shape = displacement_shape("quiescent", species, 1, times, LAGS, unit);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    for (size_t r = 0; r < REPLICAS; r++) {
        Rng rng = rng_open(KEY, STREAM_VELOCITY, r, 0);
        for (int k = 0; k < LAGS; k++) {
            const double t = times[k];
            const double exact = 4 * diffusion * t + cage_size * (1 - exp(-t / cage_time));
            // errors grow towards long lags, which have few origins
            const double factor = 1 + noise * sqrt(t / 10) * rng_normal(&rng);
            for (int a = 0; a < 3; a++) values[a * LAGS + k] = exact * factor / (a < 2 ? 2 : 1);
        }
        ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
    }
    return results;
}

START_TEST(long_time_diffusion_is_the_slope_beyond_the_cage) {
    const System system = system_of(2, 1000, 0.7, 1);
    Results *results = displacements(0.05, 0.1, 0.1, 0.005, "d^2/D0");
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const double error = error_of(results, "quiescent", "long_time_diffusion");
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "long_time_diffusion"), 0.05,
                            4 * error);
    ck_assert_double_lt(error, 0.001);
    const double begin = scalar_of(results, "quiescent", "long_time_window");
    ck_assert_double_gt(begin, 0.25); // the cage is left at 0.1
    ck_assert_double_lt(begin, 5);
    const ResultScalar *found = results_find_scalar(results, "quiescent", "long_time_diffusion");
    ck_assert_str_eq(found->unit, "D0");
    ck_assert_ptr_null(strstr(found->about, "Upper"));
    results_free(results);
}
END_TEST

// Stages may end before their limit: replicas have seen lags up to others then.
START_TEST(long_time_diffusion_is_of_the_lags_that_were_seen) {
    const System system = system_of(2, 1000, 0.7, 1);
    Results *early = displacements(0.05, 0.1, 0.1, 0.005, "d^2/D0");
    const ResultSeries *seen = series_of(early, "quiescent", "mean_squared_displacement");
    for (size_t k = 0; k < seen->size; k++) {
        if (k % LAGS >= LAGS - 4) seen->values[seen->size + k] = NAN; // of the second replica
    }
    ck_assert_int_eq(analysis_derive(early, &system), OK);
    const double error = error_of(early, "quiescent", "long_time_diffusion");
    ck_assert_double_eq_tol(scalar_of(early, "quiescent", "long_time_diffusion"), 0.05, 4 * error);
    ck_assert_double_lt(error, 0.001);
    const ResultScalar *found = results_find_scalar(early, "quiescent", "long_time_diffusion");
    ck_assert_uint_eq(results_scalar_estimate(early, found).n, REPLICAS);
    results_free(early);
}
END_TEST

START_TEST(where_the_slope_still_falls_the_last_stretch_is_taken) {
    const System system = system_of(2, 1000, 0.7, 1);
    Results *results = displacements(0.001, 10, 5, 1e-6, "d^2/D0");
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_double_ge(scalar_of(results, "quiescent", "long_time_window"), 2.5);
    ck_assert_double_gt(scalar_of(results, "quiescent", "long_time_diffusion"), 0.001);
    ck_assert_ptr_nonnull(
        strstr(results_find_scalar(results, "quiescent", "long_time_diffusion")->about, "Upper"));
    results_free(results);
}
END_TEST

START_TEST(short_time_diffusion_is_where_flight_ends) {
    // Flight <r^2> = 4 t^2/h up to h = 0.01, then 4 t: D = 1 at h, less before.
    static const char *const species[] = {"small", "big", "all"};
    double times[LAGS], values[9 * LAGS];
    for (int k = 0; k < LAGS; k++) times[k] = 1e-4 * pow(10, k / 10.0);
    for (int s = 0; s < 9; s++) {
        for (int k = 0; k < LAGS; k++) {
            const double t = times[k], flight = t < 0.01 ? t / 0.01 : 1 - 0.1 * (t - 0.01) / t;
            values[s * LAGS + k] = (s % 3 < 2 ? 2 : 4) * t * flight / (s / 3 == 1 ? 2 : 1);
        }
    }
    Results *results = displacements_of("quiescent", species, times, LAGS, values);
    const System system = system_of(2, 1000, 0.7, 2);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "short_time_diffusion"), 1, 1e-9);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "short_time_diffusion_small"), 1, 1e-9);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "short_time_diffusion_big"), 0.5, 1e-9);
    results_free(results);
}
END_TEST

START_TEST(newtonian_flight_has_no_brownian_short_time) {
    const System system = system_of(2, 1000, 0.7, 1);
    Results *results = displacements(0.05, 0.1, 0.1, 0.02, "d sqrt(m/kT)");
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert(!results_find_scalar(results, "quiescent", "short_time_diffusion"));
    ck_assert_str_eq(results_find_scalar(results, "quiescent", "long_time_diffusion")->unit,
                     "d sqrt(kT/m)");
    results_free(results);
}
END_TEST

START_TEST(where_a_force_pulls_diffusion_is_told_across_it) {
    // Diffusion 2 D t along each axis; along x a drift of 3 as well.
    static const char *const species[] = {"bath", "tracer", "all"};
    const double diffusion = 0.8, drift = 3;
    double times[LAGS], values[9 * LAGS];
    for (int k = 0; k < LAGS; k++) times[k] = 1e-2 * pow(10, k / 10.0);
    for (int s = 0; s < 3; s++) {
        for (int k = 0; k < LAGS; k++) {
            const double free = 2 * diffusion * times[k], way = s ? drift * times[k] : 0;
            values[(3 * s + 0) * LAGS + k] = free + way * way;
            values[(3 * s + 1) * LAGS + k] = free;
            values[(3 * s + 2) * LAGS + k] = 2 * free + way * way;
        }
    }
    Results *results = displacements_of("pulled", species, times, LAGS, values);
    ck_assert_int_eq(results_put_scalar(results, "pulled", "force_x", "kT/d", NULL, 0, drift), OK);
    const System system = system_of(2, 1000, 0.7, 2);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    static const char *const told[] = {
        "short_time_diffusion_y", "short_time_diffusion_y_bath", "short_time_diffusion_y_tracer",
        "long_time_diffusion_y_bath", "long_time_diffusion_y_tracer"};
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        ck_assert_double_eq_tol(scalar_of(results, "pulled", told[i]), diffusion, 1e-9);
    static const char *const untold[] = {
        "short_time_diffusion",         "short_time_diffusion_tracer", "long_time_diffusion_tracer",
        "long_time_diffusion_x_tracer", "short_time_diffusion_x",      "long_time_diffusion_total"};
    for (size_t i = 0; i < sizeof untold / sizeof *untold; i++)
        ck_assert_msg(!results_find_scalar(results, "pulled", untold[i]), "%s is told", untold[i]);
    ck_assert(!results_find_series(results, "pulled", "free_displacement"));
    results_free(results);
}
END_TEST

START_TEST(heavier_species_diffuse_freely_in_proportion_less) {
    static const char *const species[] = {"light", "heavy", "all"};
    System system = system_of(2, 100, 0.1, 2);
    system.species[0] = (Species){.diameter = 1, .mass = 2, .fraction = 0.25};
    system.species[1] = (Species){.diameter = 1, .mass = 8, .fraction = 0.75};
    const double times[] = {0.1, 1, 2}, values[27] = {0};
    Results *results = displacements_of("quiescent", species, times, 3, values);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const double *line = results_find_series(results, "quiescent", "free_displacement")->values;
    ck_assert_double_eq(line[2], 2 * 2);              // light, along x, t = 2
    ck_assert_double_eq(line[8], 4 * 2);              // light, total
    ck_assert_double_eq(line[17], 4 * 2 * 0.25);      // heavy: D0 goes with 1/m
    ck_assert_double_eq(line[26], 4 * 2 * 1.75 / 4.); // all: 25 light, 75 heavy
    results_free(results);
}
END_TEST

// g = contact exp(-decay (x - 1)), averaged over bins.
static Results *contacts(double contact, double decay) {
    static const char *const pair[] = {"disc-disc"};
    const double width = 0.001, weight = 1.5;
    double places[BINS], values[BINS];
    for (int k = 0; k < BINS; k++) {
        places[k] = 1 + (k + 0.5) * width;
        values[k] = contact * exp(-decay * k * width) * (1 - exp(-decay * width)) / (decay * width);
    }
    const ResultAxis pairs = {.name = "pair", .unit = "", .count = 1, .labels = pair};
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "contact_distribution",
        .axes = 2,
        .axis = {pairs, {.name = "scaled_distance", .unit = "", .count = BINS, .values = places}}};
    const ResultSeries weights = {
        .stage = "quiescent", .observable = "contact_weight", .axes = 1, .axis = {pairs}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(results_put_series(results, &shape, 0, values), OK);
    ck_assert_int_eq(results_put_series(results, &weights, 0, &weight), OK);
    return results;
}

START_TEST(contact_value_of_an_exponential_is_found) {
    static const double decay[] = {0.5, 3, 15, 40};
    const System system = system_of(2, 1000, 0.7, 1);
    Results *results = contacts(7, decay[_i]);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const double contact = scalar_of(results, "quiescent", "contact_value_disc_disc");
    ck_assert_double_eq_tol(contact, 7, 7 * 2e-4);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "compressibility_factor_contact"),
                            1 + 1.5 * contact, 1e-12);
    results_free(results);
}
END_TEST

// One stage, at rest or sheared.
static Plan *plan_of_contacts(const System *system, double rate) {
    Plan *plan = calloc(1, sizeof *plan);
    ck_assert_ptr_nonnull(plan);
    plan->system = *system;
    plan->stage_count = 1;
    strcpy(plan->stages[0].name, "quiescent");
    plan->stages[0].drive.flow.rate = rate;
    return plan;
}

START_TEST(an_equation_of_state_is_for_stages_at_rest) {
    const System discs = system_of(2, 1000, 0.7, 1);
    for (int sheared = 0; sheared < 2; sheared++) {
        Plan *plan = plan_of_contacts(&discs, sheared);
        Results *results = contacts(7, 3);
        ck_assert_int_eq(analysis_equation(results, plan), OK);
        if (sheared)
            ck_assert_ptr_null(results_find_scalar(results, "quiescent", "pressure_theory"));
        else
            ck_assert_double_eq_tol(
                scalar_of(results, "quiescent", "compressibility_factor_theory"),
                equation_discs_resummed(0.7), 1e-12);
        results_free(results);
        free(plan);
    }
}
END_TEST

// Series of bodies with an axis: `rows` along the middle axis, each from a function of time, with
// noise of its own in every replica.
static Results *series_of_bodies(const char *observable, const System *system, size_t rows,
                                 double (*value)(size_t row, double t), double noise) {
    static const char *const names[] = {"plate", "rod", "all"};
    static const char *const of_rows[] = {"first", "second", "third", "fourth"};
    double times[LAGS], values[3 * 4 * LAGS];
    const size_t labels = system->species_count > 1 ? 3 : 1;
    for (int k = 0; k < LAGS; k++) times[k] = 1e-3 * pow(10, k / 10.0);
    const ResultSeries shape = {
        .stage = "quiescent",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = labels, .labels = names},
                 {.name = "row", .unit = "", .count = rows, .labels = of_rows},
                 {.name = "time", .unit = "d^2/D0", .count = LAGS, .values = times}}};
    ResultSeries named = shape;
    strcpy(named.observable, observable);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, REPLICAS), OK);
    for (size_t r = 0; r < REPLICAS; r++) {
        Rng rng = rng_open(KEY, STREAM_VELOCITY, r, 1);
        for (size_t i = 0; i < labels * rows * LAGS; i++) {
            values[i] = value(i / LAGS % rows, times[i % LAGS]) + noise * rng_normal(&rng);
        }
        ck_assert_int_eq(results_put_series(results, &named, r, values), OK);
    }
    return results;
}

// Fast at first, then with tau = 0.8 (P1); with tau = 0.3 to a plateau of 0.16 (P2).
static double relaxing(size_t row, double t) {
    if (row == 0) return 0.3 * exp(-t / 0.02) + 0.7 * exp(-t / 0.8);
    return 0.16 + 0.84 * exp(-t / 0.3);
}

START_TEST(relaxation_times_are_those_of_the_late_decay) {
    const System system = oriented_system(1000, 1);
    Results *results = series_of_bodies("orientation_correlation", &system, 2, relaxing, 0.004);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    static const struct {
        const char *name;
        double value, precision;
    } expected[] = {{"relaxation_time_P1", 0.8, 0.01},
                    {"relaxation_time_P2", 0.3, 0.01},
                    {"orientation_plateau", 0.16, 0.002}};
    for (int i = 0; i < 3; i++) {
        const double error = error_of(results, "quiescent", expected[i].name);
        ck_assert_double_eq_tol(scalar_of(results, "quiescent", expected[i].name),
                                expected[i].value, 4 * error);
        ck_assert_double_lt(error, expected[i].precision);
        ck_assert_double_gt(error, 0);
    }
    results_free(results);
}
END_TEST

static double frozen(size_t row, double t) {
    return row == 0 ? exp(-t / 1000) : 0.8 + 0.2 * exp(-t / 0.3);
}

START_TEST(what_has_not_relaxed_has_no_relaxation_time) {
    const System system = oriented_system(1000, 1);
    Results *results = series_of_bodies("orientation_correlation", &system, 2, frozen, 1e-4);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_ptr_null(results_find_scalar(results, "quiescent", "relaxation_time_P1"));
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "relaxation_time_P2"), 0.3, 0.01);
    results_free(results);
}
END_TEST

static double bent(size_t row, double t) {
    static const double late[] = {0.2, 0.5, 0.3, 0.7};
    return 2 * late[row] * t + 0.1 * (1 - exp(-t / 0.05)) * (1 + 0.0001 * sin(1e5 * t));
}

START_TEST(every_direction_has_its_long_time_diffusion) {
    const System system = oriented_system(1000, 2);
    Results *results = series_of_bodies("directional_displacement", &system, 4, bent, 1e-4);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    static const double late[] = {0.2, 0.5, 0.3, 0.7};
    static const char *const names[] = {"long_time_diffusion_first", "long_time_diffusion_second",
                                        "long_time_diffusion_third_rod",
                                        "long_time_diffusion_fourth_plate"};
    for (int i = 0; i < 4; i++) {
        ck_assert_double_eq_tol(scalar_of(results, "quiescent", names[i]), late[i], 2e-3);
    }
    results_free(results);
}
END_TEST

static double nothing(size_t row, double t) {
    (void)row;
    (void)t;
    return 0;
}

// A platelet has D_par = 1/8, D_perp = 3/16, D_rot = 3/4 in kT/(eta d), hence D0 = 1/6; 0.01 and 1
// eta d^3/kT are 0.01/6 and 1/6 d^2/D0, tau_B/2 of Jabbari-Farouji and Trizac is 1/12.
START_TEST(free_platelets_move_as_their_tensor_says) {
    const System system = oriented_system(1000, 1);
    Results *results = series_of_bodies("directional_displacement", &system, 4, nothing, 0);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const ResultSeries *line = series_of(results, "quiescent", "free_directional_displacement");
    const double *times = line->axis[2].values;
    for (size_t k = 0; k < LAGS; k++) {
        const double t = 6 * times[k]; // in eta d^3/kT
        const double along = t / 3 + 4.0 / 3 * (0.125 - 0.1875) * (1 - exp(-4.5 * t)) / 4.5;
        ck_assert_double_eq_tol(line->values[k], along, 1e-12 * along);
        ck_assert_double_eq_tol(line->values[k] + 2 * line->values[LAGS + k], t, 1e-12 * t);
        ck_assert_double_eq_tol(line->values[2 * LAGS + k], t / 3, 1e-12 * t);
    }
    results_free(results);
    results = series_of_bodies("orientation_correlation", &system, 2, nothing, 0);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    line = series_of(results, "quiescent", "free_orientation_correlation");
    times = line->axis[2].values;
    for (size_t k = 0; k < LAGS; k++) {
        ck_assert_double_eq_tol(line->values[k], pow(0.4723665527, 12 * times[k]), 1e-8);
        ck_assert_double_eq_tol(line->values[LAGS + k], pow(0.4723665527, 36 * times[k]), 1e-8);
    }
    results_free(results);
}
END_TEST

START_TEST(only_hard_discs_and_spheres_have_an_equation_of_state) {
    const System rods = oriented_system(100, 2), soft = soft_system(100, 36);
    const System spheres = system_of(3, 100, 0.3, 2);
    ck_assert(!equation_of_state_known(&rods));
    ck_assert(!equation_of_state_known(&soft));
    ck_assert(equation_of_state_known(&spheres));
    Results *results = contacts(7, 3);
    Plan *plan = plan_of_contacts(&soft, 0);
    ck_assert_int_eq(analysis_equation(results, plan), OK);
    ck_assert_ptr_null(results_find_scalar(results, "quiescent", "compressibility_factor_theory"));
    results_free(results);
    free(plan);
}
END_TEST

static Results *passage_of_a_tracer(void) {
    Results *results = NULL;
    static const double begin[] = {0, 0.2}, values[] = {1, 1, 1, 1};
    static const char *const quantities[] = {"distance", "time"};
    const ResultSeries shape = {
        .stage = "pulled",
        .observable = "tracer_passage",
        .axes = 2,
        .axis = {{.name = "quantity", .unit = "", .count = 2, .labels = quantities},
                 {.name = "begin", .unit = "", .count = 2, .values = begin}}};
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(results_put_series(results, &shape, 0, values), OK);
    return results;
}

static double limit(const System *system, const char *quantity) {
    Results *results = passage_of_a_tracer();
    ck_assert_int_eq(analysis_derive(results, system), OK);
    const ResultScalar *found = results_find_scalar(results, "pulled", quantity);
    const double value = found ? found->values[0] : (double)NAN;
    results_free(results);
    return value;
}

// At 0.1 the pair distribution of Carnahan and Starling at contact is 0.95/0.729.
START_TEST(friction_among_equal_spheres_has_limits) {
    System system = system_of(3, 100, 0.1, 1);
    ck_assert_double_eq_tol(limit(&system, "friction_weak"), 1.2, 1e-12);
    ck_assert_double_eq_tol(limit(&system, "friction_strong"), 1.1, 1e-12);
    ck_assert_double_eq_tol(limit(&system, "friction_weak_contact"), 1 + 0.19 / 0.729, 1e-12);
    ck_assert_double_eq_tol(limit(&system, "friction_strong_contact"), 1 + 0.095 / 0.729, 1e-12);
    const System rods = oriented_system(100, 2), discs = system_of(2, 100, 0.1, 1);
    ck_assert(isnan(limit(&rods, "friction_weak")));
    ck_assert(isnan(limit(&discs, "friction_weak")));
    system.species[0].shape = SHAPE_SOFT_SPHERE;
    system.species[0].exponent = 36; // as hard spheres of 1.016817 d: 0.1051304
    ck_assert_double_eq_tol(limit(&system, "friction_weak"), 1.2, 1e-12);
    ck_assert_double_eq_tol(limit(&system, "friction_strong_contact"),
                            1 + 0.1051304 * 0.9474348 / 0.7165986, 1e-5);
}
END_TEST

// Pressures that rise by 0.5 in the stage, in eleven blocks of which the middle one is in no half.
START_TEST(a_stage_that_drifts_is_told) {
    double times[11], values[11];
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    for (size_t r = 0; r < 2; r++) {
        for (int k = 0; k < 11; k++) {
            times[k] = k;
            values[k] = 3 + 0.05 * k + (k == 5 ? 100 : 0) + (double)r;
        }
        const ResultSeries shape = {
            .stage = "quiescent",
            .observable = "pressure",
            .unit = "kT/d^2",
            .axes = 1,
            .axis = {{.name = "time", .unit = "d^2/D0", .count = 11, .values = times}}};
        ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
        static const char *const orders[] = {"local", "global"};
        ResultSeries both = shape;
        strcpy(both.observable, "bond_order");
        both.axis[1] = shape.axis[0];
        both.axis[0] = (ResultAxis){.name = "order", .unit = "", .count = 2, .labels = orders};
        both.axes = 2;
        const double steady[11] = {0};
        double two[22];
        memcpy(two, steady, sizeof steady);
        memcpy(two + 11, values, sizeof values);
        ck_assert_int_eq(results_put_series(results, &both, r, two), OK);
    }
    const System system = system_of(2, 100, 0.5, 1);
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "bond_order_local_drift"), 0, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "bond_order_global_drift"), 0.3, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "pressure_drift"), 0.3, 1e-12);
    ck_assert_double_eq_tol(error_of(results, "quiescent", "pressure_drift"), 0, 1e-12);
    results_free(results);
}
END_TEST

START_TEST(deriving_twice_changes_nothing) {
    const System system = system_of(2, 1000, 0.7, 1);
    Results *results = displacements(0.05, 0.1, 0.1, 0.02, "d^2/D0");
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const size_t scalars = results->scalar_count;
    const double diffusion = scalar_of(results, "quiescent", "long_time_diffusion");
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    ck_assert_uint_eq(results->scalar_count, scalars);
    ck_assert_double_eq(scalar_of(results, "quiescent", "long_time_diffusion"), diffusion);
    results_free(results);
}
END_TEST

START_TEST(a_structure_factor_changes_since_the_first_stage_that_has_it) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    const double q[] = {-1, 0, 1};
    ResultSeries shape = {
        .observable = "structure_factor_cuts",
        .axes = 1,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = 3, .values = q}}};
    static const char *const stages[] = {"rest", "shear", "faster"};
    for (size_t stage = 0; stage < 3; stage++) {
        strcpy(shape.stage, stages[stage]);
        for (size_t r = 0; r < 2; r++) {
            const double factor = (double)(1 + stage) * (double)(1 + r);
            const double values[] = {factor, NAN, 3 * factor};
            ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
        }
    }
    const System system = system_of(2, 100, 0.1, 1);
    for (int twice = 0; twice < 2; twice++) {
        ck_assert_int_eq(analysis_derive(results, &system), OK);
        ck_assert_ptr_null(results_find_series(results, "rest", "structure_factor_cuts_change"));
        for (size_t stage = 1; stage < 3; stage++) {
            const ResultSeries *change =
                series_of(results, stages[stage], "structure_factor_cuts_change");
            for (size_t r = 0; r < 2; r++) {
                const double factor = (double)stage * (double)(1 + r);
                ck_assert_double_eq(change->values[3 * r], factor);
                ck_assert(isnan(change->values[3 * r + 1]));
                ck_assert_double_eq(change->values[3 * r + 2], 3 * factor);
            }
        }
    }
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("analysis");
    TCase *c = tcase_create("analysis");
    tcase_add_test(c, equations_of_state_have_their_known_values);
    tcase_add_test(c, binary_discs_have_their_known_values);
    tcase_add_test(c, mixtures_of_equals_are_pure);
    tcase_add_loop_test(c, dilute_limit_is_the_second_virial_coefficient, 0, 4);
    tcase_add_loop_test(c, a_dilute_gas_collides_as_kinetic_theory_says, 0, 2);
    tcase_add_test(c, long_time_diffusion_is_the_slope_beyond_the_cage);
    tcase_add_test(c, long_time_diffusion_is_of_the_lags_that_were_seen);
    tcase_add_test(c, where_the_slope_still_falls_the_last_stretch_is_taken);
    tcase_add_test(c, short_time_diffusion_is_where_flight_ends);
    tcase_add_test(c, newtonian_flight_has_no_brownian_short_time);
    tcase_add_test(c, where_a_force_pulls_diffusion_is_told_across_it);
    tcase_add_test(c, heavier_species_diffuse_freely_in_proportion_less);
    tcase_add_loop_test(c, contact_value_of_an_exponential_is_found, 0, 4);
    tcase_add_test(c, an_equation_of_state_is_for_stages_at_rest);
    tcase_add_test(c, relaxation_times_are_those_of_the_late_decay);
    tcase_add_test(c, what_has_not_relaxed_has_no_relaxation_time);
    tcase_add_test(c, every_direction_has_its_long_time_diffusion);
    tcase_add_test(c, free_platelets_move_as_their_tensor_says);
    tcase_add_test(c, only_hard_discs_and_spheres_have_an_equation_of_state);
    tcase_add_test(c, friction_among_equal_spheres_has_limits);
    tcase_add_test(c, a_stage_that_drifts_is_told);
    tcase_add_test(c, deriving_twice_changes_nothing);
    tcase_add_test(c, a_structure_factor_changes_since_the_first_stage_that_has_it);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
