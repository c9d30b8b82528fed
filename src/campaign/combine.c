// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of all points as series over what is swept.
#include "campaign/combine.h"

#include "base/memory.h"
#include "base/number.h"

#include <math.h>
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

static Status axis_of(const SweepKey *key, ResultAxis *axis) {
    *axis = (ResultAxis){.name = key->name, .unit = "", .count = key->count};
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

static Status make_axes(Axes *axes, const ConfigPoints *points) {
    *axes = (Axes){.size = config_point_count(points)};
    for (size_t k = 0; k < config_sweep_keys(points); k++) {
        TRY(axis_of(config_sweep_key(points, k), &axes->axis[k]));
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
    Status status = make_axes(&axes, points);
    if (status == OK) status = put_scalars(all, &axes, point, one);
    free_axes(&axes);
    return status == OK ? put_health(all, one) : status;
}
