// SPDX-License-Identifier: GPL-3.0-or-later
// Event-driven dynamics between the moving images of Lees and Edwards: what must not matter does
// not (where the box begins, which way it flows, whole boxes of strain), the energy that the flow
// puts in is the work of the stress, nothing overlaps. Collision by collision the engine is held
// against its slow twin in test_twins.c; free particles in test_shear_motion.c.
#include "edbd/edbd.h"
#include "packing/packing.h"

#include "observe.h"
#include "suite.h"

#include <stdio.h>
#include <stdlib.h>

static const RngKey KEY = {.seed = 20261125, .replica = 3};
enum { LOG_SIZE = 1 << 14 };

static State *packed(int dimension, int64_t particles, double packing_fraction) {
    System system = system_of(dimension, particles, packing_fraction, 2);
    system.species[1].mass = 2;
    State *state = NULL;
    ck_assert_int_eq(packing_create(&state, &system, KEY, NULL, NULL), OK);
    for (size_t i = 0; i < state->count; i++) {
        Rng rng = rng_open(KEY, STREAM_VELOCITY, 0, i);
        for (int a = 0; a < dimension; a++)
            state->velocity[a][i] = rng_normal(&rng) / sqrt(state->mass[i]);
    }
    return state;
}

static State *copy_of(const State *state) {
    State *copy = new_state(&state->system);
    memcpy(copy->diameter, state->diameter, state->count * sizeof(double));
    for (int a = 0; a < 3; a++) {
        memcpy(copy->position[a], state->position[a], state->count * sizeof(double));
        memcpy(copy->velocity[a], state->velocity[a], state->count * sizeof(double));
        memcpy(copy->image[a], state->image[a], state->count * sizeof(int32_t));
    }
    copy->box = state->box;
    copy->step = state->step;
    return copy;
}

// Flight between the images for so many windows, without a thermostat unless `redraw`; `rate` is in
// sqrt(kT/m)/d.
static void fly(State *state, double rate, double window, int64_t windows, int redraw, Tally *tally,
                CollisionLog *log) {
    const EngineSettings settings = {
        .window = window, .windows_per_step = 1, .redraw = redraw, .stream = STREAM_VELOCITY};
    const Flow flow = {.rate = rate};
    const EngineFlow steady = {.flow = &flow, .step_time = window, .begun = state->step};
    Engine *engine = NULL;
    ck_assert_int_eq(engine_create(&engine, &settings, state, KEY), OK);
    ck_assert_int_eq(engine_shear(engine, &steady), OK);
    engine_record(engine, log);
    ck_assert_msg(engine_advance(engine, windows, tally) == OK, "%s", status_sentence());
    engine_free(engine);
}

static double deepest(const State *state) {
    double depth = 0;
    ck_assert_int_eq(state_deepest_overlap(state, 0, &depth, NULL), OK);
    return depth;
}

static void shift_image(State *state, size_t i, int axis, double by) {
    double *x = &state->position[axis][i];
    const double edge = state->box.edge[axis], to = *x + by, boxes = floor(to / edge);
    *x = to - boxes * edge;
    state->image[axis][i] += (int32_t)boxes;
}

static void check_same_log(const CollisionLog *one, const CollisionLog *other, double tolerance) {
    ck_assert_uint_gt(one->count, 200);
    ck_assert_uint_eq(one->count, other->count);
    for (size_t k = 0; k < one->count; k++) {
        ck_assert_uint_eq(one->records[k].low, other->records[k].low);
        ck_assert_uint_eq(one->records[k].high, other->records[k].high);
        ck_assert_double_eq_tol(one->records[k].time, other->records[k].time, tolerance);
    }
}

// Two systems that should fly alike, for as long as rounding has not grown.
typedef struct Pair {
    State *state[2];
    double rate[2];
    Tally tally[2];
} Pair;

static void fly_alike(Pair *pair, int64_t windows) {
    static CollisionRecord records[2][LOG_SIZE];
    CollisionLog log[2];
    for (int k = 0; k < 2; k++) {
        log[k] = (CollisionLog){.records = records[k], .capacity = LOG_SIZE};
        fly(pair->state[k], pair->rate[k], 0.01, windows, 0, &pair->tally[k], &log[k]);
    }
    check_same_log(&log[0], &log[1], 1e-7);
}

static void free_pair(Pair *pair) {
    for (int k = 0; k < 2; k++) state_free(pair->state[k]);
}

// In a mirror x and v_x are reversed, and the flow goes the other way: so does the shear stress.
START_TEST(a_flow_in_the_mirror_is_the_reversed_flow) {
    Pair pair = {.state = {packed(2 + _i, 100, 0.45)}, .rate = {0.4, -0.4}};
    pair.state[1] = copy_of(pair.state[0]);
    State *mirror = pair.state[1];
    for (size_t i = 0; i < mirror->count; i++) {
        mirror->position[0][i] = mirror->box.edge[0] - mirror->position[0][i];
        mirror->velocity[0][i] *= -1;
    }
    fly_alike(&pair, 100);
    const double(*one)[3] = pair.tally[0].exchange, (*other)[3] = pair.tally[1].exchange;
    ck_assert_double_eq_tol(one[0][1], -other[0][1], 1e-6);
    ck_assert_double_eq_tol(one[0][0], other[0][0], 1e-6);
    for (size_t i = 0; i < mirror->count; i++) {
        const double x = state_unfolded(pair.state[0], 0, i);
        ck_assert_double_eq_tol(mirror->box.edge[0] - x, state_unfolded(mirror, 0, i), 1e-6);
        ck_assert_double_eq_tol(state_unfolded(pair.state[0], 1, i), state_unfolded(mirror, 1, i),
                                1e-6);
    }
    free_pair(&pair);
}
END_TEST

// The same system cut elsewhere, seen from a frame in which the new y = 0 is at rest.
START_TEST(it_does_not_matter_where_the_box_begins) {
    static const double SHIFT = 3.7;
    Pair pair = {.state = {packed(2 + _i, 100, 0.45)}, .rate = {0.5, 0.5}};
    fly(pair.state[0], 0.5, 0.01, 130, 1, &(Tally){0}, NULL); // the box leans by then
    pair.state[1] = copy_of(pair.state[0]);
    State *moved = pair.state[1];
    for (size_t i = 0; i < moved->count; i++) {
        const int32_t before = moved->image[1][i];
        shift_image(moved, i, 1, SHIFT);
        const int32_t up = moved->image[1][i] - before;
        moved->image[0][i] -= (int32_t)(up * moved->box.turns);
        shift_image(moved, i, 0, -up * moved->box.offset);
        moved->velocity[0][i] += 0.5 * (SHIFT - up * moved->box.edge[1]);
    }
    double before[2][400];
    for (size_t i = 0; i < moved->count; i++) {
        for (int k = 0; k < 2; k++) before[k][i] = state_unfolded(pair.state[k], 0, i);
        ck_assert_double_eq_tol(before[0][i], before[1][i], 1e-9);
    }
    fly_alike(&pair, 100);
    for (size_t i = 0; i < moved->count; i++) {
        double way[2];
        for (int k = 0; k < 2; k++) way[k] = state_unfolded(pair.state[k], 0, i) - before[k][i];
        ck_assert_double_eq_tol(way[1] - way[0], 0.5 * SHIFT * 1.0, 1e-6);
    }
    free_pair(&pair);
}
END_TEST

// Images displaced by whole boxes are where they were: not a bit changes.
START_TEST(whole_boxes_of_strain_change_nothing) {
    Pair pair = {.state = {packed(2 + _i, 100, 0.3)}, .rate = {-0.7, -0.7}};
    fly(pair.state[0], 0.5, 0.01, 130, 1, &(Tally){0}, NULL);
    pair.state[1] = copy_of(pair.state[0]);
    State *sheared = pair.state[1];
    sheared->box.turns += 5;
    for (size_t i = 0; i < sheared->count; i++)
        sheared->image[0][i] -= 5 * sheared->image[1][i]; // the same place
    for (int k = 0; k < 2; k++) fly(pair.state[k], -0.7, 0.02, 15000, 1, &pair.tally[k], NULL);
    ck_assert_uint_gt(pair.tally[0].collisions, 10000);
    const State *plain = pair.state[0];
    int64_t crossings = 0;
    for (int a = 0; a < plain->box.dimension; a++) {
        ck_assert_mem_eq(plain->position[a], sheared->position[a], plain->count * sizeof(double));
        ck_assert_mem_eq(plain->velocity[a], sheared->velocity[a], plain->count * sizeof(double));
    }
    for (size_t i = 0; i < plain->count; i++) {
        crossings += abs(plain->image[1][i]);
        ck_assert_double_eq_tol(state_unfolded(plain, 0, i), state_unfolded(sheared, 0, i), 1e-9);
    }
    ck_assert_int_ge(crossings, 10);
    free_pair(&pair);
}
END_TEST

// sum m c_x c_y of velocities relative to the flow.
static double kinetic_stress(const State *state) {
    double sum = 0;
    for (size_t i = 0; i < state->count; i++)
        sum += state->mass[i] * state_peculiar_velocity(state, 0, i) * state->velocity[1][i];
    return sum;
}

static double peculiar_energy(const State *state) {
    double sum = 0;
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            const double c = state_peculiar_velocity(state, a, i);
            sum += state->mass[i] * c * c / 2;
        }
    }
    return sum;
}

// Without a thermostat, dE/dt = rate V sigma_xy, sigma_xy V = -(sum m c_x c_y + the momentum that
// collisions carry along y): exactly, for every trajectory. The first part is summed over ends of
// short windows, between which collisions change it: hence the tolerance.
START_TEST(the_energy_put_in_is_the_work_of_the_stress) {
    static const double RATE = 0.3, WINDOW = 2e-4;
    State *state = packed(2 + _i, 200, _i ? 0.4 : 0.6);
    Tally tally = {0};
    for (size_t i = 0; i < state->count; i++) state->velocity[0][i] += RATE * state->position[1][i];
    state->shear_rate = RATE;
    const double before = peculiar_energy(state);
    double kinetic = 0;
    for (int k = 0; k < 5000; k++) {
        kinetic += WINDOW * kinetic_stress(state) / 2;
        fly(state, RATE, WINDOW, 1, 0, &tally, NULL);
        kinetic += WINDOW * kinetic_stress(state) / 2;
    }
    const double put_in = peculiar_energy(state) - before;
    const double work = -RATE * (kinetic + tally.exchange[0][1]);
    printf("energy put in %g, work of the stress %g (collisions alone %g)\n", put_in, work,
           -RATE * tally.exchange[0][1]);
    ck_assert_double_gt(put_in, 10);
    ck_assert_double_eq_tol(put_in, work, 2e-3 * put_in);
    state_free(state);
}
END_TEST

// Dense, fast, in boxes of all proportions, forwards and back, pruned lists and not.
START_TEST(sheared_states_never_overlap) {
    static const double windows[] = {0.01, 0.001, 0.0002}, rates[] = {2, -5, 0.5};
    State *state = packed(2 + _i / 3, 150, _i / 3 ? 0.52 : 0.76);
    Tally tally = {0};
    for (int k = 0; k < 20; k++) {
        const double window = windows[_i % 3], rate = rates[k % 3] * (k % 2 ? 1 : -0.4);
        fly(state, rate, window, 300, 1, &tally, NULL);
        ck_assert_double_le(deepest(state), 1e-12);
        ck_assert_int_eq(state_validate(state), OK);
    }
    ck_assert_uint_gt(tally.collisions, 5000);
    ck_assert_double_le(tally.deepest_contact, 1e-9);
    state_free(state);
}
END_TEST

// What comes after shear: the flow is taken out, and the box stays as it leans.
START_TEST(a_newtonian_stage_begins_without_the_flow) {
    State *state = packed(2, 200, 0.6);
    fly(state, 0.9, 0.01, 137, 1, &(Tally){0}, NULL);
    const double strain = box_strain(&state->box);
    Settings settings = settings_of(&propagator_newtonian.options);
    Propagator *propagator = NULL;
    Tally tally = {0};
    ck_assert_int_eq(propagator_newtonian.create(&propagator, &settings, state, KEY), OK);
    ck_assert_int_eq(propagator_newtonian.advance(propagator, 500, &tally), OK);
    propagator_newtonian.free(propagator);
    double momentum = 0;
    for (size_t i = 0; i < state->count; i++) momentum += state->mass[i] * state->velocity[0][i];
    ck_assert_double_eq_tol(momentum, 0, 1e-9);
    ck_assert_double_eq_tol(peculiar_energy(state), (double)state->count, 1e-9);
    ck_assert_double_eq(box_strain(&state->box), strain);
    ck_assert(state->shear_rate == 0 && deepest(state) <= 1e-12);
    state_free(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("Lees and Edwards");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 120);
    tcase_add_loop_test(all, a_flow_in_the_mirror_is_the_reversed_flow, 0, 2);
    tcase_add_loop_test(all, it_does_not_matter_where_the_box_begins, 0, 2);
    tcase_add_loop_test(all, whole_boxes_of_strain_change_nothing, 0, 2);
    tcase_add_loop_test(all, the_energy_put_in_is_the_work_of_the_stress, 0, 2);
    tcase_add_loop_test(all, sheared_states_never_overlap, 0, 6);
    tcase_add_test(all, a_newtonian_stage_begins_without_the_flow);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
