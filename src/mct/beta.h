// SPDX-License-Identifier: GPL-3.0-or-later
// The beta-scaling function G(t) near a glass transition, with and without shear (Weysser, thesis,
// eq. 5.42, which contains eq. 3.16 with its sign put right):
// sigma - shear t^2 + lambda G^2 = d/dt int_0^t G(t - t') G(t') dt',  G -> t^-a for t -> 0.
#pragma once

#include "mct/exponents.h"

#include <stddef.h>

typedef struct BetaSettings {
    double lambda;
    double sigma; // the separation parameter, in units of t0^(-2a): time is t/t0
    double shear; // c (rate t0)^2
    double last;  // time
    size_t block; // points of a block of the doubling grid: an even number; 0: 1024
} BetaSettings;

typedef struct BetaFunction {
    Exponents exponents;
    size_t count;
    double *time, *value; // [count], ascending; ends where G leaves the scaling regime, at -1e3
} BetaFunction;

Status beta_create(BetaFunction **out, const BetaSettings *settings);
void beta_free(BetaFunction *beta);

// B of the fluid: G -> -B (t/t_sigma)^b, t_sigma = |sigma|^(-1/2a) t0; to 1e-4.
Status beta_von_schweidler(double lambda, double *amplitude);
