// SPDX-License-Identifier: GPL-3.0-or-later
// Newtonian and Brownian relaxation of the same states: structural relaxation is one function of
// time but for a factor (Weysser, thesis, ch. 3). For a stage and one before it whose times have
// another unit, the factor is the ratio of the times at which their functions fall to a level,
// given for levels from 0.9 to 0.1: one number where only the structure relaxes, below the plateau.
// The errors are the jackknife's over replicas.
#include "analysis/decay.h"
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LEVELS = 9 };
static const double levels[LEVELS] = {0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1};

// Two series of the same observable that differ in their times.
typedef struct Shift {
    const Results *results;
    const ResultSeries *from, *to;
    size_t rows;
    double *mean[2]; // [lags] of each
    double *values;  // [replica][row][level]: pseudo-values
} Shift;

static const ResultAxis *times_of(const ResultSeries *series) {
    return &series->axis[series->axes - 1];
}

// Times at which a function, 1 at t = 0, has fallen to each level.
static void crossings(const Shift *shift, const ResultSeries *series, size_t row, int64_t without,
                      double *mean, double out[LEVELS]) {
    const ResultAxis *time = times_of(series);
    decay_mean(shift->results, series, row * time->count, time->count, without, mean);
    for (size_t l = 0; l < LEVELS; l++)
        out[l] = decay_time_at(time->values, mean, time->count, levels[l]);
}

static void ratios(const Shift *shift, size_t row, int64_t without, double out[LEVELS]) {
    double from[LEVELS], to[LEVELS];
    const size_t same = derive_same_row(shift->to, row, shift->from, shift->to->axes - 1);
    crossings(shift, shift->from, same, without, shift->mean[0], from);
    crossings(shift, shift->to, row, without, shift->mean[1], to);
    for (size_t l = 0; l < LEVELS; l++) out[l] = to[l] / from[l];
}

static void derive_rows(Shift *shift) {
    const size_t replicas = shift->results->replicas;
    const size_t stride = shift->rows * LEVELS;
    double all[LEVELS];
    for (size_t row = 0; row < shift->rows; row++) {
        double *values = shift->values + row * LEVELS;
        ratios(shift, row, DECAY_NOBODY, all);
        for (size_t r = 0; r < replicas; r++) ratios(shift, row, (int64_t)r, values + r * stride);
        for (size_t l = 0; l < LEVELS; l++) pseudo_values(replicas, all[l], values + l, stride);
    }
}

static Status put(Results *results, const Shift *shift) {
    ResultSeries shape = derive_shape(shift->to, "_time_shift");
    const ResultAxis *from = times_of(shift->from), *to = times_of(shift->to);
    shape.axis[shape.axes - 1] =
        (ResultAxis){.name = "level", .unit = "", .count = LEVELS, .values = levels};
    snprintf(shape.about, sizeof shape.about,
             "Time at which the function falls to a level, over that in stage %.60s; jackknife "
             "over replicas.",
             shift->from->stage);
    if (strcmp(to->unit, from->unit) == 0)
        shape.unit[0] = '\0';
    else
        snprintf(shape.unit, sizeof shape.unit, "(%.28s)/(%.28s)", to->unit, from->unit);
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_series(results, &shape, r, shift->values + r * shift->rows * LEVELS));
    }
    return OK;
}

// Newtonian stages, whose centre of mass rests, have no functions about it of their own.
static const char *newtonian_name(const char *observable) {
    static const char *const names[][2] = {
        {"self_scattering_centred", "self_scattering"},
        {"collective_scattering_centred", "collective_scattering_normalised"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(observable, names[i][0]) == 0) return names[i][1];
    }
    return observable;
}

// The last of the stages before with the same functions over times of another unit.
static const ResultSeries *counterpart(const Results *results, const ResultSeries *series) {
    const ResultSeries *found = NULL;
    const char *name = newtonian_name(series->observable);
    for (const ResultSeries *s = results->series; s < series; s++) {
        if (strcmp(s->observable, name) != 0 || s->axes != series->axes) continue;
        if (!derive_has_rows(series, s, series->axes - 1)) continue;
        if (strcmp(times_of(s)->unit, times_of(series)->unit) != 0) found = s;
    }
    return found;
}

// Time is the last axis.
Status derive_shift(Results *results, const ResultSeries *scattering) {
    if (strcmp(times_of(scattering)->name, "time") != 0) return OK;
    const ResultSeries *before = counterpart(results, scattering);
    if (!before) return OK;
    const ResultSeries from = *before, to = *scattering; // results may move them when they grow
    Shift shift = {.results = results, .from = &from, .to = &to};
    shift.rows = to.size / times_of(&to)->count;
    Status status = NEW_ARRAY(shift.mean[0], times_of(&from)->count);
    if (status == OK) status = NEW_ARRAY(shift.mean[1], times_of(&to)->count);
    if (status == OK) status = NEW_ARRAY(shift.values, results->replicas * shift.rows * LEVELS);
    if (status == OK) {
        derive_rows(&shift);
        status = put(results, &shift);
    }
    for (size_t s = 0; s < 2; s++) memory_free(shift.mean[s]);
    memory_free(shift.values);
    return status;
}
