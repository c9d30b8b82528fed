// SPDX-License-Identifier: GPL-3.0-or-later
// What pairs are counted against.
#include "observables/pair_sums.h"

#include "base/constants.h"

#include <math.h>

PairSums pair_sums_of(const State *state, size_t a, size_t b) {
    // sum of (d_i + d_j)^dim = sum of binomials times products of the moments of each species
    const int dimension = state->box.dimension;
    double moment[2][4] = {{0}}, itself = 0;
    for (size_t i = 0; i < state->count; i++) {
        const double d = state->diameter[i];
        const double power[4] = {1, d, d * d, d * d * d};
        for (int p = 0; p <= dimension; p++) {
            moment[0][p] += state->species_of[i] == a ? power[p] : 0;
            moment[1][p] += state->species_of[i] == b ? power[p] : 0;
        }
        itself += state->species_of[i] == a && a == b ? power[dimension] : 0;
    }
    static const double binomial[2][4] = {{1, 2, 1, 0}, {1, 3, 3, 1}};
    double contact = 0;
    for (int p = 0; p <= dimension; p++) {
        contact += binomial[dimension - 2][p] * moment[0][p] * moment[1][dimension - p];
    }
    contact /= dimension == 2 ? 4 : 8;
    const double same = a == b ? moment[0][0] : 0, share = a == b ? 0.5 : 1;
    return (PairSums){.number = share * (moment[0][0] * moment[1][0] - same),
                      .contact = share * (contact - itself)};
}

// w_ab = Omega/(dim N V) * sum over the pairs i in a, j in b of d_ij^dim, Omega = 2 pi or 4 pi.
void pair_sums_weights(const State *state, double *weights) {
    const size_t species = state->system.species_count;
    const int dimension = state->box.dimension;
    const double solid_angle = dimension == 2 ? 2 * PI : 4 * PI;
    size_t pair = 0;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            weights[pair++] = solid_angle * pair_sums_of(state, a, b).contact /
                              ((double)dimension * (double)state->count * box_volume(&state->box));
        }
    }
}

static double ball(int dimension, double radius) {
    return dimension == 2 ? PI * radius * radius : 4 * PI / 3 * radius * radius * radius;
}

double pair_sums_shell(int dimension, double low, double high) {
    return ball(dimension, high) - ball(dimension, low);
}

bool pair_sums_have_contact(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        const ShapeKind shape = (ShapeKind)system->species[s].shape;
        if (shape_is_oriented(shape) || !shape_is_hard(shape)) return false;
    }
    return true;
}

size_t pair_sums_bins(double length, double spacing) {
    const double bins = floor(length / spacing + 1e-9);
    return bins < 1 ? 1 : (size_t)bins;
}
