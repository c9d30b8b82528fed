// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of a few species at one wave number: products and inverses, row by row in plain arrays.
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { SMALL_MOST = 8 };
typedef double SmallMatrix[SMALL_MOST][SMALL_MOST];

void small_multiply(size_t n, SmallMatrix a, SmallMatrix b, SmallMatrix product);
// False if the matrix has no inverse.
bool small_invert(size_t n, SmallMatrix a, SmallMatrix inverse);
// Whether a symmetric matrix has positive eigenvalues only.
bool small_is_positive(size_t n, SmallMatrix a);
