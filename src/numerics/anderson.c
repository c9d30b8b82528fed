// SPDX-License-Identifier: GPL-3.0-or-later
// Anderson, J. ACM 12, 547 (1965), as least squares in the differences of residuals.
#include "numerics/anderson.h"

#include "base/memory.h"

#include <gsl/gsl_linalg.h>

#include <string.h>

static const double RIDGE = 1e-13; // of the normal equations, relative: differences may be parallel

struct Anderson {
    size_t size, depth, count;        // of iterations seen since the start
    double *x, *residual;             // the last
    double *x_steps, *residual_steps; // [depth][size], in turns
    double *newest;
};

Status anderson_create(Anderson **out, size_t size, size_t depth) {
    Anderson *a = NULL;
    *out = NULL;
    TRY(NEW(a));
    a->size = size;
    a->depth = depth;
    Status status = NEW_ARRAY(a->x, size);
    if (status == OK) status = NEW_ARRAY(a->residual, size);
    if (status == OK) status = NEW_ARRAY(a->newest, size);
    if (status == OK) status = NEW_ARRAY(a->x_steps, depth * size);
    if (status == OK) status = NEW_ARRAY(a->residual_steps, depth * size);
    if (status != OK) anderson_free(a);
    *out = status == OK ? a : NULL;
    return status;
}

void anderson_free(Anderson *a) {
    if (!a) return;
    memory_free(a->x);
    memory_free(a->residual);
    memory_free(a->newest);
    memory_free(a->x_steps);
    memory_free(a->residual_steps);
    memory_free(a);
}

void anderson_restart(Anderson *a) {
    a->count = 0;
}

static double product(const double *a, const double *b, size_t size) {
    double sum = 0;
    for (size_t i = 0; i < size; i++) sum += a[i] * b[i];
    return sum;
}

// The steps that lead here from the last iteration, in place of the oldest.
static void record(Anderson *a, const double *x) {
    if (a->count > 0) {
        const size_t slot = (a->count - 1) % a->depth * a->size;
        for (size_t i = 0; i < a->size; i++) {
            a->x_steps[slot + i] = x[i] - a->x[i];
            a->residual_steps[slot + i] = a->newest[i] - a->residual[i];
        }
    }
    memcpy(a->x, x, a->size * sizeof *x);
    memcpy(a->residual, a->newest, a->size * sizeof *x);
    a->count++;
}

static void solve(const Anderson *a, size_t steps, double *weights) {
    gsl_matrix *gram = gsl_matrix_alloc(steps, steps);
    gsl_vector *right = gsl_vector_alloc(steps);
    for (size_t i = 0; i < steps; i++) {
        const double *row = a->residual_steps + i * a->size;
        gsl_vector_set(right, i, product(row, a->newest, a->size));
        for (size_t j = 0; j <= i; j++) {
            const double value = product(row, a->residual_steps + j * a->size, a->size);
            gsl_matrix_set(gram, i, j, value);
            gsl_matrix_set(gram, j, i, value);
        }
    }
    double trace = 0;
    for (size_t i = 0; i < steps; i++) trace += gsl_matrix_get(gram, i, i);
    for (size_t i = 0; i < steps; i++) *gsl_matrix_ptr(gram, i, i) += RIDGE * trace + 1e-300;
    gsl_linalg_cholesky_decomp1(gram);
    gsl_linalg_cholesky_svx(gram, right);
    for (size_t i = 0; i < steps; i++) weights[i] = gsl_vector_get(right, i);
    gsl_matrix_free(gram);
    gsl_vector_free(right);
}

void anderson_mix(Anderson *a, double *x, const double *image) {
    double weights[64] = {0};
    for (size_t i = 0; i < a->size; i++) a->newest[i] = image[i] - x[i];
    record(a, x);
    const size_t steps = a->count - 1 < a->depth ? a->count - 1 : a->depth;
    if (steps > 0) solve(a, steps, weights);
    memcpy(x, image, a->size * sizeof *x);
    for (size_t s = 0; s < steps; s++) {
        for (size_t i = 0; i < a->size; i++)
            x[i] -= weights[s] * (a->x_steps[s * a->size + i] + a->residual_steps[s * a->size + i]);
    }
}
