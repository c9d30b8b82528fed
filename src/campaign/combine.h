// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of all points as series over what is swept. Inside campaign/ only.
#pragma once

#include "config/config.h"
#include "results/results.h"

// Adds what one point found; `all` has room for as many replicas as any point has.
Status combine_point(Results *all, const ConfigPoints *points, size_t point, const Results *one);
