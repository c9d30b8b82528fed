// SPDX-License-Identifier: GPL-3.0-or-later
// How a structure factor differs from that of the first stage which has it, of the same replica:
// after a stage at rest, what shear has done to it (Weysser, thesis, ch. 5).
#include "analysis/derive.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

static const ResultSeries *first_of_its_kind(const Results *results, const ResultSeries *series) {
    for (size_t i = 0; i < results->series_count; i++) {
        if (strcmp(results->series[i].observable, series->observable) == 0)
            return &results->series[i];
    }
    return series;
}

static bool same_axes(const ResultSeries *one, const ResultSeries *other) {
    if (one->axes != other->axes) return false;
    for (size_t i = 0; i < one->axes; i++) {
        const ResultAxis *a = &one->axis[i], *b = &other->axis[i];
        if (a->count != b->count || !a->values != !b->values) return false;
        if (a->values && memcmp(a->values, b->values, a->count * sizeof *a->values) != 0)
            return false;
    }
    return true;
}

// Replica by replica; putting an entry may move the two series.
static Status put_changes(Results *results, const ResultSeries *shape, const double *changes) {
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(results_put_series(results, shape, replica, changes + replica * shape->size));
    }
    return OK;
}

Status derive_structure_change(Results *results, const ResultSeries *series) {
    const ResultSeries *rest = first_of_its_kind(results, series);
    if (rest == series || !same_axes(rest, series)) return OK;
    const size_t count = results->replicas * series->size;
    double *changes = NULL;
    TRY(NEW_ARRAY(changes, count));
    for (size_t i = 0; i < count; i++) changes[i] = series->values[i] - rest->values[i];
    ResultSeries shape = derive_shape(series, "_change");
    snprintf(shape.about, sizeof shape.about, "Change of the structure factor since stage '%s'.",
             rest->stage);
    const Status status = put_changes(results, &shape, changes);
    memory_free(changes);
    return status;
}
