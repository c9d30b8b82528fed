// SPDX-License-Identifier: GPL-3.0-or-later
// Correlation functions of particles with a body axis, over lags and time origins: what an observer
// of this kind keeps in a frame, what it adds up between two frames, and what becomes of the means.
#pragma once

#include "observables/history.h"
#include "observables/oriented.h"

enum { AXIS_SUMS_MOST = 4 };

typedef struct AxisCorrelation {
    const ObservableKind *kind;
    uint64_t tag;          // of its checkpoints
    size_t per_axis, once; // numbers of a frame: for each particle with an axis, and besides
    size_t sums;           // numbers added up for a lag and a species
    void (*copy)(const State *state, const Oriented *oriented, size_t axes, double *frame);
    // Of particles [begin, end) among the `axes` that have one.
    void (*add)(const double *then, const double *now, size_t axes, size_t begin, size_t end,
                double sums[]);
    // Means over particles and origins to what is put, a value per row.
    void (*finish)(const double means[], double values[]);
    const char *rows_name; // axis of the series that tells the rows apart
    const char *const *row_names;
    size_t rows;
    const char *unit;
} AxisCorrelation;

typedef struct LagSettingsAlone {
    LagSettings lags;
} LagSettingsAlone;

Status axis_lags_check(const AxisCorrelation *what, const Settings *settings, const System *system,
                       const Clock *clock);
Status axis_lags_create(Observer **out, const AxisCorrelation *what, const Settings *settings,
                        const State *state, const Clock *clock);
int64_t axis_lags_next(const Observer *observer, int64_t after);
Status axis_lags_see(Observer *observer, int64_t tick, const State *state, const Tally *tally);
void axis_lags_archive(Observer *observer, Archive *archive);
Status axis_lags_write(const Observer *observer, const State *state, Results *results,
                       size_t replica);
void axis_lags_free(Observer *observer);
size_t axis_lags_memory(const AxisCorrelation *what, const Settings *settings, const System *system,
                        const Clock *clock);

// The observable NAME of a file that has its options `rows` and its AxisCorrelation `what`.
#define AXIS_CORRELATION(NAME, ABOUT)                                                              \
    static Status check(const Settings *settings, const System *system, const Clock *clock) {      \
        return axis_lags_check(&what, settings, system, clock);                                    \
    }                                                                                              \
    static Status create(Observer **out, const Settings *settings, const State *state,             \
                         const Clock *clock) {                                                     \
        return axis_lags_create(out, &what, settings, state, clock);                               \
    }                                                                                              \
    static size_t memory(const Settings *settings, const System *system, const Clock *clock) {     \
        return axis_lags_memory(&what, settings, system, clock);                                   \
    }                                                                                              \
    const ObservableKind observable_##NAME = {                                                     \
        .name = #NAME,                                                                             \
        .about = ABOUT,                                                                            \
        .options = {rows, sizeof rows / sizeof *rows, sizeof(LagSettingsAlone)},                   \
        .check = check,                                                                            \
        .create = create,                                                                          \
        .next = axis_lags_next,                                                                    \
        .see = axis_lags_see,                                                                      \
        .archive = axis_lags_archive,                                                              \
        .write = axis_lags_write,                                                                  \
        .free = axis_lags_free,                                                                    \
        .memory = memory,                                                                          \
    };
