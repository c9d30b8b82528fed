// SPDX-License-Identifier: GPL-3.0-or-later
// What the thermostat's random numbers cost: nanoseconds of user CPU time per particle, 1000
// particles per call, medians of five, for each instruction set this processor has.
#include "base/memory.h"
#include "rng/rng.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

enum { PARTICLES = 1000, CALLS = 20000, REPEATS = 5 };

static double user_seconds(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double nanoseconds(CpuPath path, int components, const uint32_t *ids,
                          double *const normals[3]) {
    double costs[REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double start = user_seconds();
        for (uint64_t step = 0; step < CALLS; step++) {
            rng_normals_with(path, (RngKey){.seed = 1}, STREAM_VELOCITY, step, ids, PARTICLES,
                             components, normals);
        }
        costs[repeat] = 1e9 * (user_seconds() - start) / ((double)CALLS * PARTICLES);
    }
    qsort(costs, REPEATS, sizeof *costs, ascending);
    return costs[REPEATS / 2];
}

int main(void) {
    uint32_t *ids = memory_new(PARTICLES, sizeof *ids);
    double *normals[3] = {memory_new(PARTICLES, sizeof(double)),
                          memory_new(PARTICLES, sizeof(double)),
                          memory_new(PARTICLES, sizeof(double))};
    if (!ids || !normals[0] || !normals[1] || !normals[2]) return NO_MEMORY;
    for (uint32_t i = 0; i < PARTICLES; i++) ids[i] = i * 7919 % PARTICLES;
    printf("normal numbers, ns per particle\n%-10s %8s %8s\n", "path", "2D", "3D");
    for (int path = 0; path <= (int)cpu_path(); path++) {
        printf("%-10s %8.2f %8.2f\n", cpu_path_name((CpuPath)path),
               nanoseconds((CpuPath)path, 2, ids, normals),
               nanoseconds((CpuPath)path, 3, ids, normals));
    }
    for (int a = 0; a < 3; a++) memory_free(normals[a]);
    memory_free(ids);
    return 0;
}
