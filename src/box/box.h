// SPDX-License-Identifier: GPL-3.0-or-later
// The periodic box: geometry of space, knows no particles. Lengths in d.
#pragma once

typedef struct Box {
    int dimension;  // 2 or 3
    double edge[3]; // edge[2] = 1 in two dimensions, so that the volume is an area
} Box;

// A box of this volume (area in 2D) whose edges are in the ratios `aspect`.
Box box_of_volume(int dimension, double volume, const double aspect[3]);

double box_volume(const Box *box); // in d^dimension

// Replaces a separation by that of the nearest image: r - L round(r/L) ([T 2.9], corrected).
void box_nearest_image(const Box *box, double separation[3]);
