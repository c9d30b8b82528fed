// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the theory under shear is of, and the files that it reads. Inside itt/ only.
#pragma once

#include "itt/itt.h"

const TheorySpecies *itt_species(const IttPlan *plan, size_t *count); // never none
Mixture itt_mixture(const IttPlan *plan);
