// SPDX-License-Identifier: GPL-3.0-or-later
// The isotropically sheared model (Fuchs & Cates, Faraday Discuss. 123, 267, 2003): mode-coupling
// theory of one species under steady shear that begins at t = 0, where of the flow only the mean
// stretching of wave numbers is kept. The quick approximation to the anisotropic theory.
#pragma once

#include "mct/grid.h"
#include "oz/oz.h"

#include <stdbool.h>

typedef struct Sheared Sheared;

// `structure` is at the wave numbers of the grid, which must outlive this. A block of 0: 128.
Status sheared_create(Sheared **out, const Grid *grid, const Structure *structure,
                      double shear_rate, size_t block);
void sheared_free(Sheared *sheared);
Status sheared_advance(Sheared *sheared); // the next time of the grid

double sheared_time(const Sheared *sheared);
const double *sheared_correlator(const Sheared *sheared); // F(q, t), [stride of the grid]
double sheared_modulus(const Sheared *sheared);           // G(t), in kT/d^dimension
double sheared_stress(const Sheared *sheared);            // rate int_0^t G
bool sheared_has_decayed(const Sheared *sheared);         // no G is left to change the stress
