// SPDX-License-Identifier: GPL-3.0-or-later
// The particles that have a body axis u, and how well their axes are aligned: Q = <(3 u u - 1)/2>.
// Its largest eigenvalue is the nematic order parameter S, the eigenvector the director.
#pragma once

#include "observables/labels.h"
#include "state/state.h"

// The species with an axis; their particles stand together.
typedef struct Oriented {
    size_t count;
    size_t begin[SPECIES_MOST], end[SPECIES_MOST];
} Oriented;

Oriented oriented_of(const System *system);
size_t oriented_particles(const Oriented *oriented);

// Their names; a last "all" if there are several.
void oriented_labels(Labels *labels, const System *system);

// BAD_DATA with a sentence if no species has an axis.
Status oriented_check(const char *observable, const System *system);

// Adds u_a u_b of particles [begin, end).
void oriented_add(double sum[3][3], const State *state, size_t begin, size_t end);

typedef struct Order {
    double largest, middle; // eigenvalues of Q
    double director[3];
} Order;

Order oriented_order(const double sum[3][3], double particles);

// The director of all axes in this configuration.
void oriented_director(const State *state, const Oriented *oriented, double director[3]);
