// SPDX-License-Identifier: GPL-3.0-or-later
// Two walks over the half plane of the tilted lattice: one to count, one to choose.
#include "observables/advected_waves.h"

#include "base/constants.h"

#include <math.h>

enum { CELLS_MOST = PLANE_CUTS * OPTION_LIST_SIZE };

double advected_vectors_mean(const AdvectedCells *cells, const Box *box, size_t wave_number) {
    const double low = cells->low[wave_number], high = cells->high[wave_number];
    const double area = acos(cells->cosine) * (high * high - low * low);
    return area * box->edge[0] * box->edge[1] / (4 * PI * PI);
}

// The cell of a wave vector; one past the last where it is in none. No two overlap.
static size_t cell_of(const AdvectedCells *cells, const double q[3]) {
    const double half = sqrt(0.5), length = sqrt(q[0] * q[0] + q[1] * q[1]);
    const double along[PLANE_CUTS] = {q[0], q[1], half * (q[0] + q[1]), half * (q[0] - q[1])};
    size_t k = 0, cut = 0;
    while (k < cells->wave_numbers && !(length >= cells->low[k] && length < cells->high[k])) k++;
    while (cut < PLANE_CUTS && fabs(along[cut]) < length * cells->cosine) cut++;
    return k < cells->wave_numbers && cut < PLANE_CUTS ? cut * cells->wave_numbers + k
                                                       : advected_cells(cells);
}

typedef struct Choice {
    AdvectedVector *vectors;
    double *members;
    double available[CELLS_MOST + 1], seen[CELLS_MOST + 1];
} Choice;

// Number k of n in a cell is taken when floor(k most/n) moves on.
static void choose(const AdvectedCells *cells, Choice *choice, size_t cell, const int32_t n[2]) {
    const double share = fmin(1, (double)cells->most / choice->available[cell]);
    const double before = floor(choice->seen[cell] * share + 1e-9);
    if (!(floor(++choice->seen[cell] * share + 1e-9) > before)) return;
    const size_t at = cell * cells->most + (size_t)choice->members[cell]++;
    choice->vectors[at] = (AdvectedVector){{n[0], n[1]}};
}

static void walk(const AdvectedCells *cells, const Box *box, Choice *choice, bool counting) {
    const double last = cells->high[cells->wave_numbers - 1];
    const int32_t most_x = (int32_t)floor(last * box->edge[0] / (2 * PI));
    for (int32_t x = 0; x <= most_x; x++) {
        const double reach = last * box->edge[1] / (2 * PI), tilt = x * box->offset / box->edge[0];
        const int32_t first = x == 0 ? 1 : (int32_t)ceil(tilt - reach);
        for (int32_t y = first; y <= (int32_t)floor(tilt + reach); y++) {
            const LatticeVector vector = {.n = {x, y, 0}};
            double q[3];
            wave_vector_of(box, &vector, q);
            const size_t cell = cell_of(cells, q);
            if (cell == advected_cells(cells)) continue;
            if (counting)
                choice->available[cell]++;
            else
                choose(cells, choice, cell, vector.n);
        }
    }
}

void advected_waves_choose(const AdvectedCells *cells, const Box *box, AdvectedVector *vectors,
                           double *members) {
    Choice choice = {.vectors = vectors, .members = members};
    for (size_t cell = 0; cell < advected_cells(cells); cell++) members[cell] = 0;
    walk(cells, box, &choice, true);
    walk(cells, box, &choice, false);
}
