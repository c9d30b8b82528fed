// SPDX-License-Identifier: GPL-3.0-or-later
// What a trial move of bodies with an axis costs, translation and rotation together: trials per CPU
// second of one core for spherocylinders L = 5 and platelets, for each instruction set this
// processor has, and as ratios to the plain chain of the tests (every body against every other, one
// after the other). Also what packing costs. Medians of five, steps those of dynamic Monte Carlo.
#include "bench.h"
#include "bodies_scenes.h"
#include "reference_bodies.h"

#include "base/cpu.h"
#include "dmc/amplitude.h"
#include "packing/packing.h"

#include <string.h>

enum { REPEATS = 5 };
static const RngKey KEY = {.seed = 1};
static const ChainSettings SETTINGS = {.stream = STREAM_TRIALS, .rotation = ROTATION_MIXED};
static const double SETTLE_TRIALS = 1e6, TRIALS = 6e5, REFERENCE_TRIALS = 2e4;

static void stop_if(Status status) {
    if (status == OK) return;
    fprintf(stderr, "bench_dmc_bodies: %s\n", status_sentence());
    exit(status);
}

static Amplitude amplitude_for(const State *state, double step) {
    const Diffusion diffusion = species_diffusion(&state->system.species[0]);
    return amplitude_matched(step, &diffusion, &SETTINGS);
}

static double trials_per_second(State *state, double step, double trials) {
    Chain *chain = NULL;
    Tally tally = {0};
    const Amplitude amplitude = amplitude_for(state, step);
    stop_if(chain_create(&chain, &SETTINGS, state, KEY));
    chain_set_amplitude(chain, 0, &amplitude);
    stop_if(chain_run(chain, (int64_t)trials / 10, &tally));
    const double begin = bench_user_seconds();
    stop_if(chain_run(chain, (int64_t)trials, &tally));
    const double seconds = bench_user_seconds() - begin;
    chain_publish(chain);
    chain_free(chain);
    return trials / seconds;
}

static double plain_trials_per_second(State *state, double step) {
    ReferenceBodies *reference = NULL;
    Tally tally = {0};
    const Amplitude amplitude = amplitude_for(state, step);
    stop_if(reference_bodies_create(&reference, &SETTINGS, state, KEY));
    reference_bodies_set_amplitude(reference, 0, &amplitude);
    const double begin = bench_user_seconds();
    reference_bodies_run(reference, (int64_t)REFERENCE_TRIALS, &tally);
    const double seconds = bench_user_seconds() - begin;
    reference_bodies_free(reference);
    return REFERENCE_TRIALS / seconds;
}

static State *settled(const System *system, const char *scene) {
    State *state = NULL;
    char name[64];
    const double begin = bench_user_seconds();
    stop_if(packing_create(&state, system, KEY, NULL, NULL));
    snprintf(name, sizeof name, "packing %s", scene);
    bench_result(name, bench_user_seconds() - begin, "s");
    trials_per_second(state, 0.05, SETTLE_TRIALS);
    return state;
}

// All instruction sets and the plain chain in turns, so that a busy moment meets all of them.
static void compare(State *state, const char *scene, double step) {
    const int paths = (int)cpu_path() + 1;
    double speeds[CPU_PATHS + 1][REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (int path = 0; path < paths; path++) {
            setenv("PERRIN_CPU", cpu_path_name((CpuPath)path), 1);
            speeds[path][repeat] = trials_per_second(state, step, TRIALS);
        }
        unsetenv("PERRIN_CPU");
        speeds[CPU_PATHS][repeat] = plain_trials_per_second(state, step);
    }
    char name[64];
    const double plain = bench_median(speeds[CPU_PATHS], REPEATS);
    for (int path = paths - 1; path >= 0; path--) {
        const double median = bench_median(speeds[path], REPEATS);
        const char *of_path = cpu_path_name((CpuPath)path);
        snprintf(name, sizeof name, "dmc %s step %g %s", scene, step, of_path);
        bench_result(name, median, "trials per second");
        snprintf(name, sizeof name, "dmc %s step %g %s over plain", scene, step, of_path);
        bench_result(name, median / plain, "times faster");
    }
    snprintf(name, sizeof name, "dmc %s step %g plain", scene, step);
    bench_result(name, plain, "trials per second");
}

int main(void) {
    System rods = bodies_system(SHAPE_SPHEROCYLINDER, 5, 1000, 0);
    rods.packing_fraction = 0.38;
    State *state = settled(&rods, "rods L = 5 0.38");
    compare(state, "rods L = 5 0.38", 0.1);
    compare(state, "rods L = 5 0.38", 0.3);
    state_free(state);
    for (int density = 2; density <= 4; density += 2) {
        const System platelets = bodies_system(SHAPE_PLATELET, 0, 500, density);
        char scene[32];
        snprintf(scene, sizeof scene, "platelets rho* = %d", density);
        state = settled(&platelets, scene);
        compare(state, scene, 0.05);
        compare(state, scene, 0.2);
        state_free(state);
    }
    return 0;
}
