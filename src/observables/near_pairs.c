// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs within a range, by cells.
#include "observables/near_pairs.h"

#include "base/memory.h"

#include <math.h>

static size_t cell_count(const int64_t number[3]) {
    return (size_t)number[0] * (size_t)number[1] * (size_t)number[2];
}

// More cells than particles would only cost time.
static void choose_cells(int64_t number[3], const Box *box, size_t count, double range) {
    const double most = box->dimension == 2 ? sqrt((double)count) : cbrt((double)count);
    for (int a = 0; a < 3; a++) {
        const double fit = a < box->dimension ? fmin(box->edge[a] / range, most + 1) : 1;
        number[a] = fit < 1 ? 1 : (int64_t)fit;
    }
}

static Status allocate(NearPairs *pairs) {
    TRY(NEW_ARRAY(pairs->first, cell_count(pairs->number) + 1));
    TRY(NEW_ARRAY(pairs->particle, pairs->count));
    for (int a = 0; a < 3; a++) TRY(NEW_ARRAY(pairs->position[a], pairs->count));
    TRY(NEW_ARRAY(pairs->square, pairs->count));
    TRY(NEW_ARRAY(pairs->partner, pairs->count));
    return OK;
}

Status near_pairs_create(NearPairs **out, const Box *box, size_t count, double range) {
    NearPairs *pairs = NULL;
    TRY(NEW(pairs));
    pairs->box = *box;
    pairs->count = count;
    choose_cells(pairs->number, box, count, range);
    const Status status = allocate(pairs);
    if (status != OK) {
        near_pairs_free(pairs);
        return status;
    }
    *out = pairs;
    return OK;
}

void near_pairs_free(NearPairs *pairs) {
    if (!pairs) return;
    memory_free(pairs->first);
    memory_free(pairs->particle);
    for (int a = 0; a < 3; a++) memory_free(pairs->position[a]);
    memory_free(pairs->square);
    memory_free(pairs->partner);
    memory_free(pairs);
}

size_t near_pairs_memory(const System *system, double range) {
    const Box box = system_box(system);
    int64_t number[3];
    choose_cells(number, &box, (size_t)system->particles, range);
    return sizeof(NearPairs) + cell_count(number) * sizeof(size_t) +
           (size_t)system->particles * (3 * sizeof(size_t) + 4 * sizeof(double));
}

static size_t cell_at(const NearPairs *pairs, const int64_t at[3]) {
    return (size_t)((at[2] * pairs->number[1] + at[1]) * pairs->number[0] + at[0]);
}

static size_t cell_of(const NearPairs *pairs, const double position[3]) {
    int64_t at[3] = {0, 0, 0};
    for (int a = 0; a < pairs->box.dimension; a++) {
        at[a] = (int64_t)(position[a] / pairs->box.edge[a] * (double)pairs->number[a]);
        if (at[a] >= pairs->number[a]) at[a] = pairs->number[a] - 1;
    }
    return cell_at(pairs, at);
}

void near_pairs_sort(NearPairs *pairs, const State *state) {
    const size_t cells = cell_count(pairs->number);
    size_t *cell = pairs->partner; // free between rows
    for (size_t c = 0; c <= cells; c++) pairs->first[c] = 0;
    for (size_t i = 0; i < pairs->count; i++) {
        const double r[3] = {state->position[0][i], state->position[1][i], state->position[2][i]};
        cell[i] = cell_of(pairs, r);
        pairs->first[cell[i] + 1]++;
    }
    for (size_t c = 0; c < cells; c++) pairs->first[c + 1] += pairs->first[c];
    for (size_t i = 0; i < pairs->count; i++) {
        const size_t slot = pairs->first[cell[i]]++;
        pairs->particle[slot] = i;
        for (int a = 0; a < 3; a++) pairs->position[a][slot] = state->position[a][i];
    }
    for (size_t c = cells; c > 0; c--) pairs->first[c] = pairs->first[c - 1];
    pairs->first[0] = 0;
}

// The nearest integer, as rint, but inlined on any processor: adding 1.5 * 2^52 leaves no room for
// a fraction. For |x| < 2^51.
static inline double nearest_integer(double x) {
    static const double NO_FRACTION = 6755399441055744.0;
    return (x + NO_FRACTION) - NO_FRACTION;
}

static size_t append_distances(NearPairs *pairs, size_t slot, size_t begin, size_t end,
                               size_t found) {
    const double *edge = pairs->box.edge;
    const double *x = pairs->position[0], *y = pairs->position[1], *z = pairs->position[2];
    const double inverse[3] = {1 / edge[0], 1 / edge[1], 1 / edge[2]};
    double *square = pairs->square + found;
    for (size_t k = begin; k < end; k++) {
        double dx = x[k] - x[slot], dy = y[k] - y[slot], dz = z[k] - z[slot];
        dx -= edge[0] * nearest_integer(dx * inverse[0]);
        dy -= edge[1] * nearest_integer(dy * inverse[1]);
        dz -= edge[2] * nearest_integer(dz * inverse[2]);
        *square++ = dx * dx + dy * dy + dz * dz;
    }
    for (size_t k = begin; k < end; k++) pairs->partner[found++] = pairs->particle[k];
    return found;
}

// The distinct cells at and around the cell `at`, periodically: at most 27.
static size_t cells_around(const NearPairs *pairs, const int64_t at[3], size_t around[27]) {
    size_t count = 0;
    for (int64_t step = 0; step < 27; step++) {
        const int64_t offset[3] = {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
        int64_t near[3];
        for (int a = 0; a < 3; a++) {
            near[a] = (at[a] + offset[a] + pairs->number[a]) % pairs->number[a];
        }
        const size_t cell = cell_at(pairs, near);
        size_t known = 0;
        while (known < count && around[known] != cell) known++;
        if (known == count) around[count++] = cell;
    }
    return count;
}

size_t near_pairs_row(NearPairs *pairs, size_t slot) {
    const double r[3] = {pairs->position[0][slot], pairs->position[1][slot],
                         pairs->position[2][slot]};
    const size_t own = cell_of(pairs, r);
    const size_t row = own / (size_t)pairs->number[0];
    const int64_t at[3] = {(int64_t)(own % (size_t)pairs->number[0]),
                           (int64_t)(row % (size_t)pairs->number[1]),
                           (int64_t)(row / (size_t)pairs->number[1])};
    size_t around[27];
    const size_t cells = cells_around(pairs, at, around);
    size_t found = append_distances(pairs, slot, slot + 1, pairs->first[own + 1], 0);
    for (size_t c = 0; c < cells; c++) {
        if (around[c] <= own) continue;
        found = append_distances(pairs, slot, pairs->first[around[c]], pairs->first[around[c] + 1],
                                 found);
    }
    return found;
}
