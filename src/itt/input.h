// SPDX-License-Identifier: GPL-3.0-or-later
// The files that a run of the theory under shear reads, held against its plan. Inside itt/ only.
#pragma once

#include "itt/itt.h"
#include "theory/measurements.h"

// BAD_DATA with a sentence if they are not of equal discs, or too few for what is calculated.
Status itt_read_input(Measurements **out, const IttPlan *plan);
