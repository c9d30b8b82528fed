// SPDX-License-Identifier: GPL-3.0-or-later
// Contact values by extrapolation, and the pressure from them.
// g(r/d_ij) falls from contact over a distance that shrinks with density. It is fitted by a cubic
// from contact to where it has fallen to FALLEN of its first value (averaged over replicas; the
// whole histogram if it does not fall so far): over less than a factor of two a cubic follows an
// exponential to 1e-4 of it, while every bin in the window helps to beat the noise. What pairs meet
// in a virtual compression is extrapolated likewise.
#include "analysis/derive.h"
#include "base/memory.h"
#include "numerics/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double FALLEN = 0.6;
enum { CUBIC = 3, SMOOTH = 5, BINS_LEAST = 3 * (CUBIC + 1) };

// Rows of a series that are extrapolated from one window, side by side.
typedef struct Rows {
    size_t first, count;
} Rows;

// Mean over replicas, rows and up to SMOOTH bins from `bin` on.
static double smooth(const Results *results, const ResultSeries *series, Rows rows, size_t bins,
                     size_t bin) {
    double sum = 0, samples = 0;
    for (size_t row = rows.first; row < rows.first + rows.count; row++) {
        for (size_t k = bin; k < bins && k < bin + SMOOTH; k++, samples++) {
            sum += results_series_estimate(results, series, row * bins + k).value;
        }
    }
    return sum / samples;
}

static size_t window(const Results *results, const ResultSeries *series, Rows rows, size_t bins) {
    const double least = FALLEN * fabs(smooth(results, series, rows, bins, 0));
    size_t end = bins < BINS_LEAST ? bins : BINS_LEAST;
    while (end < bins && fabs(smooth(results, series, rows, bins, end)) > least) end++;
    return end;
}

static Status put_contact_value(Results *results, const ResultSeries *series, size_t row,
                                size_t replica, double value) {
    char quantity[RESULT_NAME];
    snprintf(quantity, sizeof quantity, "contact_value_%s", series->axis[0].labels[row]);
    for (char *c = quantity; *c; c++) {
        if (*c == '-') *c = '_';
    }
    return results_put_scalar(results, series->stage, quantity, "", NULL, replica, value);
}

// One replica: extrapolates each pair and adds up the pressure.
static Status derive_replica(Results *results, const ResultSeries *series,
                             const ResultSeries *weights, const size_t *windows, size_t replica) {
    const size_t pairs = series->axis[0].count, bins = series->axis[1].count;
    double compressibility = 1;
    for (size_t pair = 0; pair < pairs; pair++) {
        const double *g = series->values + replica * series->size + pair * bins;
        const double weight = weights->values[replica * weights->size + pair];
        double contact = NAN;
        TRY(fit_value_at_edge(g, windows[pair], CUBIC, &contact));
        TRY(put_contact_value(results, series, pair, replica, contact));
        if (weight > 0) compressibility += weight * contact; // a species may have one particle
    }
    return results_put_scalar(results, series->stage, "compressibility_factor_contact", "", NULL,
                              replica, compressibility);
}

Status derive_contact(Results *results, const ResultSeries *series) {
    const ResultSeries *weights = results_find_series(results, series->stage, "contact_weight");
    const size_t pairs = series->axis[0].count, bins = series->axis[1].count;
    if (!weights || bins < CUBIC + 1) return OK;
    size_t *windows = NULL;
    TRY(NEW_ARRAY(windows, pairs));
    for (size_t pair = 0; pair < pairs; pair++) {
        windows[pair] = window(results, series, (Rows){pair, 1}, bins);
    }
    Status status = OK;
    for (size_t replica = 0; status == OK && replica < results->replicas; replica++) {
        status = derive_replica(results, series, weights, windows, replica);
    }
    memory_free(windows);
    return status;
}

Status derive_compression(Results *results, const ResultSeries *series, const System *system) {
    const size_t bins = series->axis[0].count;
    if (bins < CUBIC + 1) return OK;
    const size_t end = window(results, series, (Rows){0, 1}, bins);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        double excess = NAN;
        TRY(fit_value_at_edge(series->values + replica * series->size, end, CUBIC, &excess));
        TRY(results_put_scalar(results, series->stage, "compressibility_factor_compression", "",
                               NULL, replica, 1 + excess));
        TRY(results_put_scalar(results, series->stage, "pressure_compression", "kT/d^3", NULL,
                               replica, system_number_density(system) * (1 + excess)));
    }
    return OK;
}

// The stress tensor at contact by its elements; what the series does not have is 0, of the shear
// stress NaN: over an oscillation it has no mean.
typedef struct Tensor {
    double xx, yy, zz, xy;
} Tensor;

static double *element_of(Tensor *tensor, const char *name) {
    if (strcmp(name, "xx") == 0) return &tensor->xx;
    if (strcmp(name, "yy") == 0) return &tensor->yy;
    if (strcmp(name, "zz") == 0) return &tensor->zz;
    return strcmp(name, "xy") == 0 ? &tensor->xy : NULL;
}

static Status put_tensor(Results *results, const ResultSeries *series, const System *system,
                         Tensor stress, size_t replica) {
    const char *stage = series->stage, *unit = series->unit;
    const double dimension = (double)system->dimension;
    if (!isnan(stress.xy))
        TRY(results_put_scalar(results, stage, "shear_stress_contact", unit, NULL, replica,
                               stress.xy));
    TRY(results_put_scalar(results, stage, "normal_stress_difference_contact", unit, NULL, replica,
                           stress.xx - stress.yy));
    if (system->dimension == 3)
        TRY(results_put_scalar(results, stage, "second_normal_stress_difference_contact", unit,
                               NULL, replica, stress.yy - stress.zz));
    return results_put_scalar(results, stage, "pressure_contact", unit, NULL, replica,
                              system_number_density(system) -
                                  (stress.xx + stress.yy + stress.zz) / dimension);
}

// All elements are extrapolated from the same window: that in which the pressure falls.
Status derive_contact_stress(Results *results, const ResultSeries *series, const System *system) {
    const size_t elements = series->axis[0].count, bins = series->axis[1].count;
    if (bins < BINS_LEAST) return OK;
    const size_t end = window(results, series, (Rows){0, 2}, bins); // xx and yy
    for (size_t replica = 0; replica < results->replicas; replica++) {
        Tensor stress = {.xy = NAN};
        for (size_t e = 0; e < elements; e++) {
            double *at = element_of(&stress, series->axis[0].labels[e]);
            if (!at) continue;
            TRY(fit_value_at_edge(series->values + replica * series->size + e * bins, end, CUBIC,
                                  at));
        }
        TRY(put_tensor(results, series, system, stress, replica));
    }
    return OK;
}

// contact[pair][angle] of one replica.
static Status extrapolate_angles(const ResultSeries *series, const size_t *windows, size_t replica,
                                 double *contact) {
    const size_t pairs = series->axis[0].count, angles = series->axis[1].count,
                 bins = series->axis[2].count;
    const double *row = series->values + replica * series->size;
    for (size_t pair = 0; pair < pairs; pair++) {
        for (size_t k = 0; k < angles; k++, row += bins) {
            TRY(fit_value_at_edge(row, windows[pair], CUBIC, contact++));
        }
    }
    return OK;
}

static Status put_angles(Results *results, size_t at, const size_t *windows, double *contact) {
    for (size_t replica = 0; replica < results->replicas; replica++) {
        const ResultSeries *series = &results->series[at]; // moves when another is put
        ResultSeries shape = {.axes = 2, .axis = {series->axis[0], series->axis[1]}};
        snprintf(shape.stage, sizeof shape.stage, "%s", series->stage);
        strcpy(shape.observable, "contact_angle");
        TRY(extrapolate_angles(series, windows, replica, contact));
        TRY(results_put_series(results, &shape, replica, contact));
    }
    return OK;
}

Status derive_contact_angles(Results *results, const ResultSeries *series) {
    const size_t pairs = series->axis[0].count, angles = series->axis[1].count,
                 bins = series->axis[2].count;
    if (bins < BINS_LEAST) return OK;
    size_t *windows = NULL;
    double *contact = NULL;
    Status status = NEW_ARRAY(windows, pairs);
    if (status == OK) status = NEW_ARRAY(contact, pairs * angles);
    for (size_t pair = 0; status == OK && pair < pairs; pair++) {
        windows[pair] = window(results, series, (Rows){pair * angles, angles}, bins);
    }
    if (status == OK) {
        status = put_angles(results, (size_t)(series - results->series), windows, contact);
    }
    memory_free(windows);
    memory_free(contact);
    return status;
}
