// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs within a range, by cells.
#include "observables/near_pairs.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>

static size_t cell_count(const int64_t number[3]) {
    return (size_t)number[0] * (size_t)number[1] * (size_t)number[2];
}

// More cells than particles would only cost time. There are most of them in a box at rest.
static void choose_cells(int64_t number[3], const Box *box, size_t count, double range) {
    const double most = box->dimension == 2 ? sqrt((double)count) : cbrt((double)count);
    for (int a = 0; a < 3; a++) {
        const double wide = a == 0 ? range * box_widening(box) : range;
        const double fit = a < box->dimension ? fmin(box->edge[a] / wide, most + 1) : 1;
        number[a] = fit < 1 ? 1 : (int64_t)fit;
    }
}

static Status allocate(NearPairs *pairs) {
    TRY(NEW_ARRAY(pairs->first, cell_count(pairs->number) + 1));
    TRY(NEW_ARRAY(pairs->particle, pairs->count));
    for (int a = 0; a < 3; a++) TRY(NEW_ARRAY(pairs->position[a], pairs->count));
    TRY(NEW_ARRAY(pairs->distance, pairs->count));
    TRY(NEW_ARRAY(pairs->partner, pairs->count));
    return OK;
}

Status near_pairs_create(NearPairs **out, const Box *box, size_t count, double range) {
    NearPairs *pairs = NULL;
    TRY(NEW(pairs));
    pairs->box = *box;
    pairs->range = range;
    pairs->count = count;
    const Box at_rest = {.dimension = box->dimension,
                         .edge = {box->edge[0], box->edge[1], box->edge[2]}};
    choose_cells(pairs->number, &at_rest, count, range);
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
    memory_free(pairs->distance);
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
    double fraction[3];
    box_fractions(&pairs->box, position, fraction);
    for (int a = 0; a < pairs->box.dimension; a++) {
        at[a] = (int64_t)(fraction[a] * (double)pairs->number[a]);
        if (at[a] >= pairs->number[a]) at[a] = pairs->number[a] - 1;
    }
    return cell_at(pairs, at);
}

void near_pairs_sort(NearPairs *pairs, const State *state) {
    pairs->box = state->box; // sheared since
    choose_cells(pairs->number, &pairs->box, pairs->count, pairs->range);
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
    pairs->cell = SIZE_MAX;
}

// The nearest integer, as rint, but inlined on any processor: adding 1.5 * 2^52 leaves no room for
// a fraction. For |x| < 2^51.
static inline double nearest_integer(double x) {
    static const double NO_FRACTION = 6755399441055744.0;
    return (x + NO_FRACTION) - NO_FRACTION;
}

// Squared distances from the particle in `slot` to those in slots [begin, end).
static void squares_to(const NearPairs *pairs, size_t slot, size_t begin, size_t end,
                       double *square) {
    const double *edge = pairs->box.edge, offset = pairs->box.offset;
    const double *x = pairs->position[0], *y = pairs->position[1], *z = pairs->position[2];
    const double inverse[3] = {1 / edge[0], 1 / edge[1], 1 / edge[2]};
    const double x0 = x[slot], y0 = y[slot], z0 = z[slot];
    for (size_t k = begin; k < end; k++) {
        double dx = x[k] - x0, dy = y[k] - y0, dz = z[k] - z0;
        const double above = nearest_integer(dy * inverse[1]);
        dy -= edge[1] * above;
        dx -= offset * above;
        dx -= edge[0] * nearest_integer(dx * inverse[0]);
        dz -= edge[2] * nearest_integer(dz * inverse[2]);
        square[k - begin] = dx * dx + dy * dy + dz * dz;
    }
}

// Appends those within the range to the row. Always written and sometimes kept: no branch that
// cannot be foretold.
static size_t append_near(NearPairs *pairs, size_t slot, size_t begin, size_t end, size_t found) {
    const double range_squared = pairs->range * pairs->range;
    double *square = pairs->distance + found;
    size_t *partner = pairs->partner + found;
    squares_to(pairs, slot, begin, end, square);
    size_t kept = 0;
    for (size_t k = begin; k < end; k++) {
        const double r2 = square[k - begin];
        square[kept] = r2;
        partner[kept] = pairs->particle[k];
        kept += r2 < range_squared;
    }
    return found + kept;
}

// Steps to the distinct neighbours along an axis: one, two or three cells.
static int64_t first_step(int64_t number) {
    return number >= 3 ? -1 : 0;
}
static int64_t last_step(int64_t number) {
    return number >= 2 ? 1 : 0;
}

static int64_t wrapped(int64_t place, int64_t number) {
    return place < 0 ? place + number : place >= number ? place - number : place;
}

// The distinct cells around `cell`, periodically, that come after it: each pair of cells once.
static void look_around(NearPairs *pairs, size_t cell) {
    const int64_t *n = pairs->number, index = (int64_t)cell;
    const int64_t at[3] = {index % n[0], index / n[0] % n[1], index / (n[0] * n[1])};
    pairs->cell = cell;
    pairs->around_count = 0;
    for (int64_t z = first_step(n[2]); z <= last_step(n[2]); z++) {
        for (int64_t y = first_step(n[1]); y <= last_step(n[1]); y++) {
            for (int64_t x = first_step(n[0]); x <= last_step(n[0]); x++) {
                const int64_t near[3] = {wrapped(at[0] + x, n[0]), wrapped(at[1] + y, n[1]),
                                         wrapped(at[2] + z, n[2])};
                const size_t other = cell_at(pairs, near);
                if (other > cell) pairs->around[pairs->around_count++] = other;
            }
        }
    }
}

size_t near_pairs_row(NearPairs *pairs, size_t slot) {
    size_t cell = pairs->cell;
    if (cell == SIZE_MAX) cell = 0;
    while (slot >= pairs->first[cell + 1]) cell++;
    if (cell != pairs->cell) look_around(pairs, cell);
    size_t found = append_near(pairs, slot, slot + 1, pairs->first[cell + 1], 0);
    for (size_t k = 0; k < pairs->around_count; k++) {
        const size_t other = pairs->around[k];
        found = append_near(pairs, slot, pairs->first[other], pairs->first[other + 1], found);
    }
    for (size_t k = 0; k < found; k++) pairs->distance[k] = sqrt(pairs->distance[k]);
    return found;
}
