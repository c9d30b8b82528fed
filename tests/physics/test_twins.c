// SPDX-License-Identifier: GPL-3.0-or-later
// The event-driven engine against its slow twin, collision by collision: both begin each step from
// the same state, so that chaos does not part them, and must find the same pairs in the same order
// at the same times, and end in the same places.
#include "reference_engine.h"
#include "suite.h"

#include "edbd/edbd.h"
#include "packing/packing.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_SIZE = 1 << 14 };
static const double SAME = 1e-9; // of times and places: rounding, grown within one step

typedef struct Case {
    int dimension, particles;
    double packing_fraction;
    double window;
    int windows_per_step;
    bool redraw, all_pairs;
    int steps;
    uint64_t collisions_least;
    Flow flow;
    EnginePull pull;
    int64_t start;
} Case;

// Equal numbers of diameters 1 and 1.4, masses 1 and 2.
static System mixture_of(const Case *test) {
    System system = {.dimension = test->dimension,
                     .particles = test->particles,
                     .packing_fraction = test->packing_fraction,
                     .start = test->start,
                     .species_count = 2};
    const Species small = {.name = "small",
                           .shape = test->dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE,
                           .diameter = 1,
                           .mass = 1,
                           .fraction = 0.5};
    system.species[0] = system.species[1] = small;
    system.species[1].name[0] = 'b';
    system.species[1].diameter = 1.4;
    system.species[1].mass = 2;
    return system;
}

static void copy(State *to, const State *from) {
    memcpy(to->diameter, from->diameter, from->count * sizeof(double));
    for (int a = 0; a < 3; a++) {
        memcpy(to->position[a], from->position[a], from->count * sizeof(double));
        memcpy(to->velocity[a], from->velocity[a], from->count * sizeof(double));
        memcpy(to->image[a], from->image[a], from->count * sizeof(int32_t));
    }
    to->box = from->box;
    to->step = from->step;
}

static void draw_velocities(State *state, RngKey key) {
    Rng rng = rng_open(key, STREAM_VELOCITY, 0, 0);
    for (size_t i = 0; i < state->count; i++) {
        for (int a = 0; a < state->box.dimension; a++) {
            state->velocity[a][i] = rng_normal(&rng) / sqrt(state->mass[i]);
        }
    }
}

static void check_same_places(const State *one, const State *other) {
    for (size_t i = 0; i < one->count; i++) {
        for (int a = 0; a < one->box.dimension; a++) {
            ck_assert_double_eq_tol(state_unfolded(one, a, i), state_unfolded(other, a, i), SAME);
            ck_assert_double_eq_tol(one->velocity[a][i], other->velocity[a][i], 100 * SAME);
        }
    }
    ck_assert_int_eq(one->step, other->step);
    ck_assert_double_eq_tol(box_strain(&one->box), box_strain(&other->box), SAME);
}

static void check_same_collisions(const CollisionLog *fast, const ReferenceLog *slow,
                                  double window) {
    ck_assert_uint_eq(fast->count, slow->count);
    ck_assert_uint_le(fast->count, LOG_SIZE);
    for (size_t k = 0; k < fast->count; k++) {
        const CollisionRecord *one = &fast->records[k];
        const ReferenceCollision *other = &slow->records[k];
        ck_assert_uint_eq(one->low, other->low);
        ck_assert_uint_eq(one->high, other->high);
        ck_assert_int_eq(one->step, other->step);
        ck_assert_double_eq_tol((double)one->window * window + one->time, other->time, SAME);
    }
}

static void check_same_tally(const Tally *fast, const Tally *slow, uint64_t collisions_least) {
    ck_assert_uint_eq(fast->collisions, slow->collisions);
    ck_assert_uint_ge(fast->collisions, collisions_least);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            ck_assert_double_eq_tol(fast->exchange[a][b], slow->exchange[a][b],
                                    1e-7 * (double)fast->collisions);
        }
    }
}

static void check_twins(const Case *test, uint64_t seed) {
    static CollisionRecord fast_records[LOG_SIZE];
    static ReferenceCollision slow_records[LOG_SIZE];
    const RngKey key = {.seed = seed};
    const double interval = test->window * test->windows_per_step;
    const EngineSettings settings = {.window = test->window,
                                     .windows_per_step = test->windows_per_step,
                                     .redraw = test->redraw,
                                     .stream = STREAM_VELOCITY};
    const System system = mixture_of(test);
    State *state = NULL, *twin = NULL;
    Engine *engine = NULL;
    Reference *reference = NULL;
    Tally fast = {0}, slow = {0};
    ck_assert_int_eq(packing_create(&state, &system, key, NULL, NULL), OK);
    draw_velocities(state, key);
    ck_assert_int_eq(state_create(&twin, &system), OK);
    copy(twin, state);
    ck_assert_int_eq(engine_create(&engine, &settings, state, key), OK);
    const EngineFlow flow = {.flow = &test->flow, .step_time = 1}; // its unit is a step, then
    if (flow_fastest(&test->flow) > 0) ck_assert_int_eq(engine_shear(engine, &flow), OK);
    const EnginePull *pull = &test->pull;
    if (pull->period > 0) engine_pull(engine, pull);
    ck_assert_int_eq(
        reference_create(&reference, twin, key, interval, test->redraw, test->all_pairs), OK);
    for (int step = 0; step < test->steps; step++) {
        CollisionLog fast_log = {.records = fast_records, .capacity = LOG_SIZE};
        ReferenceLog slow_log = {.records = slow_records, .capacity = LOG_SIZE};
        copy(twin, state);
        reference_shear(reference, flow_rate(&test->flow, step, step + 1) / interval);
        const bool pulled = pull->period > 0 && step % pull->period < pull->on;
        reference_pull(reference, pull->particle, pull->axis, pulled ? pull->drift : 0);
        engine_record(engine, &fast_log);
        reference_record(reference, &slow_log);
        ck_assert_int_eq(engine_advance(engine, test->windows_per_step, &fast), OK);
        reference_advance(reference, 1, &slow);
        check_same_collisions(&fast_log, &slow_log, test->window);
        check_same_places(state, twin);
    }
    check_same_tally(&fast, &slow, test->collisions_least);
    reference_free(reference);
    engine_free(engine);
    state_free(twin);
    state_free(state);
}

START_TEST(brownian_discs_collide_as_their_twins) {
    const Case dense = {2, 64, 0.75, 0.01, 1, true, false, 10000, 50000};
    const Case long_interval = {2, 64, 0.5, 0.01, 10, true, false, 3000, 40000};
    const Case tiny = {2, 16, 0.6, 0.01, 1, true, true, 3000, 1500};
    check_twins(&dense, 1);
    check_twins(&long_interval, 2);
    for (uint64_t seed = 3; seed < 8; seed++) check_twins(&tiny, seed);
}
END_TEST

// So many that memory is fetched ahead, from a crystal, which is there at once.
START_TEST(many_discs_collide_as_their_twins) {
    const Case many = {.dimension = 2,
                       .particles = 36000,
                       .packing_fraction = 0.55,
                       .window = 0.01,
                       .windows_per_step = 10,
                       .redraw = true,
                       .steps = 10,
                       .collisions_least = 50000,
                       .start = START_CRYSTAL};
    check_twins(&many, 31);
}
END_TEST

START_TEST(brownian_spheres_collide_as_their_twins) {
    const Case dense = {3, 64, 0.5, 0.01, 1, true, false, 1500, 5000};
    const Case dilute = {3, 64, 0.1, 0.01, 5, true, false, 1500, 1000};
    check_twins(&dense, 11);
    check_twins(&dilute, 12);
}
END_TEST

START_TEST(newtonian_particles_collide_as_their_twins) {
    const Case discs = {2, 64, 0.7, 0.01, 1, false, false, 4000, 20000};
    const Case spheres = {3, 64, 0.4, 0.01, 1, false, true, 300, 1000};
    check_twins(&discs, 21);
    check_twins(&spheres, 22);
}
END_TEST

// Strains per step of a hundredth of those between which images pass each other.
START_TEST(sheared_particles_collide_as_their_twins) {
    Case discs = {2, 64, 0.7, 0.01, 1, true, true, 2000, 10000, .flow.rate = 0.004};
    Case back = {2, 36, 0.6, 0.01, 10, true, true, 300, 2000, .flow.rate = -0.03};
    Case wave = {2, 64, 0.7, 0.01, 2, true, true, 1000, 5000};
    Case spheres = {3, 64, 0.45, 0.01, 1, true, true, 250, 500, .flow.rate = 0.02};
    wave.flow.oscillation.amplitude = 1.5;
    wave.flow.oscillation.frequency = 0.005;
    check_twins(&discs, 31);
    check_twins(&back, 32);
    check_twins(&wave, 33);
    check_twins(&spheres, 34);
}
END_TEST

// A tenth of a thermal velocity to five of them, with rests, through lists of every kind.
START_TEST(a_pulled_particle_collides_as_its_twin) {
    const Case discs = {2,    64,    0.7,  0.01,  1,
                        true, false, 3000, 10000, .pull = {17, 1, 3, 0, INT64_MAX, INT64_MAX}};
    const Case rests = {2, 36, 0.6, 0.01, 10, true, true, 300, 2000, .pull = {30, 0, 1, 0, 7, 4}};
    const Case spheres = {3,    64,    0.45, 0.01, 1,
                          true, false, 1500, 2000, .pull = {40, 2, 5, 0, INT64_MAX, INT64_MAX}};
    const Case short_windows = {3,    64,    0.45, 0.001, 1,
                                true, false, 3000, 500,   .pull = {63, 0, 0.1, 0, 100, 99}};
    check_twins(&discs, 41);
    check_twins(&rests, 42);
    check_twins(&spheres, 43);
    check_twins(&short_windows, 44);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("twins");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 120);
    tcase_add_test(all, brownian_discs_collide_as_their_twins);
    tcase_add_test(all, many_discs_collide_as_their_twins);
    tcase_add_test(all, brownian_spheres_collide_as_their_twins);
    tcase_add_test(all, newtonian_particles_collide_as_their_twins);
    tcase_add_test(all, sheared_particles_collide_as_their_twins);
    tcase_add_test(all, a_pulled_particle_collides_as_its_twin);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
