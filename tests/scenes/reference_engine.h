// SPDX-License-Identifier: GPL-3.0-or-later
// The plain, slow twin of the event-driven engine: linked cells with crossing events and a heap, or
// every pair, as the textbooks have it (Rapaport, The Art of Molecular Dynamics Simulation, ch. 14;
// Weysser, thesis, 2.5). It shares no code with edbd/, so that the two can be held against each
// other, collision by collision in the tests and in speed in the benches.
#pragma once

#include "rng/rng.h"
#include "state/state.h"
#include "state/tally.h"

#include <stdbool.h>

typedef struct Reference Reference;

typedef struct ReferenceCollision {
    uint32_t low, high; // ids of the partners
    int64_t step;       // of the state: the interval it happened in
    double time;        // since the interval began
} ReferenceCollision;

// Collisions in their order, from the beginning of the array; those beyond `capacity` are counted.
typedef struct ReferenceLog {
    ReferenceCollision *records;
    size_t capacity, count;
} ReferenceLog;

// Borrows the state until free. Free flight and elastic collisions for intervals of this length, in
// d sqrt(m/kT); with `thermostatted`, all velocities are drawn anew at the beginning of each, by
// STREAM_VELOCITY at the state's step. `all_pairs` looks at every pair instead of cells, as do
// boxes of fewer than three cells; flights must then be shorter than half the box.
Status reference_create(Reference **out, State *state, RngKey key, double interval,
                        bool thermostatted, bool all_pairs);
void reference_free(Reference *reference);

// From the next interval on the flow v_x = rate y, in sqrt(kT/m)/d, between moving images (Lees and
// Edwards). In a box that was ever sheared `all_pairs` is needed.
void reference_shear(Reference *reference, double rate);

// From the next interval on one particle has this velocity along an axis besides what is drawn.
void reference_pull(Reference *reference, size_t particle, int axis, double drift);

// Each interval begins from what stands in the state and ends with it, one step later.
void reference_advance(Reference *reference, int64_t intervals, Tally *tally);

void reference_record(Reference *reference, ReferenceLog *log); // NULL: no more
