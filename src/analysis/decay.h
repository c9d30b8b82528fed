// SPDX-License-Identifier: GPL-3.0-or-later
// What the analyses of decays in time share. Inside analysis/ only.
#pragma once

#include "results/results.h"

enum { DECAY_NOBODY = -1 };

// mean[k] of the elements first + k, of all replicas or of those without one; NaN where one of
// them has no value.
void decay_mean(const Results *results, const ResultSeries *series, size_t first, size_t count,
                int64_t without, double *mean);

// Where the curve first falls below a level, by a straight line in log t; NaN if it does not.
double decay_time_at(const double *times, const double *values, size_t count, double level);

// The value at a time between the first and the last, by a straight line in log t; else NaN.
double decay_value_at(const double *times, const double *values, size_t count, double time);
