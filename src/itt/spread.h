// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacements of a tagged particle under shear, along e = (cos, sin) at the start:
// what q -> 0 of its correlator says (Weysser, thesis, eqs 5.25-5.28). The displacement along x is
// that from where the flow at the final height has carried: it does not depend on the origin. With
// e' = (e_x, e_y - strain e_x),
// dD/dt + int_0^t [e(t').K(t - t').e(t)/e(t')^2] dD/dt' dt' = 2 e(t)^2. Inside itt/ only.
#pragma once

#include "base/status.h"

#include <stddef.h>

enum { SPREAD_DIRECTIONS = 4 }; // along x, y, xy and -xy

typedef double Friction[2][2]; // K_ij

typedef struct Spread {
    size_t block;
    double *value[SPREAD_DIRECTIONS], *mean[SPREAD_DIRECTIONS]; // [block + 1]
    Friction *friction, *friction_mean;                         // [block + 1], by lag
    Friction *friction_moment; // [block + 1]: mean of K times the lag from the middle, in steps
} Spread;

extern const char *const spread_names[SPREAD_DIRECTIONS];

Status spread_create(Spread *spread, size_t block);
void spread_free(Spread *spread);

// Time i of the beginning, by its Taylor expansion; the friction at i is there.
void spread_begin(Spread *spread, size_t i, double step, double shear);
// Time i from what is known before and the friction at i; `shear` is the strain of an interval.
void spread_advance(Spread *spread, size_t i, double step, double shear);
void spread_decimate(Spread *spread);
