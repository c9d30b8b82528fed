// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of a few species: Gauss-Jordan with pivots, Cholesky as a test of the sign.
#include "numerics/small.h"

#include <math.h>
#include <string.h>

void small_multiply(size_t n, SmallMatrix a, SmallMatrix b, SmallMatrix product) {
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            double sum = 0;
            for (size_t k = 0; k < n; k++) sum += a[i][k] * b[k][j];
            product[i][j] = sum;
        }
    }
}

static size_t pivot_row(size_t n, SmallMatrix a, size_t column) {
    size_t best = column;
    for (size_t i = column + 1; i < n; i++) {
        if (fabs(a[i][column]) > fabs(a[best][column])) best = i;
    }
    return best;
}

static void swap_rows(size_t n, SmallMatrix a, size_t i, size_t j) {
    for (size_t k = 0; k < n; k++) {
        const double kept = a[i][k];
        a[i][k] = a[j][k];
        a[j][k] = kept;
    }
}

static void eliminate(size_t n, SmallMatrix work, SmallMatrix inverse, size_t column) {
    const double scale = 1 / work[column][column];
    for (size_t k = 0; k < n; k++) {
        work[column][k] *= scale;
        inverse[column][k] *= scale;
    }
    for (size_t i = 0; i < n; i++) {
        const double factor = work[i][column];
        if (i == column || factor == 0) continue;
        for (size_t k = 0; k < n; k++) {
            work[i][k] -= factor * work[column][k];
            inverse[i][k] -= factor * inverse[column][k];
        }
    }
}

bool small_invert(size_t n, SmallMatrix a, SmallMatrix inverse) {
    if (n == 1) {
        inverse[0][0] = 1 / a[0][0];
        return isfinite(inverse[0][0]);
    }
    SmallMatrix work;
    memcpy(work, a, sizeof work);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) inverse[i][j] = i == j;
    }
    for (size_t column = 0; column < n; column++) {
        const size_t row = pivot_row(n, work, column);
        if (!(fabs(work[row][column]) > 0)) return false;
        swap_rows(n, work, row, column);
        swap_rows(n, inverse, row, column);
        eliminate(n, work, inverse, column);
    }
    return true;
}

bool small_is_positive(size_t n, SmallMatrix a) {
    SmallMatrix lower;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = a[i][j];
            for (size_t k = 0; k < j; k++) sum -= lower[i][k] * lower[j][k];
            if (i == j && !(sum > 0)) return false;
            lower[i][j] = i == j ? sqrt(sum) : sum / lower[j][j];
        }
    }
    return true;
}
