// SPDX-License-Identifier: GPL-3.0-or-later
// A number or a curve out of Results by name.
#include "measure.h"

#include "base/memory.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

enum { NAME_MOST = 2 * RESULT_NAME, KEYS_MOST = 256 };
// Relative distance at which a number names the nearest value of an axis: wave numbers of shells
// and times in whole steps are not quite those that were asked for.
static const double NEAR = 0.02;

typedef struct Name {
    char stage[NAME_MOST], quantity[NAME_MOST], keys[KEYS_MOST]; // keys: "all,total,0.06" or ""
} Name;

bool measure_is_curve(const char *quantity) {
    return strchr(quantity, '*') != NULL;
}

// "STAGE/QUANTITY[KEYS]" from `length` characters.
static Status read_name(Name *name, const char *text, size_t length) {
    char whole[2 * NAME_MOST + KEYS_MOST];
    *name = (Name){.stage = ""};
    snprintf(whole, sizeof whole, "%.*s", (int)length, text);
    // Becomes: stage up to the slash, quantity up to the bracket, keys up to the closing one.
    const int parts =
        sscanf(whole, "%127[^/]/%127[^[][%255[^]]", name->stage, name->quantity, name->keys);
    if (parts >= 2) return OK;
    return status_fail(BAD_DATA, "'%s' is not STAGE/QUANTITY or STAGE/OBSERVABLE[KEYS]", whole);
}

static bool find_label(const ResultAxis *axis, const char *key, size_t *index) {
    for (size_t i = 0; axis->labels && i < axis->count; i++) {
        *index = i;
        if (strcmp(axis->labels[i], key) == 0) return true;
    }
    return false;
}

static Status find_key(const ResultAxis *axis, const char *key, size_t *index) {
    double wanted = 0, nearest = INFINITY;
    if (find_label(axis, key, index)) return OK;
    const bool number = axis->values && number_read(key, &wanted);
    for (size_t i = 0; number && i < axis->count; i++) {
        const double off = fabs(axis->values[i] - wanted);
        if (!(off < nearest)) continue;
        nearest = off;
        *index = i;
    }
    if (nearest <= NEAR * fabs(wanted)) return OK;
    return status_fail(BAD_DATA, "there is no '%s' on the axis %s", key, axis->name);
}

typedef struct Place {
    const ResultSeries *series;
    size_t first, stride; // elements along the open axis
    const ResultAxis *open;
} Place;

// An axis at a time, the last running fastest; "*" opens one.
static Status read_keys(Place *place, char *keys) {
    const ResultSeries *series = place->series;
    char *key = keys;
    for (size_t a = 0; a < series->axes; a++) {
        const ResultAxis *axis = &series->axis[a];
        if (!key) {
            return status_fail(BAD_DATA, "%s/%s has %zu axes; a key is missing for %s",
                               series->stage, series->observable, series->axes, axis->name);
        }
        char *end = strchr(key, ',');
        if (end) *end = '\0';
        size_t index = 0;
        place->first *= axis->count;
        place->stride *= axis->count;
        if (strcmp(key, "*") == 0) {
            place->open = axis;
            place->stride = 1;
        } else
            TRY(find_key(axis, key, &index));
        place->first += index;
        key = end ? end + 1 : NULL;
    }
    return OK;
}

static Status find_place(const Results *results, Name *name, Place *place) {
    *place = (Place){.series = results_find_series(results, name->stage, name->quantity)};
    if (place->series) return read_keys(place, name->keys);
    return status_fail(BAD_DATA, "there are no results %s/%s", name->stage, name->quantity);
}

// What the analysis tells of some runs of a stage and not of others, such as where a peak is.
static bool is_withheld(const Results *results, const Name *name) {
    if (!result_meaning(name->quantity)) return false;
    for (size_t i = 0; i < results->scalar_count; i++)
        if (strcmp(results->scalars[i].stage, name->stage) == 0) return true;
    return false;
}

// The value in each replica; NaN where it is not told.
static Status read_values(const Results *results, const char *text, size_t length, double *values) {
    Name name;
    TRY(read_name(&name, text, length));
    if (name.keys[0]) {
        Place place;
        TRY(find_place(results, &name, &place));
        for (size_t r = 0; r < results->replicas; r++) {
            values[r] = place.series->values[r * place.series->size + place.first];
        }
        return OK;
    }
    const ResultScalar *scalar = results_find_scalar(results, name.stage, name.quantity);
    if (!scalar && !is_withheld(results, &name))
        return status_fail(BAD_DATA, "there is no result %s/%s", name.stage, name.quantity);
    for (size_t r = 0; r < results->replicas; r++) {
        values[r] = scalar ? scalar->values[r] : (double)NAN;
    }
    return OK;
}

static Status read_expression(const Results *results, const char *quantity, double *values,
                              double *others) {
    const char *minus = strstr(quantity, " - "), *over = strstr(quantity, " / ");
    const char *sign = minus ? minus : over;
    if (!sign) return read_values(results, quantity, strlen(quantity), values);
    TRY(read_values(results, quantity, (size_t)(sign - quantity), values));
    TRY(read_values(results, sign + 3, strlen(sign + 3), others));
    for (size_t r = 0; r < results->replicas; r++) {
        values[r] = minus ? values[r] - others[r] : values[r] / others[r];
    }
    return OK;
}

Status measure_number(const Results *results, const char *quantity, Estimate *estimate) {
    double *values = NULL, *others = NULL;
    Status status = NEW_ARRAY(values, results->replicas);
    if (status == OK) status = NEW_ARRAY(others, results->replicas);
    if (status == OK) status = read_expression(results, quantity, values, others);
    if (status == OK) {
        *estimate = results_scalar_estimate(results, &(ResultScalar){.values = values});
    }
    memory_free(values);
    memory_free(others);
    return status;
}

Status measure_curve(const Results *results, const char *quantity, FILE *out) {
    Name name;
    Place place;
    TRY(read_name(&name, quantity, strlen(quantity)));
    TRY(find_place(results, &name, &place));
    if (!place.open || !place.open->values) {
        return status_fail(BAD_DATA, "%s: the open axis must be one of numbers", quantity);
    }
    fprintf(out, "%s,value,error\n", place.open->name);
    for (size_t i = 0; i < place.open->count; i++) {
        const Estimate estimate =
            results_series_estimate(results, place.series, place.first + i * place.stride);
        fprintf(out, "%.10g,%.10g,%.10g\n", place.open->values[i], estimate.value, estimate.error);
    }
    return OK;
}
