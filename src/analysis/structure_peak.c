// SPDX-License-Identifier: GPL-3.0-or-later
// The peak of the total structure factor over the stage: it rises where particles order. Where it
// lies is found from the mean over the stage and all replicas; its height is then followed.
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Of one wave number, over the stretches that have a value in some replica.
static double mean_height(const Results *results, const ResultSeries *stretches, size_t wave) {
    const size_t times = stretches->axis[1].count;
    double sum = 0, n = 0;
    for (size_t t = 0; t < times; t++) {
        const double height = results_series_estimate(results, stretches, wave * times + t).value;
        if (!isfinite(height)) continue;
        sum += height;
        n++;
    }
    return sum / n;
}

static size_t find_peak(const Results *results, const ResultSeries *stretches) {
    size_t peak = 0;
    for (size_t q = 1; q < stretches->axis[0].count; q++) {
        if (mean_height(results, stretches, q) > mean_height(results, stretches, peak)) peak = q;
    }
    return peak;
}

static Status put_peak(Results *results, const ResultSeries *stretches, size_t peak,
                       const double *heights) {
    const size_t times = stretches->axis[1].count;
    const double wave_number = stretches->axis[0].values[peak];
    ResultSeries shape = derive_shape(stretches, "structure_peak");
    snprintf(shape.about, sizeof shape.about,
             "Height of the peak of the total S(q), at q = %.4g/d, in stretches of the stage: it "
             "rises where particles order.",
             wave_number);
    shape.axes = 1;
    shape.axis[0] = stretches->axis[1];
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_series(results, &shape, r, heights + r * times));
        TRY(results_put_scalar(results, shape.stage, "structure_peak_wave_number", "1/d", NULL, r,
                               wave_number));
    }
    return OK;
}

Status derive_structure_peak(Results *results, const ResultSeries *stretches) {
    const size_t times = stretches->axis[1].count;
    const size_t peak = find_peak(results, stretches);
    double *heights = NULL;
    TRY(NEW_ARRAY(heights, results->replicas * times));
    for (size_t r = 0; r < results->replicas; r++)
        memcpy(heights + r * times, stretches->values + r * stretches->size + peak * times,
               times * sizeof *heights);
    const Status status = put_peak(results, stretches, peak, heights);
    memory_free(heights);
    return status;
}
