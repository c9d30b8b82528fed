// SPDX-License-Identifier: GPL-3.0-or-later
// Wave vectors that go with the flow, q(t) = (q_x, q_y - strain q_x) (Weysser, thesis, eq. 5.8), in
// cells: around each wave number and along x, y and the diagonals of the plane of flow and
// gradient. The lattice of the box tilts, so that every time origin chooses vectors anew, from the
// lattice as it is then; on it they stay wherever the flow takes them.
#pragma once

#include "observables/plane_waves.h"

// Cells [direction][wave number].
typedef struct AdvectedCells {
    size_t wave_numbers;
    double low[OPTION_LIST_SIZE], high[OPTION_LIST_SIZE]; // of |q|, ascending, side by side or not
    double cosine; // of the angle that a cell is wide to either side
    size_t most;   // vectors in a cell
} AdvectedCells;

// One chosen vector, of q and -q one.
typedef struct AdvectedVector {
    double n[2]; // in the lattice of the origin
} AdvectedVector;

static inline size_t advected_cells(const AdvectedCells *cells) {
    return PLANE_CUTS * cells->wave_numbers;
}

// Vectors of the lattice of a box at rest that a cell has on average.
double advected_vectors_mean(const AdvectedCells *cells, const Box *box, size_t wave_number);

// vectors[cell][most], of which the first members[cell] are there. An even choice of those that lie
// in the cell.
void advected_waves_choose(const AdvectedCells *cells, const Box *box, AdvectedVector *vectors,
                           double *members);

// The vector on the lattice of now, in turns of the fractions along the edges of the box
// (box_fractions), if it was chosen when the box had made so many turns.
static inline AdvectedVector advected_vector_now(const AdvectedVector *then, double turns,
                                                 const Box *box) {
    return (AdvectedVector){{then->n[0], then->n[1] - ((double)box->turns - turns) * then->n[0]}};
}
