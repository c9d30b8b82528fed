// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the theory is of, and the files that it reads. Inside theory/ only.
#pragma once

#include "theory/measurements.h"
#include "theory/theory.h"

Mixture theory_mixture(const TheoryPlan *plan);
// What the transition is searched along, and of which species.
MixtureAxis theory_search_axis(const TheoryPlan *plan, size_t *species);
