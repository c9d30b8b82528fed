// SPDX-License-Identifier: GPL-3.0-or-later
// What pairs are counted against: numbers of pairs of species, volumes of shells, and the weights
// with which contact values make a pressure.
#pragma once

#include "state/state.h"

// Sums over the pairs of different particles, i of species a and j of species b.
typedef struct PairSums {
    double number;
    double contact; // of d_ij^dim, d_ij = (d_i + d_j)/2
} PairSums;

PairSums pair_sums_of(const State *state, size_t a, size_t b);

// P V/(N kT) = 1 + sum over pairs ab of w_ab g_ab(contact): weights[pair], a <= b.
void pair_sums_weights(const State *state, double *weights);

// Of the shell from `low` to `high` around a particle: an area in two dimensions.
double pair_sums_shell(int dimension, double low, double high);

bool pair_sums_have_contact(const System *system); // do all pairs touch at d_ij?

// Bins of this width that fit into a length, at least one: a pair beyond it is not looked for.
size_t pair_sums_bins(double length, double spacing);
