// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a scattering function's decay: its relaxation time, where it has fallen to 1/e, and
// Kohlrausch's law A exp(-(t/tau)^beta). The law holds of the last decay only, so that it is fitted
// from a beginning that is scanned: the exponent of every beginning is given, and chosen is that
// around which, half a decade to both sides, it changes least, behind the plateau if there is one
// (factorisation.c). The errors are the jackknife's over replicas, with the same window for all; a
// law whose tau is not among the lags that it is fitted to is not told.
#include "analysis/decay.h"
#include "analysis/derive.h"
#include "base/memory.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// Levels of functions that are 1 at t = 0, whatever the first lag.
static const double BEGINS_BELOW = 0.98, BEGINS_ABOVE = 0.2;
static const double ENDS_BELOW = 0.02; // noise comes next
static const double HALF_DECADE = 3.1622776601683795;
enum { POINTS_LEAST = 6, PARAMETERS = 3, STEPS_MOST = 100 };

typedef enum Number { AMPLITUDE, TIME, EXPONENT, NUMBERS } Number;

typedef struct Law {
    double number[NUMBERS]; // NaN where there is no fit
} Law;

// A decay, [lags], and where it is fitted.
typedef struct Curve {
    size_t lags, begin, end;
    const double *times, *values;
} Curve;

static const Law NO_LAW = {{(double)NAN, (double)NAN, (double)NAN}};

// Of the logarithms of the numbers, so that these stay positive.
static int residuals(const gsl_vector *x, void *data, gsl_vector *f) {
    const Curve *curve = data;
    const double a = exp(gsl_vector_get(x, AMPLITUDE)), tau = exp(gsl_vector_get(x, TIME)),
                 beta = exp(gsl_vector_get(x, EXPONENT));
    for (size_t k = curve->begin; k < curve->end; k++) {
        const double model = a * exp(-pow(curve->times[k] / tau, beta));
        gsl_vector_set(f, k - curve->begin, model - curve->values[k]);
    }
    return GSL_SUCCESS;
}

static bool is_decay(const Curve *curve) {
    for (size_t k = curve->begin; k < curve->end; k++) {
        if (!(curve->values[k] > 0) || !(curve->times[k] > 0)) return false;
    }
    return curve->end >= curve->begin + POINTS_LEAST;
}

static double time_at(const Curve *curve, double level) {
    return decay_time_at(curve->times, curve->values, curve->lags, level);
}

static Law fit_with(gsl_multifit_nlinear_workspace *work, Curve *curve) {
    gsl_multifit_nlinear_fdf problem = {
        .f = residuals, .n = curve->end - curve->begin, .p = PARAMETERS, .params = curve};
    const double amplitude = curve->values[curve->begin];
    double tau = time_at(curve, amplitude / exp(1));
    if (!(tau > 0)) tau = curve->times[curve->end - 1];
    double first[PARAMETERS] = {log(amplitude), log(tau), log(0.7)};
    const gsl_vector_view start = gsl_vector_view_array(first, PARAMETERS);
    int why = 0;
    if (gsl_multifit_nlinear_init(&start.vector, &problem, work) != GSL_SUCCESS) return NO_LAW;
    if (gsl_multifit_nlinear_driver(STEPS_MOST, 1e-10, 1e-10, 0, NULL, NULL, &why, work) !=
        GSL_SUCCESS)
        return NO_LAW;
    Law law;
    const gsl_vector *found = gsl_multifit_nlinear_position(work);
    for (size_t n = 0; n < NUMBERS; n++) law.number[n] = exp(gsl_vector_get(found, n));
    return law;
}

static Law fit(Curve curve) {
    if (!is_decay(&curve)) return NO_LAW;
    const gsl_multifit_nlinear_parameters usual = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *work = gsl_multifit_nlinear_alloc(
        gsl_multifit_nlinear_trust, &usual, curve.end - curve.begin, PARAMETERS);
    if (!work) return NO_LAW;
    const Law law = fit_with(work, &curve);
    gsl_multifit_nlinear_free(work);
    return law;
}

// Everything that is asked about one row of a series.
typedef struct Row {
    const Results *results;
    const ResultSeries *series;
    size_t first;     // element at the first lag
    Curve curve;      // its window is the one that was chosen
    double *mean;     // [lags], of all replicas or of those without one
    double plateau;   // the time when it is passed; NaN if that is not known
    double *exponent; // [lags], of the law that begins there; NaN where none may
} Row;

static void mean_without(Row *row, int64_t without) {
    decay_mean(row->results, row->series, row->first, row->curve.lags, without, row->mean);
}

static size_t end_of(const Curve *curve) {
    size_t end = 0;
    while (end < curve->lags && curve->values[end] > ENDS_BELOW) end++;
    return end;
}

// Of what there is to decay: of the plateau, where that is known.
static bool may_begin(const Row *row, size_t k) {
    const Curve *curve = &row->curve;
    const double height = decay_value_at(curve->times, curve->values, curve->lags, row->plateau);
    const double least = BEGINS_ABOVE * (isnan(height) ? 1 : height);
    const double value = curve->values[k];
    return value < BEGINS_BELOW && value > least && curve->times[k] > 0;
}

// The law is chosen among those that begin behind the plateau.
static bool is_candidate(const Row *row, size_t k) {
    return !isnan(row->exponent[k]) && !(row->curve.times[k] < row->plateau);
}

// Of every beginning that there may be.
static void scan(Row *row) {
    Curve curve = row->curve;
    curve.end = end_of(&curve);
    for (size_t k = 0; k < curve.lags; k++) {
        curve.begin = k;
        row->exponent[k] = may_begin(row, k) ? fit(curve).number[EXPONENT] : (double)NAN;
    }
}

// The spread of the exponent around a beginning; infinite with fewer than three.
static double unsteadiness(const Row *row, size_t at) {
    const double *times = row->curve.times;
    double least = INFINITY, most = -INFINITY;
    size_t count = 0;
    for (size_t k = 0; k < row->curve.lags; k++) {
        if (!is_candidate(row, k) || times[k] < times[at] / HALF_DECADE ||
            times[k] > times[at] * HALF_DECADE)
            continue;
        least = fmin(least, row->exponent[k]);
        most = fmax(most, row->exponent[k]);
        count++;
    }
    return count < 3 ? INFINITY : most - least;
}

static void choose_window(Row *row) {
    double best = INFINITY;
    row->curve.begin = row->curve.lags; // none
    row->curve.end = end_of(&row->curve);
    for (size_t k = 0; k < row->curve.lags; k++) {
        if (!is_candidate(row, k)) continue;
        const double spread = unsteadiness(row, k);
        if (spread < best || row->curve.begin == row->curve.lags) {
            best = spread;
            row->curve.begin = k;
        }
    }
}

enum { RELAXATION_TIME = NUMBERS, WINDOW, QUANTITIES };

static void quantities(const Row *row, double out[QUANTITIES]) {
    const Law law = row->curve.begin < row->curve.end ? fit(row->curve) : NO_LAW;
    memcpy(out, law.number, sizeof law.number);
    out[RELAXATION_TIME] = time_at(&row->curve, 1 / exp(1));
    out[WINDOW] =
        row->curve.begin < row->curve.lags ? row->curve.times[row->curve.begin] : (double)NAN;
}

// Whether the law falls to 1/e of its amplitude among the lags that it is fitted to. Of another its
// numbers depend on each other so much that they are those of the noise.
static bool is_seen(const Row *row, const double quantity[QUANTITIES]) {
    const Curve *curve = &row->curve;
    return curve->begin < curve->end && quantity[TIME] >= curve->times[curve->begin] &&
           quantity[TIME] <= curve->times[curve->end - 1];
}

// values[replica][quantity][row]: pseudo-values. No law is told where it is not seen of all
// replicas or of all but one.
static void derive_row(Row *row, double *values, size_t index, size_t rows) {
    double all[QUANTITIES], rest[QUANTITIES];
    const size_t replicas = row->results->replicas, stride = QUANTITIES * rows;
    mean_without(row, DECAY_NOBODY);
    scan(row);
    choose_window(row);
    quantities(row, all);
    bool seen = is_seen(row, all);
    for (size_t r = 0; r < replicas; r++) {
        mean_without(row, (int64_t)r);
        quantities(row, rest);
        seen = seen && (replicas < 2 || is_seen(row, rest));
        for (size_t q = 0; q < QUANTITIES; q++) values[r * stride + q * rows + index] = rest[q];
    }
    for (size_t q = 0; q < QUANTITIES; q++) {
        if (!seen && q != RELAXATION_TIME) all[q] = NAN;
        pseudo_values(replicas, all[q], values + q * rows + index, stride);
    }
}

static Status put_quantity(Results *results, const ResultSeries *of, size_t quantity,
                           const double *values, size_t rows) {
    static const struct {
        const char *name;
        bool time;
    } numbers[QUANTITIES] = {
        [AMPLITUDE] = {"_kohlrausch_amplitude", false},
        [TIME] = {"_kohlrausch_time", true},
        [EXPONENT] = {"_kohlrausch_exponent", false},
        [RELAXATION_TIME] = {"_relaxation_time", true},
        [WINDOW] = {"_kohlrausch_window", true},
    };
    ResultSeries shape = derive_shape(of, numbers[quantity].name);
    shape.axes--; // all but time
    snprintf(shape.unit, sizeof shape.unit, "%.60s",
             numbers[quantity].time ? of->axis[of->axes - 1].unit : "");
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_series(results, &shape, r, values + (r * QUANTITIES + quantity) * rows));
    }
    return OK;
}

// Of the mean over replicas: one value, that has no error.
static Status put_scan(Results *results, const ResultSeries *of, const double *exponents) {
    ResultSeries shape = derive_shape(of, "_kohlrausch_scan");
    shape.unit[0] = '\0';
    return results_put_series(results, &shape, 0, exponents);
}

// Of a row, as derive_factorisation found it for all wave numbers.
static double plateau_of(const Results *results, const ResultSeries *of, size_t row) {
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "%.40s_factorisation_window", of->observable);
    const ResultSeries *window = results_find_series(results, of->stage, name);
    if (!window) return NAN;
    const size_t waves = of->axis[of->axes - 2].count, borders = 3, middle = 1;
    return results_series_estimate(results, window, row / waves * borders + middle).value;
}

static Status derive_rows(Results *results, const ResultSeries *series, Row *row, double *values,
                          double *exponents) {
    const size_t rows = series->size / row->curve.lags;
    for (size_t i = 0; i < rows; i++) {
        row->first = i * row->curve.lags;
        row->plateau = plateau_of(results, series, i);
        row->exponent = exponents + row->first;
        derive_row(row, values, i, rows);
    }
    const ResultSeries shape = *series; // results may move it when they grow
    TRY(put_scan(results, &shape, exponents));
    for (size_t q = 0; q < QUANTITIES; q++) TRY(put_quantity(results, &shape, q, values, rows));
    return OK;
}

// Time is the last axis.
Status derive_kohlrausch(Results *results, const ResultSeries *series) {
    const ResultAxis *time = &series->axis[series->axes - 1];
    if (strcmp(time->name, "time") != 0 || time->count < POINTS_LEAST) return OK;
    Row row = {.results = results,
               .series = series,
               .curve = {.lags = time->count, .times = time->values}};
    double *values = NULL, *exponents = NULL;
    Status status = NEW_ARRAY(row.mean, time->count);
    if (status == OK) status = NEW_ARRAY(exponents, series->size);
    if (status == OK)
        status = NEW_ARRAY(values, results->replicas * QUANTITIES * (series->size / time->count));
    row.curve.values = row.mean;
    gsl_error_handler_t *before = gsl_set_error_handler_off(); // a fit that fails is no number
    if (status == OK) status = derive_rows(results, series, &row, values, exponents);
    gsl_set_error_handler(before);
    memory_free(values);
    memory_free(exponents);
    memory_free(row.mean);
    return status;
}
