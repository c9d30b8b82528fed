// SPDX-License-Identifier: GPL-3.0-or-later
// Glass form factors of one structure, and how stable they are. Inside mct/ only.
#pragma once

#include "mct/model.h"

// The non-ergodic solution of F = S - (1/S + M[F])^-1 that is the largest, from `form` down (S, or
// that of a denser state). `glass`: there is one; else `form` goes to zero.
Status glass_form_factors(Model *model, double *form, bool *glass);

// At a glass: the largest eigenvalue E of the stability map C[H] = (S - F) dM[H] (S - F) and its
// vectors, normalised to left : right = 1 and left : (right (S - F)^-1 right) = 1; the exponent
// parameter lambda = left : (S - F) M[right] (S - F), which has its meaning where E = 1.
typedef struct Stability {
    double eigenvalue, lambda;
    double *right, *left; // [size]; what they hold is where the iteration begins
} Stability;
Status stability_create(Stability *stability, const Model *model);
void stability_free(Stability *stability);
Status glass_stability(Model *model, const double *form, Stability *stability);

// left : (S - (1/S + M[form])^-1 - form): the separation parameter when `form` is the critical one.
Status glass_separation(Model *model, const double *form, const double *left, double *separation);
