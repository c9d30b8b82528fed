// SPDX-License-Identifier: GPL-3.0-or-later
// Relaxation times of orientational correlations, <P> = plateau + (1 - plateau) c(t), c ~ A
// exp(-t/tau) at long times.
//
// P1 has no plateau; P2 has that of S^2, from nematic_order if the stage has it, or else its own
// mean over the last half of the lags. tau is the slope of ln c of the mean over replicas, from the
// first lag at which c is below BEGIN to the last before it first falls below END, weighted by c^2
// (the errors of c hardly change along it). Errors are those of the jackknife: the value of replica
// r is R tau - (R - 1) tau_r, with tau_r from all replicas but r; of these pseudo-values the mean
// is tau less its bias, the standard error is the jackknife's (Efron, SIAM monograph 38, 1982).
#include "analysis/derive.h"
#include "base/memory.h"
#include "numerics/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double BEGIN = 0.5, END = 0.05;
enum { LAGS_LEAST = 3, NOBODY = -1 };

typedef struct Decay {
    const Results *results;
    const ResultSeries *series;
    size_t row, lags;
    const double *times;
    double plateau;
    size_t begin, end; // the window
} Decay;

// c at a lag, mean over the replicas that have a value, without one of them.
static double decay_at(const Decay *decay, size_t lag, int64_t without) {
    double sum = 0, count = 0;
    for (size_t r = 0; r < decay->results->replicas; r++) {
        const double value =
            decay->series->values[r * decay->series->size + decay->row * decay->lags + lag];
        if ((int64_t)r == without || isnan(value)) continue;
        sum += value;
        count++;
    }
    return (sum / count - decay->plateau) / (1 - decay->plateau);
}

static bool find_window(Decay *decay) {
    size_t begin = 0;
    while (begin < decay->lags && !(decay_at(decay, begin, NOBODY) < BEGIN)) begin++;
    size_t end = begin;
    while (end < decay->lags && decay_at(decay, end, NOBODY) > END) end++;
    decay->begin = begin;
    decay->end = end;
    return end >= begin + LAGS_LEAST;
}

static double slope_without(const Decay *decay, int64_t without, double *logarithms,
                            double *weights) {
    for (size_t k = decay->begin; k < decay->end; k++) {
        const double c = decay_at(decay, k, without);
        logarithms[k] = log(c); // NaN if noise has made it negative: then there is no number
        weights[k] = c * c;
    }
    return fit_line(decay->times + decay->begin, logarithms + decay->begin, weights + decay->begin,
                    decay->end - decay->begin)
        .slope;
}

// Pseudo-values of tau; of one replica its own tau.
static Status relaxation_times(const Decay *decay, double *times) {
    const size_t replicas = decay->results->replicas;
    double *logarithms = NULL, *weights = NULL;
    Status status = NEW_ARRAY(logarithms, decay->lags);
    if (status == OK) status = NEW_ARRAY(weights, decay->lags);
    if (status == OK) {
        const double all = -1 / slope_without(decay, NOBODY, logarithms, weights);
        for (size_t r = 0; r < replicas; r++)
            times[r] = -1 / slope_without(decay, (int64_t)r, logarithms, weights);
        pseudo_values(replicas, all, times, 1);
    }
    memory_free(logarithms);
    memory_free(weights);
    return status;
}

// The last label, which is all of them or the only one, bears no name.
static void name_of(char name[2 * RESULT_NAME], const char *quantity, const ResultSeries *series,
                    size_t label) {
    const bool named = label + 1 < series->axis[0].count;
    snprintf(name, 2 * RESULT_NAME, "%s%s%s", quantity, named ? "_" : "",
             named ? series->axis[0].labels[label] : "");
}

static Status put_time(Results *results, Decay *decay, size_t label, const char *quantity) {
    if (!find_window(decay)) return OK; // it has not relaxed, or at once
    double *times = NULL;
    TRY(NEW_ARRAY(times, results->replicas));
    char name[2 * RESULT_NAME];
    name_of(name, quantity, decay->series, label);
    Status status = relaxation_times(decay, times);
    for (size_t r = 0; status == OK && r < results->replicas; r++) {
        status = results_put_scalar(results, decay->series->stage, name,
                                    decay->series->axis[2].unit, NULL, r, times[r]);
    }
    memory_free(times);
    return status;
}

// Mean of P2 of a replica over the last half of the lags in time.
static double tail(const ResultSeries *series, size_t replica, size_t row) {
    const ResultAxis *time = &series->axis[2];
    const double *values = series->values + replica * series->size + row * time->count;
    double sum = 0, count = 0;
    for (size_t k = 0; k < time->count; k++) {
        if (time->values[k] < time->values[time->count - 1] / 2 || isnan(values[k])) continue;
        sum += values[k];
        count++;
    }
    return sum / count;
}

static Status put_plateau(Results *results, const ResultSeries *series, size_t label, size_t row) {
    char name[2 * RESULT_NAME];
    name_of(name, "orientation_plateau", series, label);
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_scalar(results, series->stage, name, "", NULL, r, tail(series, r, row)));
    }
    return OK;
}

static double plateau_of(const Results *results, const ResultSeries *series, size_t label) {
    char name[2 * RESULT_NAME];
    name_of(name, "squared_nematic_order", series, label);
    const ResultScalar *order = results_find_scalar(results, series->stage, name);
    if (!order) name_of(name, "orientation_plateau", series, label);
    if (!order) order = results_find_scalar(results, series->stage, name);
    return results_scalar_estimate(results, order).value;
}

Status derive_relaxation(Results *results, const ResultSeries *series) {
    const ResultAxis *time = &series->axis[2];
    for (size_t l = 0; l < series->axis[0].count; l++) {
        Decay first = {.results = results,
                       .series = series,
                       .row = 2 * l,
                       .lags = time->count,
                       .times = time->values};
        Decay second = first;
        second.row = 2 * l + 1;
        TRY(put_plateau(results, series, l, second.row));
        second.plateau = plateau_of(results, series, l);
        TRY(put_time(results, &first, l, "relaxation_time_P1"));
        TRY(put_time(results, &second, l, "relaxation_time_P2"));
    }
    return OK;
}
