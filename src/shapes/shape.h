// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes of hard particles, from shapes.def. Lengths in d.
#pragma once

// Becomes: enum { SHAPE_DISC, SHAPE_SPHERE, SHAPES }
typedef enum ShapeKind {
#define SHAPE(ID, name, dimension, densest) SHAPE_##ID,
#include "shapes/shapes.def"
#undef SHAPE
    SHAPES
} ShapeKind;

extern const char *const shape_names[SHAPES + 1]; // NULL-ended
int shape_dimension(ShapeKind shape);
double shape_densest_packing(ShapeKind shape);         // packing fraction of equal particles
double shape_volume(ShapeKind shape, double diameter); // an area in 2D

// Second virial coefficient of the pair of diameters a and b: half the excluded volume, in d^dim.
double shape_second_virial(ShapeKind shape, double a, double b);
