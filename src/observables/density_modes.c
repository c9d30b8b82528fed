// SPDX-License-Identifier: GPL-3.0-or-later
// Fourier components of the density: powers of one exponential per particle and axis by
// recurrence, block by block.
#include "observables/density_modes.h"

#include "base/constants.h"
#include "base/cpu.h"
#include "base/memory.h"

#include <stdbool.h>
#include <stdlib.h>

void wave_vector_of(const Box *box, const LatticeVector *vector, double q[3]) {
    for (int a = 0; a < 3; a++) {
        q[a] = a < box->dimension ? 2 * PI * vector->n[a] / box->edge[a] : 0;
    }
    q[1] -= q[0] * (box->offset / box->edge[1]);
}

static size_t table_size(int32_t most) {
    return ((size_t)most + 1) * MODES_BLOCK;
}

static Status allocate(DensityModes *modes) {
    for (int a = 0; a < modes->dimension; a++) {
        PowerTable *table = &modes->table[a];
        for (size_t v = 0; v < modes->count; v++) {
            const int32_t n = abs(modes->vectors[v].n[a]);
            if (n > table->most) table->most = n;
        }
        TRY(NEW_ARRAY(table->turns, MODES_BLOCK));
        TRY(NEW_ARRAY(table->present, MODES_BLOCK));
        TRY(NEW_ARRAY(table->cosine, table_size(table->most)));
        TRY(NEW_ARRAY(table->sine, table_size(table->most)));
    }
    return OK;
}

Status density_modes_create(DensityModes **out, int dimension, const LatticeVector *vectors,
                            size_t count) {
    DensityModes *modes = NULL;
    TRY(NEW(modes));
    *modes = (DensityModes){.dimension = dimension, .count = count, .vectors = vectors};
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
        memory_free(modes->table[a].turns);
        memory_free(modes->table[a].present);
        memory_free(modes->table[a].cosine);
        memory_free(modes->table[a].sine);
    }
    memory_free(modes);
}

size_t density_modes_memory(const int32_t most[3], int dimension) {
    size_t bytes = sizeof(DensityModes);
    for (int a = 0; a < dimension; a++)
        bytes += 2 * (MODES_BLOCK + table_size(most[a])) * sizeof(double);
    return bytes;
}

static void add_block(const DensityModes *modes, double *real, double *imaginary) {
    static void (*const kernels[CPU_PATHS])(const DensityModes *, double *, double *) = {
        density_block_portable, density_block_avx2, density_block_avx512};
    kernels[cpu_path()](modes, real, imaginary);
}

// Fractions along the edges of the tilted box.
static void lean(const DensityModes *modes, const Box *box) {
    const double tilt = box->offset / box->edge[0];
    double *x = modes->table[0].turns;
    const double *y = modes->table[1].turns;
    for (size_t lane = 0; lane < MODES_BLOCK; lane++) x[lane] -= tilt * y[lane];
}

void density_modes_add(DensityModes *modes, const Box *box, double *const position[3], size_t begin,
                       size_t end, double *real, double *imaginary) {
    for (size_t block = begin; block < end; block += MODES_BLOCK) {
        for (int a = 0; a < modes->dimension; a++) {
            const PowerTable *table = &modes->table[a];
            for (size_t lane = 0; lane < MODES_BLOCK; lane++) {
                const bool present = block + lane < end;
                table->present[lane] = present;
                table->turns[lane] = present ? position[a][block + lane] / box->edge[a] : 0;
            }
        }
        lean(modes, box);
        add_block(modes, real, imaginary);
    }
}
