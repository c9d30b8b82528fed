// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic space, at rest and sheared (Lees and Edwards 1972): geometry, knows no particles.
// Lengths in d. Flow is along x, its gradient along y.
#pragma once

#include "base/archive.h"

// The images above, in +y, are displaced along x by offset + turns edge[0]: exactly the accumulated
// strain times edge[1], whole edges apart. A particle at (x, y) with image counts n has its images
// at x + n_x edge[0] + n_y (offset + turns edge[0]), y + n_y edge[1].
typedef struct Box {
    int dimension;  // 2 or 3
    double edge[3]; // edge[2] = 1 in two dimensions, so that the volume is an area
    double offset;  // within half an edge[0] of 0
    int64_t turns;
} Box;

// A box of this volume (area in 2D) whose edges are in the ratios `aspect`, at rest.
Box box_of_volume(int dimension, double volume, const double aspect[3]);

double box_volume(const Box *box); // in d^dimension
double box_shortest_edge(const Box *box);
double box_longest_edge(const Box *box);

// Replaces a separation by that of the nearest image: r - L round(r/L) ([T 2.9], corrected), first
// along y, where each edge passed shifts x by the offset.
void box_nearest_image(const Box *box, double separation[3]);

// How far the images above have been displaced in all, in d.
static inline double box_displacement(const Box *box) {
    return box->offset + (double)box->turns * box->edge[0];
}

double box_strain(const Box *box); // accumulated
// Displaces the images above by so much more, less than half an edge[0].
void box_shear(Box *box, double displacement);
// As it leant when its offset and strain were these.
void box_lean(Box *box, double offset, double strain);
bool box_is_rectangular(const Box *box);

// Where a place in the box lies along its edges, of which the second leans over by the offset:
// fractions from 0 to 1, periodic in each of them by itself.
void box_fractions(const Box *box, const double position[3], double fraction[3]);
// By how much wider cells of such fractions must be along x to reach as far as in a box at rest.
double box_widening(const Box *box);

void box_archive(Box *box, Archive *archive); // the strain; edges follow from the system
