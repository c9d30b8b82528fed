// SPDX-License-Identifier: GPL-3.0-or-later
// Fourier components of the density: powers of one exponential per particle and axis by
// recurrence, block by block.
#include "observables/density_modes.h"

#include "base/constants.h"
#include "base/cpu.h"
#include "base/memory.h"
#include "numerics/turn.h"

#include <stdlib.h>
#include <string.h>

void wave_vector_of(const Box *box, const LatticeVector *vector, double q[3]) {
    for (int a = 0; a < 3; a++) {
        q[a] = a < box->dimension ? 2 * PI * vector->n[a] / box->edge[a] : 0;
    }
    q[1] -= q[0] * (box->offset / box->edge[1]);
}

// Which powers of an axis are kept, and in how many rows.
static Status lay_out_powers(DensityModes *modes, int axis, size_t *rows) {
    PowerTable *table = &modes->table[axis];
    for (size_t v = 0; v < modes->count; v++) {
        const int32_t n = abs(modes->vectors[v].n[axis]);
        if (n > table->most) table->most = n;
    }
    TRY(NEW_ARRAY(table->row, (size_t)table->most + 1));
    for (int32_t n = 0; n <= table->most; n++) table->row[n] = NO_POWER;
    for (size_t v = 0; v < modes->count; v++) {
        int32_t *row = &table->row[abs(modes->vectors[v].n[axis])];
        if (*row == NO_POWER) *row = (int32_t)(*rows)++;
    }
    return OK;
}

static Status allocate(DensityModes *modes) {
    for (int a = 0; a < modes->dimension; a++) {
        PowerTable *table = &modes->table[a];
        size_t rows = 0;
        TRY(lay_out_powers(modes, a, &rows));
        TRY(NEW_ARRAY(table->turns, MODES_BLOCK));
        TRY(NEW_ARRAY(table->present, MODES_BLOCK));
        TRY(NEW_ARRAY(table->cosine, rows * MODES_BLOCK));
        TRY(NEW_ARRAY(table->sine, rows * MODES_BLOCK));
    }
    return OK;
}

Status density_modes_create(DensityModes **out, int dimension, const LatticeVector *vectors,
                            size_t count) {
    static DensityBlock *const kernels[CPU_PATHS] = {density_block_portable, density_block_avx2,
                                                     density_block_avx512};
    DensityModes *modes = NULL;
    TRY(NEW(modes));
    *modes = (DensityModes){
        .dimension = dimension, .count = count, .vectors = vectors, .block = kernels[cpu_path()]};
    const Status status = allocate(modes);
    if (status != OK) {
        density_modes_free(modes);
        return status;
    }
    *out = modes;
    return OK;
}

void density_modes_free(DensityModes *modes) {
    if (!modes) return;
    for (int a = 0; a < 3; a++) {
        memory_free(modes->table[a].row);
        memory_free(modes->table[a].turns);
        memory_free(modes->table[a].present);
        memory_free(modes->table[a].cosine);
        memory_free(modes->table[a].sine);
    }
    memory_free(modes);
}

size_t density_modes_memory(const int32_t most[3], int dimension) {
    size_t bytes = sizeof(DensityModes);
    for (int a = 0; a < dimension; a++) {
        const size_t rows = (size_t)most[a] + 1; // at most
        bytes += 2 * MODES_BLOCK * (1 + rows) * sizeof(double) + rows * sizeof(int32_t);
    }
    return bytes;
}

// Fractions along the edges of the tilted box.
static void lean(const DensityModes *modes, const Box *box) {
    const double tilt = box->offset / box->edge[0];
    double *x = modes->table[0].turns;
    const double *y = modes->table[1].turns;
    for (size_t lane = 0; lane < MODES_BLOCK; lane++) x[lane] -= tilt * y[lane];
}

// Fractions of one axis; of columns without a particle 0.
static void take_in(const PowerTable *table, const double *position, size_t count, double edge) {
    for (size_t lane = 0; lane < count; lane++) table->present[lane] = 1;
    for (size_t lane = count; lane < MODES_BLOCK; lane++)
        table->present[lane] = table->turns[lane] = 0;
    memcpy(table->turns, position, count * sizeof *position);
    Lanes *turns = (Lanes *)table->turns;
    for (size_t k = 0; k < MODES_BLOCK / LANES; k++) turns[k] /= edge;
}

void density_modes_add(DensityModes *modes, const Box *box, double *const position[3], size_t begin,
                       size_t end, double *real, double *imaginary) {
    for (size_t block = begin; block < end; block += MODES_BLOCK) {
        const size_t count = end - block < MODES_BLOCK ? end - block : MODES_BLOCK;
        for (int a = 0; a < modes->dimension; a++)
            take_in(&modes->table[a], position[a] + block, count, box->edge[a]);
        lean(modes, box);
        modes->block(modes, real, imaginary);
    }
}
