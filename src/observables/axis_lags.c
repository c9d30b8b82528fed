// SPDX-License-Identifier: GPL-3.0-or-later
// One way from frames of body axes to a series: what differs between observers is in their
// AxisCorrelation.
#include "observables/axis_lags.h"

#include "base/memory.h"
#include "observables/begin.h"
#include "observables/put.h"

#include <stdio.h>

typedef struct AxisLags {
    Observer observer;
    const AxisCorrelation *what;
    Oriented oriented;
    size_t labels; // species, and all of them if there are several
    size_t axes;   // particles that have one
    History history;
    double *now;  // a frame
    double *sums; // [lag][species][what->sums]
} AxisLags;

static const LagSettings *lag_settings(const Settings *settings) {
    return &((const LagSettingsAlone *)settings->bytes)->lags;
}

static size_t frame_size(const AxisCorrelation *what, size_t axes) {
    return what->per_axis * axes + what->once;
}

Status axis_lags_check(const AxisCorrelation *what, const Settings *settings, const System *system,
                       const Clock *clock) {
    TRY(oriented_check(what->kind->name, system));
    return lags_check(what->kind->name, lag_settings(settings), clock);
}

void axis_lags_free(Observer *observer) {
    AxisLags *self = (AxisLags *)observer;
    history_clear(&self->history);
    memory_free(self->now);
    memory_free(self->sums);
    memory_free(self);
}

static size_t sum_count(const AxisLags *self, size_t lags) {
    return lags * self->oriented.count * self->what->sums;
}

static Status allocate(AxisLags *self, const Lags *lags) {
    const size_t width = frame_size(self->what, self->axes);
    TRY(history_make(&self->history, lags, width));
    TRY(NEW_ARRAY(self->now, width));
    return NEW_ARRAY(self->sums, sum_count(self, lags->count));
}

Status axis_lags_create(Observer **out, const AxisCorrelation *what, const Settings *settings,
                        const State *state, const Clock *clock) {
    AxisLags *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = what->kind, .clock = *clock};
    self->what = what;
    self->oriented = oriented_of(&state->system);
    self->labels = self->oriented.count + (self->oriented.count > 1);
    self->axes = oriented_particles(&self->oriented);
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    return observer_begin(out, &self->observer, allocate(self, &lags));
}

int64_t axis_lags_next(const Observer *observer, int64_t after) {
    return lags_next(&((const AxisLags *)observer)->history.lags, &observer->clock, after);
}

static double *sums_at(const AxisLags *self, size_t lag, size_t species) {
    return self->sums + (lag * self->oriented.count + species) * self->what->sums;
}

static void add_lag(AxisLags *self, size_t lag, const double *then) {
    size_t begin = 0; // among those that have an axis
    for (size_t s = 0; s < self->oriented.count; s++) {
        const size_t end = begin + self->oriented.end[s] - self->oriented.begin[s];
        self->what->add(then, self->now, self->axes, begin, end, sums_at(self, lag, s));
        begin = end;
    }
}

Status axis_lags_see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    AxisLags *self = (AxisLags *)observer;
    self->what->copy(state, &self->oriented, self->axes, self->now);
    for (size_t k = 0; k < self->history.lags.count; k++) {
        size_t row = 0;
        const double *then = history_begun(&self->history, tick, k, &row);
        if (then) add_lag(self, row, then);
    }
    history_keep(&self->history, tick, self->now);
    return OK;
}

void axis_lags_archive(Observer *observer, Archive *archive) {
    AxisLags *self = (AxisLags *)observer;
    archive_tag(archive, self->what->tag);
    history_archive(&self->history, archive);
    archive_f64(archive, self->sums, sum_count(self, self->history.lags.count));
}

// Over particles of a species, or of all with an axis; NaN where nothing was seen.
static void means_of(const AxisLags *self, size_t label, size_t lag, double means[]) {
    const Oriented *oriented = &self->oriented;
    const size_t first = label < oriented->count ? label : 0;
    const size_t last = label < oriented->count ? label + 1 : oriented->count;
    double samples = 0;
    for (size_t i = 0; i < self->what->sums; i++) means[i] = 0;
    for (size_t s = first; s < last; s++) {
        const double *more = sums_at(self, lag, s);
        for (size_t i = 0; i < self->what->sums; i++) means[i] += more[i];
        samples +=
            (double)self->history.seen[lag] * (double)(oriented->end[s] - oriented->begin[s]);
    }
    for (size_t i = 0; i < self->what->sums; i++) means[i] /= samples;
}

static void fill(const AxisLags *self, double *values) {
    const size_t lags = self->history.lags.count, rows = self->what->rows;
    double means[AXIS_SUMS_MOST], finished[AXIS_SUMS_MOST];
    for (size_t l = 0; l < self->labels; l++, values += rows * lags) {
        for (size_t k = 0; k < lags; k++) {
            means_of(self, l, k, means);
            self->what->finish(means, finished);
            for (size_t row = 0; row < rows; row++) values[row * lags + k] = finished[row];
        }
    }
}

static Status put(const AxisLags *self, const Labels *labels, double *values, double *times,
                  Results *results, size_t replica) {
    const AxisCorrelation *what = self->what;
    const Lags *lags = &self->history.lags;
    fill(self, values);
    lags_times(lags, &self->observer.clock, times);
    ResultSeries shape = {
        .axes = 3,
        .axis = {
            {.name = "species", .unit = "", .count = labels->count, .labels = labels->names},
            {.name = what->rows_name, .unit = "", .count = what->rows, .labels = what->row_names},
            {.name = "time",
             .unit = self->observer.clock.unit,
             .count = lags->count,
             .values = times}}};
    snprintf(shape.unit, sizeof shape.unit, "%s", what->unit);
    return observer_put_series(&self->observer, what->kind->name, &shape, results, replica, values);
}

Status axis_lags_write(const Observer *observer, const State *state, Results *results,
                       size_t replica) {
    const AxisLags *self = (const AxisLags *)observer;
    const size_t lags = self->history.lags.count;
    Labels labels;
    oriented_labels(&labels, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, self->labels * self->what->rows * lags);
    if (status == OK) status = NEW_ARRAY(times, lags);
    if (status == OK) status = put(self, &labels, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

size_t axis_lags_memory(const AxisCorrelation *what, const Settings *settings, const System *system,
                        const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    const Oriented oriented = oriented_of(system);
    const size_t frame = frame_size(what, oriented_particles(&oriented));
    return sizeof(AxisLags) + history_memory(&lags, frame) +
           (frame + lags.count * oriented.count * what->sums) * sizeof(double);
}
