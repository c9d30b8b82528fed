// SPDX-License-Identifier: GPL-3.0-or-later
// Free diffusion of a single body in a solvent of viscosity eta, without slip.
#pragma once

#include "shapes/shape.h"

// Along and across the body axis, in kT/(eta d); of the axis, in kT/(eta d^3).
typedef struct Diffusion {
    double parallel;
    double perpendicular; // = parallel where there is no axis
    double rotational;    // 0 where there is no axis
} Diffusion;

// Spheres: kT/(3 pi eta d). Platelets: Jabbari-Farouji and Trizac 2012, eqs 13, 14.
// Spherocylinders: Garcia Daza et al., eqs 30-32, for rods of length >= 2 d or so; they turn
// negative for shorter ones, a sphere must be called one. Discs have none in an infinite fluid
// (Stokes' paradox): theirs is 1, the unit, whatever their diameter.
Diffusion shape_diffusion(const Body *body);

// Averaged over orientations, in kT/(eta d).
double diffusion_mean(const Diffusion *diffusion, int dimension);
