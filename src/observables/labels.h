// SPDX-License-Identifier: GPL-3.0-or-later
// Names along the axes of results: species, and pairs of species.
#pragma once

#include "state/system.h"

enum { PAIRS_MOST = SPECIES_MOST * (SPECIES_MOST + 1) / 2 };

typedef struct Labels {
    size_t count;
    const char *names[PAIRS_MOST + 1]; // point into `text`: a Labels is not to be copied
    char text[PAIRS_MOST + 1][2 * NAME_SIZE];
} Labels;

// The species in order; a last "all" if there is more than one.
void labels_of_species(Labels *labels, const System *system);

// "small-small", "small-big", "big-big": pairs a <= b; then `last`, unless NULL.
void labels_of_pairs(Labels *labels, const System *system, const char *last);

// Where the pair of species a, b stands among them, in any order of a and b.
static inline size_t pair_index(size_t a, size_t b, size_t species_count) {
    const size_t low = a < b ? a : b, high = a < b ? b : a;
    return low * species_count - low * (low + 1) / 2 + high;
}

static inline size_t pair_count(size_t species_count) {
    return species_count * (species_count + 1) / 2;
}
