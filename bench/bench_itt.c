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
static const double GLASS = 0.69754438; // a hundredth above the transition of this structure

static void fail(void) {
    fprintf(stderr, "bench_itt: %s\n", status_sentence());
    exit(1);
}

static Direct *direct_new(double cutoff) {
    static const Mixture DISCS = {2, 1, {1}, {1}};
    Oz *oz = NULL;
    Direct *direct = NULL;
    const Structure *s = NULL;
    double q[TABLE];
    const double spacing = 3 * cutoff / TABLE;
    for (size_t i = 0; i < TABLE; i++) q[i] = direct_wave_number(spacing, i);
    if (oz_create(&oz, CLOSURE_FUNDAMENTAL, &DISCS, q, TABLE) != OK) fail();
    if (oz_solve(oz, GLASS, &s) != OK) fail();
    if (direct_create(&direct, s->density, spacing, s->direct, TABLE) != OK) fail();
    oz_free(oz);
    return direct;
}

static void bench_point(const char *name, double cutoff, double spacing, double rate, bool tagged) {
    Direct *direct = direct_new(cutoff);
    Plane *plane = NULL;
    Transient *transient = NULL;
    Flow *flow = NULL;
    const TransientSettings settings = {rate, 64, tagged};
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

static void bench_kernel(const char *name, double cutoff, double spacing) {
    Direct *direct = direct_new(cutoff);
    Plane *plane = NULL;
    Kernel *kernel = NULL;
    if (plane_create(&plane, cutoff, spacing) != OK) fail();
    if (kernel_create(&kernel, plane, direct) != OK) fail();
    double *phi = memory_new(plane->size, sizeof *phi), *memory = memory_new(plane->size, 8);
    if (!phi || !memory) fail();
    for (size_t k = 0; k < plane->size; k++) phi[k] = plane->area[k] > 0;
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

int main(void) {
    struct rusage usage;
    bench_point("itt flow-curve point rate 0.001 0.3 to 30", 30, 0.3, 1e-3, false);
    getrusage(RUSAGE_SELF, &usage);
    bench_result("itt memory of that point", (double)usage.ru_maxrss / 1024, "MiB");
    bench_point("itt with a tagged particle rate 0.001 0.3 to 30", 30, 0.3, 1e-3, true);
    bench_kernel("itt kernel 0.6 to 30", 30, 0.6);
    bench_double_sum("itt double sum 0.6 to 30", 30, 0.6);
    bench_kernel("itt kernel 0.3 to 30", 30, 0.3);
    bench_double_sum("itt double sum 0.3 to 30", 30, 0.3);
    return 0;
}
