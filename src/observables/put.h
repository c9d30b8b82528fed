// SPDX-License-Identifier: GPL-3.0-or-later
// An observer's numbers under its stage's name.
#pragma once

#include "observables/observables.h"

// `shape` has unit, about, axes and axis; stage and name are filled in.
Status observer_put_series(const Observer *observer, const char *name, const ResultSeries *shape,
                           Results *results, size_t replica, const double *values);

Status observer_put_scalar(const Observer *observer, const char *quantity, const char *unit,
                           const char *about, Results *results, size_t replica, double value);

// The shear rate of the stage, where it flows: what correlators under shear scale with. Analysis
// knows a flow that is not steady by the name, largest_shear_rate.
Status observer_put_shear_rate(const Observer *observer, Results *results, size_t replica);

// The force on the tracer of a pulled stage as force_x, by the name of its direction: what analysis
// knows a drift by. Nothing at rest, or without force.
Status observer_put_force(const Observer *observer, const System *system, Results *results,
                          size_t replica);
