// SPDX-License-Identifier: GPL-3.0-or-later
// What shapes.def says, as functions, and the closed formulas.
#include "shapes/shape.h"

#include "base/constants.h"

#include <math.h>
#include <stddef.h>

// Becomes: "disc", "sphere", ..., NULL
const char *const shape_names[SHAPES + 1] = {
#define SHAPE(ID, name, dimension, densest, oriented, hard) name,
#include "shapes/shapes.def"
#undef SHAPE
    NULL,
};

int shape_dimension(ShapeKind shape) {
    static const int dimensions[SHAPES] = {
#define SHAPE(ID, name, dimension, densest, oriented, hard) dimension,
#include "shapes/shapes.def"
#undef SHAPE
    };
    return dimensions[shape];
}

bool shape_is_oriented(ShapeKind shape) {
    static const bool are_oriented[SHAPES] = {
#define SHAPE(ID, name, dimension, densest, oriented, hard) oriented,
#include "shapes/shapes.def"
#undef SHAPE
    };
    return are_oriented[shape];
}

bool shape_is_hard(ShapeKind shape) {
    static const bool are_hard[SHAPES] = {
#define SHAPE(ID, name, dimension, densest, oriented, hard) hard,
#include "shapes/shapes.def"
#undef SHAPE
    };
    return are_hard[shape];
}

static double cubed(double x) {
    return x * x * x;
}

static double ball_volume(int dimension, double diameter) {
    return dimension == 2 ? PI / 4 * diameter * diameter : PI / 6 * cubed(diameter);
}

double shape_volume(const Body *body) {
    if (body->shape == SHAPE_PLATELET) return 0;
    const double d = body->diameter;
    return ball_volume(shape_dimension(body->shape), d) + PI / 4 * d * d * body->length;
}

// Parallel spherocylinders in close-packed layers: 2/(sqrt 2 + sqrt 3 L/d) of them in d^3.
double shape_densest_packing(const Body *body) {
    static const double of_kind[SHAPES] = {
#define SHAPE(ID, name, dimension, densest, oriented, hard) densest,
#include "shapes/shapes.def"
#undef SHAPE
    };
    if (body->shape != SHAPE_SPHEROCYLINDER) return of_kind[body->shape];
    const double d = body->diameter;
    return shape_volume(body) * 2 / (cubed(d) * (sqrt(2) + sqrt(3) * body->length / d));
}

double shape_reach(const Body *body) {
    return body->diameter + body->length;
}

static double surface(const Body *body) {
    if (body->shape == SHAPE_PLATELET) return PI / 2 * body->diameter * body->diameter; // two sides
    return PI * body->diameter * (body->diameter + body->length);
}

// Mean curvature integrated over the surface.
static double curvature(const Body *body) {
    if (body->shape == SHAPE_PLATELET) return PI * PI / 2 * body->diameter;
    return 2 * PI * body->diameter + PI * body->length;
}

// Of convex bodies in all orientations (Isihara 1950, Kihara 1953); in 2D with the perimeters.
static double excluded_volume(const Body *a, const Body *b) {
    const double own = shape_volume(a) + shape_volume(b);
    if (shape_dimension(a->shape) == 2) return own + PI / 2 * a->diameter * b->diameter;
    return own + (surface(a) * curvature(b) + surface(b) * curvature(a)) / (4 * PI);
}

// 2 pi integral of (1 - exp(-(d/r)^n)) r^2 dr.
static double soft_second_virial(const Body *a, const Body *b) {
    const double d = (a->diameter + b->diameter) / 2;
    return 2 * PI / 3 * cubed(d) * tgamma(1 - 3 / a->exponent);
}

double shape_second_virial(const Body *a, const Body *b) {
    if (!shape_is_hard(a->shape)) return soft_second_virial(a, b);
    return excluded_volume(a, b) / 2;
}
