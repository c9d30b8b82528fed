// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares, thin over GSL.
#pragma once

#include "base/status.h"

#include <stddef.h>

// Slope of the straight line through (x, y) with weights w.
double fit_slope(const double *x, const double *y, const double *weights, size_t count);

// `y` are averages over equal bins, side by side. The value, at the near edge of the first, of the
// polynomial of this degree whose averages come closest. BAD_DATA with too few bins.
Status fit_value_at_edge(const double *y, size_t bins, int degree, double *value);

// Where the parabola through (x, y), at least three, has its top or its bottom, and how high it is.
void fit_parabola_top(const double *x, const double *y, size_t count, double *place,
                      double *height);
