// SPDX-License-Identifier: GPL-3.0-or-later
// Wave numbers k_m = j_m/R and radii r_n = j_n/K' with j_m the zeros of J0 (multiples of pi in
// three dimensions). Products of two functions with wave numbers up to K have some up to 2 K; K' =
// 3 K/2 keeps what is folded back out of the wave numbers that are used.
#include "mct/grid.h"

#include "base/constants.h"
#include "base/memory.h"
#include "mct/lines.h"

#include <gsl/gsl_sf_bessel.h>

#include <math.h>

static double zero(int dimension, size_t index) {
    return dimension == 2 ? gsl_sf_bessel_zero_J0((unsigned)index) : PI * (double)index;
}

static double bessel(int dimension, int order, double x) {
    return dimension == 2 ? jn(order, x) : gsl_sf_bessel_jl(order, x);
}

// Of the quadrature of x^(d-1) f(x) at the zeros, scaled by `range`.
static double weight(int dimension, double zero_at, double range) {
    if (dimension == 3) return pow(zero_at / range, 2) * PI / range;
    return 2 / pow(range * j1(zero_at), 2);
}

static void fill(Grid *grid, double range, double band) {
    const int d = grid->dimension;
    const double circle = d == 2 ? 2 * PI : 4 * PI;
    for (size_t m = 0; m < grid->count; m++) {
        const double at = zero(d, m + 1);
        grid->wave_number[m] = at / range;
        grid->k_weight[m] = circle / pow(2 * PI, d) * weight(d, at, range);
    }
    for (size_t n = 0; n < grid->radii; n++) {
        const double at = zero(d, n + 1);
        grid->r_weight[n] = circle * weight(d, at, band);
        for (int order = 0; order < GRID_ORDERS; order++) {
            for (size_t m = 0; m < grid->count; m++)
                grid->table[order][n * grid->stride + m] =
                    bessel(d, order, grid->wave_number[m] * at / band);
        }
    }
}

Status grid_create(Grid **out, int dimension, size_t count, double last) {
    Grid *grid = NULL;
    TRY(NEW(grid));
    grid->dimension = dimension;
    grid->count = count;
    grid->lines = lines();
    grid->stride = lines_stride(count);
    const double range = zero(dimension, count) / last;
    const double band = 1.5 * zero(dimension, count + 1) / range;
    while (zero(dimension, grid->radii + 1) < band * range) grid->radii++;
    Status status = NEW_ARRAY(grid->wave_number, grid->stride);
    if (status == OK) status = NEW_ARRAY(grid->k_weight, grid->stride);
    if (status == OK) status = NEW_ARRAY(grid->r_weight, grid->radii);
    for (int order = 0; order < GRID_ORDERS && status == OK; order++)
        status = NEW_ARRAY(grid->table[order], grid->radii * grid->stride);
    if (status == OK)
        fill(grid, range, band);
    else
        grid_free(grid);
    *out = status == OK ? grid : NULL;
    return status;
}

void grid_free(Grid *grid) {
    if (!grid) return;
    memory_free(grid->wave_number);
    memory_free(grid->k_weight);
    memory_free(grid->r_weight);
    for (int order = 0; order < GRID_ORDERS; order++) memory_free(grid->table[order]);
    memory_free(grid);
}
