// SPDX-License-Identifier: GPL-3.0-or-later
// What the theory costs: structures, glass transitions with their exponents, correlators over
// twenty decades, and the memory kernel beside the plain double sum over wave numbers that it
// replaces. User CPU seconds, medians of five (three where one takes a second).
#include "bench.h"

#include "base/memory.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "mct/model.h"
#include "mct/sheared.h"
#include "oz/oz.h"
#include "schematic/driven.h"
#include "schematic/steady.h"

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

// Form factors of the shape that those of a mixture have at the transition.
static double form_like(const Structure *structure, size_t pair, size_t m, double q) {
    return structure->factor[pair * structure->count + m] * exp(-0.01 * q * q);
}

static const Structure *binary_structure(Oz **oz, const double *q, size_t count) {
    const Structure *structure = NULL;
    if (oz_create(oz, CLOSURE_PERCUS_YEVICK, &BINARY, q, count) != OK) fail();
    if (oz_solve(*oz, 0.685, &structure) != OK) fail();
    return structure;
}

static double binary_kernel_seconds(size_t count, size_t calls) {
    Grid *grid = NULL;
    Oz *oz = NULL;
    Model *model = NULL;
    if (grid_create(&grid, 2, count, 40) != OK) fail();
    const Structure *structure = binary_structure(&oz, grid->wave_number, count);
    if (model_create(&model, grid, structure) != OK) fail();
    double *form = memory_new(model->size, sizeof *form);
    double *memory = memory_new(model->size, sizeof *memory);
    if (!form || !memory) fail();
    for (size_t pair = 0; pair < model->pairs; pair++)
        for (size_t m = 0; m < count; m++)
            form[pair * grid->stride + m] = form_like(structure, pair, m, grid->wave_number[m]);
    const double start = bench_user_seconds();
    for (size_t call = 0; call < calls; call++) model_memory(model, form, memory);
    const double seconds = bench_user_seconds() - start;
    memory_free(form);
    memory_free(memory);
    model_free(model);
    oz_free(oz);
    grid_free(grid);
    return seconds / (double)calls;
}

// At a wave number: F, c F, F c and c F c.
typedef struct Vertices {
    double f[2][2], cf[2][2], fc[2][2], cfc[2][2];
} Vertices;

static void multiply(double a[2][2], double b[2][2], double product[2][2]) {
    for (size_t i = 0; i < 2; i++)
        for (size_t j = 0; j < 2; j++) product[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
}

static Vertices vertices_at(const Structure *structure, size_t m, double q) {
    Vertices at;
    double c[2][2];
    for (size_t a = 0; a < 2; a++) {
        for (size_t b = 0; b < 2; b++) {
            const size_t pair = mixture_pair(2, a, b);
            at.f[a][b] = form_like(structure, pair, m, q);
            c[a][b] = structure->direct[pair * structure->count + m];
        }
    }
    multiply(c, at.f, at.cf);
    multiply(at.f, c, at.fc);
    multiply(at.cf, c, at.cfc);
    return at;
}

// What wave numbers k and p = q - k add to the three pairs: k.q = `to_k`, p.q = `to_p`.
static void add_triangle(const Vertices *k, const Vertices *p, double to_k, double to_p,
                         double weight, double sum[3]) {
    for (size_t pair = 0; pair < 3; pair++) {
        const size_t a = pair / 2, b = (pair + 1) / 2;
        sum[pair] +=
            weight *
            (to_k * to_k * k->cfc[a][b] * p->f[a][b] + to_p * to_p * k->f[a][b] * p->cfc[a][b] +
             to_k * to_p * (k->cf[a][b] * p->fc[a][b] + k->fc[a][b] * p->cf[a][b]));
    }
}

// All triangles of wave numbers q = (i + 0.303) dq (Bayer et al. 2007), in units of dq.
static double add_triangles(const Vertices *at, size_t count) {
    double total = 0;
    for (size_t i = 0; i < count; i++) {
        const double q = (double)i + 0.303;
        double sum[3] = {0};
        for (size_t k = 0; k < count; k++) {
            for (size_t p = i > k ? i - k : k - i; p <= i + k && p < count; p++) {
                const double k1 = (double)k + 0.303, p1 = (double)p + 0.303;
                const double to_k = (q * q + k1 * k1 - p1 * p1) / 2;
                const double weight = k1 * p1 / sqrt(q * q * k1 * k1 - to_k * to_k);
                add_triangle(&at[k], &at[p], to_k, q * q - to_k, weight, sum);
            }
        }
        total += (sum[0] + sum[1] + sum[2]) / pow(q, 4);
    }
    return total;
}

static double binary_sum_seconds(size_t count, size_t calls) {
    Oz *oz = NULL;
    double *q = memory_new(count, sizeof *q), total = 0;
    Vertices *at = memory_new(count, sizeof *at);
    if (!q || !at) fail();
    for (size_t i = 0; i < count; i++) q[i] = ((double)i + 0.303) * 40 / (double)count;
    const Structure *structure = binary_structure(&oz, q, count);
    for (size_t m = 0; m < count; m++) at[m] = vertices_at(structure, m, q[m]);
    const double start = bench_user_seconds();
    for (size_t call = 0; call < calls; call++) {
        total += add_triangles(at, count);
        at[0].f[0][0] += 1e-300 * total; // so that no call can be left out
    }
    const double seconds = bench_user_seconds() - start;
    memory_free(q);
    memory_free(at);
    oz_free(oz);
    return seconds / (double)calls;
}

// A point of a flow curve of F12 in the glass, 512 points in a block.
static double steady_seconds(void) {
    Steady *steady = NULL;
    const F12 model = {f12_v1_at(2, 1e-3), 2, 1, 0.15, 100, 0};
    const double start = bench_user_seconds();
    if (steady_create(&steady, &(SteadySettings){model, 1e-6, 512}) != OK) fail();
    while (!steady_has_decayed(steady)) steady_advance(steady);
    const double seconds = bench_user_seconds() - start;
    steady_free(steady);
    return seconds;
}

// Four cycles of an oscillation of F12, 128 moments each.
static double driven_seconds(void) {
    Driven *driven = NULL;
    const DrivenSettings settings = {.model = {f12_v1_at(2, 1e-3), 2, 1, 0.15, 100, 0},
                                     .strain = {.amplitude = 0.2, .frequency = 1e-3},
                                     .moments = 128,
                                     .periods = 4,
                                     .block = 128};
    const double start = bench_user_seconds();
    if (driven_create(&driven, &settings) != OK) fail();
    while (!driven_finished(driven)) driven_advance(driven);
    const double seconds = bench_user_seconds() - start;
    driven_free(driven);
    return seconds;
}

// The same oscillation by the plain double integral on a uniform grid would need a point in 1/20 of
// the time of the free decay, t of them for every pair of beginning and end: this many seconds for
// 200 points, and the cube of what there are more.
static double double_integral_seconds(void) {
    enum { COUNT = 200 };
    double *phi = memory_new((COUNT + 1) * (COUNT + 1), sizeof *phi);
    if (!phi) fail();
    const double start = bench_user_seconds();
    for (size_t age = 1; age <= COUNT; age++) {
        for (size_t s = 0; s + age <= COUNT; s++) {
            const size_t t = s + age;
            double sum = 0;
            for (size_t r = s + 1; r < t; r++) {
                const double a = phi[t * (COUNT + 1) + r], b = phi[r * (COUNT + 1) + s];
                sum += (0.8 + 2 * a) * a * (b - phi[(r - 1) * (COUNT + 1) + s]);
            }
            phi[t * (COUNT + 1) + s] = (1 - 0.05 * sum) / (1 + 0.05 * (double)age);
        }
    }
    const double seconds = bench_user_seconds() - start;
    if (!isfinite(phi[COUNT * (COUNT + 1)])) fail(); // looked at, so that none can be left out
    memory_free(phi);
    return seconds;
}

// A point of the flow curve of the isotropically sheared model.
static double sheared_seconds(void) {
    Grid *grid = NULL;
    Oz *oz = NULL;
    Sheared *sheared = NULL;
    const Structure *structure = NULL;
    if (grid_create(&grid, 3, 100, 40) != OK) fail();
    if (oz_create(&oz, CLOSURE_PERCUS_YEVICK, &SPHERES, grid->wave_number, 100) != OK) fail();
    if (oz_solve(oz, 0.52, &structure) != OK) fail();
    const double start = bench_user_seconds();
    if (sheared_create(&sheared, grid, structure, 1e-3, 128) != OK) fail();
    while (!sheared_has_decayed(sheared))
        if (sheared_advance(sheared) != OK) fail();
    const double seconds = bench_user_seconds() - start;
    sheared_free(sheared);
    oz_free(oz);
    grid_free(grid);
    return seconds;
}

static void bench_median_of(const char *name, double (*seconds_of)(void)) {
    double seconds[REPEATS];
    for (int i = 0; i < REPEATS; i++) seconds[i] = seconds_of();
    bench_result(name, bench_median(seconds, REPEATS), "s");
}

int main(void) {
    bench_median_of("schematic flow point 512", steady_seconds);
    bench_median_of("schematic four cycles 128", driven_seconds);
    bench_median_of("schematic plain double integral 200", double_integral_seconds);
    bench_median_of("mct isotropically sheared spheres 100 to 40", sheared_seconds);
    bench_critical("mct transition discs 203 to 40",
                   &(CriticalSearch){DISCS, CLOSURE_PERCUS_YEVICK, 203, 40, 0.6, 0.74});
    bench_critical("mct transition discs 305 to 59.84",
                   &(CriticalSearch){DISCS, CLOSURE_PERCUS_YEVICK, 305, 59.84, 0.6, 0.74});
    bench_critical("mct transition discs 407 to 79.85",
                   &(CriticalSearch){DISCS, CLOSURE_PERCUS_YEVICK, 407, 79.85, 0.6, 0.74});
    bench_critical("mct transition binary discs 203 to 40",
                   &(CriticalSearch){BINARY, CLOSURE_PERCUS_YEVICK, 203, 40, 0.6, 0.74});
    bench_critical("mct transition binary discs 305 to 59.84",
                   &(CriticalSearch){BINARY, CLOSURE_PERCUS_YEVICK, 305, 59.84, 0.6, 0.74});
    bench_critical("mct transition binary discs 407 to 79.85",
                   &(CriticalSearch){BINARY, CLOSURE_PERCUS_YEVICK, 407, 79.85, 0.6, 0.74});
    bench_correlators("mct twenty decades spheres 100 to 40", 100, 40);
    bench_correlators("mct twenty decades spheres 300 to 60", 300, 60);
    bench_result("mct kernel and history spheres 100", 1e6 * kernel_seconds(100), "us");
    bench_result("mct double sum spheres 100", 1e6 * double_sum_seconds(100, 50), "us");
    bench_result("mct kernel and history spheres 300", 1e6 * kernel_seconds(300), "us");
    bench_result("mct double sum spheres 300", 1e6 * double_sum_seconds(300, 3), "us");
    bench_result("mct kernel binary discs 203", 1e6 * binary_kernel_seconds(203, 100), "us");
    bench_result("mct double sum binary discs 203", 1e6 * binary_sum_seconds(203, 3), "us");
    return 0;
}
