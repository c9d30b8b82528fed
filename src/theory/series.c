// SPDX-License-Identifier: GPL-3.0-or-later
// Labels, axes and numbers of theories of mixtures.
#include "theory/series.h"

#include <stdio.h>

#define STAGE "theory"

static void append(TheoryLabels *labels, const char *first, const char *dash, const char *second) {
    char *text = labels->text[labels->count];
    snprintf(text, sizeof labels->text[0], "%s%s%s", first, dash, second);
    labels->names[labels->count++] = text;
}

void theory_label_pairs(TheoryLabels *labels, const TheorySpecies *species, size_t count) {
    labels->count = 0;
    for (size_t a = 0; a < count; a++) {
        for (size_t b = a; b < count; b++) append(labels, species[a].name, "-", species[b].name);
    }
    append(labels, "total", "", "");
}

void theory_label_species(TheoryLabels *labels, const TheorySpecies *species, size_t count) {
    labels->count = 0;
    for (size_t a = 0; a < count; a++) append(labels, species[a].name, "", "");
}

ResultSeries theory_series(const char *name, const char *unit, const char *about) {
    ResultSeries series = {.stage = STAGE};
    snprintf(series.observable, sizeof series.observable, "%s", name);
    snprintf(series.unit, sizeof series.unit, "%s", unit);
    snprintf(series.about, sizeof series.about, "%s", about);
    return series;
}

void theory_add_labels(ResultSeries *series, const char *axis, size_t count,
                       const char *const *labels) {
    series->axis[series->axes++] =
        (ResultAxis){.name = axis, .unit = "", .count = count, .labels = labels};
}

void theory_add_numbers(ResultSeries *series, const char *axis, const char *unit, size_t count,
                        const double *values) {
    series->axis[series->axes++] =
        (ResultAxis){.name = axis, .unit = unit, .count = count, .values = values};
}

void theory_turn(const double *kept, size_t times, size_t lines, double *out) {
    for (size_t t = 0; t < times; t++) {
        for (size_t i = 0; i < lines; i++) out[i * times + t] = kept[t * lines + i];
    }
}

Status theory_put_number(Results *results, const char *name, const char *unit, const char *about,
                         double value) {
    return results_put_scalar(results, STAGE, name, unit, about, 0, value);
}

Status theory_put_each(Results *results, const TheorySpecies *species, size_t count,
                       const char *name, const char *unit, const char *about,
                       const double *values) {
    for (size_t a = 0; a < count; a++) {
        char full[RESULT_NAME];
        snprintf(full, sizeof full, "%.28s_%s", name, species[a].name);
        TRY(theory_put_number(results, count > 1 ? full : name, unit, about, values[a]));
    }
    return OK;
}
