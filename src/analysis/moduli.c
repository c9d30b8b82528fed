// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli of linear response to an oscillation, from a state at rest: with eta(t) the viscosity that
// shows within a time t, whose derivative is the relaxing shear modulus G(t),
//   G'(w) + i G''(w) = i w integral of G(t) exp(-i w t) dt.
// eta(t), slopes of the wandering of the stress integral between lags, is laid out by a cubic
// spline over ln t; on short pieces of it G is a constant. Before the first slope all relaxes at
// once, after the last one nothing. With ten lags to a decade this is good to half a percent.
#include "analysis/derive.h"
#include "base/memory.h"

#include <gsl/gsl_spline.h>

#include <math.h>
#include <string.h>

enum { PER_DECADE = 10, FREQUENCIES_MOST = 200, PIECES = 16, SLOPES_LEAST = 4 };

// Ten to a decade, among them 1, 10, 100: those whose inverse lies between the lags.
static size_t choose_frequencies(const ResultAxis *time, double frequencies[FREQUENCIES_MOST]) {
    const double last = time->values[time->count - 1];
    const int from = (int)ceil(-PER_DECADE * log10(last) - 1e-9);
    size_t count = 0;
    for (int k = from; count < FREQUENCIES_MOST; k++) {
        const double frequency = pow(10, (double)k / PER_DECADE);
        if (frequency * time->values[0] > 1) break;
        frequencies[count++] = frequency;
    }
    return count;
}

// The viscosity at times between the lags, the first between nothing and the first lag.
typedef struct Rise {
    size_t count;
    double *log_time, *viscosity; // [count]
    gsl_spline *spline;
} Rise;

static Status rise_make(Rise *rise, const ResultAxis *time) {
    *rise =
        (Rise){.count = time->count, .spline = gsl_spline_alloc(gsl_interp_cspline, time->count)};
    TRY(NEW_ARRAY(rise->log_time, rise->count));
    TRY(NEW_ARRAY(rise->viscosity, rise->count));
    for (size_t k = 0; k < rise->count; k++)
        rise->log_time[k] = log((time->values[k] + (k > 0 ? time->values[k - 1] : 0)) / 2);
    return OK;
}

static void rise_free(Rise *rise) {
    gsl_spline_free(rise->spline);
    memory_free(rise->log_time);
    memory_free(rise->viscosity);
}

static void rise_of(Rise *rise, const double *wandering, const ResultAxis *time) {
    for (size_t k = 0; k < rise->count; k++) {
        const double span = time->values[k] - (k > 0 ? time->values[k - 1] : 0);
        rise->viscosity[k] = (wandering[k] - (k > 0 ? wandering[k - 1] : 0)) / span;
    }
    gsl_spline_init(rise->spline, rise->log_time, rise->viscosity, rise->count);
}

static void moduli_of(const Rise *rise, double frequency, double *elastic, double *viscous) {
    *elastic = 0;
    *viscous = frequency * rise->viscosity[0];
    double then = exp(rise->log_time[0]), reached = rise->viscosity[0];
    for (size_t k = 0; k < PIECES * (rise->count - 1); k++) {
        const size_t left = k / PIECES;
        const double part = (double)(k % PIECES + 1) / PIECES;
        const double place = (1 - part) * rise->log_time[left] + part * rise->log_time[left + 1];
        const double now = exp(place), viscosity = gsl_spline_eval(rise->spline, place, NULL);
        const double modulus = (viscosity - reached) / (now - then);
        *elastic += modulus * (cos(frequency * then) - cos(frequency * now));
        *viscous += modulus * (sin(frequency * now) - sin(frequency * then));
        then = now;
        reached = viscosity;
    }
}

static Status put_moduli(Results *results, size_t of, const ResultSeries *shape, Rise *rise) {
    const size_t count = shape->axis[1].count;
    double moduli[2 * FREQUENCIES_MOST];
    for (size_t r = 0; r < results->replicas; r++) {
        const ResultSeries *from = &results->series[of]; // moves when another is put
        rise_of(rise, from->values + r * from->size, &from->axis[0]);
        for (size_t k = 0; k < count; k++)
            moduli_of(rise, shape->axis[1].values[k], &moduli[k], &moduli[count + k]);
        TRY(results_put_series(results, shape, r, moduli));
    }
    return OK;
}

Status derive_moduli(Results *results, const ResultSeries *wandering, const System *system) {
    static const char *const parts[] = {"elastic", "viscous"};
    double frequencies[FREQUENCIES_MOST];
    const ResultAxis *time = &wandering->axis[0];
    if (wandering->axes != 1 || time->count < SLOPES_LEAST) return OK;
    const size_t count = choose_frequencies(time, frequencies);
    ResultSeries shape = {
        .observable = "moduli_at_rest",
        .axes = 2,
        .axis = {{.name = "part", .unit = "", .count = 2, .labels = parts},
                 {.name = "frequency", .unit = "D0/d^2", .count = count, .values = frequencies}}};
    strcpy(shape.stage, wandering->stage);
    strcpy(shape.unit, system->dimension == 2 ? "kT/d^2" : "kT/d^3");
    Rise rise;
    Status status = rise_make(&rise, time);
    if (status == OK && count > 0)
        status = put_moduli(results, (size_t)(wandering - results->series), &shape, &rise);
    rise_free(&rise);
    return status;
}
