// SPDX-License-Identifier: GPL-3.0-or-later
// The results as one JSON object:
//   "run": facts as strings, "health": {COUNTER: number}
//   "quantities": {"STAGE/NAME": {"value", "error", "unit", "n", "about"}}
//   "series": {"STAGE/OBSERVABLE": {"axes": names, "axis_units", AXIS: values or labels...,
//              "mean" and "error", nested in the order of the axes, "unit", "about"}}
// What is no number is null.
#include "report/show.h"

#include "report/json.h"

static void member(Text *text, const char *name, const char *words) {
    json_string(text, name);
    text_put(text, ": ");
    json_string(text, words);
}

static void full_name(Text *text, const char *stage, const char *name) {
    Text full = {0};
    text_add(&full, "%s/%s", stage, name);
    json_string(text, text_words(&full));
    text_free(&full);
}

static void show_run(Text *text, const Results *results) {
    text_put(text, "  \"run\": {");
    for (size_t i = 0; i < results->fact_count; i++) {
        text_put(text, "\n    ");
        member(text, results->facts[i].name, results->facts[i].text);
        text_put(text, ",");
    }
    text_put(text, "\n    \"health\": {");
    for (size_t i = 0; i < results->health_count; i++) {
        text_put(text, i ? ",\n      " : "\n      ");
        json_string(text, results->health[i].name);
        text_put(text, ": ");
        json_number(text, results->health[i].value);
    }
    text_put(text, "\n    }\n  }");
}

static void show_scalar(Text *text, const Results *results, const ResultScalar *scalar) {
    const Estimate estimate = results_scalar_estimate(results, scalar);
    full_name(text, scalar->stage, scalar->quantity);
    text_put(text, ": {\"value\": ");
    json_number(text, estimate.value);
    text_put(text, ", \"error\": ");
    json_number(text, estimate.error);
    text_put(text, ", ");
    member(text, "unit", scalar->unit);
    text_add(text, ", \"n\": %zu, ", estimate.n);
    member(text, "about", scalar->about);
    text_put(text, "}");
}

static void show_axis(Text *text, const ResultAxis *axis) {
    json_string(text, axis->name);
    text_put(text, ": [");
    for (size_t i = 0; i < axis->count; i++) {
        if (i) text_put(text, ", ");
        if (axis->labels)
            json_string(text, axis->labels[i]);
        else
            json_number(text, axis->values[i]);
    }
    text_put(text, "]");
}

// "axes" names the nesting of mean and error, the outermost first.
static void show_axes(Text *text, const ResultSeries *series) {
    text_put(text, "\n      \"axes\": [");
    for (size_t i = 0; i < series->axes; i++) {
        if (i) text_put(text, ", ");
        json_string(text, series->axis[i].name);
    }
    text_put(text, "],\n      \"axis_units\": [");
    for (size_t i = 0; i < series->axes; i++) {
        if (i) text_put(text, ", ");
        json_string(text, series->axis[i].unit);
    }
    text_put(text, "],");
    for (size_t i = 0; i < series->axes; i++) {
        text_put(text, "\n      ");
        show_axis(text, &series->axis[i]);
        text_put(text, ",");
    }
}

typedef double Part(Estimate estimate);
static double mean_of(Estimate estimate) {
    return estimate.value;
}
static double error_of(Estimate estimate) {
    return estimate.error;
}

// The values as nested arrays: a bracket opens and closes wherever an axis begins and ends.
static void show_values(Text *text, const Results *results, const ResultSeries *series,
                        Part *part) {
    if (series->size == 0) text_put(text, "[]");
    for (size_t i = 0; i < series->size; i++) {
        if (i) text_put(text, ", ");
        for (size_t block = series->size, axis = 0; axis < series->axes; axis++) {
            if (i % block == 0) text_put(text, "[");
            block /= series->axis[axis].count;
        }
        json_number(text, part(results_series_estimate(results, series, i)));
        for (size_t block = series->size, axis = 0; axis < series->axes; axis++) {
            if ((i + 1) % block == 0) text_put(text, "]");
            block /= series->axis[axis].count;
        }
    }
}

static void show_series(Text *text, const Results *results, const ResultSeries *series) {
    full_name(text, series->stage, series->observable);
    text_put(text, ": {");
    show_axes(text, series);
    text_put(text, "\n      \"mean\": ");
    show_values(text, results, series, mean_of);
    text_put(text, ",\n      \"error\": ");
    show_values(text, results, series, error_of);
    text_put(text, ",\n      ");
    member(text, "unit", series->unit);
    text_put(text, ", ");
    member(text, "about", series->about);
    text_put(text, "}");
}

void show_json(Text *text, const Results *results, const Selection *selection) {
    text_put(text, "{\n");
    show_run(text, results);
    text_put(text, ",\n  \"quantities\": {");
    const char *between = "\n    ";
    for (size_t i = 0; i < results->scalar_count; i++) {
        if (!selects_scalar(selection, &results->scalars[i])) continue;
        text_put(text, between);
        show_scalar(text, results, &results->scalars[i]);
        between = ",\n    ";
    }
    text_put(text, "\n  },\n  \"series\": {");
    between = "\n    ";
    for (size_t i = 0; i < results->series_count; i++) {
        if (!selects_series(selection, &results->series[i])) continue;
        text_put(text, between);
        show_series(text, results, &results->series[i]);
        between = ",\n    ";
    }
    text_put(text, "\n  }\n}\n");
}
