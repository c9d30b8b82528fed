// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of balls as a machine: on every instruction set the bits of its plain twin, whatever
// the lists, the splitting and the moments of resuming; no overlap ever; what it refuses.
#include "dmc/balls.h"
#include "packing/packing.h"
#include "reference_chain.h"
#include "suite.h"

#include "base/memory.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 11, .replica = 2};
static const ChainSettings UNIFORM = {.stream = STREAM_TRIALS};
static const ChainSettings NORMAL = {.stream = STREAM_TRIALS, .gaussian = 1};

// A system, packed as hard balls; `exponent` makes them soft afterwards.
typedef struct Scene {
    const char *name;
    int dimension;
    int64_t particles;
    double density; // packing fraction
    double ratio;   // of the second diameter to the first; 1: one species
    double spread, exponent, aspect, step;
    const ChainSettings *settings;
} Scene;

static const Scene SCENES[] = {
    {"dense spheres", 3, 500, 0.50, 1, 0, 0, 1, 0.1, &UNIFORM},
    {"dense spheres, small steps", 3, 300, 0.52, 1, 0, 0, 1, 0.01, &UNIFORM},
    {"dilute spheres, large steps", 3, 200, 0.05, 1, 0, 0, 1, 1.2, &UNIFORM},
    {"normal steps", 3, 300, 0.40, 1, 0, 0, 1, 0.1, &NORMAL},
    {"long normal steps", 3, 300, 0.10, 1, 0, 0, 1, 0.8, &NORMAL},
    {"mixture", 3, 400, 0.45, 1.4, 0, 0, 1, 0.1, &UNIFORM},
    {"polydisperse", 3, 400, 0.45, 1, 0.1, 0, 1, 0.1, &UNIFORM},
    {"a long box", 3, 400, 0.40, 1, 0, 0, 2, 0.1, &UNIFORM},
    {"discs", 2, 400, 0.70, 1, 0, 0, 1, 0.1, &UNIFORM},
    {"mixture of discs", 2, 400, 0.72, 1.4, 0, 0, 1.5, 0.1, &UNIFORM},
    {"one sphere", 3, 1, 0.01, 1, 0, 0, 1, 0.3, &UNIFORM},
    {"two spheres", 3, 2, 0.02, 1, 0, 0, 1, 0.3, &UNIFORM},
    {"few spheres", 3, 4, 0.10, 1, 0, 0, 1, 0.3, &UNIFORM},
    {"soft spheres", 3, 300, 0.45, 1, 0, 36, 1, 0.1, &UNIFORM},
    {"dilute soft spheres, large steps", 3, 60, 0.10, 1, 0, 36, 1, 0.4, &UNIFORM},
    {"softer spheres", 3, 400, 0.25, 1, 0, 13, 1, 0.1, &UNIFORM},
    {"exponent 15", 3, 300, 0.40, 1, 0, 15, 1, 0.1, &UNIFORM},
    {"soft spheres that are nearly hard", 3, 200, 0.30, 1, 0, 501, 1, 0.05, &UNIFORM},
    {"one soft sphere", 3, 1, 0.01, 1, 0, 12, 1, 0.3, &UNIFORM},
    {"mixture of soft spheres", 3, 300, 0.40, 1.2, 0, 24, 1, 0.1, &UNIFORM},
    {"soft spheres in a long box", 3, 300, 0.45, 1, 0, 36, 2, 0.1, &UNIFORM},
    {"mixture of soft spheres in a long box", 3, 300, 0.40, 1.2, 0, 24, 1.3, 0.1, &NORMAL},
    {"soft spheres of many sizes", 3, 300, 0.40, 1, 0.1, 35, 1.2, 0.1, &UNIFORM},
};
enum { SCENES_COUNT = sizeof SCENES / sizeof *SCENES };

static System system_of(const Scene *scene) {
    System system = {.dimension = scene->dimension,
                     .particles = scene->particles,
                     .packing_fraction = scene->density,
                     .species_count = scene->ratio == 1 ? 1 : 2};
    if (scene->aspect != 1) {
        system.aspect = (OptionReals){.count = (size_t)scene->dimension};
        for (int a = 0; a < scene->dimension; a++) {
            system.aspect.values[a] = a == 0 ? scene->aspect : 1;
        }
    }
    for (size_t s = 0; s < system.species_count; s++) {
        system.species[s] = (Species){.shape = scene->dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE,
                                      .diameter = s == 0 ? 1 : scene->ratio,
                                      .mass = 1,
                                      .spread = scene->spread > 0 ? SPREAD_GAUSSIAN : SPREAD_NONE,
                                      .spread_width = scene->spread,
                                      .fraction = 1.0 / (double)system.species_count};
    }
    return system;
}

static State *state_of(const Scene *scene) {
    const System system = system_of(scene);
    State *state = NULL;
    PackingReport report;
    ck_assert_int_eq(packing_create(&state, &system, KEY, NULL, &report), OK);
    for (size_t s = 0; scene->exponent > 0 && s < system.species_count; s++) {
        state->system.species[s].shape = SHAPE_SOFT_SPHERE;
        state->system.species[s].exponent = scene->exponent;
    }
    return state;
}

static State *copy_of(const State *state) {
    State *copy = NULL;
    ck_assert_int_eq(state_create(&copy, &state->system), OK);
    memcpy(copy->diameter, state->diameter, state->count * sizeof(double));
    for (int a = 0; a < state->box.dimension; a++) {
        memcpy(copy->position[a], state->position[a], state->count * sizeof(double));
        memcpy(copy->image[a], state->image[a], state->count * sizeof(int32_t));
    }
    copy->step = state->step;
    return copy;
}

static void check_equal(const State *a, const State *b) {
    ck_assert_int_eq(a->step, b->step);
    for (int k = 0; k < a->box.dimension; k++) {
        ck_assert_mem_eq(a->position[k], b->position[k], a->count * sizeof(double));
        ck_assert_mem_eq(a->image[k], b->image[k], a->count * sizeof(int32_t));
    }
}

// The second species moves half as far.
static void set_steps(Chain *chain, const State *state, double step) {
    for (size_t s = 0; s < state->system.species_count; s++) {
        const double parallel = step / (double)(s + 1);
        chain_set_amplitude(chain, s, &(Amplitude){.parallel = parallel});
    }
}

static Chain *chain_for(const Scene *scene, int path, State *state) {
    Chain *chain = NULL;
    if (path == CPU_PATHS)
        ck_assert_int_eq(reference_chain.create(&chain, scene->settings, state, KEY), OK);
    else
        ck_assert_int_eq(balls_create_with((CpuPath)path, &chain, scene->settings, state, KEY), OK);
    set_steps(chain, state, scene->step);
    return chain;
}

static Tally run_scene(const Scene *scene, int path, State *state, int64_t trials) {
    Tally tally = {0};
    Chain *chain = chain_for(scene, path, state);
    ck_assert_int_eq(chain_run(chain, trials, &tally), OK);
    chain_publish(chain);
    chain_free(chain);
    return tally;
}

START_TEST(every_instruction_set_gives_the_bits_of_the_twin) {
    const Scene *scene = &SCENES[_i];
    const int64_t trials = scene->exponent > 0 ? 100000 : 400000;
    State *start = state_of(scene), *expected = copy_of(start);
    const Tally twin = run_scene(scene, CPU_PATHS, expected, trials);
    ck_assert_uint_gt(twin.moves[0].accepted, 1000);
    for (int path = 0; path <= (int)cpu_path(); path++) {
        State *found = copy_of(start);
        const Tally tally = run_scene(scene, path, found, trials);
        check_equal(found, expected);
        ck_assert_mem_eq(tally.moves, twin.moves, sizeof tally.moves);
        state_free(found);
    }
    state_free(start);
    state_free(expected);
}
END_TEST

START_TEST(splits_and_resumes_do_not_show) {
    const Scene *scene = &SCENES[_i];
    State *whole = state_of(scene), *split = copy_of(whole);
    const int path = (int)cpu_path();
    run_scene(scene, path, whole, 50000);
    run_scene(scene, path, split, 777); // published, and created anew
    Tally tally = {0};
    Chain *chain = chain_for(scene, path, split);
    ck_assert_int_eq(chain_run(chain, 1, &tally), OK);
    ck_assert_int_eq(chain_run(chain, 0, &tally), OK);
    ck_assert_int_eq(chain_run(chain, 10000, &tally), OK);
    chain_publish(chain);
    set_steps(chain, split, 0);
    set_steps(chain, split, scene->step);
    ck_assert_int_eq(chain_run(chain, 50000 - 10778, &tally), OK);
    chain_publish(chain);
    chain_free(chain);
    check_equal(split, whole);
    state_free(whole);
    state_free(split);
}
END_TEST

START_TEST(nothing_overlaps_after_ten_million_trials) {
    static const int hard[] = {0, 5, 8}; // of SCENES
    const Scene *scene = &SCENES[hard[_i]];
    State *state = state_of(scene);
    run_scene(scene, (int)cpu_path(), state, 10000000);
    double deepest;
    ck_assert_int_eq(state_deepest_overlap(state, 1e-12, &deepest, NULL), OK);
    ck_assert_double_le(deepest, 1e-12);
    ck_assert_int_eq(state_validate(state), OK);
    state_free(state);
}
END_TEST

// Pairs in contact to the last bit, all over the lattice: some of them rounding pushes together.
START_TEST(touching_pairs_are_parted_and_counted) {
    const Scene scene = {"pairs", 3, 400, 0.01, 1, 0, 0, 1, 0.1, &UNIFORM};
    const System system = system_of(&scene);
    State *state = NULL;
    Rng rng = rng_open(KEY, STREAM_PACKING, 0, 0);
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < state->count; i++) {
        const size_t pair = i / 2, at[3] = {pair % 6, pair / 6 % 6, pair / 36};
        const double gap = state->box.edge[0] / 6;
        const double z = 2 * rng_uniform(&rng) - 1, phi = 6.2831853 * rng_uniform(&rng);
        const double across = sqrt(1 - z * z);
        const double u[3] = {across * cos(phi), across * sin(phi), z};
        state->diameter[i] = 1;
        for (int a = 0; a < 3; a++) {
            state->position[a][i] =
                i % 2 == 0 ? ((double)at[a] + 0.5) * gap : state->position[a][i - 1] + u[a];
        }
    }
    const Tally tally = run_scene(&scene, (int)cpu_path(), state, 0);
    double deepest;
    ck_assert_int_eq(state_deepest_overlap(state, 1e-12, &deepest, NULL), OK);
    ck_assert_double_le(deepest, 1e-12);
    ck_assert_uint_gt(tally.corrected, 20);
    ck_assert_uint_lt(tally.corrected, 200);
    state_free(state);
}
END_TEST

START_TEST(overlaps_at_the_start_are_refused) {
    State *state = state_of(&SCENES[0]);
    Tally tally = {0};
    state->diameter[0] = 1.5;
    Chain *chain = chain_for(&SCENES[0], (int)cpu_path(), state);
    ck_assert_int_eq(chain_run(chain, 1, &tally), UNHEALTHY);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "overlap by"));
    chain_free(chain);
    state_free(state);
}
END_TEST

START_TEST(sizes_grow_until_something_would_overlap) {
    State *state = state_of(&SCENES[3]);
    Tally tally = {0};
    Chain *chain = chain_for(&SCENES[3], (int)cpu_path(), state);
    ck_assert(!chain_rescale(chain, 1.3));
    ck_assert(chain_rescale(chain, 0.5));
    ck_assert_int_eq(chain_run(chain, 300000, &tally), OK);
    ck_assert(!chain_rescale(chain, 1)); // forgotten where they were
    ck_assert(chain_rescale(chain, 0.49));
    ck_assert_int_eq(chain_run(chain, 1000, &tally), OK);
    chain_free(chain);
    state_free(state);
}
END_TEST

static void check_refused(const System *system, const char *why) {
    ck_assert_int_eq(chain_of_balls.check(system), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), why), "%s", status_sentence());
}

START_TEST(what_cannot_work_is_a_sentence) {
    System system = system_of(&SCENES[5]);
    ck_assert_int_eq(chain_of_balls.check(&system), OK);
    system.species[1].shape = SHAPE_SOFT_SPHERE;
    system.species[1].exponent = 12;
    check_refused(&system, "do not mix");
    system.species[0] = system.species[1];
    system.species[0].exponent = 36;
    check_refused(&system, "have one exponent");
    system.species[0].exponent = 2.5;
    check_refused(&system, "must be a whole number");
    system = system_of(&SCENES[0]);
    system.particles = 2;
    check_refused(&system, "take more particles");
    system = system_of(&SCENES[0]);
    system.species[0].shape = SHAPE_DISC;
    check_refused(&system, "lives in 2 dimensions");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("balls");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 120);
    tcase_add_loop_test(all, every_instruction_set_gives_the_bits_of_the_twin, 0, SCENES_COUNT);
    tcase_add_loop_test(all, splits_and_resumes_do_not_show, 0, SCENES_COUNT);
    tcase_add_loop_test(all, nothing_overlaps_after_ten_million_trials, 0, 3);
    tcase_add_test(all, touching_pairs_are_parted_and_counted);
    tcase_add_test(all, overlaps_at_the_start_are_refused);
    tcase_add_test(all, sizes_grow_until_something_would_overlap);
    tcase_add_test(all, what_cannot_work_is_a_sentence);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
