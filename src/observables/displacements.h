// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements of all particles since the time origins, species by species, in the layout that
// vector units want: [dimension][lane], the particles of each species from a multiple of LANES on;
// the lanes that are left over stay at zero. Coordinates are unfolded and seen from the box
// or from the centre of mass (frame.h). Under shear they are the non-affine displacements (Weysser,
// thesis, eq. 5.64): what the flow has done since the origin, strain times y as it is now, is taken
// from x.
#pragma once

#include "numerics/turn.h"
#include "observables/frame.h"
#include "observables/history.h"

typedef struct Displacements {
    History history; // of unfolded coordinates
    int64_t frame;   // set before it is made
    int dimension;
    size_t species_count;
    size_t population[SPECIES_MOST];
    size_t begin[SPECIES_MOST + 1]; // lanes of species s: [begin[s], begin[s + 1])
    size_t lanes;                   // of one axis
    double *now;                    // [dimension][lanes], then the strain
    double *moved;                  // [dimension][lanes]
} Displacements;

Status displacements_make(Displacements *d, const State *state, const Lags *lags);
void displacements_clear(Displacements *d);
size_t displacements_memory(const System *system, const Lags *lags);
void displacements_archive(Displacements *d, Archive *archive);

void displacements_look(Displacements *d, const State *state); // first, at each tick
// True where lag `k` ends at `tick`: then `moved` has the displacements, and `row` says where its
// sums are.
bool displacements_ended(Displacements *d, int64_t tick, size_t k, size_t *row);
void displacements_keep(Displacements *d, int64_t tick); // last

// |moved|^2 of every lane.
void displacements_squares(const Displacements *d, double *squares);

// Samples of row `row`: particles of species [first, last) times origins seen.
double displacements_samples(const Displacements *d, size_t row, size_t first, size_t last);
