// SPDX-License-Identifier: GPL-3.0-or-later
// The inside of the chain of bodies, for bodies*.c, its tests and benches only.
//
// Places are fractions of the box: the lower 32 bits of a 64-bit integer, whose upper bits count
// the images. The difference of two lower halves, taken as a signed integer, is the nearest image,
// and nothing is ever wrapped.
#pragma once

#include "dmc/chain.h"

#include "shapes/overlap.h"

typedef struct Bodies {
    Chain chain; // first
    ChainSettings settings;
    RngKey key;
    State *state;
    size_t count;
    double scale;          // of the sizes, against those of the State
    double unit[3];        // of places: edge/2^32, in d
    double units_per_d[3]; // 1/unit
    int64_t *place[3];     // [count] unfolded, in `unit`
    double (*axis)[3];     // [count] of length 1; z for bodies without
    Body *body;            // [count] with their sizes at this scale
    Amplitude amplitude[SPECIES_MOST];
} Bodies;
