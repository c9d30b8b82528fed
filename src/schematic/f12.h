// SPDX-License-Identifier: GPL-3.0-or-later
// The schematic model F12 of the glass transition under shear (Weysser, thesis, section 6.2): one
// correlator, d Phi/dt + Gamma (Phi + int m(t, t') dPhi(t')) = 0, with the memory kernel
// m = h(t, t') h(t, s) (v1 Phi + v2 Phi^2)(t, t'), where h falls with the strain in between and s
// is the time when Phi began.
#pragma once

#include "mct/exponents.h"

#include <stdbool.h>

typedef struct F12 {
    double v1, v2;
    double rate;            // Gamma, of the free decay
    double critical_strain; // gamma_c, that of half of h
    double modulus;         // v_sigma, stress per strain and Phi^2
    double softening;       // strain where the modulus passes 0; 0: never
} F12;

// The transition at this v2 > 1, where a plateau comes up at once: v1 = 2 sqrt(v2) - v2. Below, at
// v1 = 1, it grows from 0.
bool f12_is_discontinuous(double v2);
double f12_critical_v1(double v2);
// v1 at a distance from it, in the units in which Phi = f_c + (1 - f_c)^2 G obeys the beta-scaling
// equation with sigma = separation; where the plateau grows from 0, v1 = 1 + separation.
double f12_v1_at(double v2, double separation);

// The plateau f/(1 - f) = v1 f + v2 f^2; 0 in a fluid.
double f12_plateau(const F12 *model);
// lambda = 1/sqrt(v2) and what follows from it; BAD_DATA where the plateau grows from 0.
Status f12_exponents(const F12 *model, Exponents *exponents);

// c of the beta-scaling equation under shear, sigma - c (rate t)^2 + lambda G^2 = d/dt int G G
// (Weysser, thesis, eq. 5.42): near the plateau h^2 = 1 - 2 (strain/gamma_c)^2 takes as much from
// the kernel as a change of sigma, hence c = 2 f_c/((1 - f_c)^2 gamma_c^2). 0 where the plateau
// grows from 0.
double f12_shear_coefficient(const F12 *model);

double f12_coupling(const F12 *model, double phi);        // v1 Phi + v2 Phi^2
double f12_strain_decay(const F12 *model, double strain); // h = 1/(1 + (strain/gamma_c)^2)
// What a strain leaves of the modulus: v_sigma, or, with softening g, v_sigma (1 - x^2) exp(-x^2)
// at x = strain/g, a form of our own that lets the stress overshoot.
double f12_modulus_at(const F12 *model, double strain);
