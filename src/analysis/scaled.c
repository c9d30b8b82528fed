// SPDX-License-Identifier: GPL-3.0-or-later
// The second scaling law, of the final decay: scattering functions against t/tau, tau where they
// have fallen to 1/e, are one master curve for all states near the glass transition (Weysser,
// thesis, ch. 3). Here they are put on one grid of t/tau, the same for all states, so that a sweep
// can lay them over each other. tau is found anew for each sample of the jackknife.
//
// And those of steady flows against strain: where strain is all that makes a glass relax, as in
// slow flows, they are one master curve for all rates (ch. 5).
#include "analysis/decay.h"
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { POINTS = 51, PER_DECADE = 10 };
static const double FIRST = 1e-4; // up to 10

typedef struct Scaling {
    const ResultSeries *series;
    const char *suffix, *axis;
    double unit; // the time that is 1 on the grid; 0: tau
    size_t lags, rows;
    double grid[POINTS];
    double *mean;   // [lags]
    double *values; // [replica][row][POINTS]: pseudo-values
} Scaling;

static void scale(const Scaling *scaling, const double *times, double *out) {
    const double *mean = scaling->mean, *grid = scaling->grid;
    const size_t lags = scaling->lags;
    const double tau =
        scaling->unit > 0 ? scaling->unit : decay_time_at(times, mean, lags, 1 / exp(1));
    for (size_t i = 0; i < POINTS; i++)
        out[i] = isnan(tau) ? (double)NAN : decay_value_at(times, mean, lags, tau * grid[i]);
}

static void derive_row(const Results *results, Scaling *scaling, size_t row) {
    double all[POINTS], *values = scaling->values + row * POINTS;
    const size_t lags = scaling->lags, stride = scaling->rows * POINTS;
    const double *times = scaling->series->axis[scaling->series->axes - 1].values;
    decay_mean(results, scaling->series, row * lags, lags, DECAY_NOBODY, scaling->mean);
    scale(scaling, times, all);
    for (size_t r = 0; r < results->replicas; r++) {
        decay_mean(results, scaling->series, row * lags, lags, (int64_t)r, scaling->mean);
        scale(scaling, times, values + r * stride);
    }
    for (size_t i = 0; i < POINTS; i++)
        pseudo_values(results->replicas, all[i], values + i, stride);
}

static Status put(Results *results, const Scaling *scaling) {
    ResultSeries shape = derive_shape(scaling->series, scaling->suffix);
    shape.axis[shape.axes - 1] = (ResultAxis){.unit = "", .count = POINTS, .values = scaling->grid};
    shape.axis[shape.axes - 1].name = scaling->axis;
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_series(results, &shape, r, scaling->values + r * scaling->rows * POINTS));
    }
    return OK;
}

// Time is the last axis.
static Status derive(Results *results, const ResultSeries *series, Scaling scaling) {
    const ResultAxis *time = &series->axis[series->axes - 1];
    if (strcmp(time->name, "time") != 0) return OK;
    const ResultSeries shape = *series; // results may move it when they grow
    scaling.series = &shape;
    scaling.lags = time->count;
    scaling.rows = series->size / time->count;
    for (size_t i = 0; i < POINTS; i++) scaling.grid[i] = FIRST * pow(10, (double)i / PER_DECADE);
    Status status = NEW_ARRAY(scaling.mean, scaling.lags);
    if (status == OK) status = NEW_ARRAY(scaling.values, results->replicas * scaling.rows * POINTS);
    for (size_t row = 0; row < scaling.rows && status == OK; row++)
        derive_row(results, &scaling, row);
    if (status == OK) status = put(results, &scaling);
    memory_free(scaling.mean);
    memory_free(scaling.values);
    return status;
}

Status derive_scaled(Results *results, const ResultSeries *series) {
    return derive(results, series, (Scaling){.suffix = "_scaled", .axis = "scaled_time"});
}

Status derive_against_strain(Results *results, const ResultSeries *series) {
    const ResultScalar *found = results_find_scalar(results, series->stage, "shear_rate");
    const double rate = found ? fabs(results_scalar_estimate(results, found).value) : 0;
    if (!(rate > 0)) return OK;
    return derive(results, series,
                  (Scaling){.suffix = "_against_strain", .axis = "strain", .unit = 1 / rate});
}
