// SPDX-License-Identifier: GPL-3.0-or-later
// The direct correlation function of a pair of species at wave numbers that shear has stretched, in
// the isotropic approximation (Fuchs & Cates, Faraday Discuss. 123, 267, 2003): the mean over
// directions of k(t)^2 is k^2 (1 + strain^2/dimension). Inside mct/ only.
#pragma once

#include "mct/grid.h"
#include "oz/oz.h"

typedef struct Stretch Stretch;

// Of species a with b. The wave numbers of the structure are those of the grid.
Status stretch_create(Stretch **out, const Grid *grid, const Structure *structure, size_t a,
                      size_t b);
void stretch_free(Stretch *stretch);

double stretch_factor(int dimension, double strain); // of all wave numbers
// c at the wave numbers of the grid after this strain, [stride].
const double *stretch_direct(Stretch *stretch, double strain);
// Of one species: the shear modulus that is left of the correlator F(q) after this strain,
// G = rho^2/(2 d (d + 2)) int d^dk/(2 pi)^d k^2 (k/k') c'(k) c'(k') F(k)^2, k' the stretched k
// (Weysser, thesis, eq. 5.14, averaged over directions).
double stretch_modulus(const Stretch *stretch, const double *correlator, double strain);
