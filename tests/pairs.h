// SPDX-License-Identifier: GPL-3.0-or-later
// Random pairs that kernels are held against their twins on.
#pragma once

#include "rng/rng.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// As many as the environment asks for.
static inline int64_t pairs_wanted(void) {
    const char *wish = getenv("PERRIN_SHAPE_PAIRS");
    return wish ? (int64_t)atof(wish) : 200000;
}

// Of length 1; in two dimensions u[2] = 0.
static inline void random_direction(Rng *rng, int dimension, double u[3]) {
    double square = 0;
    for (int a = 0; a < 3; a++) {
        u[a] = a < dimension ? rng_normal(rng) : 0;
        square += u[a] * u[a];
    }
    for (int a = 0; a < 3; a++) u[a] /= sqrt(square);
}
