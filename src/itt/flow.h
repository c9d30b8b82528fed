// SPDX-License-Identifier: GPL-3.0-or-later
// What transient correlators say of the flow: integrals through the transients over the time since
// shear was switched on (Weysser, thesis, eqs 5.13-5.15, summed over pairs of species). The
// integral up to t is the state at t after the start; for t -> infinity it is the stationary flow.
#pragma once

#include "base/archive.h"
#include "itt/direct.h"
#include "itt/plane.h"

typedef struct Flow Flow;

Status flow_create(Flow **out, const Plane *plane, const Direct *direct, double shear_rate);
void flow_free(Flow *flow);

// The matrix of correlators at a time after the one before; first at t = 0, where it is 1.
void flow_see(Flow *flow, double time, const double *phi);

double flow_modulus(const Flow *flow);           // G(t), now, in kT/d^2
double flow_stress(const Flow *flow);            // sigma_xy, in kT/d^2
double flow_normal_difference(const Flow *flow); // sigma_xx - sigma_yy
// S_ab(q) less that at rest, a field by pairs of species, [pair][size of the plane].
const double *flow_distortion(const Flow *flow);

// Saves all of it, or loads it into one created with the same arguments.
void flow_archive(Flow *flow, Archive *archive);
