// SPDX-License-Identifier: GPL-3.0-or-later
// Einstein and Helfand's viscosity: the slope of how far the integral of the shear stress wanders,
// between each two lags as a function of time, and over a window of the last lags (curve.h) as the
// zero-shear viscosity. It grows with time until the slowest relaxation is over, so where the slope
// has not settled it is a lower bound.
#include "analysis/derive.h"
#include "analysis/curve.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *unit_of(const System *system) {
    return system->dimension == 2 ? "kT/D0" : "kT/(d D0)";
}

static Status put_zero_shear(Results *results, const Curve *curve, const System *system) {
    static const char GROWING[] =
        "Lower bound, for the slope is not seen to have settled: Einstein-Helfand, from "
        "zero_shear_viscosity_window to the last lag.";
    bool settled = false;
    const char *stage = curve->series->stage;
    const size_t begin = curve_window(curve, &settled);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(results_put_scalar(results, stage, "zero_shear_viscosity", unit_of(system),
                               settled ? NULL : GROWING, replica,
                               curve_slope(curve, replica, begin, curve->lags)));
        TRY(results_put_scalar(results, stage, "zero_shear_viscosity_window",
                               curve->series->axis[0].unit, NULL, replica, curve->times[begin]));
    }
    return OK;
}

// Slopes from each lag to the next, at the times between them.
static Status put_slopes(Results *results, const Curve *curve, const System *system, double *slopes,
                         double *times) {
    const size_t count = curve->lags - 1;
    for (size_t k = 0; k < count; k++) times[k] = (curve->times[k] + curve->times[k + 1]) / 2;
    ResultSeries shape = {.axes = 1,
                          .axis = {{.name = "time",
                                    .unit = curve->series->axis[0].unit,
                                    .count = count,
                                    .values = times}}};
    snprintf(shape.stage, sizeof shape.stage, "%s", curve->series->stage);
    strcpy(shape.observable, "viscosity");
    strcpy(shape.unit, unit_of(system));
    // The series that the curve is of is not where it was once another has been put.
    const size_t of = (size_t)(curve->series - results->series);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        const ResultSeries *series = &results->series[of];
        const double *wandering = series->values + replica * series->size;
        for (size_t k = 0; k < count; k++) {
            slopes[k] = (wandering[k + 1] - wandering[k]) /
                        (series->axis[0].values[k + 1] - series->axis[0].values[k]);
        }
        TRY(results_put_series(results, &shape, replica, slopes));
    }
    return OK;
}

Status derive_viscosity(Results *results, const ResultSeries *wandering, const System *system) {
    if (wandering->axis[0].count < CURVE_LAGS_LEAST) return OK;
    double *weights = NULL, *slopes = NULL, *times = NULL;
    Status status = curve_weights(&weights, &wandering->axis[0]);
    const size_t count = wandering->axis[0].count;
    if (status == OK) status = NEW_ARRAY(slopes, count);
    if (status == OK) status = NEW_ARRAY(times, count);
    if (status == OK) {
        const Curve curve = curve_in(results, wandering, 0, weights);
        const bool enough = curve.lags >= CURVE_LAGS_LEAST;
        if (enough) status = put_zero_shear(results, &curve, system);
        if (enough && status == OK) status = put_slopes(results, &curve, system, slopes, times);
    }
    memory_free(weights);
    memory_free(slopes);
    memory_free(times);
    return status;
}
