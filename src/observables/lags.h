// SPDX-License-Identifier: GPL-3.0-or-later
// The lags of a correlation function: spaced evenly in log(time), many time origins, bounded
// memory. Origins lie `spacing` ticks apart, at whole steps, and the last `slots` of them are kept
// in a ring; each lag is seen from every origin. Long lags are multiples of the spacing, so that
// they end where another origin is and need no look of their own. A lag longer than a step is a
// whole number of steps: a walk by whole intervals has no sub-interval phase.
#pragma once

#include "observables/observables.h"

enum { LAGS_MOST = 400 };

typedef struct Lags {
    int64_t spacing; // of the time origins, in ticks
    size_t slots;    // origins that are kept
    size_t count;
    int64_t ticks[LAGS_MOST]; // ascending
} Lags;

// Times in the clock's unit; a `first` of 0 is one tick, a `last` of 0 a third of the stage.
// `origins` are the time origins that fit into the last lag.
Lags lags_of(const Clock *clock, double first, double last, int64_t per_decade, int64_t origins);

// The keys by which the run file chooses lags, the same for every correlation function.
typedef struct LagSettings {
    double first, last;
    int64_t per_decade, origins;
} LagSettings;

// Their rows of an option table, for the member `lags` of the struct `Type`.
#define LAG_OPTIONS(Type, lags)                                                                    \
    {.name = "times.first",                                                                        \
     .type = OPTION_REAL,                                                                          \
     .offset = offsetof(Type, lags.first),                                                         \
     .least = 0,                                                                                   \
     .most = 1e12,                                                                                 \
     .unit = "time unit of the stage",                                                             \
     .about = "Shortest lag; 0 is one tick of the clock, a fraction of a thermostat interval."},   \
        {.name = "times.last",                                                                     \
         .type = OPTION_REAL,                                                                      \
         .offset = offsetof(Type, lags.last),                                                      \
         .least = 0,                                                                               \
         .most = 1e12,                                                                             \
         .unit = "time unit of the stage",                                                         \
         .about = "Longest lag; 0 is a third of the stage."},                                      \
        {.name = "times.per_decade",                                                               \
         .type = OPTION_INTEGER,                                                                   \
         .offset = offsetof(Type, lags.per_decade),                                                \
         .fallback = 10,                                                                           \
         .least = 1,                                                                               \
         .most = 50,                                                                               \
         .unit = "",                                                                               \
         .about =                                                                                  \
             "Lags per factor of ten in time, as near to even spacing as whole ticks allow."},     \
    {                                                                                              \
        .name = "origins", .type = OPTION_INTEGER, .offset = offsetof(Type, lags.origins),         \
        .fallback = 64, .least = 1, .most = 4096, .unit = "",                                      \
        .about = "Time origins within the longest lag: as many configurations are kept in memory." \
    }

Lags lags_chosen(const LagSettings *settings, const Clock *clock);

// BAD_DATA with a sentence if they do not fit into the stage.
Status lags_check(const char *observable, const LagSettings *settings, const Clock *clock);

void lags_times(const Lags *lags, const Clock *clock, double *times); // in the clock's unit

// The first tick after `after` that is an origin or at which a lag ends; INT64_MAX past the end.
int64_t lags_next(const Lags *lags, const Clock *clock, int64_t after);

static inline bool lags_is_origin(const Lags *lags, int64_t tick) {
    return tick % lags->spacing == 0;
}

// Does lag `k` end at `tick`, having begun at an origin?
static inline bool lags_ends(const Lags *lags, int64_t tick, size_t k) {
    return tick >= lags->ticks[k] && lags_is_origin(lags, tick - lags->ticks[k]);
}

// The ring's slot of the origin from which lag `k` ends at `tick`.
static inline size_t lags_slot(const Lags *lags, int64_t tick, size_t k) {
    return (size_t)((tick - lags->ticks[k]) / lags->spacing) % lags->slots;
}
