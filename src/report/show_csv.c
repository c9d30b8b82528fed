// SPDX-License-Identifier: GPL-3.0-or-later
// The results as comma-separated values (RFC 4180): all scalars, or one series point by point.
#include "report/show.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

// In quotes where it holds a comma, a quote or a new line.
static void field(Text *text, const char *words) {
    const bool plain = strpbrk(words, ",\"\r\n") == NULL;
    if (!plain) text_put(text, "\"");
    for (const char *c = words; *c; c++) {
        if (*c == '"') text_put(text, "\"");
        text_bytes(text, c, 1);
    }
    if (!plain) text_put(text, "\"");
}

static void number_field(Text *text, double value) { // empty for what is not finite
    char digits[NUMBER_SIZE];
    if (isfinite(value)) text_put(text, number_write(digits, value));
}

static void estimate_fields(Text *text, Estimate estimate, const char *unit) {
    number_field(text, estimate.value);
    text_put(text, ",");
    number_field(text, estimate.error);
    text_put(text, ",");
    field(text, unit);
    text_add(text, ",%zu", estimate.n);
}

static void scalar_line(Text *text, const Results *results, const ResultScalar *scalar) {
    Text name = {0};
    text_add(&name, "%s/%s", scalar->stage, scalar->quantity);
    field(text, text_words(&name));
    text_free(&name);
    text_put(text, ",");
    estimate_fields(text, results_scalar_estimate(results, scalar), scalar->unit);
    text_put(text, ",");
    field(text, scalar->about);
    text_put(text, "\n");
}

static void scalars(Text *text, const Results *results, const Selection *selection) {
    size_t lines = 0;
    for (size_t i = 0; i < results->scalar_count; i++) {
        if (!selects_scalar(selection, &results->scalars[i])) continue;
        if (lines++ == 0) text_put(text, "quantity,value,error,unit,n,about\n");
        scalar_line(text, results, &results->scalars[i]);
    }
}

static void series_line(Text *text, const Results *results, const ResultSeries *series,
                        size_t element) {
    size_t index[RESULT_AXES];
    show_indices(series, element, index);
    for (size_t i = 0; i < series->axes; i++) {
        const ResultAxis *axis = &series->axis[i];
        if (axis->labels)
            field(text, axis->labels[index[i]]);
        else
            number_field(text, axis->values[index[i]]);
        text_put(text, ",");
    }
    estimate_fields(text, results_series_estimate(results, series, element), series->unit);
    text_put(text, "\n");
}

static void one_series(Text *text, const Results *results, const ResultSeries *series) {
    for (size_t i = 0; i < series->axes; i++) {
        field(text, series->axis[i].name);
        text_put(text, ",");
    }
    text_put(text, "value,error,unit,n\n");
    for (size_t i = 0; i < series->size; i++) series_line(text, results, series, i);
}

// One table, for a program reads one: where a number and a series share a name, the series.
void show_csv(Text *text, const Results *results, const Selection *selection) {
    for (size_t i = 0; !selection->all && i < results->series_count; i++) {
        if (!selects_series(selection, &results->series[i])) continue;
        one_series(text, results, &results->series[i]);
        return;
    }
    scalars(text, results, selection);
}
