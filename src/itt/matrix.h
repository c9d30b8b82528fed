// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of the species at all wave vectors: a field for each entry, [row][column][size]. Inside
// itt/ only.
#pragma once

#include <stddef.h>

double *matrix_entry(double *matrix, size_t species, size_t size, size_t row, size_t column);
const double *matrix_read(const double *matrix, size_t species, size_t size, size_t row,
                          size_t column);

void matrix_multiply(size_t species, size_t size, const double *left, const double *right,
                     double *product);
// In place and without pivots: the leading minors must not vanish, as those of positive matrices
// and of such with their rows scaled.
void matrix_invert(size_t species, size_t size, double *matrix);
