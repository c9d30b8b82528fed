// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacements of event-driven Brownian dynamics against exact results for free
// particles and isolated pairs, the short-time law of dense suspensions, and values that another
// program computed (event-driven and Monte Carlo, N = 432 to 1024, interval to zero).
#include "simulate.h"

#include "base/constants.h"
#include "packing/packing.h"

static const double SIGMAS = 4;

// <r^2>/(2 dim D0 t) at the lag nearest to `time`.
static Estimate reduced(const Results *results, double time) {
    const ResultSeries *msd = series_of(results, "measured", "mean_squared_displacement");
    const size_t lags = msd->axis[2].count, dimension = msd->axis[1].count - 1;
    size_t best = 0;
    for (size_t k = 0; k < lags; k++) {
        if (fabs(msd->axis[2].values[k] - time) < fabs(msd->axis[2].values[best] - time)) best = k;
    }
    ck_assert_double_eq_tol(msd->axis[2].values[best] / time, 1, 1e-6);
    Estimate e = measured_at(results, "mean_squared_displacement",
                             msd->size - lags + best); // the last row is the total
    e.value /= 2 * (double)dimension * time;
    e.error /= 2 * (double)dimension * time;
    return e;
}

static Settings *observe_displacement(Plan *plan, double first, double last, int per_decade) {
    Settings *settings = observe(plan, &observable_mean_squared_displacement);
    const OptionTable *options = &observable_mean_squared_displacement.options;
    set_number(settings, options, "times.first", first);
    set_number(settings, options, "times.last", last);
    set_number(settings, options, "times.per_decade", per_decade);
    return settings;
}

// So dilute that hardly anything collides: <dx^2> = t^2 kT/m inside an interval, 2 D0 t after n of
// them, D0 = interval/2.
START_TEST(free_particles_fly_and_then_diffuse) {
    enum { SUBSTEPS = 8 };
    const double interval = 0.08, step = interval * interval / 2; // in d^2/D0
    Plan *plan = new_plan(system_of(2, 400, 1e-4, 1), interval, 1, 500 * step, 8);
    set_number(&plan->stages[1].dynamics.settings, &propagator_event_driven.options, "substeps",
               SUBSTEPS);
    observe_displacement(plan, 0, 50 * step, 20);
    Results *results = simulate(plan);
    for (int k = 1; k <= SUBSTEPS; k *= 2) {
        const double fraction = (double)k / SUBSTEPS;
        expect_within("flight: <r^2>/(4 D0 t) over t/interval", reduced(results, fraction * step),
                      fraction, 0, SIGMAS, 0.01);
    }
    expect_within("diffusion: <r^2>/(4 D0 t) at 10 intervals", reduced(results, 10 * step), 1, 0,
                  SIGMAS, 0.01);
    expect_within("diffusion: <r^2>/(4 D0 t) at 50 intervals", reduced(results, 50 * step), 1, 0,
                  SIGMAS, 0.02);
    results_free(results);
}
END_TEST

START_TEST(heavy_particles_diffuse_slowly) {
    const double interval = 0.05, step = interval * interval / 2;
    System system = system_of(2, 400, 1e-4, 2);
    system.species[1].mass = 4;
    Plan *plan = new_plan(system, interval, 1, 500 * step, 8);
    observe_displacement(plan, 0, 20 * step, 10);
    Results *results = simulate(plan);
    expect_within("D of a light particle over D0", measured(results, "short_time_diffusion_small"),
                  1, 0, SIGMAS, 0.01);
    expect_within("D of one four times as heavy", measured(results, "short_time_diffusion_big"),
                  0.25, 0, SIGMAS, 0.01);
    results_free(results);
}
END_TEST

// Pairs far from each other, the two of each touching at the start.
static State *new_pairs(int dimension, int64_t pairs) {
    const double room = 12; // d
    const System system = {.dimension = dimension,
                           .particles = 2 * pairs,
                           .number_density = 2 / pow(room, dimension),
                           .species_count = 1,
                           .species = {{.name = "ball",
                                        .shape = dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE,
                                        .diameter = 1,
                                        .mass = 1,
                                        .fraction = 1}}};
    State *state = new_state(&system);
    const size_t along = (size_t)rint(state->box.edge[0] / room);
    for (size_t p = 0; p < (size_t)pairs; p++) {
        const size_t place[3] = {p % along, p / along % along, p / (along * along)};
        for (int a = 0; a < dimension; a++) {
            const double middle = ((double)place[a] + 0.5) * room;
            for (size_t k = 0; k < 2; k++) {
                state->position[a][2 * p + k] = middle + (a == 0 ? (double)k : 0);
            }
        }
    }
    return state;
}

static double mean_square_separation(const State *state) {
    double sum = 0;
    for (size_t i = 0; i < state->count; i += 2) {
        for (int a = 0; a < state->box.dimension; a++) {
            const double x = state_unfolded(state, a, i + 1) - state_unfolded(state, a, i);
            sum += x * x;
        }
    }
    return sum / ((double)state->count / 2);
}

// Two hard particles released in contact: the diffusion equation with a reflecting sphere.
// In 3D <r^2> = 1 + 12 t + 2 (1 - exp(2 t) erfc(sqrt(2 t))); in 2D by numerical inversion of the
// Laplace transform.
START_TEST(a_pair_released_in_contact_separates_as_the_diffusion_equation_says) {
    static const double times[2] = {0.001, 0.1};
    static const double exact[2][2] = {{1.10697431, 2.64849419}, {1.10905597, 2.91242346}};
    enum { RUNS = 24 };
    const int dimension = 2 + _i / 2;
    const double time = times[_i % 2], interval = _i % 2 ? 0.02 : 0.002;
    const int64_t steps = (int64_t)rint(time / (interval * interval / 2));
    Settings settings = settings_of(&propagator_event_driven.options);
    set_number(&settings, &propagator_event_driven.options, "thermostat_interval", interval);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, RUNS), OK);
    for (size_t run = 0; run < RUNS; run++) {
        const RngKey key = {.seed = 20261125, .replica = run};
        State *state = new_pairs(dimension, dimension == 2 ? 1024 : 1000);
        Propagator *propagator = NULL;
        Tally tally = {0};
        ck_assert_int_eq(propagator_event_driven.create(&propagator, &settings, state, key), OK);
        const int64_t ticks = steps * propagator_event_driven.ticks_per_step(&settings);
        ck_assert_int_eq(propagator_event_driven.advance(propagator, ticks, &tally), OK);
        results_put_scalar(results, "measured", "gain", "", "", run,
                           mean_square_separation(state) - 1);
        propagator_event_driven.free(propagator);
        state_free(state);
    }
    char line[80];
    snprintf(line, sizeof line, "pair at contact, %dD: <r^2> - 1 at t D0 = %g", dimension, time);
    expect_within(line, measured(results, "gain"), exact[_i / 2][_i % 2] - 1, 0, SIGMAS, 0.01);
    results_free(results);
}
END_TEST

START_TEST(short_time_diffusion_falls_with_the_root_of_time) {
    // <r^2>/(6 D0 t) = 1 - c phi g(d) sqrt(D0 t)/d + ..., c = (32/3)/sqrt(2 pi), at any density.
    const double phi = 0.3, interval = 0.002, step = interval * interval / 2;
    const double slope = 32.0 / 3 / sqrt(2 * PI) * phi * 2.4868;
    Plan *plan = new_plan(system_of(3, 400, phi, 1), interval, 10, 40000 * step, 8);
    observe_displacement(plan, 0, 400 * step, 10);
    Results *results = simulate(plan);
    // Two times, so that the next order, linear in t, drops out.
    static const char *const name = "slope";
    const ResultSeries *msd = series_of(results, "measured", "mean_squared_displacement");
    const size_t lags = msd->axis[2].count;
    for (size_t r = 0; r < results->replicas; r++) {
        double loss[2] = {0, 0}, root[2] = {0, 0};
        for (size_t k = 0; k < lags; k++) {
            const double t = msd->axis[2].values[k];
            const int which = fabs(t / (100 * step) - 1) < 0.03   ? 0
                              : fabs(t / (400 * step) - 1) < 0.03 ? 1
                                                                  : -1;
            if (which < 0) continue;
            loss[which] = 1 - msd->values[r * msd->size + 3 * lags + k] / (6 * t);
            root[which] = sqrt(t);
        }
        // loss/root = slope + b root
        const double s0 = loss[0] / root[0], s1 = loss[1] / root[1];
        results_put_scalar(results, "measured", name, "", "", r,
                           s0 - (s1 - s0) * root[0] / (root[1] - root[0]));
    }
    expect_within("slope of <r^2>/(6 D0 t) in sqrt(t), spheres 0.30", measured(results, name),
                  slope, 0.01 * slope, SIGMAS, 0.06);
    results_free(results);
}
END_TEST

// Three intervals fall on one curve in units of D0, and it is the one that others found.
static const struct {
    const char *what;
    int dimension;
    double packing_fraction, time, value, error; // at that time
    double length;                               // of the stage, in those times
    double intervals[3];                         // that divide the time
} known[] = {
    {"discs 0.20: <r^2>/(4 D0 t) at 0.405",
     2,
     0.20,
     0.405,
     0.7823,
     0.0012,
     10,
     {0.09, 0.045, 0.03}},
    {"discs 0.40: <r^2>/(4 D0 t) at 0.06", 2, 0.40, 0.06, 0.6923, 0.0006, 15, {0.04, 0.02, 0.01}},
    {"spheres 0.30: <r^2>/(6 D0 t) at 0.2", 3, 0.30, 0.2, 0.5318, 0.0008, 10, {0.04, 0.02, 0.01}},
    {"spheres 0.50: <r^2>/(6 D0 t) at 0.01",
     3,
     0.50,
     0.01,
     0.3919,
     0.0006,
     40,
     {0.02, 0.01, 0.005}},
    {"spheres 0.50: <r^2>/(6 D0 t) at 0.25", 3, 0.50, 0.25, 0.1301, 0.001, 25, {0.05, 0.025, 0.02}},
};

START_TEST(three_intervals_collapse_onto_the_known_displacement) {
    const int which = _i / 3;
    const double interval = known[which].intervals[_i % 3], time = known[which].time;
    Plan *plan = new_plan(system_of(known[which].dimension, 600, known[which].packing_fraction, 1),
                          interval, 10, known[which].length * time, 6);
    Settings *settings = observe_displacement(plan, time / 2, time, 1);
    set_number(settings, &observable_mean_squared_displacement.options, "origins", 25);
    Results *results = simulate(plan);
    char line[100];
    snprintf(line, sizeof line, "%s, interval %g", known[which].what, interval);
    // Whether their centre of mass was held is not told: it diffuses with D0/N.
    const double error = hypot(known[which].error, 1.0 / 600);
    expect_within(line, reduced(results, time), known[which].value, error, SIGMAS, 0.02);
    results_free(results);
}
END_TEST

START_TEST(spheres_diffuse_at_long_times_as_in_the_literature) {
    Plan *plan = new_plan(system_of(3, 432, 0.3, 1), 0.03, 10, 16, 6);
    observe_displacement(plan, 0, 5, 10);
    Results *results = simulate(plan);
    expect_within("D_L/D0, spheres 0.30", measured(results, "long_time_diffusion"), 0.478, 0.003,
                  SIGMAS, 0.03);
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("diffusion");
    ADD_CASE(suite, free_particles_fly_and_then_diffuse, 1);
    ADD_CASE(suite, heavy_particles_diffuse_slowly, 1);
    ADD_CASE(suite, a_pair_released_in_contact_separates_as_the_diffusion_equation_says, 4);
    ADD_CASE(suite, short_time_diffusion_falls_with_the_root_of_time, 1);
    ADD_CASE(suite, three_intervals_collapse_onto_the_known_displacement,
             3 * sizeof known / sizeof *known);
    ADD_CASE(suite, spheres_diffuse_at_long_times_as_in_the_literature, 1);
    return run_suite(suite);
}
