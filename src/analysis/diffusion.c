// SPDX-License-Identifier: GPL-3.0-or-later
// Diffusion coefficients from mean squared displacements.
//
// Short time: the largest <r^2>/(2 dim t). Below a thermostat interval flight makes it grow with
// t, beyond it collisions make it fall; in between it is D0 less what collisions within the
// interval take, and tends to D0 with the interval.
//
// Long time: the slope of a straight line a + 2 dim D t, weighted by 1/t^2 (errors grow with t).
// The window ends at the last lag. To see where the slope stops changing, stretches of lags that
// end there are cut into halves (in log t): the earliest stretch is taken whose halves have slopes
// that agree within AGREEMENT standard errors of their difference over replicas. Its later half is
// the window; its earlier half is the proof that the window is long after the change. Where no
// stretch is like that, or with one replica, the window is the last LAST_STRETCH in time; the slope
// is then an upper bound on the diffusion coefficient.
//
// The displacements of bodies with an axis, along and across the body axis and the director at the
// time origin, have each its own: in the isotropic phase all tend to one, in the nematic those of
// the director are the diffusion tensor.
#include "analysis/derive.h"
#include "base/memory.h"
#include "numerics/fit.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double AGREEMENT = 2;
static const double LAST_STRETCH = 4; // the window is t_last/4 to t_last
enum { HALF_LEAST = 3 };              // lags in each half of a window

// The curve of one species, along one direction or in total.
typedef struct Curve {
    const Results *results;
    const ResultSeries *series;
    const double *times;
    size_t lags, row;         // values[replica][row * lags + lag]
    double dimensions;        // that it sums over
    double *weights;          // [lags], 1/t^2
    char suffix[RESULT_NAME]; // of the names of its numbers: "_parallel_rod"
} Curve;

static const double *curve_of(const Curve *curve, size_t replica) {
    return curve->series->values + replica * curve->series->size + curve->row * curve->lags;
}

static double curve_mean(const Curve *curve, size_t lag) {
    return results_series_estimate(curve->results, curve->series, curve->row * curve->lags + lag)
        .value;
}

// D of one replica from lags [begin, end).
static double slope(const Curve *curve, size_t replica, size_t begin, size_t end) {
    return fit_slope(curve->times + begin, curve_of(curve, replica) + begin, curve->weights + begin,
                     end - begin) /
           (2 * curve->dimensions);
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
    if (half - begin < HALF_LEAST || end - half < HALF_LEAST) return false;
    double sum = 0, squares = 0, count = 0;
    for (size_t replica = 0; replica < curve->results->replicas; replica++) {
        const double difference =
            slope(curve, replica, begin, half + 1) - slope(curve, replica, half, end);
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

// Where the window begins; `settled` if the slope is seen to have stopped changing before.
static size_t window_begin(const Curve *curve, bool *settled) {
    *settled = true;
    for (size_t begin = 0; begin + 2 * HALF_LEAST <= curve->lags; begin++) {
        if (halves_agree(curve, begin, curve->lags)) return middle(curve, begin, curve->lags);
    }
    *settled = false;
    size_t begin = 0;
    const double last = curve->times[curve->lags - 1];
    while (begin + 2 < curve->lags && curve->times[begin] < last / LAST_STRETCH) begin++;
    return begin;
}

static size_t fastest_lag(const Curve *curve) {
    size_t best = 0;
    for (size_t k = 1; k < curve->lags; k++) {
        const double here = curve_mean(curve, k) / curve->times[k];
        if (here > curve_mean(curve, best) / curve->times[best]) best = k;
    }
    return best;
}

static Status put(Results *results, const Curve *curve, const char *quantity, const char *unit,
                  const char *about, size_t replica, double value) {
    char name[2 * RESULT_NAME];
    snprintf(name, sizeof name, "%s%s", quantity, curve->suffix);
    return results_put_scalar(results, curve->series->stage, name, unit, about, replica, value);
}

static Status put_short(Results *results, const Curve *curve) {
    const size_t lag = fastest_lag(curve);
    const double time = curve->times[lag];
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(put(results, curve, "short_time_diffusion", "D0",
                "Largest <r^2>/(2 dim t), reached about one thermostat interval (Monte Carlo: at "
                "once); the free coefficient for vanishing interval or step.",
                replica, curve_of(curve, replica)[lag] / (2 * curve->dimensions * time)));
    }
    return OK;
}

static Status put_long(Results *results, const Curve *curve, const char *unit) {
    static const char SETTLED[] =
        "Slope of <r^2>/(2 dim) against t, from long_time_window to the last lag.";
    static const char FALLING[] =
        "Upper bound, for the slope is not seen to have stopped falling: that of <r^2>/(2 dim) "
        "against t, from long_time_window to the last lag.";
    bool settled = false;
    const size_t begin = window_begin(curve, &settled);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(put(results, curve, "long_time_diffusion", unit, settled ? SETTLED : FALLING, replica,
                slope(curve, replica, begin, curve->lags)));
        TRY(put(
            results, curve, "long_time_window", curve->series->axis[2].unit,
            "Start of the fit: over as long before it in log t the slope is the same within two "
            "standard errors; or else a quarter of the last lag.",
            replica, curve->times[begin]));
    }
    return OK;
}

static bool is_brownian(const ResultSeries *series) {
    return strcmp(series->axis[2].unit, "d^2/D0") == 0;
}

static Status derive_curve(Results *results, const Curve *curve, bool short_too) {
    const bool brownian = is_brownian(curve->series);
    if (brownian && short_too) TRY(put_short(results, curve));
    return put_long(results, curve, brownian ? "D0" : "d sqrt(kT/m)");
}

// The last species, which is all of them or the only one, bears no name.
static void name_curve(Curve *curve, const ResultSeries *series, size_t species,
                       const char *direction) {
    const bool named = species + 1 < series->axis[0].count;
    snprintf(curve->suffix, sizeof curve->suffix, "%s%s%s%s", direction ? "_" : "",
             direction ? direction : "", named ? "_" : "",
             named ? series->axis[0].labels[species] : "");
}

static Status new_weights(double **weights, const ResultAxis *time) {
    TRY(NEW_ARRAY(*weights, time->count));
    for (size_t k = 0; k < time->count; k++) {
        (*weights)[k] = 1 / (time->values[k] * time->values[k]);
    }
    return OK;
}

static Curve curve_in(const Results *results, const ResultSeries *series, size_t row,
                      double *weights) {
    return (Curve){.results = results,
                   .series = series,
                   .times = series->axis[2].values,
                   .lags = series->axis[2].count,
                   .row = row,
                   .dimensions = 1,
                   .weights = weights};
}

Status derive_diffusion(Results *results, const ResultSeries *series) {
    const size_t species = series->axis[0].count, directions = series->axis[1].count;
    if (series->axis[2].count < HALF_LEAST) return OK;
    double *weights = NULL;
    TRY(new_weights(&weights, &series->axis[2]));
    Status status = OK;
    for (size_t s = 0; status == OK && s < species; s++) {
        Curve curve = curve_in(results, series, (s + 1) * directions - 1, weights);
        curve.dimensions = (double)directions - 1; // the last direction is the total
        name_curve(&curve, series, s, NULL);
        status = derive_curve(results, &curve, true);
    }
    memory_free(weights);
    return status;
}

Status derive_directional_diffusion(Results *results, const ResultSeries *series) {
    const size_t species = series->axis[0].count, directions = series->axis[1].count;
    if (series->axis[2].count < HALF_LEAST) return OK;
    double *weights = NULL;
    TRY(new_weights(&weights, &series->axis[2]));
    Status status = OK;
    for (size_t row = 0; status == OK && row < species * directions; row++) {
        Curve curve = curve_in(results, series, row, weights);
        name_curve(&curve, series, row / directions, series->axis[1].labels[row % directions]);
        status = derive_curve(results, &curve, false);
    }
    memory_free(weights);
    return status;
}
