// SPDX-License-Identifier: GPL-3.0-or-later
// Wave numbers and radii of mode-coupling theory, where integrals over them are spectrally
// accurate: zeros of the Bessel function J0 in two dimensions, multiples of pi in three. Inside
// mct/ only.
#pragma once

#include "base/status.h"

#include <stddef.h>

enum { GRID_ORDERS = 3 }; // Bessel functions of order 0, 1, 2, spherical ones in three dimensions

typedef struct Grid {
    int dimension;
    size_t count;              // of wave numbers k_m, the last of which is the cutoff
    size_t stride;             // count rounded up to whole vectors; what lies beyond count is zero
    size_t radii;              // of r_n, up to half the period in space
    const struct Lines *lines; // the inner loops for this processor
    double *wave_number;       // [stride]
    double *k_weight;          // [stride]: sum_m k_weight f(k_m) is the integral of f d^dk/(2 pi)^d
    double *r_weight;          // [radii]: likewise of f d^dr, over the sphere of directions
    double *table[GRID_ORDERS]; // [radii][stride]: J_order(k_m r_n)
} Grid;

Status grid_create(Grid **out, int dimension, size_t count, double last);
void grid_free(Grid *grid);
