// SPDX-License-Identifier: GPL-3.0-or-later
// What is made of a series: its shape, and which rows of two series of the same observable are of
// the same species, direction, wave number: stages may look at other ones, and in another order.
#include "analysis/derive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

ResultSeries derive_shape(const ResultSeries *of, const char *name) {
    ResultSeries shape = *of; // adding a series moves those that are there
    const int source = name[0] == '_' ? RESULT_NAME - 1 - (int)strlen(name) : 0;
    snprintf(shape.observable, sizeof shape.observable, "%.*s%s", source, of->observable, name);
    shape.about[0] = '\0';
    return shape;
}

static const double SAME_NUMBER = 1e-9; // relative, as both were read from one run file

static bool same_place(const ResultAxis *a, size_t i, const ResultAxis *b, size_t j) {
    if (a->labels && b->labels) return strcmp(a->labels[i], b->labels[j]) == 0;
    if (!a->values || !b->values) return false;
    return fabs(a->values[i] - b->values[j]) <= SAME_NUMBER * fabs(a->values[i]);
}

size_t derive_same_row(const ResultSeries *series, size_t row, const ResultSeries *other,
                       size_t axes) {
    size_t found = 0, stride = 1;
    for (size_t k = axes; k-- > 0;) {
        const ResultAxis *axis = &series->axis[k], *others = &other->axis[k];
        const size_t at = row % axis->count;
        row /= axis->count;
        size_t j = 0;
        while (j < others->count && !same_place(axis, at, others, j)) j++;
        if (j == others->count || strcmp(axis->name, others->name) != 0) return NO_ROW;
        found += j * stride;
        stride *= others->count;
    }
    return found;
}

bool derive_has_rows(const ResultSeries *series, const ResultSeries *other, size_t axes) {
    size_t rows = 1;
    for (size_t k = 0; k < axes; k++) rows *= series->axis[k].count;
    for (size_t row = 0; row < rows; row++) {
        if (derive_same_row(series, row, other, axes) == NO_ROW) return false;
    }
    return true;
}
