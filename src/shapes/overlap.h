// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two hard bodies in space overlap, whatever they are.
#pragma once

#include "shapes/platelet.h"
#include "shapes/shape.h"
#include "shapes/spherocylinder.h"

// Whether overlap_of knows this pair: not platelets with spherocylinders, nor anything soft.
static inline bool overlap_is_known(ShapeKind a, ShapeKind b) {
    if (shape_dimension(a) != 3 || shape_dimension(b) != 3) return false;
    if (!shape_is_hard(a) || !shape_is_hard(b)) return false;
    const bool rod = a == SHAPE_SPHEROCYLINDER || b == SHAPE_SPHEROCYLINDER;
    const bool platelet = a == SHAPE_PLATELET || b == SHAPE_PLATELET;
    return !(rod && platelet);
}

// r leads from the centre of a, whose axis is u, to that of b, whose axis is v; a sphere needs
// none. Touching is no overlap.
static inline bool overlap_of(const Body *a, const double u[3], const Body *b, const double v[3],
                              const double r[3]) {
    const bool a_is_flat = a->shape == SHAPE_PLATELET, b_is_flat = b->shape == SHAPE_PLATELET;
    if (a_is_flat && b_is_flat) {
        return platelet_overlap(a->diameter / 2, u, b->diameter / 2, v, r);
    }
    if (a_is_flat) {
        return platelet_distance2(r, u, a->diameter / 2) < b->diameter * b->diameter / 4;
    }
    if (b_is_flat) {
        return platelet_distance2(r, v, b->diameter / 2) < a->diameter * a->diameter / 4;
    }
    return spherocylinder_overlap(a->diameter, u, a->length, b->diameter, v, b->length, r);
}
