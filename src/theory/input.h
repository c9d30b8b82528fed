// SPDX-License-Identifier: GPL-3.0-or-later
// The files that a run of the theory reads, held against its plan. Inside theory/ only.
#pragma once

#include "theory/measurements.h"
#include "theory/theory.h"

// BAD_DATA with a sentence if they are of another mixture, or too few for what is calculated.
Status theory_read_input(Measurements **out, const TheoryPlan *plan);
