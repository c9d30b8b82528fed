// SPDX-License-Identifier: GPL-3.0-or-later
// Crystals to start from. Internal to packing.
#pragma once

#include "packing/lattice.h"
#include "state/state.h"

// Upright bodies in layers across z, each a plane lattice with room for the largest.
typedef struct Layers {
    int count;      // of layers
    double spacing; // of layers, in d
    Lattice plane;  // of one layer
} Layers;

// BAD_DATA with a sentence if bodies of this diameter and height do not fit.
Status crystal_layers(Layers *layers, const Box *box, size_t particles, double diameter,
                      double height);
size_t crystal_sites(const Layers *layers);
void crystal_site(const Layers *layers, size_t site, double position[3]); // in [0, edge)
