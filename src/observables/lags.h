// SPDX-License-Identifier: GPL-3.0-or-later
// The lags of a correlation function: spaced evenly in log(time), many time origins, bounded
// memory. Origins lie `spacing` ticks apart, at whole steps, and the last `slots` of them are kept
// in a ring; each lag is seen from every origin. Long lags are multiples of the spacing, so that
// they end where another origin is and need no look of their own. A lag longer than a step is a
// whole number of steps: a walk by whole intervals has no sub-interval phase.
//
// What ages is seen from given origins instead, waiting times after the stage began or, under
// steady shear, waiting strains, each by itself: sums then have a row for every waiting time and
// lag, else for every lag.
#pragma once

#include "observables/observables.h"

enum { LAGS_MOST = 400 };

typedef struct Lags {
    int64_t spacing; // of the time origins, in ticks
    size_t slots;    // origins that are kept
    size_t count;
    int64_t ticks[LAGS_MOST]; // ascending
    int64_t phase[LAGS_MOST]; // ticks beyond whole spacings
    size_t waits;             // waiting times; 0: the origins are evenly spaced
    int64_t wait[OPTION_LIST_SIZE];
    bool by_strain; // they were given as strains
} Lags;

// Times in the clock's unit; a `first` of 0 is one tick, a `last` of 0 a third of the stage.
// `origins` are the time origins that fit into the last lag.
Lags lags_of(const Clock *clock, double first, double last, int64_t per_decade, int64_t origins);

// The keys by which the run file chooses lags, the same for every correlation function.
typedef struct LagSettings {
    double first, last;
    int64_t per_decade, origins;
    OptionReals waiting_times;  // empty where the observable has no such key
    OptionReals waiting_strain; // likewise
} LagSettings;

// Their rows of an option table, for the member `lags` of the struct `Type`, with the defaults that
// a correlation function has by its cost.
#define LAG_OPTIONS(Type, lags) LAG_OPTIONS_OF(Type, lags, 10, 64)
#define LAG_OPTIONS_OF(Type, lags, lags_per_decade, origins_kept)                                  \
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
         .fallback = lags_per_decade,                                                              \
         .least = 1,                                                                               \
         .most = 50,                                                                               \
         .unit = "",                                                                               \
         .about =                                                                                  \
             "Lags per factor of ten in time, as near to even spacing as whole ticks allow."},     \
    {                                                                                              \
        .name = "origins", .type = OPTION_INTEGER, .offset = offsetof(Type, lags.origins),         \
        .fallback = origins_kept, .least = 1, .most = 4096, .unit = "",                            \
        .about = "Time origins within the longest lag: as many configurations are kept in memory." \
    }

// Further rows, of the observables that can tell one origin from another: the first alone for those
// of stages at rest.
#define WAITING_TIMES_OPTION(Type, lags)                                                           \
    {                                                                                              \
        .name = "waiting_times", .type = OPTION_REALS,                                             \
        .offset = offsetof(Type, lags.waiting_times), .least = 0, .most = 1e12,                    \
        .unit = "time unit of the stage",                                                          \
        .about = "Time origins, ascending, counted from the start of the stage, each shown by "    \
                 "itself: how a sample ages; lags that end after the stage have no value. Empty: " \
                 "the mean over many origins.",                                                    \
    }
#define WAITING_OPTIONS(Type, lags)                                                                \
    WAITING_TIMES_OPTION(Type, lags), {                                                            \
        .name = "waiting_strain", .type = OPTION_REALS,                                            \
        .offset = offsetof(Type, lags.waiting_strain), .least = 0, .most = 1e9, .unit = "",        \
        .about = "The same of a stage with a steady shear_rate, counted in strain: 0 is the "      \
                 "transient after the start of shear, 1 and more the stationary state.",           \
    }

Lags lags_chosen(const LagSettings *settings, const Clock *clock);

// BAD_DATA with a sentence if they do not fit into the stage.
Status lags_check(const char *observable, const LagSettings *settings, const Clock *clock);

// A line for `perrin check` where a waiting time leaves some of them no room in the stage.
void lags_describe(const LagSettings *settings, const Clock *clock, Text *lines);

void lags_times(const Lags *lags, const Clock *clock, double *times); // in the clock's unit

// The first tick after `after` that is an origin or at which a lag ends; INT64_MAX past the end.
int64_t lags_next(const Lags *lags, const Clock *clock, int64_t after);

enum { LAGS_NO_ORIGIN = -1 };

// The slot of the ring in which the origin at `tick` is kept; LAGS_NO_ORIGIN where there is none.
static inline int64_t lags_slot(const Lags *lags, int64_t tick) {
    for (size_t w = 0; w < lags->waits; w++) {
        if (lags->wait[w] == tick) return (int64_t)w;
    }
    if (lags->waits > 0 || tick < 0 || tick % lags->spacing != 0) return LAGS_NO_ORIGIN;
    return tick / lags->spacing % (int64_t)lags->slots;
}

static inline size_t lags_rows(const Lags *lags) {
    return (lags->waits > 0 ? lags->waits : 1) * lags->count;
}

// The row of sums for lag `k` that began in `slot`.
static inline size_t lags_row(const Lags *lags, int64_t slot, size_t k) {
    return (lags->waits > 0 ? (size_t)slot * lags->count : 0) + k;
}

// The axes of the rows, waiting times if there are any and times: as many as it returns.
// `values`: room for lags_axis_values numbers, which the axes point to.
size_t lags_axes(const Lags *lags, const Clock *clock, double *values, ResultAxis *axes);
static inline size_t lags_axis_values(const Lags *lags) {
    return lags->waits + lags->count;
}
