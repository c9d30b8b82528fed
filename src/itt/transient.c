// SPDX-License-Identifier: GPL-3.0-or-later
// Transient correlators: from time to time, a fixed point in the memory kernel.
#include "itt/transient.h"

#include "base/memory.h"
#include "itt/kernel.h"
#include "itt/relaxation.h"
#include "itt/walk.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 64, ITERATIONS_MOST = 2000 };
static const double CONVERGED = 1e-8;  // change of Phi in an iteration
static const double TAYLOR_END = 1e-3; // q^2 t at the end of the expansion, for the largest q

struct Transient {
    const Plane *plane;
    TransientSettings settings;
    Kernel *kernel;
    double step;
    size_t block, now; // index of the present time in the block
    Relaxation collective, tagged;
    Walk walk;
};

const char *const transient_direction[TRANSIENT_DIRECTIONS] = {"x", "y", "xy", "-xy"};

static Status allocate(Transient *t) {
    TRY(relaxation_create(&t->collective, t->plane, t->block));
    if (!t->settings.tagged) return OK;
    TRY(relaxation_create(&t->tagged, t->plane, t->block));
    return walk_create(&t->walk, t->block);
}

// The kernels at time i, whose correlators are known.
static void collective_kernel(Transient *t, size_t i) {
    kernel_memory(t->kernel, relaxation_phi(&t->collective, i),
                  relaxation_memory(&t->collective, i));
}

static void tagged_kernel(Transient *t, size_t i) {
    const double *phi = relaxation_phi(&t->tagged, i);
    kernel_tagged(t->kernel, phi, relaxation_memory(&t->tagged, i));
    kernel_displacement(t->kernel, relaxation_phi(&t->collective, i), phi, t->walk.friction[i]);
}

// To second order in t: 1 - t rate + t^2 rate^2 (1 + m)/2, the rate at rest and its mean since.
static void expand(Transient *t, Relaxation *r, size_t i, const double *rest, const double *rate) {
    const double time = (double)i * t->step;
    const double *kernel = relaxation_memory(r, 0);
    double *phi = relaxation_phi(r, i);
    for (size_t k = 0; k < t->plane->size; k++) {
        if (!(t->plane->area[k] > 0)) continue;
        const double x = time * (rest[k] + rate[k]) / 2;
        phi[k] = 1 - x + x * x / 2 * (1 + kernel[k]);
    }
}

static Status begin(Transient *t) {
    const size_t size = t->plane->size;
    double *rest = NULL, *tagged_rest = NULL;
    Status status = NEW_ARRAY(rest, size);
    if (status == OK) status = NEW_ARRAY(tagged_rest, size);
    for (size_t i = 0; status == OK && i <= t->block / 2; i++) {
        kernel_set_strain(t->kernel, t->settings.shear_rate * (double)i * t->step);
        if (i == 0) {
            memcpy(rest, kernel_rate(t->kernel), size * sizeof *rest);
            memcpy(tagged_rest, kernel_tagged_rate(t->kernel), size * sizeof *rest);
        }
        expand(t, &t->collective, i, rest, kernel_rate(t->kernel));
        collective_kernel(t, i);
        if (i > 0) relaxation_average(&t->collective, i);
        if (!t->settings.tagged) continue;
        expand(t, &t->tagged, i, tagged_rest, kernel_tagged_rate(t->kernel));
        tagged_kernel(t, i);
        if (i > 0) relaxation_average(&t->tagged, i);
        walk_begin(&t->walk, i, t->step, t->settings.shear_rate * t->step);
    }
    memory_free(rest);
    memory_free(tagged_rest);
    return status;
}

static Status fail_slow(const Transient *t, double change) {
    return status_fail(UNHEALTHY,
                       "correlators under shear: at t = %g, after %d iterations, Phi still changes "
                       "by %.3g",
                       transient_time(t), ITERATIONS_MOST, change);
}

static Status advance_collective(Transient *t, double shear) {
    double change = INFINITY;
    relaxation_prepare(&t->collective, t->now, t->step, shear, kernel_rate(t->kernel));
    for (int i = 0; i < ITERATIONS_MOST && !(change < CONVERGED); i++) {
        collective_kernel(t, t->now);
        change = relaxation_iterate(&t->collective, t->now, i == 0);
    }
    if (!(change < CONVERGED)) return fail_slow(t, change);
    relaxation_average(&t->collective, t->now);
    return OK;
}

static Status advance_tagged(Transient *t, double shear) {
    double change = INFINITY;
    relaxation_prepare(&t->tagged, t->now, t->step, shear, kernel_tagged_rate(t->kernel));
    for (int i = 0; i < ITERATIONS_MOST && !(change < CONVERGED); i++) {
        kernel_tagged(t->kernel, relaxation_phi(&t->tagged, t->now),
                      relaxation_memory(&t->tagged, t->now));
        change = relaxation_iterate(&t->tagged, t->now, i == 0);
    }
    if (!(change < CONVERGED)) return fail_slow(t, change);
    relaxation_average(&t->tagged, t->now);
    kernel_displacement(t->kernel, relaxation_phi(&t->collective, t->now),
                        relaxation_phi(&t->tagged, t->now), t->walk.friction[t->now]);
    walk_advance(&t->walk, t->now, t->step, shear);
    return OK;
}

static void next_block(Transient *t) {
    relaxation_decimate(&t->collective);
    if (t->settings.tagged) {
        relaxation_decimate(&t->tagged);
        walk_decimate(&t->walk);
    }
    t->step *= 2;
    t->now = t->block / 2;
}

Status transient_advance(Transient *t) {
    if (t->now == t->block) next_block(t);
    t->now++;
    if (t->now <= t->block / 2) return OK; // the beginning, which is there already
    const double shear = t->settings.shear_rate * t->step;
    kernel_set_strain(t->kernel, transient_strain(t));
    TRY(advance_collective(t, shear));
    return t->settings.tagged ? advance_tagged(t, shear) : OK;
}

Status transient_create(Transient **out, const Plane *plane, const Direct *direct,
                        const TransientSettings *settings) {
    Transient *t = NULL;
    *out = NULL;
    TRY(NEW(t));
    t->plane = plane;
    t->settings = *settings;
    t->block = settings->block ? settings->block : BLOCK;
    t->step = TAYLOR_END / (plane->cutoff * plane->cutoff) / (double)(t->block / 2);
    Status status = kernel_create(&t->kernel, plane, direct);
    if (status == OK) status = allocate(t);
    if (status == OK) status = begin(t);
    if (status == OK)
        *out = t;
    else
        transient_free(t);
    return status;
}

void transient_free(Transient *t) {
    if (!t) return;
    relaxation_free(&t->collective);
    relaxation_free(&t->tagged);
    walk_free(&t->walk);
    kernel_free(t->kernel);
    memory_free(t);
}

size_t transient_memory(double cutoff, double spacing, const TransientSettings *settings) {
    const double columns = cutoff / spacing,
                 block = (double)(settings->block ? settings->block : BLOCK);
    const double fields = (3 * block + 10) * (settings->tagged ? 2 : 1) + 30;
    const double size = columns * (1.6 * columns + 6), room = 5 * columns * columns;
    return (size_t)(sizeof(double) * (fields * size + 15 * room));
}

double transient_time(const Transient *t) {
    return (double)t->now * t->step;
}

double transient_strain(const Transient *t) {
    return t->settings.shear_rate * transient_time(t);
}

const double *transient_collective(const Transient *t) {
    return relaxation_phi(&t->collective, t->now);
}

const double *transient_tagged(const Transient *t) {
    return t->settings.tagged ? relaxation_phi(&t->tagged, t->now) : NULL;
}

double transient_displacement(const Transient *t, int direction) {
    return t->settings.tagged ? t->walk.value[direction][t->now] : NAN;
}

void transient_archive(Transient *t, Archive *archive) {
    uint64_t now = t->now;
    archive_f64(archive, &t->step, 1);
    archive_u64(archive, &now, 1);
    archive_require(archive, t->step > 0 && now <= t->block, "its time is none of the grid");
    if (archive->status != OK) return;
    t->now = now;
    relaxation_archive(&t->collective, archive);
    if (!t->settings.tagged) return;
    relaxation_archive(&t->tagged, archive);
    walk_archive(&t->walk, archive);
}
