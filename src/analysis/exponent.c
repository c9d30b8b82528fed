// SPDX-License-Identifier: GPL-3.0-or-later
// Effective exponents of displacements, d ln <dr^2>/d ln t: 1 for diffusion, less in a cage, 3
// along a flow (Taylor). From lag to lag over two steps of the ladder of lags; a function of means,
// hence by the jackknife over replicas.
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>

static const int64_t NOBODY = -1;

// The mean over replicas but one.
static double mean_without(const Results *results, const ResultSeries *series, size_t element,
                           int64_t without) {
    double sum = 0, count = 0;
    for (size_t r = 0; r < results->replicas; r++) {
        if ((int64_t)r == without) continue;
        sum += series->values[r * series->size + element];
        count++;
    }
    return sum / count;
}

// Around an element that is neither the first nor the last lag; NaN where the sign changes.
static double exponent(const Results *results, const ResultSeries *series, size_t element,
                       const double *time, int64_t without) {
    const double before = mean_without(results, series, element - 1, without);
    const double after = mean_without(results, series, element + 1, without);
    return log(after / before) / log(time[1] / time[-1]);
}

static void fill(const Results *results, const ResultSeries *series, double *values) {
    const ResultAxis *time = &series->axis[series->axes - 1];
    for (size_t e = 0; e < series->size; e++) {
        const size_t k = e % time->count;
        const bool inside = k > 0 && k + 1 < time->count;
        const double *at = time->values + k;
        const double all = inside ? exponent(results, series, e, at, NOBODY) : (double)NAN;
        for (size_t r = 0; r < results->replicas && inside; r++)
            values[r * series->size + e] = exponent(results, series, e, at, (int64_t)r);
        pseudo_values(results->replicas, all, values + e, series->size);
    }
}

Status derive_exponent(Results *results, const ResultSeries *series) {
    ResultSeries shape = derive_shape(series, "_exponent");
    double *values = NULL;
    TRY(NEW_ARRAY(values, results->replicas * shape.size));
    fill(results, series, values);
    shape.unit[0] = '\0';
    Status status = OK;
    for (size_t r = 0; r < results->replicas && status == OK; r++) {
        status = results_put_series(results, &shape, r, values + r * shape.size);
    }
    memory_free(values);
    return status;
}
