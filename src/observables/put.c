// SPDX-License-Identifier: GPL-3.0-or-later
// An observer's numbers under its stage's name.
#include "observables/put.h"

#include "propagator/tracer.h"

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

Status observer_put_shear_rate(const Observer *observer, Results *results, size_t replica) {
    const Drive *drive = observer->clock.drive;
    if (!drive || !(drive_kinds(drive) & DRIVE_FLOW)) return OK;
    if (observer->clock.before)
        TRY(observer_put_scalar(observer, "shear_rate_before", "D0/d^2", NULL, results, replica,
                                flow_fastest(observer->clock.before)));
    if (drive->flow.rate == 0)
        return observer_put_scalar(observer, "largest_shear_rate", "D0/d^2", NULL, results, replica,
                                   flow_fastest(&drive->flow));
    return observer_put_scalar(observer, "shear_rate", "D0/d^2", NULL, results, replica,
                               drive->flow.rate);
}

Status observer_put_force(const Observer *observer, const System *system, Results *results,
                          size_t replica) {
    const Drive *drive = observer->clock.drive;
    if (!drive || !(drive_kinds(drive) & DRIVE_PULL) || drive->pull.peclet == 0) return OK;
    const Pull *pull = &drive->pull;
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "force_%s", drive_pull_axes[pull->axis]);
    const double diameter = system->species[tracer_species(pull, system)].diameter;
    return observer_put_scalar(observer, name, "kT/d", NULL, results, replica,
                               drive_pull_force(pull, diameter));
}
