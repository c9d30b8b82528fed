// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a stage is stationary: a series in blocks of time, its second half less its first.
#include "analysis/derive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Of the blocks that have a value.
static double mean_of(const double *values, size_t from, size_t to) {
    double sum = 0, count = 0;
    for (size_t k = from; k < to; k++) {
        if (!isfinite(values[k])) continue;
        sum += values[k];
        count++;
    }
    return count > 0 ? sum / count : (double)NAN;
}

Status derive_drift(Results *results, const ResultSeries *series) {
    const size_t blocks = series->size;
    if (series->axes != 1 || strcmp(series->axis[0].name, "time") != 0 || blocks < 2) return OK;
    char name[2 * RESULT_NAME];
    snprintf(name, sizeof name, "%s_drift", series->observable);
    for (size_t r = 0; r < results->replicas; r++) {
        const double *values = series->values + r * blocks;
        TRY(results_put_scalar(
            results, series->stage, name, series->unit,
            "Mean of the second half of the stage less that of the first: well "
            "above its error, the stage is not stationary.",
            r, mean_of(values, (blocks + 1) / 2, blocks) - mean_of(values, 0, blocks / 2)));
    }
    return OK;
}
