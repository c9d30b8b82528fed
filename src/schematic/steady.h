// SPDX-License-Identifier: GPL-3.0-or-later
// F12 at rest, or under steady shear that begins at t = 0 with the correlator: Phi(t) and the
// stress sigma(t) = rate int_0^t v_sigma Phi^2 over any number of decades (Weysser, thesis,
// eqs 6.8-6.11 for a constant rate).
#pragma once

#include "schematic/f12.h"

#include <stddef.h>

typedef struct SteadySettings {
    F12 model;
    double shear_rate; // 0: at rest
    size_t block;      // points of a block of the doubling grid, even; 0: 256
} SteadySettings;

typedef struct Steady Steady;

Status steady_create(Steady **out, const SteadySettings *settings);
void steady_free(Steady *steady);
void steady_advance(Steady *steady); // the next time of the grid

double steady_time(const Steady *steady);
double steady_correlator(const Steady *steady);
double steady_stress(const Steady *steady);    // since the beginning
double steady_viscosity(const Steady *steady); // int_0^t v_sigma Phi^2, also at rest
// Whether nothing is left of Phi that could change the stress.
bool steady_has_decayed(const Steady *steady);
