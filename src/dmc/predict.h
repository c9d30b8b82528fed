// SPDX-License-Identifier: GPL-3.0-or-later
// The acceptance to expect before anything has run. Of hard discs and spheres exact for small
// steps, given the equation of state, and good to a few per cent down to acceptances of 0.2; of
// bodies with an axis in the isotropic phase an estimate from excluded volumes, good to some 20 %;
// of soft spheres that of hard ones of the Barker-Henderson diameter, a lower bound for steps well
// below d/exponent.
#pragma once

#include "dmc/chain.h"

// Of one species, when all are moved with amplitudes from `parallel` along their axes.
double predict_acceptance(const System *system, size_t species, double parallel,
                          const ChainSettings *settings);

// The step along the axis that gives this acceptance.
double predict_step(const System *system, size_t species, double acceptance,
                    const ChainSettings *settings);
