// SPDX-License-Identifier: GPL-3.0-or-later
// Named numbers and arrays with axes and units, one slot per replica: what observers give, what
// results.h5 holds, what analysis, report and `perrin show` read. Mean and standard error over
// replicas are derived, never stored twice in memory.
#pragma once

#include "base/archive.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Axes: five of an observable, three of a sweep.
enum { RESULT_NAME = 64, RESULT_TEXT = 256, RESULT_AXES = 8 };

typedef struct ResultAxis {
    const char *name; // "time", "species", "wave_number"
    const char *unit; // "" for labels and pure numbers
    size_t count;
    const double *values;      // [count]; NULL for an axis of labels
    const char *const *labels; // [count]; NULL for an axis of numbers
} ResultAxis;

// values[replica][axis 0][axis 1]...; NaN where a replica has no value.
typedef struct ResultSeries {
    char stage[RESULT_NAME];
    char observable[RESULT_NAME];
    char unit[RESULT_NAME];
    char about[RESULT_TEXT];
    size_t axes;
    ResultAxis axis[RESULT_AXES]; // values and labels owned by the Results
    size_t size;                  // elements per replica
    double *values;               // [replicas][size]
} ResultSeries;

typedef struct ResultScalar {
    char stage[RESULT_NAME];
    char quantity[RESULT_NAME];
    char unit[RESULT_NAME];
    char about[RESULT_TEXT];
    double *values; // [replicas]
} ResultScalar;

// A line of provenance or of health: text, or a number as text.
typedef struct ResultFact {
    char name[RESULT_NAME];
    char *text;
} ResultFact;

typedef struct ResultCounter {
    char name[RESULT_NAME];
    char about[RESULT_TEXT];
    double value; // a count, or a depth
    double limit; // the most that is healthy; NaN: a number to know, not to judge
} ResultCounter;

typedef struct Results {
    size_t replicas;
    size_t series_count, scalar_count, fact_count, health_count;
    ResultSeries *series;
    ResultScalar *scalars;
    ResultFact *facts; // version, commit, compiler, flags, host, seed, plan, wall time, ...
    ResultCounter *health;
} Results;

// What a quantity or series is, whatever the run: a row of meanings.def or of series.def.
typedef struct ResultMeaning {
    const char *name; // of a number with * at the end if a species, a pair or a direction may
                      // follow; of a series with * in front if it is made of another
    const char *of;   // the observable; NULL of a series that is made of another
    const char *about;
    const char *unit; // "kT/d^2 or kT/d^3", NULL of a pure number
} ResultMeaning;

const ResultMeaning *result_meaning(const char *quantity); // the longest that fits; NULL if none
const ResultMeaning *result_meaning_at(size_t row);        // NULL past the last
const ResultMeaning *result_series_meaning(const char *name);
const ResultMeaning *result_series_meaning_at(size_t row);
// The series that this one is made of, if the row says so: self_scattering of
// self_scattering_kohlrausch_time.
bool result_series_source(char source[RESULT_NAME], const char *name, const ResultMeaning *row);

Status results_create(Results **out, size_t replicas);
void results_free(Results *results);

// Puts one replica's values in place; the first call for a name makes the entry, with copies of
// the axes, and fills the others with NaN. `shape` has stage, observable, unit, about, axes, axis;
// without `about` the sentence is that of series.def, if it has one.
Status results_put_series(Results *results, const ResultSeries *shape, size_t replica,
                          const double *values);
// One element of a series, by its place among the replica's values.
Status results_put_element(Results *results, const ResultSeries *shape, size_t replica,
                           size_t element, double value);
// Without `about` the sentence is that of meanings.def, which then must have one.
Status results_put_scalar(Results *results, const char *stage, const char *quantity,
                          const char *unit, const char *about, size_t replica, double value);
Status results_put_fact(Results *results, const char *name, const char *text);
// The fact of a sweep that lists, with commas, series whose axes differ from point to point.
#define RESULTS_NOT_SIDE_BY_SIDE "not side by side"
Status results_put_health(Results *results, const char *name, const char *about, double limit,
                          double value);

const ResultSeries *results_find_series(const Results *results, const char *stage,
                                        const char *observable); // NULL if none
const ResultScalar *results_find_scalar(const Results *results, const char *stage,
                                        const char *quantity);
const char *results_find_fact(const Results *results, const char *name); // NULL if none
// False of a series that a sweep could not put together from all its points.
bool results_side_by_side(const Results *results, const ResultSeries *series);

// From those of all samples, from[0], and those without each of the groups, from[1] to
// from[groups]: pseudo-values in place of replicas, so that mean and standard error are those of
// the jackknife. Without error, in the first place alone, stand flags and numbers that are the same
// whatever is left out, and what some of the results lack, have over other axes or know no finite
// value of. Health is that of all samples.
Status results_jackknife(Results *results, Results *const *from, size_t groups);

bool result_healthy(const ResultCounter *counter);
const ResultCounter *results_broken_limit(const Results *results); // the first; NULL if healthy

typedef struct Estimate {
    double value; // mean over the replicas that have a value
    double error; // its standard error; of a single replica that which it tells itself, else NaN
    size_t n;     // how many
} Estimate;

// Of a single replica, the series of the standard errors of this one, which stands beside it under
// its name and "_error"; NULL if it tells none.
const ResultSeries *results_own_errors(const Results *results, const ResultSeries *series);

Estimate results_series_estimate(const Results *results, const ResultSeries *series,
                                 size_t element);
Estimate results_scalar_estimate(const Results *results, const ResultScalar *scalar);

// Saves all of it, or loads it into what results_create(&results, 0) made.
void results_archive(Results *results, Archive *archive);
