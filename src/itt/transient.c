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
    size_t species;
    size_t block, now; // index of the present time in the block
    Relaxation collective;
    Relaxation tagged[MIXTURE_SPECIES_MOST]; // of species that are not wanted: empty
    Walk walk[MIXTURE_SPECIES_MOST];
};

const char *const transient_direction[TRANSIENT_DIRECTIONS] = {"x", "y", "xy", "-xy"};

// Species with tagged particles: all or none.
static size_t tagged_species(const Transient *t) {
    return t->settings.tagged ? t->species : 0;
}

static Status allocate(Transient *t) {
    TRY(relaxation_create(&t->collective, t->plane, t->species, t->block));
    for (size_t s = 0; s < tagged_species(t); s++) {
        TRY(relaxation_create(&t->tagged[s], t->plane, 1, t->block));
        TRY(walk_create(&t->walk[s], t->settings.diffusion[s], t->block));
    }
    return OK;
}

// The kernels at time i, whose correlators are known.
static void collective_kernel(Transient *t, size_t i) {
    kernel_memory(t->kernel, relaxation_phi(&t->collective, i),
                  relaxation_memory(&t->collective, i));
}

static void tagged_kernel(Transient *t, size_t s, size_t i) {
    kernel_tagged(t->kernel, s, relaxation_phi(&t->tagged[s], i),
                  relaxation_memory(&t->tagged[s], i));
}

static void set_friction(Transient *t, size_t s, size_t i) {
    double friction[2][2];
    kernel_displacement(t->kernel, s, relaxation_phi(&t->tagged[s], i), friction);
    walk_set_friction(&t->walk[s], i, friction);
}

static void begin_tagged(Transient *t, size_t s, size_t i, const double *rest) {
    relaxation_expand(&t->tagged[s], i, (double)i * t->step, rest + s * t->plane->size,
                      kernel_tagged_rate(t->kernel, s));
    tagged_kernel(t, s, i);
    set_friction(t, s, i);
    if (i > 0) relaxation_average(&t->tagged[s], i);
    walk_begin(&t->walk[s], i, t->step, t->settings.shear_rate * t->step);
}

static void begin_at(Transient *t, size_t i, const double *rest, const double *tagged_rest) {
    kernel_set_strain(t->kernel, t->settings.shear_rate * (double)i * t->step);
    relaxation_expand(&t->collective, i, (double)i * t->step, rest, kernel_rate(t->kernel));
    collective_kernel(t, i);
    if (i > 0) relaxation_average(&t->collective, i);
    for (size_t s = 0; s < tagged_species(t); s++) begin_tagged(t, s, i, tagged_rest);
}

// The rates at rest are those of a kernel that has just been created.
static Status begin(Transient *t) {
    const size_t size = t->plane->size, entries = t->species * t->species;
    double *rest = NULL, *tagged_rest = NULL;
    Status status = NEW_ARRAY(rest, entries * size);
    if (status == OK) status = NEW_ARRAY(tagged_rest, t->species * size);
    if (status == OK) {
        memcpy(rest, kernel_rate(t->kernel), entries * size * sizeof *rest);
        memcpy(tagged_rest, kernel_tagged_rate(t->kernel, 0), t->species * size * sizeof *rest);
    }
    for (size_t i = 0; status == OK && i <= t->block / 2; i++) begin_at(t, i, rest, tagged_rest);
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

static Status advance_tagged(Transient *t, size_t s, double shear) {
    double change = INFINITY;
    Relaxation *tagged = &t->tagged[s];
    relaxation_prepare(tagged, t->now, t->step, shear, kernel_tagged_rate(t->kernel, s));
    for (int i = 0; i < ITERATIONS_MOST && !(change < CONVERGED); i++) {
        tagged_kernel(t, s, t->now);
        change = relaxation_iterate(tagged, t->now, i == 0);
    }
    if (!(change < CONVERGED)) return fail_slow(t, change);
    relaxation_average(tagged, t->now);
    set_friction(t, s, t->now);
    walk_advance(&t->walk[s], t->now, t->step, shear);
    return OK;
}

static void next_block(Transient *t) {
    relaxation_decimate(&t->collective);
    for (size_t s = 0; s < tagged_species(t); s++) {
        relaxation_decimate(&t->tagged[s]);
        walk_decimate(&t->walk[s]);
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
    for (size_t s = 0; s < tagged_species(t); s++) TRY(advance_tagged(t, s, shear));
    return OK;
}

static double fastest(const Transient *t) {
    double most = 0;
    for (size_t s = 0; s < t->species; s++) most = fmax(most, t->settings.diffusion[s]);
    return most;
}

Status transient_create(Transient **out, const Plane *plane, const Direct *direct,
                        const TransientSettings *settings) {
    Transient *t = NULL;
    *out = NULL;
    TRY(NEW(t));
    t->plane = plane;
    t->settings = *settings;
    t->block = settings->block ? settings->block : BLOCK;
    t->species = direct->mixture.species;
    t->step = TAYLOR_END / (fastest(t) * plane->cutoff * plane->cutoff) / (double)(t->block / 2);
    Status status = kernel_create(&t->kernel, plane, direct, settings->diffusion);
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
    for (size_t s = 0; s < MIXTURE_SPECIES_MOST; s++) {
        relaxation_free(&t->tagged[s]);
        walk_free(&t->walk[s]);
    }
    kernel_free(t->kernel);
    memory_free(t);
}

// Histories, the kernel's matrices, and what it has in space.
size_t transient_memory(double cutoff, double spacing, size_t species,
                        const TransientSettings *settings) {
    const double columns = cutoff / spacing, entries = (double)(species * species);
    const double history = (double)relaxation_fields(settings->block ? settings->block : BLOCK);
    const double fields =
        history * (entries + (settings->tagged ? (double)species : 0)) + 16 * entries + 20;
    const double size = columns * (1.6 * columns + 6), room = 5 * columns * columns;
    return (size_t)(sizeof(double) * (fields * size + (12 + 3 * entries) * room));
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

const double *transient_tagged(const Transient *t, size_t species) {
    return t->settings.tagged ? relaxation_phi(&t->tagged[species], t->now) : NULL;
}

double transient_displacement(const Transient *t, size_t species, int direction) {
    return t->settings.tagged ? t->walk[species].value[direction][t->now] : NAN;
}

void transient_archive(Transient *t, Archive *archive) {
    uint64_t now = t->now;
    archive_f64(archive, &t->step, 1);
    archive_u64(archive, &now, 1);
    archive_require(archive, t->step > 0 && now <= t->block, "its time is none of the grid");
    if (archive->status != OK) return;
    t->now = now;
    relaxation_archive(&t->collective, archive);
    for (size_t s = 0; s < tagged_species(t); s++) {
        relaxation_archive(&t->tagged[s], archive);
        walk_archive(&t->walk[s], archive);
    }
}
