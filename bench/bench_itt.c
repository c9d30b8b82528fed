// SPDX-License-Identifier: GPL-3.0-or-later
// What the theory under shear costs: a point of the flow curve, and the memory kernel beside the
// plain double sum over wave vectors that it replaces. User CPU seconds; a point once, as it takes
// seconds.
#include "bench.h"

#include "base/memory.h"
#include "itt/flow.h"
#include "itt/kernel.h"
#include "itt/transient.h"
#include "oz/oz.h"

#include <math.h>
#include <sys/resource.h>

enum { TABLE = 3000, KERNELS = 50 };
static const Mixture DISCS = {2, 1, {1}, {1}}, BINARY = {2, 2, {1, 1.4}, {0.5, 0.5}};
// A hundredth above the transitions of these structures.
static const double GLASS = 0.69754438, BINARY_GLASS = 0.69274783;

static void fail(void) {
    fprintf(stderr, "bench_itt: %s\n", status_sentence());
    exit(1);
}

static Direct *direct_new(Closure closure, const Mixture *mixture, double packing_fraction,
                          double cutoff) {
    Oz *oz = NULL;
    Direct *direct = NULL;
    const Structure *s = NULL;
    double q[TABLE];
    const double spacing = 3 * cutoff / TABLE;
    for (size_t i = 0; i < TABLE; i++) q[i] = direct_wave_number(spacing, i);
    if (oz_create(&oz, closure, mixture, q, TABLE) != OK) fail();
    if (oz_solve(oz, packing_fraction, &s) != OK) fail();
    if (direct_create(&direct, mixture, s->density, spacing, s->direct, TABLE) != OK) fail();
    oz_free(oz);
    return direct;
}

static Direct *discs(double cutoff) {
    return direct_new(CLOSURE_FUNDAMENTAL, &DISCS, GLASS, cutoff);
}

static Direct *binary(double cutoff) {
    return direct_new(CLOSURE_PERCUS_YEVICK, &BINARY, BINARY_GLASS, cutoff);
}

static void bench_point(const char *name, Direct *direct, double cutoff, double spacing,
                        double rate, bool tagged) {
    Plane *plane = NULL;
    Transient *transient = NULL;
    Flow *flow = NULL;
    const TransientSettings settings = {rate, 64, tagged, .diffusion = {1, 1}};
    const double start = bench_user_seconds();
    if (plane_create(&plane, cutoff, spacing) != OK) fail();
    if (transient_create(&transient, plane, direct, &settings) != OK) fail();
    if (flow_create(&flow, plane, direct, rate) != OK) fail();
    flow_see(flow, 0, transient_collective(transient));
    while (transient_strain(transient) < 10) {
        if (transient_advance(transient) != OK) fail();
        flow_see(flow, transient_time(transient), transient_collective(transient));
    }
    bench_result(name, bench_user_seconds() - start, "s");
    flow_free(flow);
    transient_free(transient);
    plane_free(plane);
    direct_free(direct);
}

static void bench_kernel(const char *name, Direct *direct, double cutoff, double spacing) {
    static const double FREE[] = {1, 1};
    const size_t species = direct->mixture.species;
    Plane *plane = NULL;
    Kernel *kernel = NULL;
    if (plane_create(&plane, cutoff, spacing) != OK) fail();
    if (kernel_create(&kernel, plane, direct, FREE) != OK) fail();
    const size_t numbers = species * species * plane->size;
    double *phi = memory_new(numbers, sizeof *phi), *memory = memory_new(numbers, sizeof *memory);
    if (!phi || !memory) fail();
    for (size_t a = 0; a < species; a++) {
        for (size_t k = 0; k < plane->size; k++)
            phi[a * (species + 1) * plane->size + k] = plane->area[k] > 0;
    }
    kernel_set_strain(kernel, 0.1);
    const double start = bench_user_seconds();
    for (int i = 0; i < KERNELS; i++) kernel_memory(kernel, phi, memory);
    bench_result(name, 1e3 * (bench_user_seconds() - start) / KERNELS, "ms");
    memory_free(phi);
    memory_free(memory);
    kernel_free(kernel);
    plane_free(plane);
    direct_free(direct);
}

// The sum for one wave vector q = (q, 0), with tables of c and of the advected c.
static double sum_at(const Plane *plane, const double *c, const double *late_c, int qi) {
    const int last = plane->last, side = 2 * last + 1;
    double sum = 0;
    for (int i = -last; i <= last; i++) {
        for (int j = -last; j <= last; j++) {
            const int k = (i + last) * side + j + last, pi = qi - i, pj = -j;
            if (i * i + j * j > last * last || pi * pi + pj * pj > last * last) continue;
            const int p = (pi + last) * side + pj + last;
            const double vertex = qi * (i * c[k] + pi * c[p]);
            sum += vertex * (qi * (i * late_c[k] + pi * late_c[p]));
        }
    }
    return sum;
}

static void bench_double_sum(const char *name, double cutoff, double spacing) {
    Plane *plane = NULL;
    if (plane_create(&plane, cutoff, spacing) != OK) fail();
    const size_t side = 2 * (size_t)plane->last + 1, count = side * side;
    double *c = memory_new(count, sizeof *c), *late = memory_new(count, sizeof *late);
    double total = 0;
    if (!c || !late) fail();
    for (size_t k = 0; k < count; k++) c[k] = late[k] = 1.0 / (double)(k + 1);
    const double start = bench_user_seconds();
    for (int i = 0; i <= plane->last; i++) total += sum_at(plane, c, late, i);
    // A sum for each wave vector of the half plane, of which this was one per column.
    const double all = (double)plane->size / ((double)plane->last + 1);
    bench_result(name, 1e3 * all * (bench_user_seconds() - start), total == 0 ? "" : "ms");
    memory_free(c);
    memory_free(late);
    plane_free(plane);
}

// Of all so far.
static void bench_memory(const char *name) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    bench_result(name, (double)usage.ru_maxrss / 1024, "MiB");
}

int main(void) {
    bench_point("itt flow-curve point rate 0.001 0.3 to 30", discs(30), 30, 0.3, 1e-3, false);
    bench_memory("itt memory of that point");
    bench_point("itt with a tagged particle rate 0.001 0.3 to 30", discs(30), 30, 0.3, 1e-3, true);
    bench_point("itt binary flow-curve point rate 0.001 0.3 to 30", binary(30), 30, 0.3, 1e-3,
                false);
    bench_memory("itt memory of that binary point");
    bench_point("itt binary with tagged particles rate 0.001 0.3 to 30", binary(30), 30, 0.3, 1e-3,
                true);
    bench_memory("itt memory with tagged particles of both");
    bench_kernel("itt kernel 0.6 to 30", discs(30), 30, 0.6);
    bench_double_sum("itt double sum 0.6 to 30", 30, 0.6);
    bench_kernel("itt kernel 0.3 to 30", discs(30), 30, 0.3);
    bench_kernel("itt binary kernel 0.3 to 30", binary(30), 30, 0.3);
    bench_double_sum("itt double sum 0.3 to 30", 30, 0.3);
    return 0;
}
