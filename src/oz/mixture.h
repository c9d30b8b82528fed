// SPDX-License-Identifier: GPL-3.0-or-later
// A mixture of hard discs or hard spheres as the theory sees it: diameters and fractions. Pairs of
// species are numbered 11, 12, .., 1M, 22, ..; what is symmetric in the species is kept by pairs.
#pragma once

#include "base/status.h"

#include <stddef.h>

enum { MIXTURE_SPECIES_MOST = 8, MIXTURE_PAIRS_MOST = 36 };

typedef struct Mixture {
    int dimension; // 2 or 3
    size_t species;
    double diameter[MIXTURE_SPECIES_MOST];
    double fraction[MIXTURE_SPECIES_MOST]; // of the number of particles; they add up to 1
} Mixture;

Status mixture_check(const Mixture *mixture); // BAD_DATA with a sentence
size_t mixture_pairs(const Mixture *mixture);
size_t mixture_pair(size_t species, size_t a, size_t b);            // a and b in either order
double mixture_contact(const Mixture *mixture, size_t a, size_t b); // distance at contact
// One number that says, with the others held, which state a mixture is in.
typedef enum MixtureAxis {
    MIXTURE_PACKING_FRACTION,
    MIXTURE_FRACTION, // of one species; the others share the rest as they do
    MIXTURE_DIAMETER  // of one species; packing fraction and fractions are held
} MixtureAxis;
typedef struct MixtureLine {
    MixtureAxis axis;
    size_t species; // of the last two
    Mixture mixture;
    double packing_fraction;
} MixtureLine;
// The mixture and its packing fraction where that number has this value.
void mixture_on(const MixtureLine *line, double value, Mixture *mixture, double *packing_fraction);

// Particles per unit of area or volume at this packing fraction.
double mixture_density(const Mixture *mixture, double packing_fraction);
