// SPDX-License-Identifier: GPL-3.0-or-later
// What shapes.def says, as functions.
#include "shapes/shape.h"

#include "base/constants.h"

#include <stddef.h>

// Becomes: "disc", "sphere", NULL
const char *const shape_names[SHAPES + 1] = {
#define SHAPE(ID, name, dimension, densest) #name,
#include "shapes/shapes.def"
#undef SHAPE
    NULL,
};

int shape_dimension(ShapeKind shape) {
    static const int dimensions[SHAPES] = {
#define SHAPE(ID, name, dimension, densest) dimension,
#include "shapes/shapes.def"
#undef SHAPE
    };
    return dimensions[shape];
}

double shape_densest_packing(ShapeKind shape) {
    static const double densest_packing[SHAPES] = {
#define SHAPE(ID, name, dimension, densest) densest,
#include "shapes/shapes.def"
#undef SHAPE
    };
    return densest_packing[shape];
}

static double ball_volume(int dimension, double diameter) {
    return dimension == 2 ? PI / 4 * diameter * diameter : PI / 6 * diameter * diameter * diameter;
}

double shape_volume(ShapeKind shape, double diameter) {
    return ball_volume(shape_dimension(shape), diameter);
}

double shape_second_virial(ShapeKind shape, double a, double b) {
    return ball_volume(shape_dimension(shape), a + b) / 2;
}
