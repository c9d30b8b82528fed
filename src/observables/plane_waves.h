// SPDX-License-Identifier: GPL-3.0-or-later
// Wave vectors in the plane (q_x, q_y): all of the reciprocal lattice within a square, sorted into
// its pixels and into cuts through it, wherever the strain of the box has taken them.
#pragma once

#include "observables/wave_vectors.h"

enum { PLANE_CUTS = 4 };
extern const char *const plane_cut_names[PLANE_CUTS + 1]; // x, y, xy, -xy

typedef struct PlaneShape {
    double spacing;     // edge of a pixel
    size_t side;        // pixels along an edge of the picture, an odd number: q = 0 is a centre
    double cut_last;    // largest |q| of a cut
    double cut_spacing; // bin of |q|
    size_t cut_bins;
    double cut_cosine; // of the angle that a cut is wide to either side
} PlaneShape;

double plane_spacing_least(const Box *box); // of pixels none of which is without a vector

// `spacing` 0: three times the least, so that no vector of a box at rest lies on an edge.
PlaneShape plane_shape(const Box *box, double last, double spacing, double cut_spacing,
                       double cut_degrees);
static inline size_t plane_pixels(const PlaneShape *shape) {
    return shape->side * shape->side;
}
static inline double plane_pixel_centre(const PlaneShape *shape, size_t k) {
    return ((double)k - (double)(shape->side / 2)) * shape->spacing;
}

typedef struct PlaneWaves {
    PlaneShape shape;
    size_t count;
    LatticeVector *vector; // [count], of q and -q one, in the order that DensityModes wants
} PlaneWaves;

Status plane_waves_make(PlaneWaves *waves, const Box *box, const PlaneShape *shape);
void plane_waves_clear(PlaneWaves *waves);
size_t plane_waves_count(const Box *box, const PlaneShape *shape);
size_t plane_waves_memory(const Box *box, const PlaneShape *shape); // with DensityModes' tables

// The pixel [side q_x + q_y] and the bin [cut][bin] in which each vector is now; one past the last
// of them where it is in none.
void plane_waves_place(const PlaneWaves *waves, const Box *box, uint32_t *pixel, uint32_t *bin);
