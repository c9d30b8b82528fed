// SPDX-License-Identifier: GPL-3.0-or-later
// Structure factors that were measured in fluids of one composition, at one packing fraction or at
// several, as a smooth function of wave number and packing fraction: what c_ab(r) differs from
// Percus and Yevick's is a spline in distance, with a step at contact, that ends at a few
// diameters. So c_ab(q) has an even power series at q = 0 and, beyond the last wave number, the
// decay of a step. Spline coefficients are fitted to c_ab(q), weighted by its errors, and as smooth
// as generalised cross-validation says; through two packing fractions goes a straight line, a
// parabola through more.
#pragma once

#include "oz/mixture.h"

// S_ab(q) with S_ab -> x_a delta_ab at large q, of independent samples.
typedef struct MeasuredState {
    double packing_fraction;
    size_t replicas, count;    // of wave numbers
    const double *wave_number; // [count]
    const double *factor;      // [replicas][pair][count]
} MeasuredState;

typedef struct Measured Measured;

Status measured_create(Measured **out, const Mixture *mixture);
void measured_free(Measured *measured);

// Copies nothing but what the fit gives. `groups` > 1 leaves out every replica whose number, modulo
// `groups`, is `omitted`. BAD_DATA with a sentence if S is not positive or ends too early.
Status measured_add(Measured *measured, const MeasuredState *state, size_t groups, size_t omitted);

const Mixture *measured_mixture(const Measured *measured);
double measured_lowest(const Measured *measured);  // packing fraction
double measured_highest(const Measured *measured); // packing fraction
// The mean square of (c - fit)/error over all wave numbers and pairs: about 1; NaN of one replica.
double measured_misfit(const Measured *measured);
