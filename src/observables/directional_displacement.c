// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacements of bodies with an axis, along and across two directions of the time
// origin: the body axis u(0), <(dr.u(0))^2>, and the director n(0) of all axes together. What is
// across is half of the square in the plane, the mean over its two directions: every one of the
// four is 2 D t where motion is diffusive (Jabbari-Farouji & Trizac 2012, sec. IV).
#include "base/memory.h"
#include "observables/history.h"
#include "observables/oriented.h"
#include "observables/put.h"

typedef struct DirectionalSettings {
    LagSettings lags;
} DirectionalSettings;

static const Option rows[] = {LAG_OPTIONS(DirectionalSettings, lags)};

// Squares summed over the particles of a species, and over origins.
typedef struct SquareSums {
    double total, axis, director;
} SquareSums;

typedef struct Directional {
    Observer observer;
    Oriented oriented;
    size_t labels;    // species, and all of them if there are several
    size_t axes;      // particles that have one
    History history;  // of unfolded coordinates [3][axes], body axes [3][axes], director [3]
    double *now;      // the same
    SquareSums *sums; // [lag][species]
} Directional;

static const LagSettings *lag_settings(const Settings *settings) {
    return &((const DirectionalSettings *)settings->bytes)->lags;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    TRY(oriented_check("directional_displacement", system));
    return lags_check("directional_displacement", lag_settings(settings), clock);
}

static void discard(Observer *observer) {
    Directional *self = (Directional *)observer;
    history_clear(&self->history);
    memory_free(self->now);
    memory_free(self->sums);
    memory_free(self);
}

static size_t frame_size(size_t axes) {
    return 6 * axes + 3;
}

static Status allocate(Directional *self, const Lags *lags) {
    TRY(history_make(&self->history, lags, frame_size(self->axes)));
    TRY(NEW_ARRAY(self->now, frame_size(self->axes)));
    return NEW_ARRAY(self->sums, lags->count * self->oriented.count);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Directional *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_directional_displacement, .clock = *clock};
    self->oriented = oriented_of(&state->system);
    self->labels = self->oriented.count + (self->oriented.count > 1);
    self->axes = oriented_particles(&self->oriented);
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    const Status status = allocate(self, &lags);
    if (status != OK) {
        discard(&self->observer);
        return status;
    }
    *out = &self->observer;
    return OK;
}

static int64_t next(const Observer *observer, int64_t after) {
    return lags_next(&((const Directional *)observer)->history.lags, &observer->clock, after);
}

// From one frame to another, particles [begin, end) of those that have an axis.
static SquareSums squares_of(const double *then, const double *now, size_t axes, size_t begin,
                             size_t end) {
    const double *u = then + 3 * axes, *n = then + 6 * axes;
    SquareSums sums = {0};
    for (size_t i = begin; i < end; i++) {
        const double x = now[i] - then[i], y = now[axes + i] - then[axes + i],
                     z = now[2 * axes + i] - then[2 * axes + i];
        const double along_axis = x * u[i] + y * u[axes + i] + z * u[2 * axes + i];
        const double along_director = x * n[0] + y * n[1] + z * n[2];
        sums.total += x * x + y * y + z * z;
        sums.axis += along_axis * along_axis;
        sums.director += along_director * along_director;
    }
    return sums;
}

static void add_lag(Directional *self, size_t lag, const double *then) {
    size_t begin = 0;
    for (size_t s = 0; s < self->oriented.count; s++) {
        const size_t end = begin + self->oriented.end[s] - self->oriented.begin[s];
        const SquareSums more = squares_of(then, self->now, self->axes, begin, end);
        SquareSums *sums = &self->sums[lag * self->oriented.count + s];
        sums->total += more.total;
        sums->axis += more.axis;
        sums->director += more.director;
        begin = end;
    }
}

static void copy_frame(const Directional *self, const State *state) {
    const size_t axes = self->axes;
    for (int a = 0; a < 3; a++) {
        double *coordinate = self->now + (size_t)a * axes;
        double *axis = self->now + (size_t)(3 + a) * axes;
        for (size_t s = 0; s < self->oriented.count; s++) {
            for (size_t i = self->oriented.begin[s]; i < self->oriented.end[s]; i++) {
                *coordinate++ = state_unfolded(state, a, i);
                *axis++ = state->orientation[a][i];
            }
        }
    }
    oriented_director(state, &self->oriented, self->now + 6 * axes);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Directional *self = (Directional *)observer;
    copy_frame(self, state);
    for (size_t k = 0; k < self->history.lags.count; k++) {
        size_t row = 0;
        const double *then = history_begun(&self->history, tick, k, &row);
        if (then) add_lag(self, row, then);
    }
    history_keep(&self->history, tick, self->now);
    return OK;
}

static const uint64_t DIRECTIONAL_TAG = 0x4449524543303031; // "DIREC001"

static void archive(Observer *observer, Archive *archive) {
    Directional *self = (Directional *)observer;
    archive_tag(archive, DIRECTIONAL_TAG);
    history_archive(&self->history, archive);
    const size_t sums = self->history.lags.count * self->oriented.count;
    for (size_t i = 0; i < sums; i++) {
        archive_f64(archive, &self->sums[i].total, 1);
        archive_f64(archive, &self->sums[i].axis, 1);
        archive_f64(archive, &self->sums[i].director, 1);
    }
}

// Means over particles of a species, or of all with an axis; NaN where nothing was seen.
static SquareSums means(const Directional *self, size_t label, size_t lag) {
    const Oriented *oriented = &self->oriented;
    const size_t first = label < oriented->count ? label : 0;
    const size_t last = label < oriented->count ? label + 1 : oriented->count;
    SquareSums sums = {0};
    double samples = 0;
    for (size_t s = first; s < last; s++) {
        const SquareSums *more = &self->sums[lag * oriented->count + s];
        sums.total += more->total;
        sums.axis += more->axis;
        sums.director += more->director;
        samples +=
            (double)self->history.seen[lag] * (double)(oriented->end[s] - oriented->begin[s]);
    }
    return (SquareSums){.total = sums.total / samples,
                        .axis = sums.axis / samples,
                        .director = sums.director / samples};
}

enum { PARALLEL, PERPENDICULAR, ALONG_DIRECTOR, ACROSS_DIRECTOR, DIRECTIONS };

static void fill(const Directional *self, double *values) {
    const size_t lags = self->history.lags.count;
    for (size_t l = 0; l < self->labels; l++, values += DIRECTIONS * lags) {
        for (size_t k = 0; k < lags; k++) {
            const SquareSums mean = means(self, l, k);
            values[PARALLEL * lags + k] = mean.axis;
            values[PERPENDICULAR * lags + k] = (mean.total - mean.axis) / 2;
            values[ALONG_DIRECTOR * lags + k] = mean.director;
            values[ACROSS_DIRECTOR * lags + k] = (mean.total - mean.director) / 2;
        }
    }
}

static Status put(const Directional *self, const Labels *labels, double *values, double *times,
                  Results *results, size_t replica) {
    static const char *const directions[DIRECTIONS] = {"parallel", "perpendicular",
                                                       "along_director", "across_director"};
    const Clock *clock = &self->observer.clock;
    fill(self, values);
    lags_times(&self->history.lags, clock, times);
    const ResultSeries shape = {
        .unit = "d^2",
        .about = "Mean squared displacement along and (mean of two directions) across the body "
                 "axis and the director, both at the time origin.",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = labels->count, .labels = labels->names},
                 {.name = "direction", .unit = "", .count = DIRECTIONS, .labels = directions},
                 {.name = "time",
                  .unit = clock->unit,
                  .count = self->history.lags.count,
                  .values = times}}};
    return observer_put_series(&self->observer, "directional_displacement", &shape, results,
                               replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Directional *self = (const Directional *)observer;
    const size_t lags = self->history.lags.count;
    Labels labels;
    oriented_labels(&labels, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, self->labels * DIRECTIONS * lags);
    if (status == OK) status = NEW_ARRAY(times, lags);
    if (status == OK) status = put(self, &labels, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    const Oriented oriented = oriented_of(system);
    const size_t frame = frame_size(oriented_particles(&oriented));
    return sizeof(Directional) + history_memory(&lags, frame) + frame * sizeof(double) +
           lags.count * oriented.count * sizeof(SquareSums);
}

const ObservableKind observable_directional_displacement = {
    .name = "directional_displacement",
    .about = "Mean squared displacements along and across the body axis and the director, of "
             "particles with a body axis.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(DirectionalSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
