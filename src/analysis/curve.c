// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes of curves over lags.
#include "analysis/curve.h"

#include "base/memory.h"
#include "numerics/fit.h"

#include <math.h>

static const double AGREEMENT = 2;
static const double LAST_STRETCH = 4; // the window is t_last/4 to t_last

Status curve_weights(double **weights, const ResultAxis *time) {
    TRY(NEW_ARRAY(*weights, time->count));
    for (size_t k = 0; k < time->count; k++) {
        (*weights)[k] = 1 / (time->values[k] * time->values[k]);
    }
    return OK;
}

static size_t lags_seen(const double *values, size_t lags) {
    while (lags > 0 && isnan(values[lags - 1])) lags--;
    return lags;
}

Curve curve_in(const Results *results, const ResultSeries *series, size_t row, double *weights) {
    const ResultAxis *time = &series->axis[series->axes - 1];
    Curve curve = {.results = results,
                   .series = series,
                   .times = time->values,
                   .stride = time->count,
                   .row = row,
                   .lags = time->count,
                   .weights = weights};
    for (size_t replica = 0; replica < results->replicas; replica++) {
        const size_t seen = lags_seen(curve_of(&curve, replica), time->count);
        if (seen > 0 && seen < curve.lags) curve.lags = seen;
    }
    return curve;
}

const double *curve_of(const Curve *curve, size_t replica) {
    return curve->series->values + replica * curve->series->size + curve->row * curve->stride;
}

double curve_mean(const Curve *curve, size_t lag) {
    return results_series_estimate(curve->results, curve->series, curve->row * curve->stride + lag)
        .value;
}

double curve_slope(const Curve *curve, size_t replica, size_t begin, size_t end) {
    return fit_line(curve->times + begin, curve_of(curve, replica) + begin, curve->weights + begin,
                    end - begin)
        .slope;
}

// The lag that halves [begin, end) in log t.
static size_t middle(const Curve *curve, size_t begin, size_t end) {
    const double time = sqrt(curve->times[begin] * curve->times[end - 1]);
    size_t lag = begin;
    while (curve->times[lag] < time) lag++;
    return lag;
}

static bool halves_agree(const Curve *curve, size_t begin, size_t end) {
    const size_t half = middle(curve, begin, end);
    if (half - begin < CURVE_LAGS_LEAST || end - half < CURVE_LAGS_LEAST) return false;
    double sum = 0, squares = 0, count = 0;
    for (size_t replica = 0; replica < curve->results->replicas; replica++) {
        const double difference =
            curve_slope(curve, replica, begin, half + 1) - curve_slope(curve, replica, half, end);
        if (!isfinite(difference)) continue;
        sum += difference;
        squares += difference * difference;
        count++;
    }
    if (count < 2) return false;
    const double mean = sum / count;
    const double error = sqrt(fmax(squares / count - mean * mean, 0) / (count - 1));
    return fabs(mean) <= AGREEMENT * error;
}

size_t curve_window(const Curve *curve, bool *settled) {
    *settled = true;
    for (size_t begin = 0; begin + 2 * CURVE_LAGS_LEAST <= curve->lags; begin++) {
        if (halves_agree(curve, begin, curve->lags)) return middle(curve, begin, curve->lags);
    }
    *settled = false;
    size_t begin = 0;
    const double last = curve->times[curve->lags - 1];
    while (begin + 2 < curve->lags && curve->times[begin] < last / LAST_STRETCH) begin++;
    return begin;
}
