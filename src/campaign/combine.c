// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of all points as series over what is swept.
#include "campaign/combine.h"

#include "base/memory.h"
#include "base/number.h"
#include "base/text.h"
#include "store/store.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct Axes {
    ResultAxis axis[SWEEP_KEYS_MOST];
    size_t count, size;
} Axes;

static void free_axes(Axes *axes) {
    for (size_t a = 0; a < axes->count; a++) {
        memory_free((void *)axes->axis[a].values);
        memory_free((void *)axes->axis[a].labels);
    }
}

static bool has_axis(const ResultSeries *series, const char *name) {
    bool has = false;
    for (size_t a = 0; a < series->axes; a++) has = has || strcmp(series->axis[a].name, name) == 0;
    return has;
}

// The whole key where its last word is the name of an axis of a series already, as `time` is. All
// points have it as the first.
static const char *name_of(const ConfigPoints *points, size_t k, const Results *all,
                           const Results *one) {
    const SweepKey *key = config_sweep_key(points, k);
    if (all->series_count > 0)
        return strcmp(all->series[0].axis[k].name, key->path) == 0 ? key->path : key->name;
    bool taken = store_keeps_name(key->name);
    for (size_t i = 0; i < one->series_count; i++)
        taken = taken || has_axis(&one->series[i], key->name);
    return taken ? key->path : key->name;
}

static Status axis_of(const SweepKey *key, const char *name, ResultAxis *axis) {
    *axis = (ResultAxis){.name = name, .unit = key->unit, .count = key->count};
    double *values = NULL;
    const char **labels = NULL;
    if (key->numbers) {
        TRY(NEW_ARRAY(values, key->count));
        for (size_t i = 0; i < key->count; i++) number_read(key->words[i], &values[i]);
    } else {
        TRY(NEW_ARRAY(labels, key->count));
        for (size_t i = 0; i < key->count; i++) labels[i] = key->words[i];
    }
    axis->values = values;
    axis->labels = labels;
    return OK;
}

static Status make_axes(Axes *axes, const ConfigPoints *points, const Results *all,
                        const Results *one) {
    *axes = (Axes){.size = config_point_count(points)};
    for (size_t k = 0; k < config_sweep_keys(points); k++) {
        const char *name = name_of(points, k, all, one);
        TRY(axis_of(config_sweep_key(points, k), name, &axes->axis[k]));
        axes->count++;
    }
    return OK;
}

static Status put_scalar(Results *all, const Axes *axes, size_t point, const Results *one,
                         const ResultScalar *scalar) {
    ResultSeries shape = {.axes = axes->count};
    strcpy(shape.stage, scalar->stage);
    strcpy(shape.observable, scalar->quantity);
    strcpy(shape.unit, scalar->unit);
    strcpy(shape.about, scalar->about);
    memcpy(shape.axis, axes->axis, sizeof axes->axis);
    for (size_t r = 0; r < one->replicas; r++) {
        TRY(results_put_element(all, &shape, r, point, scalar->values[r]));
    }
    return OK;
}

static Status put_scalars(Results *all, const Axes *axes, size_t point, const Results *one) {
    for (size_t i = 0; i < one->scalar_count; i++) {
        TRY(put_scalar(all, axes, point, one, &one->scalars[i]));
    }
    return OK;
}

// Wave numbers of shells and times in whole steps depend a little on the box and the step.
static const double NEAR = 0.02;

static bool same_axis(const ResultAxis *a, const ResultAxis *b) {
    if (strcmp(a->name, b->name) != 0 || a->count != b->count) return false;
    for (size_t i = 0; i < a->count; i++) {
        if (a->labels && strcmp(a->labels[i], b->labels[i]) != 0) return false;
        if (a->values && !(fabs(a->values[i] - b->values[i]) <= NEAR * fabs(a->values[i])))
            return false;
    }
    return true;
}

// The axes of the sweep, then those of the series. False if they are too many, or two have one
// name, or they are not those that the first point had: what each point measures at places of its
// own cannot stand side by side.
static bool shape_series(ResultSeries *shape, const Results *all, const Axes *axes,
                         const ResultSeries *series) {
    if (axes->count + series->axes > RESULT_AXES) return false;
    for (size_t k = 0; k < axes->count; k++) {
        if (has_axis(series, axes->axis[k].name)) return false;
    }
    const ResultSeries *there = results_find_series(all, series->stage, series->observable);
    if (there && there->axes != axes->count + series->axes) return false;
    *shape = *series;
    memcpy(shape->axis, axes->axis, axes->count * sizeof *shape->axis);
    for (size_t a = 0; a < series->axes; a++) {
        const ResultAxis *axis = &series->axis[a];
        shape->axis[axes->count + a] = *axis;
        if (there && !same_axis(&there->axis[axes->count + a], axis)) return false;
    }
    shape->axes = axes->count + series->axes;
    return true;
}

// Adds it to the fact that lists what could not be laid side by side.
static Status list_left_out(Results *all, const ResultSeries *series) {
    char name[2 * RESULT_NAME];
    const char *list = results_find_fact(all, RESULTS_NOT_SIDE_BY_SIDE);
    if (!results_side_by_side(all, series)) return OK;
    snprintf(name, sizeof name, "%s/%s", series->stage, series->observable);
    Text longer = {0};
    text_add(&longer, "%s%s%s", list ? list : "", list ? ", " : "", name);
    Status status = text_status(&longer);
    if (status == OK) status = results_put_fact(all, RESULTS_NOT_SIDE_BY_SIDE, text_words(&longer));
    text_free(&longer);
    return status;
}

static Status put_series(Results *all, const Axes *axes, size_t point, const Results *one,
                         const ResultSeries *series) {
    // Over the sweep the name is that of the quantity: of the pressure, not of its blocks in time.
    if (results_find_scalar(one, series->stage, series->observable)) return OK;
    ResultSeries shape;
    if (!shape_series(&shape, all, axes, series)) return list_left_out(all, series);
    for (size_t r = 0; r < one->replicas; r++) {
        for (size_t e = 0; e < series->size; e++) {
            TRY(results_put_element(all, &shape, r, point * series->size + e,
                                    series->values[r * series->size + e]));
        }
    }
    return OK;
}

// The worst of all points.
static Status put_health(Results *all, const Results *one) {
    for (size_t i = 0; i < one->health_count; i++) {
        const ResultCounter *counter = &one->health[i];
        double worst = counter->value;
        for (size_t k = 0; k < all->health_count; k++) {
            if (strcmp(all->health[k].name, counter->name) == 0)
                worst = fmax(worst, all->health[k].value);
        }
        TRY(results_put_health(all, counter->name, counter->about, counter->limit, worst));
    }
    return OK;
}

Status combine_point(Results *all, const ConfigPoints *points, size_t point, const Results *one) {
    Axes axes;
    Status status = make_axes(&axes, points, all, one);
    if (status == OK) status = put_scalars(all, &axes, point, one);
    for (size_t i = 0; i < one->series_count && status == OK; i++) {
        status = put_series(all, &axes, point, one, &one->series[i]);
    }
    free_axes(&axes);
    return status == OK ? put_health(all, one) : status;
}
