// SPDX-License-Identifier: GPL-3.0-or-later
// Fourier components of the density, rho(q) = sum over particles of exp(i q.r), on vectors of the
// reciprocal lattice of the box. Strain tilts it: q_y falls by strain q_x, the strain being reduced
// to what the offset of the box is.
#pragma once

#include "base/status.h"
#include "box/box.h"

#include <stddef.h>
#include <stdint.h>

// q = 2 pi (n[0]/L_x, n[1]/L_y - n[0]/L_x offset/L_y, n[2]/L_z).
typedef struct LatticeVector {
    int32_t n[3];
} LatticeVector;

void wave_vector_of(const Box *box, const LatticeVector *vector, double q[3]); // in 1/d

enum { NO_POWER = -1 };

// Particles at a time: their powers of exp(2 pi i x/L) lie in `table` while all vectors are run.
enum { MODES_BLOCK = 64 };

// Those of the powers 0..most of exp(2 pi i x/L) of one axis that the vectors have, x/L along the
// edge of a tilted box: cosine[row][MODES_BLOCK], sine[row][MODES_BLOCK].
typedef struct PowerTable {
    int32_t most;
    int32_t *row;            // [most + 1], where a power is kept; NO_POWER
    double *turns, *present; // [MODES_BLOCK]: x/L, and 1 where there is a particle, else 0
    double *cosine, *sine;
} PowerTable;

typedef struct DensityModes DensityModes;

// Adds the particles that lie in the tables.
typedef void DensityBlock(const DensityModes *modes, double *real, double *imaginary);

struct DensityModes {
    int dimension;
    size_t count;
    const LatticeVector *vectors; // sorted by n[0], then n[1]: neighbours share products
    PowerTable table[3];
    DensityBlock *block; // for this processor
};

// Borrows the vectors; n[0] >= 0 in each.
Status density_modes_create(DensityModes **out, int dimension, const LatticeVector *vectors,
                            size_t count);
void density_modes_free(DensityModes *modes);
size_t density_modes_memory(const int32_t most[3], int dimension);

// Adds rho(q) of particles [begin, end) to real[], imaginary[]. Same bits on every cpu_path.
void density_modes_add(DensityModes *modes, const Box *box, double *const position[3], size_t begin,
                       size_t end, double *real, double *imaginary);

DensityBlock density_block_portable, density_block_avx2, density_block_avx512;
