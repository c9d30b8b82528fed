// SPDX-License-Identifier: GPL-3.0-or-later
// The table of named numbers and arrays, and what is derived from it.
#include "results/results.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

static Status keep_text(char *field, size_t size, const char *text) {
    if (strlen(text) >= size) {
        return status_fail(BAD_DATA, "'%s' is longer than the %zu characters of a result's text",
                           text, size - 1);
    }
    strcpy(field, text);
    return OK;
}

#define KEEP_TEXT(field, text) keep_text((field), sizeof(field), (text))

static Status keep_name(char field[RESULT_NAME], const char *name) {
    if (name[0] == '\0' || strchr(name, '/')) {
        return status_fail(BAD_DATA, "'%s' cannot be the name of a result", name);
    }
    return keep_text(field, RESULT_NAME, name);
}

static Status new_values(double **values, size_t replicas, size_t size) {
    size_t count = 0;
    if (__builtin_mul_overflow(replicas, size, &count)) {
        return status_fail(NO_MEMORY, "out of memory: %zu replicas of %zu numbers", replicas, size);
    }
    TRY(NEW_ARRAY(*values, count));
    for (size_t i = 0; i < count; i++) (*values)[i] = NAN;
    return OK;
}

Status results_create(Results **out, size_t replicas) {
    Results *results = NULL;
    TRY(NEW(results));
    results->replicas = replicas;
    *out = results;
    return OK;
}

static void axis_free(ResultAxis *axis) {
    for (size_t i = 0; axis->labels && i < axis->count; i++) free((char *)axis->labels[i]);
    memory_free((void *)axis->labels);
    memory_free((double *)axis->values);
    free((char *)axis->name);
    free((char *)axis->unit);
    *axis = (ResultAxis){0};
}

static void series_free(ResultSeries *series) {
    for (size_t a = 0; a < series->axes; a++) axis_free(&series->axis[a]);
    memory_free(series->values);
}

void results_free(Results *results) {
    if (!results) return;
    for (size_t i = 0; i < results->series_count; i++) series_free(&results->series[i]);
    for (size_t i = 0; i < results->scalar_count; i++) memory_free(results->scalars[i].values);
    for (size_t i = 0; i < results->fact_count; i++) free(results->facts[i].text);
    free(results->series);
    free(results->scalars);
    free(results->facts);
    free(results->health);
    memory_free(results);
}

// Makes room for one more element at the end of an array that realloc() holds.
static Status one_more(void **array, size_t count, size_t size) {
    void *longer = realloc(*array, (count + 1) * size);
    if (!longer) return status_fail(NO_MEMORY, "out of memory: cannot keep %zu results", count + 1);
    memset((char *)longer + count * size, 0, size);
    *array = longer;
    return OK;
}

#define ONE_MORE(array, count) one_more((void **)&(array), (count), sizeof *(array))

static Status copy_labels(ResultAxis *copy, const ResultAxis *axis) {
    const char **labels = NULL;
    TRY(NEW_ARRAY(labels, axis->count));
    copy->labels = labels;
    for (size_t i = 0; i < axis->count; i++) {
        labels[i] = strdup(axis->labels[i]);
        if (!labels[i]) return status_fail(NO_MEMORY, "out of memory: axis '%s'", axis->name);
    }
    return OK;
}

static Status copy_axis(ResultAxis *copy, const ResultAxis *axis) {
    char name[RESULT_NAME], unit[RESULT_NAME];
    TRY(keep_name(name, axis->name));
    TRY(KEEP_TEXT(unit, axis->unit));
    copy->count = axis->count;
    copy->name = strdup(name);
    copy->unit = strdup(unit);
    if (!copy->name || !copy->unit) return status_fail(NO_MEMORY, "out of memory: axis '%s'", name);
    if (axis->labels) return copy_labels(copy, axis);
    double *values = NULL;
    TRY(NEW_ARRAY(values, axis->count));
    copy->values = values;
    if (axis->count > 0) memcpy(values, axis->values, axis->count * sizeof *values);
    return OK;
}

// A number over the points of a sweep is a series of the number's name, which may end like the name
// of a series made of another: flow_curve_exponent.
static const ResultMeaning *meaning_of_series(const char *name) {
    const ResultMeaning *series = result_series_meaning(name), *number = result_meaning(name);
    if (!series || !number) return series ? series : number;
    return series->name[0] == '*' && strcmp(number->name, name) == 0 ? number : series;
}

static Status fill_series(ResultSeries *series, const ResultSeries *shape, size_t replicas) {
    TRY(keep_name(series->stage, shape->stage));
    TRY(keep_name(series->observable, shape->observable));
    TRY(KEEP_TEXT(series->unit, shape->unit));
    const ResultMeaning *meaning = meaning_of_series(shape->observable);
    TRY(KEEP_TEXT(series->about, shape->about[0] || !meaning ? shape->about : meaning->about));
    ASSERT(shape->axes <= RESULT_AXES);
    series->size = 1;
    for (size_t a = 0; a < shape->axes; a++) {
        series->axes = a + 1;
        TRY(copy_axis(&series->axis[a], &shape->axis[a]));
        if (__builtin_mul_overflow(series->size, shape->axis[a].count, &series->size)) {
            return status_fail(NO_MEMORY, "out of memory: the axes of '%s' are too long",
                               shape->observable);
        }
    }
    return new_values(&series->values, replicas, series->size);
}

static ResultSeries *find_series(const Results *results, const char *stage,
                                 const char *observable) {
    for (size_t i = 0; i < results->series_count; i++) {
        ResultSeries *series = &results->series[i];
        if (strcmp(series->stage, stage) == 0 && strcmp(series->observable, observable) == 0) {
            return series;
        }
    }
    return NULL;
}

static Status add_series(Results *results, const ResultSeries *shape, ResultSeries **out) {
    TRY(ONE_MORE(results->series, results->series_count));
    ResultSeries *series = &results->series[results->series_count];
    const Status status = fill_series(series, shape, results->replicas);
    if (status != OK) {
        series_free(series);
        return status;
    }
    results->series_count++;
    *out = series;
    return OK;
}

static bool same_shape(const ResultSeries *a, const ResultSeries *b) {
    if (a->axes != b->axes) return false;
    for (size_t i = 0; i < a->axes; i++) {
        if (a->axis[i].count != b->axis[i].count) return false;
        if (strcmp(a->axis[i].name, b->axis[i].name) != 0) return false;
    }
    return true;
}

// Of this shape; made where there is none yet.
static Status series_of(Results *results, const ResultSeries *shape, size_t replica,
                        ResultSeries **out) {
    ASSERT(replica < results->replicas);
    *out = find_series(results, shape->stage, shape->observable);
    if (!*out) TRY(add_series(results, shape, out));
    if (same_shape(*out, shape)) return OK;
    return status_fail(BAD_DATA, "%s/%s has other axes in replica %zu than before", shape->stage,
                       shape->observable, replica);
}

Status results_put_series(Results *results, const ResultSeries *shape, size_t replica,
                          const double *values) {
    ResultSeries *series = NULL;
    TRY(series_of(results, shape, replica, &series));
    memcpy(series->values + replica * series->size, values, series->size * sizeof *values);
    return OK;
}

Status results_put_element(Results *results, const ResultSeries *shape, size_t replica,
                           size_t element, double value) {
    ResultSeries *series = NULL;
    TRY(series_of(results, shape, replica, &series));
    ASSERT(element < series->size);
    series->values[replica * series->size + element] = value;
    return OK;
}

static ResultScalar *find_scalar(const Results *results, const char *stage, const char *quantity) {
    for (size_t i = 0; i < results->scalar_count; i++) {
        ResultScalar *scalar = &results->scalars[i];
        if (strcmp(scalar->stage, stage) == 0 && strcmp(scalar->quantity, quantity) == 0) {
            return scalar;
        }
    }
    return NULL;
}

static Status add_scalar(Results *results, const char *stage, const char *quantity,
                         const char *unit, const char *about, ResultScalar **out) {
    TRY(ONE_MORE(results->scalars, results->scalar_count));
    ResultScalar *scalar = &results->scalars[results->scalar_count];
    TRY(keep_name(scalar->stage, stage));
    TRY(keep_name(scalar->quantity, quantity));
    TRY(KEEP_TEXT(scalar->unit, unit));
    TRY(KEEP_TEXT(scalar->about, about));
    TRY(new_values(&scalar->values, results->replicas, 1));
    results->scalar_count++;
    *out = scalar;
    return OK;
}

Status results_put_scalar(Results *results, const char *stage, const char *quantity,
                          const char *unit, const char *about, size_t replica, double value) {
    ASSERT(replica < results->replicas);
    ResultScalar *scalar = find_scalar(results, stage, quantity);
    if (!about) {
        const ResultMeaning *meaning = result_meaning(quantity);
        ASSERT(meaning);
        about = meaning->about;
    }
    if (!scalar) TRY(add_scalar(results, stage, quantity, unit, about, &scalar));
    scalar->values[replica] = value;
    return OK;
}

static ResultFact *find_fact(const Results *results, const char *name) {
    for (size_t i = 0; i < results->fact_count; i++) {
        if (strcmp(results->facts[i].name, name) == 0) return &results->facts[i];
    }
    return NULL;
}

Status results_put_fact(Results *results, const char *name, const char *text) {
    char *copy = strdup(text);
    if (!copy) return status_fail(NO_MEMORY, "out of memory: cannot keep '%s'", name);
    ResultFact *fact = find_fact(results, name);
    if (!fact) {
        Status status = ONE_MORE(results->facts, results->fact_count);
        if (status == OK) status = keep_name(results->facts[results->fact_count].name, name);
        if (status != OK) {
            free(copy);
            return status;
        }
        fact = &results->facts[results->fact_count++];
    }
    free(fact->text);
    fact->text = copy;
    return OK;
}

Status results_put_health(Results *results, const char *name, const char *about, double limit,
                          double value) {
    for (size_t i = 0; i < results->health_count; i++) {
        if (strcmp(results->health[i].name, name) != 0) continue;
        results->health[i].limit = limit;
        results->health[i].value = value;
        return OK;
    }
    TRY(ONE_MORE(results->health, results->health_count));
    ResultCounter *counter = &results->health[results->health_count];
    TRY(keep_name(counter->name, name));
    TRY(KEEP_TEXT(counter->about, about));
    counter->limit = limit;
    counter->value = value;
    results->health_count++;
    return OK;
}

const ResultSeries *results_find_series(const Results *results, const char *stage,
                                        const char *observable) {
    return find_series(results, stage, observable);
}

const ResultScalar *results_find_scalar(const Results *results, const char *stage,
                                        const char *quantity) {
    return find_scalar(results, stage, quantity);
}

const char *results_find_fact(const Results *results, const char *name) {
    const ResultFact *fact = find_fact(results, name);
    return fact ? fact->text : NULL;
}

bool results_side_by_side(const Results *results, const ResultSeries *series) {
    char name[2 * RESULT_NAME];
    const int length = snprintf(name, sizeof name, "%s/%s", series->stage, series->observable);
    const char *list = results_find_fact(results, RESULTS_NOT_SIDE_BY_SIDE);
    for (const char *at = list ? list : ""; (at = strstr(at, name)); at += length) {
        const bool begins = at == list || at[-1] == ' ';
        if (begins && (at[length] == '\0' || at[length] == ',')) return false;
    }
    return true;
}

bool result_healthy(const ResultCounter *counter) {
    return isnan(counter->limit) || counter->value <= counter->limit; // a NaN value is not
}

const ResultCounter *results_broken_limit(const Results *results) {
    for (size_t i = 0; i < results->health_count; i++) {
        if (!result_healthy(&results->health[i])) return &results->health[i];
    }
    return NULL;
}

// Mean and its standard error s/sqrt(n), in two passes so that close values lose no digits.
static Estimate estimate(const double *values, size_t count, size_t stride) {
    Estimate result = {.value = NAN, .error = NAN};
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        if (isnan(values[i * stride])) continue;
        sum += values[i * stride];
        result.n++;
    }
    if (result.n == 0) return result;
    result.value = sum / (double)result.n;
    if (result.n < 2) return result;
    double squares = 0;
    for (size_t i = 0; i < count; i++) {
        const double deviation = values[i * stride] - result.value;
        if (!isnan(deviation)) squares += deviation * deviation;
    }
    result.error = sqrt(squares / ((double)result.n * (double)(result.n - 1)));
    return result;
}

static void name_of_error(char name[RESULT_NAME + 8], const char *of) {
    snprintf(name, RESULT_NAME + 8, "%s_error", of);
}

const ResultSeries *results_own_errors(const Results *results, const ResultSeries *series) {
    char name[RESULT_NAME + 8];
    if (results->replicas != 1) return NULL;
    name_of_error(name, series->observable);
    const ResultSeries *errors = results_find_series(results, series->stage, name);
    return errors && errors->size == series->size ? errors : NULL;
}

Estimate results_series_estimate(const Results *results, const ResultSeries *series,
                                 size_t element) {
    ASSERT(element < series->size);
    Estimate result = estimate(series->values + element, results->replicas, series->size);
    const ResultSeries *errors = results_own_errors(results, series);
    if (errors) result.error = errors->values[element];
    return result;
}

Estimate results_scalar_estimate(const Results *results, const ResultScalar *scalar) {
    char name[RESULT_NAME + 8];
    Estimate result = estimate(scalar->values, results->replicas, 1);
    if (results->replicas != 1) return result;
    name_of_error(name, scalar->quantity);
    const ResultScalar *error = results_find_scalar(results, scalar->stage, name);
    if (error) result.error = error->values[0];
    return result;
}
