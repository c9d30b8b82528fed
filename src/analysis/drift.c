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

static Status put_drift(Results *results, const ResultSeries *series, size_t first, size_t blocks,
                        const char *name) {
    for (size_t r = 0; r < results->replicas; r++) {
        const double *values = series->values + r * series->size + first;
        TRY(results_put_scalar(results, series->stage, name, series->unit, NULL, r,
                               mean_of(values, (blocks + 1) / 2, blocks) -
                                   mean_of(values, 0, blocks / 2)));
    }
    return OK;
}

// Time is the last axis; one of labels may stand before it.
Status derive_drift(Results *results, const ResultSeries *series) {
    const ResultAxis *time = &series->axis[series->axes - 1], *kind = &series->axis[0];
    const bool alone = series->axes == 1;
    if (strcmp(time->name, "time") != 0 || time->count < 2) return OK;
    if (!alone && (series->axes != 2 || !kind->labels)) return OK;
    for (size_t row = 0; row < series->size / time->count; row++) {
        char name[3 * RESULT_NAME];
        snprintf(name, sizeof name, "%s%s%s_drift", series->observable, alone ? "" : "_",
                 alone ? "" : kind->labels[row]);
        TRY(put_drift(results, series, row * time->count, time->count, name));
    }
    return OK;
}
