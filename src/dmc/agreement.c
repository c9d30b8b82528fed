// SPDX-License-Identifier: GPL-3.0-or-later
// Clocks of species, held against each other by blocks of a calibration.
#include "dmc/agreement.h"

#include <math.h>

enum { LAST = AGREEMENT_BLOCKS - 1 };

static double ratio(const Agreement *agreement, size_t species) {
    return agreement->cycle[LAST][species] / agreement->cycle[LAST][0];
}

double agreement_apart(const Agreement *agreement, size_t species) {
    return ratio(agreement, species) - 1;
}

// From the blocks, and not from the number of trials: one is accepted or not as the one before was,
// for as long as the neighbours stay. A block alone is the difference of the sums up to its end.
double agreement_error(const Agreement *agreement, size_t species) {
    const double all = agreement->cycle[LAST][0], found = ratio(agreement, species);
    double square = 0, before = 0;
    for (int b = 0; b < AGREEMENT_BLOCKS; b++) {
        const double *cycle = agreement->cycle[b];
        const double sum = (b + 1) * (cycle[species] - found * cycle[0]) / all;
        square += (sum - before) * (sum - before);
        before = sum; // in the end 0
    }
    return sqrt(square / (AGREEMENT_BLOCKS * LAST));
}

// The step was found from a measurement no better than the one that judges it: hence the root of 2.
bool agreement_holds(const Agreement *agreement, size_t species) {
    static const double APART_MOST = 0.1, SURE = 4; // standard errors
    const double chance = SURE * sqrt(2) * agreement_error(agreement, species);
    return fabs(agreement_apart(agreement, species)) <= APART_MOST + chance;
}
