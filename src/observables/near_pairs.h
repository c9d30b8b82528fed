// SPDX-License-Identifier: GPL-3.0-or-later
// All pairs of particles nearer than a range, each once: cells at least that wide, particles
// sorted by cell so that a row of candidates is contiguous.
#pragma once

#include "state/state.h"

typedef struct NearPairs {
    Box box;
    double range;
    size_t count;                    // particles
    int64_t number[3];               // cells along each axis
    size_t *first;                   // [cells + 1], slot where each cell begins
    size_t *particle;                // [count], by slot
    double *position[3];             // [3][count], by slot
    size_t cell;                     // of the current row
    size_t around_count, around[27]; // the cells after it where partners may be
    double *distance;                // [count], of the partners in the current row
    size_t *partner;                 // [count], the particles that they are
} NearPairs;

// `range` at most half of the shortest edge.
Status near_pairs_create(NearPairs **out, const Box *box, size_t count, double range);
void near_pairs_free(NearPairs *pairs);
size_t near_pairs_memory(const System *system, double range); // bytes

void near_pairs_sort(NearPairs *pairs, const State *state);

// The partners of the particle in `slot` that stand after it: partner[k] at distance[k] < range,
// nearest image, for k below the value returned. Slots are to be asked for in ascending order.
size_t near_pairs_row(NearPairs *pairs, size_t slot);
