// SPDX-License-Identifier: GPL-3.0-or-later
// Wave vectors q = spacing (i, j) up to a cutoff |q|, and what shear does to them. Fields on them
// are even under q -> -q, so the half plane i >= 0 is kept: a column for each i, its rows
// j = -half[i]..half[i] one after the other, with zeros at both ends for readings between rows.
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct Plane {
    double spacing, cutoff;
    int last;      // the largest i, and j
    size_t size;   // numbers in a field, the zeros between columns included
    int *half;     // [last + 1]
    size_t *start; // [last + 1]: where row j = 0 of a column lies
    double *x, *y; // [size]: components of q, 0 between columns
    double *area;  // [size]: of the plane, for integrals over d^2q/(2 pi)^2; that of -q included
} Plane;

Status plane_create(Plane **out, double cutoff, double spacing);
void plane_free(Plane *plane);

// sum[q] += part[q] field[q_x, q_y - strain q_x]: a field read at advected wave vectors (Weysser,
// thesis, eq. 5.9), by cubic interpolation along the columns; zero beyond the cutoff. `count` parts
// and sums, one after the other, for one reading.
void plane_add_advected(const Plane *plane, double strain, const double *field, const double *part,
                        double *sum, size_t count);

size_t plane_place(const Plane *plane, int i, int j); // of q = spacing (i, j), i >= 0, in a field

// A field between the wave vectors, q_x of any sign, by cubics along both axes.
double plane_read(const Plane *plane, const double *field, double x, double y);
