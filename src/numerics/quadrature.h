// SPDX-License-Identifier: GPL-3.0-or-later
// Points and weights of Gauss-Legendre quadrature, on one interval or on a row of them.
#pragma once

#include <stddef.h>

// `count` points of (from, to), ascending, and their weights.
void quadrature_legendre(size_t count, double from, double to, double *points, double *weights);
