// SPDX-License-Identifier: GPL-3.0-or-later
// The glass transition along the packing fraction, or another number of a mixture: where it is, and
// what happens near it.
#pragma once

#include "mct/exponents.h"
#include "oz/oz.h"

// Fields are by pairs of species, [pair][count] at the wave numbers of the grid.
typedef struct CriticalPoint {
    double value; // of what is searched along, x: of the packing fraction, if nothing else
    Mixture mixture;
    double packing_fraction; // of the mixture there
    Exponents exponents;
    double slope; // C: the separation parameter is C (x - x_c)/x_c
    // c of sigma - c (rate t)^2 + lambda G^2 = d/dt int GG in the isotropically sheared model
    // (Weysser, thesis, eqs 5.42-5.43)
    double shear;
    // (x - x_c)/s^2 for s = 1 - E -> 0 as found, and x_c/(4 C (1 - lambda)) as it must be
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
    double low, high;         // values of x, one of a fluid and one of a glass
    const Measured *measured; // structure in place of the closure's; NULL: none
    MixtureAxis axis;         // what x is; of the packing fraction `low` is the fluid
    size_t species;           // of other axes; whose ends may lie either way
    double packing_fraction;  // likewise
    const char *name;         // of x, for sentences; NULL: "packing fraction"
} CriticalSearch;

// By bisection, then by extrapolation of states a little on the side of the glass: x, lambda and
// all fields are smooth functions of s = 1 - E there. BAD_DATA with a sentence unless one end is a
// glass and the other a fluid.
Status critical_find(CriticalPoint **out, const CriticalSearch *search);
void critical_free(CriticalPoint *point);
