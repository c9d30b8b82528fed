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

static const double FALLEN = 0.6;
enum { CUBIC = 3, SMOOTH = 5, BINS_LEAST = 3 * (CUBIC + 1) };

// Mean over replicas and over up to SMOOTH bins from `bin` on.
static double smooth(const Results *results, const ResultSeries *series, size_t row, size_t bins,
                     size_t bin) {
    double sum = 0, samples = 0;
    for (size_t k = bin; k < bins && k < bin + SMOOTH; k++, samples++) {
        sum += results_series_estimate(results, series, row * bins + k).value;
    }
    return sum / samples;
}

static size_t window(const Results *results, const ResultSeries *series, size_t row, size_t bins) {
    const double first = smooth(results, series, row, bins, 0);
    size_t end = bins < BINS_LEAST ? bins : BINS_LEAST;
    while (end < bins && smooth(results, series, row, bins, end) > FALLEN * first) end++;
    return end;
}

static Status put_contact_value(Results *results, const ResultSeries *series, size_t row,
                                size_t replica, double value) {
    char quantity[RESULT_NAME];
    snprintf(quantity, sizeof quantity, "contact_value_%s", series->axis[0].labels[row]);
    for (char *c = quantity; *c; c++) {
        if (*c == '-') *c = '_';
    }
    return results_put_scalar(results, series->stage, quantity, "",
                              "Pair distribution at contact, extrapolated by a cubic from where "
                              "it has fallen to 0.6 of its first value.",
                              replica, value);
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
    return results_put_scalar(results, series->stage, "compressibility_factor_contact", "",
                              "P V/(N kT) from the contact values of the pair distributions: no "
                              "collision enters.",
                              replica, compressibility);
}

Status derive_contact(Results *results, const ResultSeries *series) {
    const ResultSeries *weights = results_find_series(results, series->stage, "contact_weight");
    const size_t pairs = series->axis[0].count, bins = series->axis[1].count;
    if (!weights || bins < CUBIC + 1) return OK;
    size_t *windows = NULL;
    TRY(NEW_ARRAY(windows, pairs));
    for (size_t pair = 0; pair < pairs; pair++) {
        windows[pair] = window(results, series, pair, bins);
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
    const size_t end = window(results, series, 0, bins);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        double excess = NAN;
        TRY(fit_value_at_edge(series->values + replica * series->size, end, CUBIC, &excess));
        TRY(results_put_scalar(results, series->stage, "compressibility_factor_compression", "",
                               "P V/(N kT) from the pairs that meet in a virtual compression, "
                               "extrapolated to none by a cubic.",
                               replica, 1 + excess));
        TRY(results_put_scalar(results, series->stage, "pressure_compression", "kT/d^3",
                               "From the pairs that meet in a virtual compression.", replica,
                               system_number_density(system) * (1 + excess)));
    }
    return OK;
}
