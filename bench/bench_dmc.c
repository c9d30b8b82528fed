// SPDX-License-Identifier: GPL-3.0-or-later
// What a trial move costs: trials per CPU second of one core for hard and soft spheres at packing
// fraction 0.50, for each instruction set this processor has, and as ratios to the plain chain of
// the tests (linked cells, one neighbour after the other), measured in turns with them. Medians of
// five.
#include "bench.h"
#include "reference_chain.h"

#include "base/cpu.h"
#include "packing/packing.h"

#include <string.h>

enum { REPEATS = 5, PARTICLES = 1024 };
static const RngKey KEY = {.seed = 1};
static const double SETTLE_TRIALS = 2e7, TRIALS = 4e6, REFERENCE_TRIALS = 2e5;

static void stop_if(Status status) {
    if (status == OK) return;
    fprintf(stderr, "bench_dmc: %s\n", status_sentence());
    exit(status);
}

static double trials_per_second(const ChainKind *kind, State *state, double step, double trials) {
    static const ChainSettings settings = {.stream = STREAM_TRIALS};
    Chain *chain = NULL;
    Tally tally = {0};
    stop_if(kind->create(&chain, &settings, state, KEY));
    chain_set_amplitude(chain, 0, &(Amplitude){.parallel = step});
    stop_if(chain_run(chain, (int64_t)trials / 10, &tally));
    const double begin = bench_user_seconds();
    stop_if(chain_run(chain, (int64_t)trials, &tally));
    const double seconds = bench_user_seconds() - begin;
    chain_publish(chain);
    chain_free(chain);
    return trials / seconds;
}

// Packed as hard spheres; `exponent` > 0 makes them soft.
static State *settled(double exponent) {
    System system = {
        .dimension = 3, .particles = PARTICLES, .packing_fraction = 0.50, .species_count = 1};
    system.species[0] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 1};
    State *state = NULL;
    PackingReport packing;
    stop_if(packing_create(&state, &system, KEY, NULL, &packing));
    if (exponent > 0) {
        state->system.species[0].shape = SHAPE_SOFT_SPHERE;
        state->system.species[0].exponent = exponent;
    }
    trials_per_second(&chain_of_balls, state, 0.1, SETTLE_TRIALS);
    return state;
}

// All instruction sets and the plain chain in turns, so that a busy moment meets all of them.
static void compare(const char *scene, double exponent, double step) {
    State *state = settled(exponent);
    const int paths = (int)cpu_path() + 1;
    double speeds[CPU_PATHS + 1][REPEATS], median[CPU_PATHS + 1];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (int path = 0; path < paths; path++) {
            setenv("PERRIN_CPU", cpu_path_name((CpuPath)path), 1);
            speeds[path][repeat] = trials_per_second(&chain_of_balls, state, step, TRIALS);
        }
        unsetenv("PERRIN_CPU");
        speeds[CPU_PATHS][repeat] =
            trials_per_second(&reference_chain, state, step, REFERENCE_TRIALS);
    }
    char name[64];
    median[CPU_PATHS] = bench_median(speeds[CPU_PATHS], REPEATS);
    for (int path = paths - 1; path >= 0; path--) {
        median[path] = bench_median(speeds[path], REPEATS);
        snprintf(name, sizeof name, "dmc %s %s", scene, cpu_path_name((CpuPath)path));
        bench_result(name, median[path], "trials per second");
        snprintf(name, sizeof name, "dmc %s %s over plain", scene, cpu_path_name((CpuPath)path));
        bench_result(name, median[path] / median[CPU_PATHS], "times faster");
    }
    snprintf(name, sizeof name, "dmc %s plain", scene);
    bench_result(name, median[CPU_PATHS], "trials per second");
    state_free(state);
}

int main(void) {
    compare("spheres 0.50 step 0.1", 0, 0.1);
    compare("spheres 0.50 step 0.01", 0, 0.01);
    compare("soft r^-36 0.50 step 0.07", 36, 0.07);
    return 0;
}
