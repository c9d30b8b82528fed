// SPDX-License-Identifier: GPL-3.0-or-later
// Where particles are put at first: the periodic lattice with room for all of them whose nearest
// sites are farthest apart. Triangular or square in 2D; cubic, bcc or fcc in 3D, stretched to fit.
#pragma once

#include "box/box.h"

#include <stddef.h>

typedef struct Lattice {
    int cells[3];   // along each edge
    int basis;      // sites in a cell: 1 simple, 2 centred, 4 face-centred (3D)
    double cell[3]; // edges of a cell, in d
    double nearest; // distance of nearest sites, in d
} Lattice;

Lattice lattice_best(const Box *box, size_t particles);
size_t lattice_sites(const Lattice *lattice);
void lattice_site(const Lattice *lattice, size_t site, double position[3]); // in [0, edge)
