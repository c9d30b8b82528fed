// SPDX-License-Identifier: GPL-3.0-or-later
// The glass transition along the packing fraction: where it is, and what happens near it.
#pragma once

#include "mct/exponents.h"
#include "oz/oz.h"

// Fields are by pairs of species, [pair][count] at the wave numbers of the grid.
typedef struct CriticalPoint {
    double packing_fraction;
    Exponents exponents;
    double slope; // C: the separation parameter is C (phi - phi_c)/phi_c
    // c of sigma - c (rate t)^2 + lambda G^2 = d/dt int GG in the isotropically sheared model
    // (Weysser, thesis, eqs 5.42-5.43); NAN of a mixture
    double shear;
    // (phi - phi_c)/s^2 for s = 1 - E -> 0 as found, and phi_c/(4 C (1 - lambda)) as it must be
    double curvature, expected_curvature;
    size_t count;
    double *wave_number;
    double *form;       // F_ab
    double *amplitude;  // H_ab: F_ab(t) = F_ab + H_ab G(t) in the beta window
    double *factor;     // S_ab
    size_t evaluations; // structures for which form factors were found
} CriticalPoint;

typedef struct CriticalSearch {
    Mixture mixture;
    Closure closure;
    size_t count;             // of wave numbers
    double last;              // the largest of them
    double low, high;         // packing fractions: a fluid, a glass
    const Measured *measured; // structure in place of the closure's; NULL: none
} CriticalSearch;

// By bisection, then by extrapolation of states a little above: packing fraction, lambda and all
// fields are smooth functions of s = 1 - E there. BAD_DATA if `high` is no glass or `low` is one.
Status critical_find(CriticalPoint **out, const CriticalSearch *search);
void critical_free(CriticalPoint *point);
