// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes of particles, from shapes.def, and what follows from a shape and its sizes. Lengths in
// d, energies in kT.
#pragma once

#include <stdbool.h>

// Becomes: enum { SHAPE_DISC, SHAPE_SPHERE, ..., SHAPES }
typedef enum ShapeKind {
#define SHAPE(ID, name, dimension, densest, oriented, hard) SHAPE_##ID,
#include "shapes/shapes.def"
#undef SHAPE
    SHAPES
} ShapeKind;

// A shape with its sizes.
typedef struct Body {
    ShapeKind shape;
    double diameter; // of the disc, sphere, platelet; of the caps and the cylinder
    double length;   // of the cylinder, without caps; 0 for other shapes
    double exponent; // of soft spheres: energy kT (d/r)^exponent, d the mean diameter of a pair
} Body;

extern const char *const shape_names[SHAPES + 1]; // NULL-ended
int shape_dimension(ShapeKind shape);
bool shape_is_oriented(ShapeKind shape); // has a body axis
bool shape_is_hard(ShapeKind shape);     // excludes others; else it has an energy

double shape_volume(const Body *body);          // an area in 2D; 0 of an infinitely thin platelet
double shape_densest_packing(const Body *body); // packing fraction of equal particles
double shape_reach(const Body *body);           // diameter of the smallest ball around it

// Second virial coefficient of a pair in the isotropic phase: half the mean excluded volume, in
// d^dim; of soft spheres that of the energy.
double shape_second_virial(const Body *a, const Body *b);
