// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacements of a tagged particle under shear, along e = (cos, sin) at the start:
// what q -> 0 of its correlator says (Weysser, thesis, eqs 5.25-5.28). The displacement along x is
// that from where the flow at the final height has carried: it does not depend on the origin. With
// e' = (e_x, e_y - strain e_x),
// dD/dt + D_s int_0^t [e(t').K(t - t').e(t)/e(t')^2] dD/dt' dt' = 2 D_s e(t)^2, D_s its free
// diffusion coefficient. Inside itt/ only.
#pragma once

#include "base/archive.h"

#include <stddef.h>

enum { WALK_DIRECTIONS = 4 }; // along x, y, xy and -xy

typedef double Friction[2][2]; // D_s K_ij

typedef struct Walk {
    size_t block;
    double diffusion;
    double *value[WALK_DIRECTIONS], *mean[WALK_DIRECTIONS]; // [block + 1]
    Friction *friction, *friction_mean;                     // [block + 1], by lag
    Friction *friction_moment; // [block + 1]: mean of K times the lag from the middle, in steps
} Walk;

Status walk_create(Walk *walk, double diffusion, size_t block);
void walk_free(Walk *walk);

// The friction at i from K there.
void walk_set_friction(Walk *walk, size_t i, const double friction[2][2]);
// Time i of the beginning, by its Taylor expansion; the friction at i is there.
void walk_begin(Walk *walk, size_t i, double step, double shear);
// Time i from what is known before and the friction at i; `shear` is the strain of an interval.
void walk_advance(Walk *walk, size_t i, double step, double shear);
void walk_decimate(Walk *walk);

// Saves all of it, or loads it into one of the same block.
void walk_archive(Walk *walk, Archive *archive);
