// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the theory under shear is of, and the files that it reads. Inside itt/ only.
#pragma once

#include "itt/itt.h"
#include "theory/measurements.h"

extern const Mixture itt_discs;
MeasurementsInput itt_input(const IttPlan *plan);
