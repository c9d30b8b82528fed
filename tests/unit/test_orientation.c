// SPDX-License-Identifier: GPL-3.0-or-later
// Observers of body axes on distributions whose order is known, and on free rotors that walk in
// this file, step by step, by exact rules.
#include "observe.h"
#include "suite.h"

#include "base/constants.h"

static const RngKey KEY = {.seed = 20261125, .replica = 5};
static const double SIGMAS = 5; // two-sided p = 6e-7

static Clock rotor_clock(double tick, int64_t ticks) {
    return (Clock){
        .tick = tick, .ticks = ticks, .ticks_per_step = 1, .unit = "d^2/D0", .stage = "quiescent"};
}

// Makes the configuration of a tick, from that of the tick before.
typedef void (*Mover)(State *state, int64_t tick);

static Results *watched(const ObservableKind *kind, State *state, const Clock *clock, Mover mover) {
    const Settings settings = settings_of(&kind->options);
    const Tally none = {0};
    ck_assert_int_eq(kind->check(&settings, &state->system, clock), OK);
    Observer *observer = new_observer(kind, &settings, state, clock);
    int64_t wanted = kind->next(observer, -1);
    for (int64_t tick = 0; tick <= clock->ticks; tick++) {
        mover(state, tick);
        if (tick != wanted) continue;
        ck_assert_int_eq(kind->see(observer, tick, state, &none), OK);
        wanted = kind->next(observer, tick);
    }
    Results *results = written(observer, state);
    kind->free(observer);
    return results;
}

static double found(const Results *results, const char *quantity) {
    return scalar_of(results, "quiescent", quantity);
}

static void point_at_random(State *state, int64_t tick) {
    scatter(state, KEY, (uint64_t)tick);
}

static void point_along_y(State *state, int64_t tick) {
    for (size_t i = 0; i < state->count; i++) {
        const double u[3] = {0, (tick + (int64_t)i) % 2 ? 1 : -1, 0};
        set_axis(state, i, u);
    }
}

START_TEST(aligned_axes_have_order_one_whichever_end_is_up) {
    const System system = oriented_system(101, 1);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(0.5, 100);
    Results *results = watched(&observable_nematic_order, state, &clock, point_along_y);
    ck_assert_double_eq_tol(found(results, "nematic_order"), 1, 1e-14);
    ck_assert_double_eq_tol(found(results, "nematic_order_middle"), 1, 1e-14);
    ck_assert_double_eq_tol(found(results, "squared_nematic_order"), 1, 1e-14);
    const ResultSeries *director = series_of(results, "quiescent", "director");
    ck_assert_uint_eq(director->size, 3);
    ck_assert_double_eq_tol(director->values[0], 0, 1e-14);
    ck_assert_double_eq_tol(director->values[1], 1, 1e-14);
    results_free(results);
    state_free(state);
}
END_TEST

// For many axes Q is a Gaussian tensor, of which <largest eigenvalue> sqrt(N) is
// sqrt(2/5) (9/4)/sqrt(pi); <(2/3) tr Q^2> = 1/N, of which the pairs i != j have nothing.
START_TEST(axes_without_order_have_the_bias_of_their_number_and_no_other) {
    enum { AXES = 500, LOOKS = 1000 };
    const System system = oriented_system(AXES, 1);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(1, LOOKS);
    Results *results = watched(&observable_nematic_order, state, &clock, point_at_random);
    const double bias = sqrt(0.4) * 2.25 / sqrt(PI);
    ck_assert_double_eq_tol(bias, 0.803, 5e-4); // as the results say
    // Spread of an eigenvalue in one look: below that of a component, sqrt(1/5N).
    const double error = sqrt(0.2 / AXES / LOOKS);
    ck_assert_double_eq_tol(found(results, "nematic_order"), bias / sqrt(AXES), SIGMAS * error);
    ck_assert_double_lt(SIGMAS * error, 0.1 * bias / sqrt(AXES));
    ck_assert_double_eq_tol(found(results, "nematic_order_middle"), 0, SIGMAS * error);
    // Five independent components: the relative spread of their sum of squares is sqrt(2/5).
    ck_assert_double_eq_tol(found(results, "squared_nematic_order"), 0,
                            SIGMAS * sqrt(0.4 / LOOKS) / AXES);
    results_free(results);
    state_free(state);
}
END_TEST

static const double FIELD = 4; // of Maier and Saupe: density exp(FIELD cos^2) over the sphere
static const double TILT[3] = {0.6, 0, 0.8};

static void set_around(State *state, size_t i, const double axis[3], double cosine, double turn) {
    const double across[3] = {axis[1], axis[2], axis[0]}; // any vector that is not along the axis
    double p[3], q[3], along = 0, length = 0;
    for (int a = 0; a < 3; a++) along += across[a] * axis[a];
    for (int a = 0; a < 3; a++) p[a] = across[a] - along * axis[a];
    for (int a = 0; a < 3; a++) length += p[a] * p[a];
    for (int a = 0; a < 3; a++) p[a] /= sqrt(length);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        q[a] = axis[b] * p[c] - axis[c] * p[b];
    }
    const double sine = sqrt(1 - cosine * cosine);
    double u[3];
    for (int a = 0; a < 3; a++) {
        u[a] = cosine * axis[a] + sine * (cos(2 * PI * turn) * p[a] + sin(2 * PI * turn) * q[a]);
    }
    set_axis(state, i, u);
}

static void point_in_field(State *state, int64_t tick) {
    Rng rng = rng_open(KEY, STREAM_PACKING, (uint64_t)tick, 1);
    for (size_t i = 0; i < state->count; i++) {
        double cosine;
        do {
            cosine = 2 * rng_uniform(&rng) - 1;
        } while (rng_uniform(&rng) > exp(FIELD * (cosine * cosine - 1)));
        set_around(state, i, TILT, cosine, rng_uniform(&rng));
    }
}

static double order_in_field(void) {
    enum { POINTS = 20000 };
    double sum = 0, weights = 0;
    for (int k = 0; k < POINTS; k++) {
        const double cosine = (k + 0.5) / POINTS, weight = exp(FIELD * cosine * cosine);
        sum += weight * (3 * cosine * cosine - 1) / 2;
        weights += weight;
    }
    return sum / weights;
}

START_TEST(axes_in_a_field_have_the_order_of_its_quadrature) {
    enum { AXES = 1000, LOOKS = 200 };
    const System system = oriented_system(AXES, 1);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(1, LOOKS);
    Results *results = watched(&observable_nematic_order, state, &clock, point_in_field);
    const double order = order_in_field(); // 0.61
    // P2 of an axis spreads by less than 0.5; the largest eigenvalue is above by O(1/N).
    const double error = 0.5 / sqrt((double)AXES * LOOKS);
    ck_assert_double_eq_tol(found(results, "nematic_order"), order, SIGMAS * error + 1.0 / AXES);
    ck_assert_double_eq_tol(found(results, "squared_nematic_order"), order * order,
                            SIGMAS * 2 * order * error);
    ck_assert_double_lt(SIGMAS * 2 * error, 0.03 * order);
    const double *director = series_of(results, "quiescent", "director")->values;
    for (int a = 0; a < 3; a++) ck_assert_double_eq_tol(director[a], TILT[a], 0.02);
    results_free(results);
    state_free(state);
}
END_TEST

// Platelets along y, rods along x: half and half they are Q = diag(1/4, 1/4, -1/2).
static void cross(State *state, int64_t tick) {
    (void)tick;
    for (size_t i = 0; i < state->count; i++) {
        const double u[3] = {state->species_of[i] == 1, state->species_of[i] == 0, 0};
        set_axis(state, i, u);
    }
}

START_TEST(every_species_has_its_own_order) {
    const System system = oriented_system(200, 2);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(1, 50);
    Results *results = watched(&observable_nematic_order, state, &clock, cross);
    ck_assert_double_eq_tol(found(results, "nematic_order_plate"), 1, 1e-14);
    ck_assert_double_eq_tol(found(results, "nematic_order_rod"), 1, 1e-14);
    ck_assert_double_eq_tol(found(results, "nematic_order"), 0.25, 1e-14);
    const double *director = series_of(results, "quiescent", "director")->values;
    ck_assert_double_eq_tol(director[1], 1, 1e-14); // plates: y
    ck_assert_double_eq_tol(director[3], 1, 1e-14); // rods: x
    results_free(results);
    state_free(state);
}
END_TEST

static void align_later(State *state, int64_t tick) {
    if (tick <= 400)
        point_at_random(state, tick);
    else
        point_along_y(state, tick);
}

START_TEST(order_that_appears_later_is_seen_in_its_blocks) {
    const System system = oriented_system(400, 1);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(0.5, 1000);
    Results *results = watched(&observable_nematic_order, state, &clock, align_later);
    const ResultSeries *series = series_of(results, "quiescent", "nematic_order");
    const ResultAxis *time = &series->axis[2];
    ck_assert_uint_eq(time->count, 50);
    ck_assert_double_eq_tol(time->values[0], 0.5 * 10.5, 1e-12); // looks 1 to 20
    ck_assert_double_eq_tol(time->values[49], 0.5 * 990.5, 1e-12);
    for (size_t b = 0; b < 50; b++) {
        const double largest = series->values[b];
        if (b < 20)
            ck_assert_double_eq_tol(largest, 0.803 / sqrt(400), 0.01);
        else
            ck_assert_double_eq_tol(largest, 1, 1e-13);
    }
    ck_assert_double_eq_tol(found(results, "nematic_order"), 0.6 + 0.4 * 0.803 / 20, 0.002);
    results_free(results);
    state_free(state);
}
END_TEST

// A free platelet, times in d^2/D0 with D0 = 1/6 kT/(eta d): the coefficients below are those of
// Jabbari-Farouji and Trizac, eqs 13 and 14, over that.
static const double PARALLEL = 0.75, PERPENDICULAR = 1.125, ROTATIONAL = 4.5;
enum { WALK_TICKS = 3000, WALKERS = 400, ORIGINS = 3 * 64 };
static const double TICK = 0.004;

// A walk on the sphere with the <P1> and <P2> of rotational diffusion over any span: turns by one
// angle about a random axis, made with a probability; the two numbers have two equations.
static void turn(State *state, size_t i, double span, Rng *rng) {
    const double p1 = exp(-2 * ROTATIONAL * span), p2 = exp(-6 * ROTATIONAL * span);
    const double cosine = 2 * (1 - p2) / (3 * (1 - p1)) - 1, share = (1 - p1) / (1 - cosine);
    if (rng_uniform(rng) >= share) return;
    const double axis[3] = {state->orientation[0][i], state->orientation[1][i],
                            state->orientation[2][i]};
    set_around(state, i, axis, cosine, rng_uniform(rng));
}

static void translate(State *state, size_t i, double span, Rng *rng) {
    const double along = sqrt(2 * PARALLEL * span), across = sqrt(2 * PERPENDICULAR * span);
    const double g[3] = {rng_normal(rng), rng_normal(rng), rng_normal(rng)};
    double axial = 0;
    for (int a = 0; a < 3; a++) axial += g[a] * state->orientation[a][i];
    for (int a = 0; a < 3; a++) {
        const double u = state->orientation[a][i], edge = state->box.edge[a];
        const double x = state->position[a][i] + across * g[a] + (along - across) * axial * u;
        state->image[a][i] += (int32_t)floor(x / edge);
        state->position[a][i] = x - floor(x / edge) * edge;
    }
}

// Half a turn before and after the translation: the orientation of the middle of the tick counts.
static void walk(State *state, int64_t tick) {
    if (tick == 0) {
        point_at_random(state, 0);
        return;
    }
    Rng rng = rng_open(KEY, STREAM_VELOCITY, (uint64_t)tick, 0);
    for (size_t i = 0; i < state->count; i++) {
        turn(state, i, TICK / 2, &rng);
        translate(state, i, TICK, &rng);
        turn(state, i, TICK / 2, &rng);
    }
}

// Of a mean over all origins of a function with unit variance that relaxes at this rate, or over
// windows as long as the lag if these are longer.
static double walk_error(double rate, double lag) {
    const double independent = WALK_TICKS * TICK / (2 / rate + lag);
    return 1 / sqrt(WALKERS * fmax(independent, 1));
}

START_TEST(free_rotors_forget_as_debye_says) {
    const System system = oriented_system(WALKERS, 1);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(TICK, WALK_TICKS);
    Results *results = watched(&observable_orientation_correlation, state, &clock, walk);
    const ResultSeries *series = series_of(results, "quiescent", "orientation_correlation");
    const ResultAxis *time = &series->axis[2];
    ck_assert_str_eq(series->axis[1].labels[0], "P1");
    for (size_t k = 0; k < time->count; k++) {
        const double t = time->values[k];
        const double p1 = series->values[k], p2 = series->values[time->count + k];
        ck_assert_double_eq_tol(p1, exp(-2 * ROTATIONAL * t),
                                SIGMAS * sqrt(1 / 3.0) * walk_error(2 * ROTATIONAL, t));
        ck_assert_double_eq_tol(p2, exp(-6 * ROTATIONAL * t),
                                SIGMAS * sqrt(1 / 5.0) * walk_error(6 * ROTATIONAL, t));
    }
    results_free(results);
    state_free(state);
}
END_TEST

// <(dr.u(0))^2> = 2 D0 t + (4/3)(D_par - D_perp)(1 - exp(-6 D_rot t))/(6 D_rot), and at
// 0.01 and 1 eta d^3/kT (0.01/6 and 1/6 of our unit) the values that this has in d^2.
static double along_axis(double t) {
    const double mean = (PARALLEL + 2 * PERPENDICULAR) / 3, rate = 6 * ROTATIONAL;
    return 2 * mean * t + 4.0 / 3 * (PARALLEL - PERPENDICULAR) * (1 - exp(-rate * t)) / rate;
}

START_TEST(free_bodies_diffuse_along_where_they_pointed) {
    ck_assert_double_eq_tol(along_axis(0.01 / 6), 0.0025184719, 1e-9);
    ck_assert_double_eq_tol(along_axis(1 / 6.0), 0.315020537, 1e-8);
    const System system = oriented_system(WALKERS, 1);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(TICK, WALK_TICKS);
    Results *results = watched(&observable_directional_displacement, state, &clock, walk);
    const ResultSeries *series = series_of(results, "quiescent", "directional_displacement");
    const ResultAxis *time = &series->axis[2];
    const size_t lags = time->count;
    for (size_t k = 0; k < lags; k++) {
        const double t = time->values[k];
        const double axial = along_axis(t), across = (6 * t - axial) / 2;
        const double windows = fmin(WALK_TICKS * TICK / t, ORIGINS);
        const double error = SIGMAS * sqrt(2 / (WALKERS * windows)) + 2e-4;
        const double *at = series->values + k;
        ck_assert_double_eq_tol(at[0] / axial, 1, error);
        ck_assert_double_eq_tol(at[lags] / across, 1, error);
        ck_assert_double_eq_tol(at[2 * lags] / (2 * t), 1, error); // no order: no direction
        ck_assert_double_eq_tol(at[3 * lags] / (2 * t), 1, error);
        ck_assert_double_eq_tol(at[0] + 2 * at[lags], at[2 * lags] + 2 * at[3 * lags], 1e-12 * t);
    }
    ck_assert_double_lt(series->values[0] / (2 * TICK), 0.8); // the short time knows D_par
    results_free(results);
    state_free(state);
}
END_TEST

// Rods along z fly along (1, 2, 3).
static void fly(State *state, int64_t tick) {
    for (size_t i = 0; i < state->count; i++) {
        const double up[3] = {0, 0, i % 2 ? 1 : -1};
        set_axis(state, i, up);
        for (int a = 0; a < 3; a++) {
            const double x = 0.01 * (a + 1) * (double)tick, edge = state->box.edge[a];
            state->image[a][i] = (int32_t)floor(x / edge);
            state->position[a][i] = x - floor(x / edge) * edge;
        }
    }
}

START_TEST(flight_is_along_and_across_the_director) {
    const System system = oriented_system(50, 2);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(1, 900);
    Results *results = watched(&observable_directional_displacement, state, &clock, fly);
    const ResultSeries *series = series_of(results, "quiescent", "directional_displacement");
    const size_t lags = series->axis[2].count;
    ck_assert_uint_eq(series->axis[0].count, 3);
    for (size_t i = 0; i < 12; i++) { // species and directions
        const double t = series->axis[2].values[lags - 1];
        const double expected = 1e-4 * t * t * (i % 2 ? 2.5 : 9);
        ck_assert_double_eq_tol(series->values[i * lags + lags - 1] / expected, 1, 1e-11);
    }
    results_free(results);
    state_free(state);
}
END_TEST

static void turn_over(State *state, int64_t tick) {
    for (size_t i = 0; i < state->count; i++) {
        const double u[3] = {0, 0, state->species_of[i] == 1 && tick % 2 ? -1 : 1};
        set_axis(state, i, u);
    }
}

START_TEST(a_body_turned_over_is_seen_by_the_first_polynomial_only) {
    const System system = oriented_system(40, 2);
    State *state = new_state(&system);
    const Clock clock = rotor_clock(1, 100);
    Results *results = watched(&observable_orientation_correlation, state, &clock, turn_over);
    const ResultSeries *series = series_of(results, "quiescent", "orientation_correlation");
    const size_t lags = series->axis[2].count;
    ck_assert_uint_eq(series->axis[0].count, 3);
    ck_assert_double_eq(series->axis[2].values[0], 1);              // a tick: rods have turned over
    static const double expected[3][2] = {{1, 1}, {-1, 1}, {0, 1}}; // plates, rods, all
    for (size_t s = 0; s < 3; s++) {
        for (size_t p = 0; p < 2; p++) {
            ck_assert_double_eq_tol(series->values[(s * 2 + p) * lags], expected[s][p], 1e-14);
        }
    }
    results_free(results);
    state_free(state);
}
END_TEST

static void expect_refusal(const ObservableKind *kind, const System *system, const char *words) {
    const Clock clock = rotor_clock(1, 100);
    const Settings settings = settings_of(&kind->options);
    ck_assert_int_eq(kind->check(&settings, system, &clock), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), words) != NULL, "'%s'", status_sentence());
    ck_assert_msg(strstr(status_sentence(), kind->name) != NULL, "'%s'", status_sentence());
}

START_TEST(bodies_without_an_axis_have_no_orientation) {
    const System spheres = system_of(3, 100, 0.3, 2);
    expect_refusal(&observable_nematic_order, &spheres, "no species has a body axis");
    expect_refusal(&observable_orientation_correlation, &spheres, "no species has a body axis");
    expect_refusal(&observable_directional_displacement, &spheres, "no species has a body axis");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orientation");
    TCase *c = tcase_create("orientation");
    tcase_set_timeout(c, 120);
    tcase_add_test(c, aligned_axes_have_order_one_whichever_end_is_up);
    tcase_add_test(c, axes_without_order_have_the_bias_of_their_number_and_no_other);
    tcase_add_test(c, axes_in_a_field_have_the_order_of_its_quadrature);
    tcase_add_test(c, every_species_has_its_own_order);
    tcase_add_test(c, order_that_appears_later_is_seen_in_its_blocks);
    tcase_add_test(c, free_rotors_forget_as_debye_says);
    tcase_add_test(c, free_bodies_diffuse_along_where_they_pointed);
    tcase_add_test(c, flight_is_along_and_across_the_director);
    tcase_add_test(c, a_body_turned_over_is_seen_by_the_first_polynomial_only);
    tcase_add_test(c, bodies_without_an_axis_have_no_orientation);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
