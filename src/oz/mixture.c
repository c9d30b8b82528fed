// SPDX-License-Identifier: GPL-3.0-or-later
// Diameters, fractions, pairs of species.
#include "oz/mixture.h"

#include "base/constants.h"

#include <math.h>

Status mixture_check(const Mixture *mixture) {
    double sum = 0;
    if (mixture->dimension != 2 && mixture->dimension != 3)
        return status_fail(BAD_DATA, "theory is for dimension 2 and 3, not %d", mixture->dimension);
    if (mixture->species < 1 || mixture->species > MIXTURE_SPECIES_MOST)
        return status_fail(BAD_DATA, "%zu species; theory has room for 1 to %d", mixture->species,
                           MIXTURE_SPECIES_MOST);
    for (size_t a = 0; a < mixture->species; a++) {
        if (!(mixture->diameter[a] > 0) || !(mixture->fraction[a] > 0))
            return status_fail(BAD_DATA, "species %zu: diameter and fraction must be positive",
                               a + 1);
        sum += mixture->fraction[a];
    }
    if (fabs(sum - 1) > 1e-9)
        return status_fail(BAD_DATA, "the fractions of the species add up to %.10g, not to 1", sum);
    return OK;
}

size_t mixture_pairs(const Mixture *mixture) {
    return mixture->species * (mixture->species + 1) / 2;
}

size_t mixture_pair(size_t species, size_t a, size_t b) {
    const size_t low = a < b ? a : b, high = a < b ? b : a;
    return low * species - low * (low + 1) / 2 + high;
}

double mixture_contact(const Mixture *mixture, size_t a, size_t b) {
    return (mixture->diameter[a] + mixture->diameter[b]) / 2;
}

void mixture_on(const MixtureLine *line, double value, Mixture *mixture, double *packing_fraction) {
    *mixture = line->mixture;
    *packing_fraction = line->axis == MIXTURE_PACKING_FRACTION ? value : line->packing_fraction;
    if (line->axis == MIXTURE_DIAMETER) mixture->diameter[line->species] = value;
    if (line->axis != MIXTURE_FRACTION) return;
    const double others = 1 - line->mixture.fraction[line->species];
    for (size_t a = 0; a < mixture->species; a++) mixture->fraction[a] *= (1 - value) / others;
    mixture->fraction[line->species] = value;
}

double mixture_density(const Mixture *mixture, double packing_fraction) {
    double size = 0; // mean area or volume of a particle
    for (size_t a = 0; a < mixture->species; a++) {
        const double d = mixture->diameter[a];
        size +=
            mixture->fraction[a] * (mixture->dimension == 2 ? PI / 4 * d * d : PI / 6 * d * d * d);
    }
    return packing_fraction / size;
}
