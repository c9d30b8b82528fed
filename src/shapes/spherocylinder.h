// SPDX-License-Identifier: GPL-3.0-or-later
// Spherocylinders, and spheres as those without length: two overlap if the segments in their
// middles are nearer than the mean of their diameters.
//
// The shortest distance of two segments (Vega and Lago 1994): the nearest points of the two lines,
// brought back into the segments. Exact in every degenerate case, to the rounding of the lengths:
// where the lines are parallel and their nearest points are lost in it, any point that is taken
// for the first line's is as good, because the distance along a common valley is the same.
#pragma once

#include "numerics/vector.h"

#include <math.h>
#include <stdbool.h>

static inline double spherocylinder_within(double x, double half_length) {
    return x < -half_length ? -half_length : x > half_length ? half_length : x;
}

// Square of the shortest distance of the segments s u, |s| <= half_u, and r + t v, |t| <= half_v;
// u and v of length 1.
static inline double spherocylinder_distance2(const double r[3], const double u[3], double half_u,
                                              const double v[3], double half_v) {
    double w[3], rxv[3];
    vector_cross(u, v, w);
    vector_cross(r, v, rxv);
    const double ru = vector_dot(r, u), rv = vector_dot(r, v), uv = vector_dot(u, v);
    const double sine2 = vector_dot(w, w);
    const double nearest = sine2 > 0 ? vector_dot(rxv, w) / sine2 : 0; // on the line of u
    const double s = spherocylinder_within(nearest, half_u);
    const double t = spherocylinder_within(s * uv - rv, half_v);
    const double again =
        spherocylinder_within(t * uv + ru, half_u); // = s unless t was brought back
    double distance2 = 0;
    for (int a = 0; a < 3; a++) {
        const double x = r[a] + t * v[a] - again * u[a];
        distance2 += x * x;
    }
    return distance2;
}

// r leads from the centre of the first body, of axis u, to that of the second, of axis v. Touching
// is no overlap.
static inline bool spherocylinder_overlap(double diameter_u, const double u[3], double length_u,
                                          double diameter_v, const double v[3], double length_v,
                                          const double r[3]) {
    const double contact = (diameter_u + diameter_v) / 2;
    return spherocylinder_distance2(r, u, length_u / 2, v, length_v / 2) < contact * contact;
}
