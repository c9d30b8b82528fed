// SPDX-License-Identifier: GPL-3.0-or-later
// A tracer pulled through hard spheres, by Monte Carlo and by event-driven dynamics, against
// velocities found by an independent event-driven program and against each other. Fixed seeds.
#include "base/constants.h"
#include "shapes/overlap.h"
#include "simulate.h"

#include <stdlib.h>

// A tracer of the bath's size. Box and times as small as its wake allows.
static Plan *pulled_plan(double packing_fraction, double peclet, double step, double period,
                         double trajectories) {
    System system = {.dimension = 3,
                     .particles = 300,
                     .packing_fraction = packing_fraction,
                     .aspect = {3, {2, 1, 1}},
                     .species_count = 2};
    for (size_t s = 0; s < 2; s++) {
        system.species[s] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .mass = 1};
    }
    system.species[1].fraction = 1 / (double)system.particles;
    system.species[0].fraction = 1 - system.species[1].fraction;
    strcpy(system.species[0].name, "bath");
    strcpy(system.species[1].name, "tracer");
    Plan *plan = new_plan(system, 0.01, 100, period * trajectories, 4);
    Stage *measured = &plan->stages[1];
    const PropagatorKind *kind = &propagator_dynamic_monte_carlo;
    measured->dynamics = (Dynamics){.kind = kind, .settings = settings_of(&kind->options)};
    set_number(&measured->dynamics.settings, &kind->options, "step", step);
    set_number(&measured->dynamics.settings, &kind->options, "clock", 0); // acceptance-rescaling
    set_number(&measured->dynamics.settings, &kind->options, "calibration", 4000);
    strcpy(measured->drive.pull.species, "tracer");
    measured->drive.pull.peclet = peclet;
    measured->drive.pull.period = period;
    measured->drive.pull.rest = 0.1;
    observe(plan, &observable_pulled_tracer);
    return plan;
}

// The same by event-driven dynamics.
static Plan *event_driven_plan(double packing_fraction, double peclet, double interval,
                               double period, double trajectories) {
    Plan *plan = pulled_plan(packing_fraction, peclet, 0.02, period, trajectories);
    Dynamics *dynamics = &plan->stages[1].dynamics;
    dynamics->kind = &propagator_event_driven;
    dynamics->settings = settings_of(&propagator_event_driven.options);
    set_number(&dynamics->settings, &propagator_event_driven.options, "thermostat_interval",
               interval);
    return plan;
}

// What the clock leaves at the longer of the steps: at 0.05 the friction is 6 % too large, and the
// error is linear in the step.
static const double STEP_ERROR = 0.024;

// The rounds in which the tracer's step is found: the last of them leave it on the bath's clock.
static void check_settling(const Results *results) {
    const size_t rounds = 8; // 4000 cycles of calibration
    ck_assert_uint_eq(series_of(results, "measured", "tracer_pace")->size, rounds);
    ck_assert_uint_eq(series_of(results, "measured", "tracer_step")->size, rounds);
    const Estimate pace = measured_at(results, "tracer_pace", rounds - 1);
    const Estimate before = measured_at(results, "tracer_step", rounds - 2);
    const Estimate step = measured_at(results, "tracer_step", rounds - 1);
    ck_assert_double_eq_tol(pace.value, 1, 0.05);
    ck_assert_double_eq_tol(step.value / before.value, 1, 0.02);
}

// v/v_free: 0.928(5) at packing fraction 0.05 and Pe = 5, 0.727(4) at 0.2 and 20.
START_TEST(friction_is_that_of_event_driven_dynamics) {
    static const struct {
        double packing_fraction, peclet, step, period, trajectories, velocity, known;
    } cases[] = {{0.05, 5, 0.05, 2.5, 24, 0.928, 0.005}, {0.2, 20, 0.02, 0.5, 10, 0.727, 0.004}};
    Results *results =
        simulate(pulled_plan(cases[_i].packing_fraction, cases[_i].peclet, cases[_i].step,
                             cases[_i].period, cases[_i].trajectories));
    const Estimate friction = measured(results, "effective_friction");
    const Estimate velocity = measured(results, "tracer_velocity");
    const double expected = 1 / cases[_i].velocity;
    const double known = cases[_i].known / cases[_i].velocity * expected;
    expect_within("effective friction", friction, expected, known + STEP_ERROR * expected / 3, 3,
                  0.04);
    ck_assert_double_eq_tol(velocity.value * friction.value, 2 * cases[_i].peclet,
                            0.02 * cases[_i].peclet); // D F; the jackknife of each is its own
    check_settling(results);
    results_free(results);
}
END_TEST

// Our own event-driven dynamics against that program, at an interval twice the usual one.
START_TEST(friction_is_that_of_another_event_driven_program) {
    static const struct {
        double packing_fraction, peclet, period, trajectories, velocity, known;
    } cases[] = {{0.05, 5, 2.5, 24, 0.928, 0.005}, {0.2, 20, 0.5, 10, 0.727, 0.004}};
    Results *results = simulate(event_driven_plan(cases[_i].packing_fraction, cases[_i].peclet,
                                                  0.02, cases[_i].period, cases[_i].trajectories));
    const double expected = 1 / cases[_i].velocity;
    expect_within("effective friction", measured(results, "effective_friction"), expected,
                  cases[_i].known / cases[_i].velocity * expected, 3, 0.04);
    ck_assert_ptr_null(results_find_series(results, "measured", "tracer_pace"));
    results_free(results);
}
END_TEST

// Of simulate, with the friction alone.
static Estimate friction_of(Plan *plan) {
    Results *results = simulate(plan);
    const Estimate friction = measured(results, "effective_friction");
    results_free(results);
    return friction;
}

// A strong force: drifted trials, extrapolated in the step by a straight line, against event-driven
// dynamics.
START_TEST(both_methods_feel_the_same_friction) {
    const double packing_fraction = 0.3, peclet = 50, period = 0.25, trajectories = 10;
    const Estimate known =
        friction_of(event_driven_plan(packing_fraction, peclet, 0.02, period, trajectories));
    const Estimate coarse =
        friction_of(pulled_plan(packing_fraction, peclet, 0.01, period, trajectories));
    const Estimate fine =
        friction_of(pulled_plan(packing_fraction, peclet, 0.005, period, trajectories));
    Estimate straight = fine;
    straight.value = 2 * fine.value - coarse.value;
    straight.error = hypot(2 * fine.error, coarse.error);
    expect_within("friction at no step", straight, known.value, known.error, 3, 0.08);
}
END_TEST

// Without force it is as crowded in front as behind: g(d) = (1 - phi/2)/(1 - phi)^3 = 1.7578 of
// Carnahan and Starling, less what g(r) falls by within the shell of 0.05 d, some 3 %.
START_TEST(nothing_is_in_front_without_a_force) {
    Plan *plan = pulled_plan(0.2, 0, 0.05, 8, 1);
    plan->stages[1].drive.pull.period = plan->stages[1].drive.pull.rest = 0;
    Settings *settings = observe(plan, &observable_tracer_surroundings);
    set_number(settings, &observable_tracer_surroundings.options, "looks", 4000);
    Results *results = simulate(plan);
    const Estimate front = measured(results, "contact_density_front");
    const Estimate behind = measured(results, "contact_density_behind");
    const Estimate wake = measured(results, "wake_length");
    expect_within("in front", front, 1.70, 0.05, 4, 0.15);
    expect_within("behind", behind, 1.70, 0.05, 4, 0.15);
    printf("wake %.3f(%.3f) d\n", wake.value, wake.error);
    ck_assert_double_lt(fabs(wake.value), 0.03 + 4 * wake.error);
    results_free(results);
}
END_TEST

// Pushed through, it has a crowd in front and nothing behind.
START_TEST(a_strong_force_leaves_a_wake) {
    Plan *plan = pulled_plan(0.2, 30, 0.02, 0.4, 5);
    observe(plan, &observable_tracer_surroundings);
    Results *results = simulate(plan);
    const Estimate front = measured(results, "contact_density_front");
    const Estimate behind = measured(results, "contact_density_behind");
    const Estimate wake = measured(results, "wake_length");
    printf("in front %.2f(%.2f), behind %.3f(%.3f), wake %.2f(%.2f) d\n", front.value, front.error,
           behind.value, behind.error, wake.value, wake.error);
    ck_assert_double_gt(front.value - 4 * front.error, 2 * 1.7578);
    ck_assert_double_lt(behind.value + 4 * behind.error, 0.5);
    ck_assert_double_gt(wake.value - 4 * wake.error, 0.1);
    results_free(results);
}
END_TEST

// All rods anew; one that would overlap the tracer in the middle is put half a box away.
static void place_rods(State *state, int64_t look) {
    const size_t tracer = state->count - 1;
    for (size_t i = 0; i < tracer; i++) {
        Rng rng = rng_open((RngKey){.seed = 3}, STREAM_PACKING, (uint64_t)look, i);
        double axis[3], r[3], square = 0;
        for (int a = 0; a < 3; a++) {
            state->position[a][i] = rng_uniform(&rng) * state->box.edge[a];
            r[a] = state->position[a][i] - state->position[a][tracer];
            axis[a] = rng_normal(&rng);
            square += axis[a] * axis[a];
        }
        for (int a = 0; a < 3; a++) state->orientation[a][i] = axis[a] /= sqrt(square);
        box_nearest_image(&state->box, r);
        if (!spherocylinder_overlap(1.4, axis, 0, 1, axis, 3, r)) continue;
        for (int a = 0; a < 3; a++) {
            const double there = state->position[a][tracer] + state->box.edge[a] / 2;
            state->position[a][i] = fmod(there, state->box.edge[a]);
        }
    }
}

// Rods that are anywhere and point anywhere, but where they would overlap the tracer: they touch it
// as often as those that are spread evenly, which is what 1 means.
START_TEST(scattered_rods_touch_as_often_as_evenly_spread_ones) {
    enum { RODS = 100, LOOKS = 60000 };
    System system = {
        .dimension = 3, .particles = RODS + 1, .number_density = 0.1, .species_count = 2};
    system.species[0] = (Species){.name = "bath",
                                  .shape = SHAPE_SPHEROCYLINDER,
                                  .diameter = 1,
                                  .length = 3,
                                  .fraction = RODS / (RODS + 1.0)};
    system.species[1] = (Species){
        .name = "tracer", .shape = SHAPE_SPHERE, .diameter = 1.4, .fraction = 1 / (RODS + 1.0)};
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i <= RODS; i++) state->diameter[i] = i < RODS ? 1 : 1.4;
    const Drive drive = {.pull = {.species = "tracer", .peclet = 1}};
    const Clock clock = {.tick = 1,
                         .ticks = LOOKS,
                         .ticks_per_step = 1,
                         .unit = "d^2/D0",
                         .stage = "measured",
                         .drive = &drive};
    const ObservableKind *kind = &observable_tracer_surroundings;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "begin", 0);
    set_number(&settings, &kind->options, "looks", LOOKS);
    Observer *observer = NULL;
    ck_assert_int_eq(kind->create(&observer, &settings, state, &clock), OK);
    for (int64_t look = 0; look < LOOKS; look++) {
        place_rods(state, look);
        ck_assert_int_eq(kind->see(observer, look, state, &(Tally){0}), OK);
    }
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(kind->write(observer, state, results, 0), OK);
    // Some 830 on either side in all looks.
    const double error = 1 / sqrt(830);
    ck_assert_double_eq_tol(measured(results, "contact_density_front").value, 1, 4 * error);
    ck_assert_double_eq_tol(measured(results, "contact_density_behind").value, 1, 4 * error);
    kind->free(observer);
    results_free(results);
    state_free(state);
}
END_TEST

// Two spheres in a box of 20 d, the second one the tracer.
static State *pair_in_a_box(void) {
    System system = {
        .dimension = 3, .particles = 2, .number_density = 2 / 8000.0, .species_count = 2};
    for (size_t s = 0; s < 2; s++) {
        system.species[s] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .fraction = 0.5};
    }
    strcpy(system.species[1].name, "tracer");
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < 2; i++) {
        state->diameter[i] = 1;
        for (int a = 0; a < 3; a++) state->position[a][i] = 10;
    }
    return state;
}

// A tracer that goes half a diameter in each tick, once round the box in each of two trajectories,
// and one neighbour: in the first in touch in front of it, up to 3/4 of the edge, and from there on
// in touch behind.
static void place_pair(State *state, int64_t tick) {
    const double edge = state->box.edge[0], gone = 0.5 * (double)(tick % 40);
    const double place = 1 + gone, near = tick < 40 ? 1.02 : 5;
    const double side = gone < 0.75 * edge ? near : -1.02;
    state->image[0][1] = (int32_t)floor(place / edge);
    state->position[0][1] = place - edge * state->image[0][1];
    state->position[0][0] = fmod(place + side + edge, edge);
}

// What is seen of two trajectories of 40 ticks in which `place` moves the particles.
static Results *two_trajectories(const ObservableKind *kind, const Settings *settings, State *state,
                                 void (*place)(State *state, int64_t tick)) {
    const Drive drive = {.pull = {.species = "tracer", .peclet = 1, .period = 40}};
    const Clock clock = {.tick = 1,
                         .ticks = 80,
                         .ticks_per_step = 1,
                         .unit = "d^2/D0",
                         .stage = "measured",
                         .drive = &drive};
    Observer *observer = NULL;
    Results *results = NULL;
    ck_assert_int_eq(kind->create(&observer, settings, state, &clock), OK);
    for (int64_t tick = kind->next(observer, -1); tick <= clock.ticks;
         tick = kind->next(observer, tick)) {
        place(state, tick);
        ck_assert_int_eq(kind->see(observer, tick, state, &(Tally){0}), OK);
    }
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(kind->write(observer, state, results, 0), OK);
    kind->free(observer);
    return results;
}

// What a tracer meets after 3/4 of the edge it may have pushed there itself. Looks are every three
// ticks, and the second trajectory does not begin with one.
START_TEST(a_tracer_is_not_looked_at_in_its_own_wake) {
    State *state = pair_in_a_box();
    const ObservableKind *kind = &observable_tracer_surroundings;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "begin", 0);
    set_number(&settings, &kind->options, "looks", 27);
    Results *results = two_trajectories(kind, &settings, state, place_pair);
    const double shell = 4 * PI / 3 * (pow(1.05, 3) - 1) * (1 - sqrt(0.75)) / 2;
    ck_assert_double_eq(measured(results, "contact_density_behind").value, 0);
    ck_assert_double_eq_tol(measured(results, "contact_density_front").value,
                            9.0 / 19 * 8000 / shell, 0.01); // looks of the first, of both
    results_free(results);
    state_free(state);
}
END_TEST

static void place_tracer(State *state, int64_t tick) {
    state->position[0][1] = (tick < 40 ? 0.1 : 0.3) * (double)(tick % 40);
}

// Two trajectories of 40 ticks, in which a tracer goes 0.1 and 0.3 d in each: a single replica
// tells the error of their mean.
START_TEST(a_single_replica_has_errors_over_its_trajectories) {
    State *state = pair_in_a_box();
    const ObservableKind *kind = &observable_pulled_tracer;
    const Settings settings = settings_of(&kind->options);
    Results *results = two_trajectories(kind, &settings, state, place_tracer);
    ck_assert_int_eq(analysis_derive(results, &state->system), OK);
    ck_assert_double_eq(measured(results, "tracer_trajectories").value, 2);
    const Estimate velocity = measured(results, "tracer_velocity"),
                   friction = measured(results, "effective_friction"),
                   drift = measured(results, "tracer_velocity_drift"),
                   way = measured_at(results, "tracer_displacement", 19), // after 20 ticks
        square = measured_at(results, "tracer_square_displacement", 19);
    ck_assert_double_eq_tol(velocity.value, 0.2, 1e-12);
    ck_assert_double_eq_tol(velocity.error, 0.1, 1e-12);
    ck_assert_double_eq_tol(friction.value, 10, 1e-9); // D F = 2
    ck_assert_double_eq_tol(friction.error, 5, 1e-9);
    ck_assert_double_eq_tol(drift.value, 0, 1e-12);
    ck_assert_double_gt(drift.error, 0);
    ck_assert_double_eq_tol(way.value, 4, 1e-12);
    ck_assert_double_eq_tol(way.error, 2, 1e-12);
    ck_assert_double_eq_tol(square.value, 20, 1e-12); // of 4 and 36
    ck_assert_double_eq_tol(square.error, 16, 1e-12);
    results_free(results);
    state_free(state);
}
END_TEST

// Twelve replicas of twelve trajectories each: errors over them are, within the noise of either,
// those that single replicas would tell: their ratio is known to a quarter.
START_TEST(errors_over_trajectories_are_those_over_replicas) {
    Plan *plan = pulled_plan(0.2, 20, 0.05, 0.4, 12);
    plan->ensemble.replicas = 12;
    const Estimate over_replicas = friction_of(plan);
    double square = 0;
    enum { SINGLE = 4 };
    for (uint64_t seed = 1; seed <= SINGLE; seed++) {
        plan = pulled_plan(0.2, 20, 0.05, 0.4, 12);
        plan->ensemble = (EnsemblePlan){.replicas = 1, .seed = 100 + seed};
        const Estimate single = friction_of(plan);
        square += single.error * single.error / SINGLE;
    }
    const double expected = sqrt(square / 12);
    printf("error over replicas %.4f, over trajectories %.4f\n", over_replicas.error, expected);
    ck_assert_double_eq_tol(over_replicas.error / expected, 1, 0.6);
}
END_TEST

// A tracer alone, whose trials of exact mean at f = 2 are worth half the bath's at first: within
// 4000 cycles its step is that which makes them one clock, so that it drifts at D F.
START_TEST(a_lone_tracer_finds_its_step_in_a_calibration) {
    Plan *plan = pulled_plan(1e-6, 10, 0.1, 10, 10);
    plan->system.particles = 2;
    plan->system.species[0].fraction = plan->system.species[1].fraction = 0.5;
    set_number(&plan->stages[1].dynamics.settings, &propagator_dynamic_monte_carlo.options,
               "calibration", 4000);
    plan->stages[1].drive.pull.clock = PULL_EXACT_FORCE;
    plan->stages[1].drive.pull.rest = 0;
    Results *results = simulate(plan);
    const Estimate friction = measured(results, "effective_friction"),
                   pace = measured_at(results, "tracer_pace", 7);
    printf("friction %.4f(%.4f), pace %.4f(%.4f)\n", friction.value, friction.error, pace.value,
           pace.error);
    ck_assert_double_eq_tol(pace.value, 1, 0.005); // 0.973 by the square root of the pace
    ck_assert_double_eq_tol(friction.value, 1, 0.005 + 3 * friction.error);
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("a pulled tracer");
    ADD_CASE(suite, friction_is_that_of_event_driven_dynamics, 2);
    ADD_CASE(suite, friction_is_that_of_another_event_driven_program, 2);
    ADD_CASE(suite, both_methods_feel_the_same_friction, 1);
    ADD_CASE(suite, nothing_is_in_front_without_a_force, 1);
    ADD_CASE(suite, a_strong_force_leaves_a_wake, 1);
    ADD_CASE(suite, scattered_rods_touch_as_often_as_evenly_spread_ones, 1);
    ADD_CASE(suite, a_lone_tracer_finds_its_step_in_a_calibration, 1);
    ADD_CASE(suite, a_tracer_is_not_looked_at_in_its_own_wake, 1);
    ADD_CASE(suite, a_single_replica_has_errors_over_its_trajectories, 1);
    ADD_CASE(suite, errors_over_trajectories_are_those_over_replicas, 1);
    return run_suite(suite) ? EXIT_FAILURE : EXIT_SUCCESS;
}
