// SPDX-License-Identifier: GPL-3.0-or-later
// An observer's numbers under its stage's name.
#include "observables/put.h"

#include <stdio.h>

Status observer_put_series(const Observer *observer, const char *name, const ResultSeries *shape,
                           Results *results, size_t replica, const double *values) {
    ResultSeries named = *shape;
    snprintf(named.stage, sizeof named.stage, "%s", observer->clock.stage);
    snprintf(named.observable, sizeof named.observable, "%s", name);
    return results_put_series(results, &named, replica, values);
}

Status observer_put_scalar(const Observer *observer, const char *quantity, const char *unit,
                           const char *about, Results *results, size_t replica, double value) {
    return results_put_scalar(results, observer->clock.stage, quantity, unit, about, replica,
                              value);
}
