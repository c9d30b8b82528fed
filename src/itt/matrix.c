// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of the species, entry by entry and for all wave vectors at once.
#include "itt/matrix.h"

#include <string.h>

double *matrix_entry(double *matrix, size_t species, size_t size, size_t row, size_t column) {
    return matrix + (row * species + column) * size;
}

const double *matrix_read(const double *matrix, size_t species, size_t size, size_t row,
                          size_t column) {
    return matrix + (row * species + column) * size;
}

void matrix_multiply(size_t species, size_t size, const double *left, const double *right,
                     double *product) {
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++) {
            double *to = matrix_entry(product, species, size, a, b);
            const double *l = matrix_read(left, species, size, a, 0);
            const double *r = matrix_read(right, species, size, 0, b);
            for (size_t k = 0; k < size; k++) to[k] = l[k] * r[k];
            for (size_t e = 1; e < species; e++) {
                l += size;
                r += species * size;
                for (size_t k = 0; k < size; k++) to[k] += l[k] * r[k];
            }
        }
    }
}

// row -= factor pivot, for all entries but that of the pivot's column, which gets -factor/pivot.
static void eliminate(size_t species, size_t size, double *matrix, size_t row, size_t pivot) {
    double *factor = matrix_entry(matrix, species, size, row, pivot);
    for (size_t b = 0; b < species; b++) {
        const double *from = matrix_read(matrix, species, size, pivot, b);
        double *to = matrix_entry(matrix, species, size, row, b);
        if (b == pivot) continue;
        for (size_t k = 0; k < size; k++) to[k] -= factor[k] * from[k];
    }
    const double *inverse = matrix_read(matrix, species, size, pivot, pivot);
    for (size_t k = 0; k < size; k++) factor[k] *= -inverse[k];
}

// Gauss and Jordan's elimination.
void matrix_invert(size_t species, size_t size, double *matrix) {
    for (size_t p = 0; p < species; p++) {
        double *pivot = matrix_entry(matrix, species, size, p, p);
        for (size_t k = 0; k < size; k++) pivot[k] = 1 / pivot[k];
        for (size_t b = 0; b < species; b++) {
            double *entry = matrix_entry(matrix, species, size, p, b);
            for (size_t k = 0; b != p && k < size; k++) entry[k] *= pivot[k];
        }
        for (size_t a = 0; a < species; a++) {
            if (a != p) eliminate(species, size, matrix, a, p);
        }
    }
}
