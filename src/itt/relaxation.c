// SPDX-License-Identifier: GPL-3.0-or-later
// The equation of motion on a doubling grid of times, with kernels read at advected wave vectors.
#include "itt/relaxation.h"

#include "base/memory.h"
#include "itt/matrix.h"

#include <math.h>
#include <string.h>

Status relaxation_create(Relaxation *r, const Plane *plane, size_t species, size_t block) {
    *r = (Relaxation){.plane = plane,
                      .species = species,
                      .size = species * species * plane->size,
                      .block = block};
    double **const fields[] = {&r->known,   &r->weight, &r->jump,    &r->image,
                               &r->residue, &r->part,   &r->inverse, &r->scratch};
    TRY(NEW_ARRAY(r->phi, (block + 1) * r->size));
    TRY(NEW_ARRAY(r->memory, (block + 1) * r->size));
    TRY(NEW_ARRAY(r->phi_mean, (block / 2 + 1) * r->size));
    TRY(NEW_ARRAY(r->memory_mean, (block / 2 + 1) * r->size));
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) TRY(NEW_ARRAY(*fields[i], r->size));
    return OK;
}

void relaxation_free(Relaxation *r) {
    double *const fields[] = {r->phi,     r->memory, r->phi_mean, r->memory_mean,
                              r->known,   r->weight, r->jump,     r->image,
                              r->residue, r->part,   r->inverse,  r->scratch};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) memory_free(fields[i]);
    *r = (Relaxation){0};
}

size_t relaxation_fields(size_t block) {
    return 2 * (block + 1) + 2 * (block / 2 + 1) + 8;
}

double *relaxation_phi(const Relaxation *r, size_t i) {
    return r->phi + i * r->size;
}

double *relaxation_memory(const Relaxation *r, size_t i) {
    return r->memory + i * r->size;
}

static double *phi_mean(const Relaxation *r, size_t i) {
    return r->phi_mean + i * r->size;
}

static double *memory_mean(const Relaxation *r, size_t i) {
    return r->memory_mean + i * r->size;
}

static void average(double *mean, const double *before, const double *now, size_t size) {
    for (size_t k = 0; k < size; k++) mean[k] = (before[k] + now[k]) / 2;
}

void relaxation_average(Relaxation *r, size_t i) {
    if (i > r->block / 2) return;
    average(phi_mean(r, i), relaxation_phi(r, i - 1), relaxation_phi(r, i), r->size);
    average(memory_mean(r, i), relaxation_memory(r, i - 1), relaxation_memory(r, i), r->size);
}

static void multiply(const Relaxation *r, const double *left, const double *right,
                     double *product) {
    matrix_multiply(r->species, r->plane->size, left, right, product);
}

static void add_unit(const Relaxation *r, double number, double *matrix) {
    for (size_t a = 0; a < r->species; a++) {
        double *entry = matrix_entry(matrix, r->species, r->plane->size, a, a);
        for (size_t k = 0; k < r->plane->size; k++) entry[k] += number;
    }
}

// Between the columns, where there are no wave vectors, correlators are zero.
static void clear_margins(const Relaxation *r, double *matrix) {
    const size_t size = r->plane->size;
    for (size_t n = 0; n < r->species * r->species; n++) {
        for (size_t k = 0; k < size; k++)
            if (!(r->plane->area[k] > 0)) matrix[n * size + k] = 0;
    }
}

// 1 - X + X (1 + m) X/2, X the time times the mean of the rate since.
void relaxation_expand(Relaxation *r, size_t i, double time, const double *rest,
                       const double *rate) {
    double *phi = relaxation_phi(r, i);
    for (size_t k = 0; k < r->size; k++) {
        r->part[k] = time * (rest[k] + rate[k]) / 2;
        r->inverse[k] = relaxation_memory(r, 0)[k];
    }
    add_unit(r, 1, r->inverse);
    multiply(r, r->inverse, r->part, r->scratch);
    multiply(r, r->part, r->scratch, phi);
    for (size_t k = 0; k < r->size; k++) phi[k] = phi[k] / 2 - r->part[k];
    add_unit(r, 1, phi);
    clear_margins(r, phi);
}

// known += kernel part, the kernel read where the strain has advected from.
static void add_kernel(Relaxation *r, double strain, const double *kernel) {
    const size_t species = r->species, size = r->plane->size;
    for (size_t a = 0; a < species; a++) {
        for (size_t c = 0; c < species; c++)
            plane_add_advected(r->plane, strain, matrix_read(kernel, species, size, a, c),
                               matrix_read(r->part, species, size, c, 0),
                               matrix_entry(r->known, species, size, a, 0), species);
    }
}

// The part of the integral over early times, up to `half`: m(t, t_j) times the change of what Phi
// is there, by parts; that of t' = 0 is left to the iteration.
static void add_early(Relaxation *r, size_t i, size_t half, double shear) {
    for (size_t j = 1; j <= half; j++) {
        const double *next = j == half ? relaxation_phi(r, half) : phi_mean(r, j + 1);
        const double *mean = phi_mean(r, j);
        for (size_t k = 0; k < r->size; k++) r->part[k] = mean[k] - next[k];
        add_kernel(r, shear * (double)j, relaxation_memory(r, i - j));
    }
}

// Over recent times; the newest difference of Phi lacks its newer end.
static void add_recent(Relaxation *r, size_t i, size_t half, double shear) {
    for (size_t j = half + 1; j <= i; j++) {
        const double *before = relaxation_phi(r, j - 1), *now = relaxation_phi(r, j);
        for (size_t k = 0; k < r->size; k++) r->part[k] = before[k] - (j == i ? 0 : now[k]);
        add_kernel(r, shear * ((double)j - 0.5), memory_mean(r, i - j + 1));
    }
}

static void extrapolate(Relaxation *r, size_t i) {
    double *now = relaxation_phi(r, i);
    const double *a = relaxation_phi(r, i - 1), *b = relaxation_phi(r, i - 2);
    const double *c = relaxation_phi(r, i - 3);
    for (size_t k = 0; k < r->size; k++) now[k] = 3 * a[k] - 3 * b[k] + c[k];
}

// The inverse of 3/2 + step rate (1 + the newest average of the kernel).
static void invert(Relaxation *r, size_t i, double step, double shear, const double *rate) {
    const size_t size = r->plane->size, entries = r->species * r->species;
    for (size_t k = 0; k < size; k++) r->part[k] = 1;
    memset(r->scratch, 0, r->size * sizeof *r->scratch);
    for (size_t n = 0; n < entries; n++)
        plane_add_advected(r->plane, shear * ((double)i - 0.5), memory_mean(r, 1) + n * size,
                           r->part, r->scratch + n * size, 1);
    add_unit(r, 1, r->scratch);
    multiply(r, rate, r->scratch, r->inverse);
    for (size_t k = 0; k < r->size; k++) r->inverse[k] *= step;
    add_unit(r, 1.5, r->inverse);
    matrix_invert(r->species, size, r->inverse);
}

// All is multiplied by the rate, so that q = 0, which does not move, is like the others.
void relaxation_prepare(Relaxation *r, size_t i, double step, double shear, const double *rate) {
    const size_t half = i / 2;
    const double *before = relaxation_phi(r, i - 1), *earlier = relaxation_phi(r, i - 2);
    memset(r->known, 0, r->size * sizeof *r->known);
    add_early(r, i, half, shear);
    add_recent(r, i, half, shear);
    invert(r, i, step, shear, rate);
    multiply(r, rate, r->known, r->scratch);
    for (size_t k = 0; k < r->size; k++) {
        r->part[k] = (4 * before[k] - earlier[k]) / 2 + step * r->scratch[k];
        r->scratch[k] = step * rate[k];
        r->jump[k] = -phi_mean(r, 1)[k];
    }
    add_unit(r, 1, r->jump);
    multiply(r, r->inverse, r->part, r->known);
    multiply(r, r->inverse, r->scratch, r->weight);
    extrapolate(r, i);
}

// Anderson's mixing of two iterations: one slow direction is taken out, the critical one.
double relaxation_iterate(Relaxation *r, size_t i, bool first) {
    double *phi = relaxation_phi(r, i), along = 0, square = 0, change = 0;
    multiply(r, relaxation_memory(r, i), r->jump, r->scratch);
    multiply(r, r->weight, r->scratch, r->part);
    for (size_t k = 0; k < r->size; k++) {
        const double next = r->known[k] + r->part[k];
        const double moved = next - phi[k], difference = first ? 0 : moved - r->residue[k];
        along += moved * difference;
        square += difference * difference;
        change = fmax(change, fabs(moved));
        phi[k] = r->image[k]; // the image before, for which the newest changes places
        r->image[k] = next;
        r->residue[k] = moved;
    }
    const double part = square > 0 ? along / square : 0;
    for (size_t k = 0; k < r->size; k++)
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
    halve(r->phi, r->phi_mean, r->size, r->block);
    halve(r->memory, r->memory_mean, r->size, r->block);
}

void relaxation_archive(Relaxation *r, Archive *archive) {
    const size_t size = r->size;
    archive_f64(archive, r->phi, (r->block + 1) * size);
    archive_f64(archive, r->memory, (r->block + 1) * size);
    archive_f64(archive, r->phi_mean, (r->block / 2 + 1) * size);
    archive_f64(archive, r->memory_mean, (r->block / 2 + 1) * size);
}
