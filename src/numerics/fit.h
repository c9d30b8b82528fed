// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares, thin over GSL.
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Line {
    double intercept, slope;
    double misfit; // sum of the squares of what is left of y, times the weights
} Line;

// The straight line through (x, y) with these weights; NULL: all weigh 1.
Line fit_line(const double *x, const double *y, const double *weights, size_t count);

typedef double FitMisfit(double at, const void *of);

// Where the misfit is least, first of `places` evenly from one end to the other, then by Brent's
// method. False if it is least at an end.
bool fit_least(FitMisfit *misfit, const void *of, double from, double to, size_t places,
               double *at);

// `y` are averages over equal bins, side by side. The value, at the near edge of the first, of the
// polynomial of this degree whose averages come closest. BAD_DATA with too few bins.
Status fit_value_at_edge(const double *y, size_t bins, int degree, double *value);

// Where the parabola through (x, y), at least three, has its top or its bottom, and how high it is.
// Returns the factor of x^2: below 0 it is a top.
double fit_parabola_top(const double *x, const double *y, size_t count, double *place,
                        double *height);
