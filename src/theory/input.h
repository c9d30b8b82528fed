// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the theory is of, and the files that it reads. Inside theory/ only.
#pragma once

#include "theory/measurements.h"
#include "theory/theory.h"

Mixture theory_mixture(const TheoryPlan *plan);
MeasurementsInput theory_input(const TheoryPlan *plan);
