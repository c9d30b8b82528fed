// SPDX-License-Identifier: GPL-3.0-or-later
// What the theory costs: structures, glass transitions with their exponents, correlators over
// twenty decades, and the memory kernel beside the plain double sum over wave numbers that it
// replaces. User CPU seconds, medians of five (three where one takes a second).
#include "bench.h"

#include "base/memory.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "oz/oz.h"

#include <math.h>

enum { REPEATS = 5 };

static const Mixture DISCS = {2, 1, {1}, {1}}, SPHERES = {3, 1, {1}, {1}};
static const Mixture BINARY = {2, 2, {5.0 / 7, 1}, {0.5, 0.5}};

static void fail(void) {
    fprintf(stderr, "bench_theory: %s\n", status_sentence());
    exit(1);
}

static double critical_seconds(const CriticalSearch *search) {
    CriticalPoint *point = NULL;
    const double start = bench_user_seconds();
    if (critical_find(&point, search) != OK) fail();
    const double seconds = bench_user_seconds() - start;
    critical_free(point);
    return seconds;
}

static void bench_critical(const char *name, const CriticalSearch *search) {
    double seconds[REPEATS];
    for (int i = 0; i < REPEATS; i++) seconds[i] = critical_seconds(search);
    bench_result(name, bench_median(seconds, REPEATS), "s");
}

// Twenty decades, from 1e-8 to 1e12, a thousandth below the transition.
static double correlator_seconds(const Grid *grid, const Structure *structure) {
    Correlators *correlators = NULL;
    const CorrelatorSettings settings = {.diffusion = {1}};
    const double start = bench_user_seconds();
    if (correlators_create(&correlators, grid, structure, &settings) != OK) fail();
    while (correlators_time(correlators) < 1e12)
        if (correlators_advance(correlators) != OK) fail();
    const double seconds = bench_user_seconds() - start;
    correlators_free(correlators);
    return seconds;
}

static void bench_correlators(const char *name, size_t count, double last) {
    Grid *grid = NULL;
    Oz *oz = NULL;
    const Structure *structure = NULL;
    double seconds[REPEATS];
    if (grid_create(&grid, 3, count, last) != OK) fail();
    if (oz_create(&oz, CLOSURE_PERCUS_YEVICK, &SPHERES, grid->wave_number, count) != OK) fail();
    if (oz_solve(oz, 0.5158 * (1 - 1e-3), &structure) != OK) fail();
    for (int i = 0; i < REPEATS; i++) seconds[i] = correlator_seconds(grid, structure);
    bench_result(name, bench_median(seconds, REPEATS), "s");
    oz_free(oz);
    grid_free(grid);
}

// Bengtzelius' sum for equal spheres on q = (i + 1/2) dq: all triangles of wave numbers.
static double double_sum_seconds(size_t count, size_t calls) {
    double *f = memory_new(count, sizeof *f), *c = memory_new(count, sizeof *c), total = 0;
    const double spacing = 40.0 / (double)count;
    if (!f || !c) fail();
    for (size_t i = 0; i < count; i++) {
        const double q = ((double)i + 0.5) * spacing;
        f[i] = exp(-0.01 * q * q);
        c[i] = -30 * exp(-0.03 * q * q);
    }
    const double start = bench_user_seconds();
    for (size_t call = 0; call < calls; call++) {
        for (size_t i = 0; i < count; i++) {
            const double q = (double)i + 0.5;
            double sum = 0;
            for (size_t k = 0; k < count; k++) {
                const size_t low = i > k ? i - k : k - i;
                for (size_t p = low; p <= i + k && p < count; p++) {
                    const double k1 = (double)k + 0.5, p1 = (double)p + 0.5;
                    const double vertex =
                        (q * q + k1 * k1 - p1 * p1) * c[k] + (q * q - k1 * k1 + p1 * p1) * c[p];
                    sum += k1 * p1 * vertex * vertex * f[k] * f[p];
                }
            }
            total += sum;
        }
        f[0] += 1e-300 * total; // so that no call can be left out
    }
    const double seconds = bench_user_seconds() - start;
    memory_free(f);
    memory_free(c);
    return seconds / (double)calls;
}

// The transforms' cost per kernel, from the count of kernels that correlators took.
static double kernel_seconds(size_t count) {
    Grid *grid = NULL;
    Oz *oz = NULL;
    Correlators *correlators = NULL;
    const Structure *structure = NULL;
    const CorrelatorSettings settings = {.diffusion = {1}, .block = 32};
    if (grid_create(&grid, 3, count, 40) != OK) fail();
    if (oz_create(&oz, CLOSURE_PERCUS_YEVICK, &SPHERES, grid->wave_number, count) != OK) fail();
    if (oz_solve(oz, 0.515, &structure) != OK) fail();
    if (correlators_create(&correlators, grid, structure, &settings) != OK) fail();
    const double start = bench_user_seconds();
    while (correlators_time(correlators) < 1e6)
        if (correlators_advance(correlators) != OK) fail();
    const double seconds = bench_user_seconds() - start;
    const double kernels = (double)correlators_evaluations(correlators);
    correlators_free(correlators);
    oz_free(oz);
    grid_free(grid);
    return seconds / kernels;
}

int main(void) {
    bench_critical("mct transition discs 203 to 40",
                   &(CriticalSearch){DISCS, CLOSURE_PERCUS_YEVICK, 203, 40, 0.6, 0.74});
    bench_critical("mct transition discs 305 to 59.84",
                   &(CriticalSearch){DISCS, CLOSURE_PERCUS_YEVICK, 305, 59.84, 0.6, 0.74});
    bench_critical("mct transition binary discs 203 to 40",
                   &(CriticalSearch){BINARY, CLOSURE_PERCUS_YEVICK, 203, 40, 0.6, 0.74});
    bench_critical("mct transition binary discs 305 to 59.84",
                   &(CriticalSearch){BINARY, CLOSURE_PERCUS_YEVICK, 305, 59.84, 0.6, 0.74});
    bench_correlators("mct twenty decades spheres 100 to 40", 100, 40);
    bench_correlators("mct twenty decades spheres 300 to 60", 300, 60);
    bench_result("mct kernel and history spheres 100", 1e6 * kernel_seconds(100), "us");
    bench_result("mct double sum spheres 100", 1e6 * double_sum_seconds(100, 50), "us");
    bench_result("mct kernel and history spheres 300", 1e6 * kernel_seconds(300), "us");
    bench_result("mct double sum spheres 300", 1e6 * double_sum_seconds(300, 3), "us");
    return 0;
}
