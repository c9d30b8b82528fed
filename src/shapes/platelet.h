// SPDX-License-Identifier: GPL-3.0-or-later
// Platelets, infinitely thin discs, among themselves and with spheres.
//
// Two discs overlap if the chords that they cut from the line common to their planes do (Eppenga
// and Frenkel 1984). With w = u x v along that line, of length sin, centre a is |r.v|/sin away from
// it, and the centres are |r.w|/sin apart along it. Multiplied by sin, nothing is divided by what
// may vanish: parallel planes cut no line, their discs overlap only if they are one plane.
#pragma once

#include "numerics/vector.h"

#include <math.h>
#include <stdbool.h>

// r leads from the centre of the first disc, of normal u, to that of the second, of normal v.
// Touching is no overlap.
static inline bool platelet_overlap(double radius_u, const double u[3], double radius_v,
                                    const double v[3], const double r[3]) {
    double w[3];
    vector_cross(u, v, w);
    const double sine2 = vector_dot(w, w);
    const double ru = vector_dot(r, u), rv = vector_dot(r, v);
    if (sine2 == 0) {
        const double contact = radius_u + radius_v;
        return ru == 0 && vector_dot(r, r) < contact * contact;
    }
    const double chord_u = radius_u * radius_u * sine2 - rv * rv; // (half of it * sin)^2
    const double chord_v = radius_v * radius_v * sine2 - ru * ru;
    if (chord_u <= 0 || chord_v <= 0) return false;
    return fabs(vector_dot(r, w)) < sqrt(chord_u) + sqrt(chord_v);
}

// Square of the distance of the point r from the disc of normal u round the origin.
static inline double platelet_distance2(const double r[3], const double u[3], double radius) {
    const double height = vector_dot(r, u);
    double in_plane2 = 0;
    for (int a = 0; a < 3; a++) {
        const double x = r[a] - height * u[a];
        in_plane2 += x * x;
    }
    const double outside = sqrt(in_plane2) - radius;
    return height * height + (outside > 0 ? outside * outside : 0);
}
