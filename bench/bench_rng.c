// SPDX-License-Identifier: GPL-3.0-or-later
// What the thermostat's random numbers cost: nanoseconds of user CPU time per particle, 1000
// particles per call, medians of five, for each instruction set this processor has.
#include "bench.h"

#include "base/memory.h"
#include "rng/rng.h"

enum { PARTICLES = 1000, CALLS = 20000, REPEATS = 5 };

static double nanoseconds(CpuPath path, int components, const uint32_t *ids,
                          double *const normals[3]) {
    double costs[REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double start = bench_user_seconds();
        for (uint64_t step = 0; step < CALLS; step++) {
            rng_normals_with(path, (RngKey){.seed = 1}, STREAM_VELOCITY, step, ids, PARTICLES,
                             components, normals);
        }
        costs[repeat] = 1e9 * (bench_user_seconds() - start) / ((double)CALLS * PARTICLES);
    }
    return bench_median(costs, REPEATS);
}

int main(void) {
    uint32_t *ids = memory_new(PARTICLES, sizeof *ids);
    double *normals[3] = {memory_new(PARTICLES, sizeof(double)),
                          memory_new(PARTICLES, sizeof(double)),
                          memory_new(PARTICLES, sizeof(double))};
    if (!ids || !normals[0] || !normals[1] || !normals[2]) return NO_MEMORY;
    for (uint32_t i = 0; i < PARTICLES; i++) ids[i] = i * 7919 % PARTICLES;
    for (int path = 0; path <= (int)cpu_path(); path++) {
        for (int components = 2; components <= 3; components++) {
            char name[64];
            snprintf(name, sizeof name, "normals %dD %s", components, cpu_path_name((CpuPath)path));
            bench_result(name, nanoseconds((CpuPath)path, components, ids, normals),
                         "ns per particle");
        }
    }
    for (int a = 0; a < 3; a++) memory_free(normals[a]);
    memory_free(ids);
    return 0;
}
