// SPDX-License-Identifier: GPL-3.0-or-later
// The equation of motion on a doubling grid of times, with kernels read at advected wave vectors.
#include "itt/relaxation.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

Status relaxation_create(Relaxation *r, const Plane *plane, size_t block) {
    *r = (Relaxation){.plane = plane, .block = block};
    double **const fields[] = {&r->known, &r->denominator, &r->jump,
                               &r->image, &r->residue,     &r->part};
    TRY(NEW_ARRAY(r->phi, (block + 1) * plane->size));
    TRY(NEW_ARRAY(r->memory, (block + 1) * plane->size));
    TRY(NEW_ARRAY(r->phi_mean, (block / 2 + 1) * plane->size));
    TRY(NEW_ARRAY(r->memory_mean, (block / 2 + 1) * plane->size));
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        TRY(NEW_ARRAY(*fields[i], plane->size));
    return OK;
}

void relaxation_free(Relaxation *r) {
    double *const fields[] = {r->phi,         r->memory, r->phi_mean, r->memory_mean, r->known,
                              r->denominator, r->jump,   r->image,    r->residue,     r->part};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) memory_free(fields[i]);
    *r = (Relaxation){0};
}

double *relaxation_phi(const Relaxation *r, size_t i) {
    return r->phi + i * r->plane->size;
}

double *relaxation_memory(const Relaxation *r, size_t i) {
    return r->memory + i * r->plane->size;
}

static double *phi_mean(const Relaxation *r, size_t i) {
    return r->phi_mean + i * r->plane->size;
}

static double *memory_mean(const Relaxation *r, size_t i) {
    return r->memory_mean + i * r->plane->size;
}

static void average(double *mean, const double *before, const double *now, size_t size) {
    for (size_t k = 0; k < size; k++) mean[k] = (before[k] + now[k]) / 2;
}

void relaxation_average(Relaxation *r, size_t i) {
    const size_t size = r->plane->size;
    if (i > r->block / 2) return;
    average(phi_mean(r, i), relaxation_phi(r, i - 1), relaxation_phi(r, i), size);
    average(memory_mean(r, i), relaxation_memory(r, i - 1), relaxation_memory(r, i), size);
}

// The part of the integral over early times, up to `half`: m(t, t_j) times the change of what Phi
// is there, by parts; that of t' = 0 is left to the iteration.
static void add_early(Relaxation *r, size_t i, size_t half, double shear) {
    const size_t size = r->plane->size;
    for (size_t j = 1; j <= half; j++) {
        const double *next = j == half ? relaxation_phi(r, half) : phi_mean(r, j + 1);
        const double *mean = phi_mean(r, j);
        for (size_t k = 0; k < size; k++) r->part[k] = mean[k] - next[k];
        plane_add_advected(r->plane, shear * (double)j, relaxation_memory(r, i - j), r->part,
                           r->known);
    }
}

// Over recent times; the newest difference of Phi lacks its newer end.
static void add_recent(Relaxation *r, size_t i, size_t half, double shear) {
    const size_t size = r->plane->size;
    for (size_t j = half + 1; j <= i; j++) {
        const double *before = relaxation_phi(r, j - 1), *now = relaxation_phi(r, j);
        for (size_t k = 0; k < size; k++) r->part[k] = before[k] - (j == i ? 0 : now[k]);
        plane_add_advected(r->plane, shear * ((double)j - 0.5), memory_mean(r, i - j + 1), r->part,
                           r->known);
    }
}

static void extrapolate(Relaxation *r, size_t i) {
    double *now = relaxation_phi(r, i);
    const double *a = relaxation_phi(r, i - 1), *b = relaxation_phi(r, i - 2);
    const double *c = relaxation_phi(r, i - 3);
    for (size_t k = 0; k < r->plane->size; k++) now[k] = 3 * a[k] - 3 * b[k] + c[k];
}

void relaxation_prepare(Relaxation *r, size_t i, double step, double shear, const double *rate) {
    const size_t size = r->plane->size, half = i / 2;
    const double *before = relaxation_phi(r, i - 1), *earlier = relaxation_phi(r, i - 2);
    const double *first = phi_mean(r, 1);
    memset(r->known, 0, size * sizeof *r->known);
    add_early(r, i, half, shear);
    add_recent(r, i, half, shear);
    memset(r->denominator, 0, size * sizeof *r->denominator);
    for (size_t k = 0; k < size; k++) r->part[k] = 1;
    plane_add_advected(r->plane, shear * ((double)i - 0.5), memory_mean(r, 1), r->part,
                       r->denominator);
    for (size_t k = 0; k < size; k++) {
        // Times the rate, so that q = 0, which does not move, is like the others.
        const double friction = rate[k] * step;
        r->known[k] = (4 * before[k] - earlier[k]) / 2 + friction * r->known[k];
        r->denominator[k] = 1.5 + friction * (1 + r->denominator[k]);
        r->jump[k] = friction * (1 - first[k]);
    }
    extrapolate(r, i);
}

// Anderson's mixing of two iterations: one slow direction is taken out, the critical one.
double relaxation_iterate(Relaxation *r, size_t i, bool first) {
    const double *memory = relaxation_memory(r, i);
    double *phi = relaxation_phi(r, i), along = 0, square = 0, change = 0;
    for (size_t k = 0; k < r->plane->size; k++) {
        const double next = (r->known[k] + memory[k] * r->jump[k]) / r->denominator[k];
        const double moved = next - phi[k], difference = first ? 0 : moved - r->residue[k];
        along += moved * difference;
        square += difference * difference;
        change = fmax(change, fabs(moved));
        phi[k] = r->image[k]; // the image before, for which the newest changes places
        r->image[k] = next;
        r->residue[k] = moved;
    }
    const double part = square > 0 ? along / square : 0;
    for (size_t k = 0; k < r->plane->size; k++)
        phi[k] = first ? r->image[k] : r->image[k] - part * (r->image[k] - phi[k]);
    return change;
}

// Averages over twice the interval: from two where they are kept, from three values beyond.
static void halve(double *values, double *mean, size_t size, size_t block) {
    for (size_t i = 1; i <= block / 2; i++) {
        const double *a = values + (2 * i - 2) * size, *b = a + size, *c = b + size;
        for (size_t k = 0; k < size; k++)
            mean[i * size + k] = 4 * i <= block
                                     ? (mean[(2 * i - 1) * size + k] + mean[2 * i * size + k]) / 2
                                     : (a[k] + 2 * b[k] + c[k]) / 4;
    }
    for (size_t i = 1; i <= block / 2; i++)
        memcpy(values + i * size, values + 2 * i * size, size * sizeof *values);
}

void relaxation_decimate(Relaxation *r) {
    halve(r->phi, r->phi_mean, r->plane->size, r->block);
    halve(r->memory, r->memory_mean, r->plane->size, r->block);
}

void relaxation_archive(Relaxation *r, Archive *archive) {
    const size_t size = r->plane->size;
    archive_f64(archive, r->phi, (r->block + 1) * size);
    archive_f64(archive, r->memory, (r->block + 1) * size);
    archive_f64(archive, r->phi_mean, (r->block / 2 + 1) * size);
    archive_f64(archive, r->memory_mean, (r->block / 2 + 1) * size);
}
