// SPDX-License-Identifier: GPL-3.0-or-later
// Diffusion coefficients from mean squared displacements.
//
// Short time: the largest <r^2>/(2 dim t). Below a thermostat interval flight makes it grow with
// t, beyond it collisions make it fall; in between it is D0 less what collisions within the
// interval take, and tends to D0 with the interval.
//
// Long time: the slope of a straight line a + 2 dim D t (curve.h says over which window). Where the
// slope is not seen to have stopped changing, it is an upper bound on the diffusion coefficient.
//
// The displacements of bodies with an axis, along and across the body axis and the director at the
// time origin, have each its own: in the isotropic phase all tend to one, in the nematic those of
// the director are the diffusion tensor. Under shear there is a coefficient across the flow, D_y;
// where a force pulls a tracer, one of each direction across the force, along which it drifts.
#include "analysis/derive.h"
#include "analysis/curve.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

// The curve of one species, along one direction or in total.
typedef struct Displacement {
    Curve curve;
    double dimensions;        // that it sums over
    char suffix[RESULT_NAME]; // of the names of its numbers: "_parallel_rod"
} Displacement;

static const ResultAxis *time_of(const ResultSeries *series) {
    return &series->axis[series->axes - 1];
}

static size_t fastest_lag(const Curve *curve) {
    size_t best = 0;
    for (size_t k = 1; k < curve->lags; k++) {
        const double here = curve_mean(curve, k) / curve->times[k];
        if (here > curve_mean(curve, best) / curve->times[best]) best = k;
    }
    return best;
}

static Status put(Results *results, const Displacement *of, const char *quantity, const char *unit,
                  const char *about, size_t replica, double value) {
    char name[2 * RESULT_NAME];
    snprintf(name, sizeof name, "%s%s", quantity, of->suffix);
    return results_put_scalar(results, of->curve.series->stage, name, unit, about, replica, value);
}

static Status put_short(Results *results, const Displacement *of) {
    const size_t lag = fastest_lag(&of->curve);
    const double time = of->curve.times[lag];
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(put(results, of, "short_time_diffusion", "D0", NULL, replica,
                curve_of(&of->curve, replica)[lag] / (2 * of->dimensions * time)));
    }
    return OK;
}

static Status put_long(Results *results, const Displacement *of, const char *unit) {
    static const char FALLING[] =
        "Upper bound, for the slope is not seen to have stopped falling: that of <r^2>/(2 dim) "
        "against t, from long_time_window to the last lag.";
    const Curve *curve = &of->curve;
    bool settled = false;
    const size_t begin = curve_window(curve, &settled);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(put(results, of, "long_time_diffusion", unit, settled ? NULL : FALLING, replica,
                curve_slope(curve, replica, begin, curve->lags) / (2 * of->dimensions)));
        TRY(put(results, of, "long_time_window", time_of(curve->series)->unit, NULL, replica,
                curve->times[begin]));
    }
    return OK;
}

static bool is_brownian(const ResultSeries *series) {
    return strcmp(time_of(series)->unit, "d^2/D0") == 0;
}

static Status derive_from(Results *results, const Displacement *of, bool short_too) {
    if (of->curve.lags < CURVE_LAGS_LEAST) return OK;
    const bool brownian = is_brownian(of->curve.series);
    if (brownian && short_too) TRY(put_short(results, of));
    return put_long(results, of, brownian ? "D0" : "d sqrt(kT/m)");
}

// The last species, which is all of them or the only one, bears no name.
static void name_curve(Displacement *of, const ResultSeries *series, size_t species,
                       const char *direction) {
    const bool named = species + 1 < series->axis[0].count;
    const bool centred = strstr(series->observable, "_centred") != NULL;
    snprintf(of->suffix, sizeof of->suffix, "%s%s%s%s%s", direction ? "_" : "",
             direction ? direction : "", named ? "_" : "",
             named ? series->axis[0].labels[species] : "", centred ? "_centred" : "");
}

// Of those directions that it is asked for.
typedef bool IsWanted(const Results *results, const char *stage, const char *direction);

// Of several waiting times or strains the last, which is nearest to what is stationary.
static Status derive_directions(Results *results, const ResultSeries *series, IsWanted *wanted,
                                bool short_too) {
    const size_t species = series->axis[0].count, directions = series->axis[1].count;
    const size_t waits = series->axes > 3 ? series->axis[2].count : 1;
    if (time_of(series)->count < CURVE_LAGS_LEAST) return OK;
    double *weights = NULL;
    TRY(curve_weights(&weights, time_of(series)));
    Status status = OK;
    for (size_t row = 0; status == OK && row < species * directions; row++) {
        const char *direction = series->axis[1].labels[row % directions];
        if (!wanted(results, series->stage, direction)) continue;
        const size_t last = (row + 1) * waits - 1;
        Displacement of = {.curve = curve_in(results, series, last, weights), .dimensions = 1};
        if (waits > 1 && isnan(curve_mean(&of.curve, 0))) continue; // the stage ended before
        name_curve(&of, series, row / directions, direction);
        status = derive_from(results, &of, short_too);
    }
    memory_free(weights);
    return status;
}

bool derive_forced(const Results *results, const char *stage, const char *direction) {
    static const char *const DIRECTIONS[] = {"x", "y", "z"};
    for (size_t a = 0; a < sizeof DIRECTIONS / sizeof *DIRECTIONS; a++) {
        char name[RESULT_NAME];
        snprintf(name, sizeof name, "force_%s", DIRECTIONS[a]);
        if (direction && strcmp(direction, DIRECTIONS[a]) != 0) continue;
        if (results_find_scalar(results, stage, name)) return true;
    }
    return false;
}

// Along the force it drifts, and so does the sum over directions.
static bool across_force(const Results *results, const char *stage, const char *direction) {
    return strcmp(direction, "total") != 0 && !derive_forced(results, stage, direction);
}

Status derive_diffusion(Results *results, const ResultSeries *series) {
    const size_t species = series->axis[0].count, directions = series->axis[1].count;
    if (derive_forced(results, series->stage, NULL))
        return derive_directions(results, series, across_force, true);
    if (series->axis[2].count < CURVE_LAGS_LEAST) return OK;
    double *weights = NULL;
    TRY(curve_weights(&weights, &series->axis[2]));
    Status status = OK;
    for (size_t s = 0; status == OK && s < species; s++) {
        const size_t total = (s + 1) * directions - 1; // the last direction
        Displacement of = {.curve = curve_in(results, series, total, weights),
                           .dimensions = (double)directions - 1};
        name_curve(&of, series, s, NULL);
        status = derive_from(results, &of, true);
    }
    memory_free(weights);
    return status;
}

static bool any(const Results *results, const char *stage, const char *direction) {
    (void)results, (void)stage, (void)direction;
    return true;
}

Status derive_directional_diffusion(Results *results, const ResultSeries *series) {
    return derive_directions(results, series, any, false);
}

// Along the flow displacements grow with t^3.
static bool across_flow(const Results *results, const char *stage, const char *direction) {
    (void)results, (void)stage;
    return strcmp(direction, "y") == 0 || strcmp(direction, "z") == 0;
}

bool derive_unsteady(const Results *results, const char *stage) {
    return results_find_scalar(results, stage, "largest_shear_rate") != NULL;
}

Status derive_diffusion_across_flow(Results *results, const ResultSeries *series) {
    if (derive_unsteady(results, series->stage)) return OK;
    return derive_directions(results, series, across_flow, false);
}
