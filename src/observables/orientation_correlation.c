// SPDX-License-Identifier: GPL-3.0-or-later
// How long a body remembers where it pointed: <P1(u(t).u(0))> and <P2(u(t).u(0))> over particles
// and time origins (lags.h says which), P1(x) = x, P2(x) = (3 x^2 - 1)/2. A free body has
// exp(-2 D_rot t) and exp(-6 D_rot t); in a nematic P2 falls to S^2. Bodies whose two ends are
// alike have a marked one here, so that P1 tells how they turn over.
#include "base/memory.h"
#include "observables/history.h"
#include "observables/oriented.h"
#include "observables/put.h"

#include <string.h>

typedef struct CorrelationSettings {
    LagSettings lags;
} CorrelationSettings;

static const Option rows[] = {LAG_OPTIONS(CorrelationSettings, lags)};

// Over the particles of a species, and over origins.
typedef struct CosineSums {
    double cosine, square; // of u(t).u(0)
} CosineSums;

typedef struct Correlation {
    Observer observer;
    Oriented oriented;
    size_t labels;    // species, and all of them if there are several
    size_t axes;      // particles that have one
    History history;  // of u, [3][axes]
    double *now;      // [3][axes]
    CosineSums *sums; // [lag][species]
} Correlation;

static const LagSettings *lag_settings(const Settings *settings) {
    return &((const CorrelationSettings *)settings->bytes)->lags;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    TRY(oriented_check("orientation_correlation", system));
    return lags_check("orientation_correlation", lag_settings(settings), clock);
}

static void discard(Observer *observer) {
    Correlation *self = (Correlation *)observer;
    history_clear(&self->history);
    memory_free(self->now);
    memory_free(self->sums);
    memory_free(self);
}

static Status allocate(Correlation *self, const Lags *lags) {
    TRY(history_make(&self->history, lags, 3 * self->axes));
    TRY(NEW_ARRAY(self->now, 3 * self->axes));
    return NEW_ARRAY(self->sums, lags->count * self->oriented.count);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Correlation *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_orientation_correlation, .clock = *clock};
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
    return lags_next(&((const Correlation *)observer)->history.lags, &observer->clock, after);
}

// Four partial sums in a fixed order: a vector unit can run them, and every compiler agrees.
static CosineSums sums_of(const double *then, const double *now, size_t axes, size_t begin,
                          size_t end) {
    enum { LANES = 4 };
    double cosines[LANES] = {0}, squares[LANES] = {0};
    for (size_t i = begin; i < end; i++) {
        const double cosine = now[i] * then[i] + now[axes + i] * then[axes + i] +
                              now[2 * axes + i] * then[2 * axes + i];
        cosines[i % LANES] += cosine;
        squares[i % LANES] += cosine * cosine;
    }
    return (CosineSums){.cosine = (cosines[0] + cosines[1]) + (cosines[2] + cosines[3]),
                        .square = (squares[0] + squares[1]) + (squares[2] + squares[3])};
}

static void add_lag(Correlation *self, size_t lag, const double *then) {
    size_t begin = 0; // among those that have an axis
    for (size_t s = 0; s < self->oriented.count; s++) {
        const size_t end = begin + self->oriented.end[s] - self->oriented.begin[s];
        const CosineSums more = sums_of(then, self->now, self->axes, begin, end);
        CosineSums *sums = &self->sums[lag * self->oriented.count + s];
        sums->cosine += more.cosine;
        sums->square += more.square;
        begin = end;
    }
}

static void copy_axes(const Correlation *self, const State *state) {
    double *now = self->now;
    for (int a = 0; a < 3; a++) {
        for (size_t s = 0; s < self->oriented.count; s++) {
            const size_t begin = self->oriented.begin[s], count = self->oriented.end[s] - begin;
            memcpy(now, state->orientation[a] + begin, count * sizeof *now);
            now += count;
        }
    }
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Correlation *self = (Correlation *)observer;
    copy_axes(self, state);
    for (size_t k = 0; k < self->history.lags.count; k++) {
        size_t row = 0;
        const double *then = history_begun(&self->history, tick, k, &row);
        if (then) add_lag(self, row, then);
    }
    history_keep(&self->history, tick, self->now);
    return OK;
}

static const uint64_t CORRELATION_TAG = 0x4f5249454e303031; // "ORIEN001"

static void archive(Observer *observer, Archive *archive) {
    Correlation *self = (Correlation *)observer;
    archive_tag(archive, CORRELATION_TAG);
    history_archive(&self->history, archive);
    const size_t sums = self->history.lags.count * self->oriented.count;
    for (size_t i = 0; i < sums; i++) {
        archive_f64(archive, &self->sums[i].cosine, 1);
        archive_f64(archive, &self->sums[i].square, 1);
    }
}

// Means over particles of a species, or of all with an axis; NaN where nothing was seen.
static CosineSums means(const Correlation *self, size_t label, size_t lag) {
    const Oriented *oriented = &self->oriented;
    const size_t first = label < oriented->count ? label : 0;
    const size_t last = label < oriented->count ? label + 1 : oriented->count;
    CosineSums means = {0};
    double samples = 0;
    for (size_t s = first; s < last; s++) {
        means.cosine += self->sums[lag * oriented->count + s].cosine;
        means.square += self->sums[lag * oriented->count + s].square;
        samples +=
            (double)self->history.seen[lag] * (double)(oriented->end[s] - oriented->begin[s]);
    }
    return (CosineSums){.cosine = means.cosine / samples, .square = means.square / samples};
}

enum { P1, P2, POLYNOMIALS };

static void fill(const Correlation *self, double *values) {
    const size_t lags = self->history.lags.count;
    for (size_t l = 0; l < self->labels; l++, values += POLYNOMIALS * lags) {
        for (size_t k = 0; k < lags; k++) {
            const CosineSums mean = means(self, l, k);
            values[P1 * lags + k] = mean.cosine;
            values[P2 * lags + k] = (3 * mean.square - 1) / 2;
        }
    }
}

static Status put(const Correlation *self, const Labels *labels, double *values, double *times,
                  Results *results, size_t replica) {
    static const char *const polynomials[POLYNOMIALS] = {"P1", "P2"};
    const Clock *clock = &self->observer.clock;
    fill(self, values);
    lags_times(&self->history.lags, clock, times);
    const ResultSeries shape = {
        .unit = "",
        .about = "Orientational correlation <P(u(t).u(0))> of the body axes with the Legendre "
                 "polynomials P1 and P2, over particles and time origins.",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = labels->count, .labels = labels->names},
                 {.name = "polynomial", .unit = "", .count = POLYNOMIALS, .labels = polynomials},
                 {.name = "time",
                  .unit = clock->unit,
                  .count = self->history.lags.count,
                  .values = times}}};
    return observer_put_series(&self->observer, "orientation_correlation", &shape, results, replica,
                               values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Correlation *self = (const Correlation *)observer;
    const size_t lags = self->history.lags.count;
    Labels labels;
    oriented_labels(&labels, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, self->labels * POLYNOMIALS * lags);
    if (status == OK) status = NEW_ARRAY(times, lags);
    if (status == OK) status = put(self, &labels, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    const Oriented oriented = oriented_of(system);
    const size_t frame = 3 * oriented_particles(&oriented);
    return sizeof(Correlation) + history_memory(&lags, frame) + frame * sizeof(double) +
           lags.count * oriented.count * sizeof(CosineSums);
}

const ObservableKind observable_orientation_correlation = {
    .name = "orientation_correlation",
    .about = "Orientational correlation functions P1 and P2 of particles with a body axis, at "
             "logarithmic lags.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(CorrelationSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
