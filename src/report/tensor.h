// SPDX-License-Identifier: GPL-3.0-or-later
// The diffusion tensor of bodies with an axis as a table of its own: numbers that are read beside
// each other and would be scattered among the others. Inside report/ only.
#pragma once

#include "base/text.h"
#include "results/results.h"

#include <stdbool.h>

bool tensor_has(const ResultScalar *scalar);           // it stands in the table
void tensor_table(Text *page, const Results *results); // nothing if there are no such bodies
