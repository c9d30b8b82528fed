// SPDX-License-Identifier: GPL-3.0-or-later
// A row per species and direction: alone, at long times, and from when on.
#include "report/tensor.h"

#include "report/html.h"
#include "report/notation.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *direction, *words;
} ROWS[] = {
    {"parallel", "along the body axis"},
    {"perpendicular", "across the body axis"},
    {"along_director", "along the director"},
    {"across_director", "across the director"},
};
static const char *const COLUMNS[] = {"free_diffusion", "long_time_diffusion", "long_time_window"};
enum { ROW_COUNT = sizeof ROWS / sizeof *ROWS, COLUMN_COUNT = sizeof COLUMNS / sizeof *COLUMNS };

static bool begins_with(const char *words, const char *start) {
    return strncmp(words, start, strlen(start)) == 0;
}

bool tensor_has(const ResultScalar *scalar) {
    for (int c = 0; c < COLUMN_COUNT; c++) {
        for (int r = 0; r < ROW_COUNT; r++) {
            char start[2 * RESULT_NAME];
            snprintf(start, sizeof start, "%s_%s", COLUMNS[c], ROWS[r].direction);
            if (begins_with(scalar->quantity, start)) return true;
        }
    }
    return false;
}

static void put_cell(Text *page, const Results *results, const ResultScalar *scalar) {
    text_put(page, "<td class=\"n\">");
    if (scalar) {
        Text words = {0};
        const Estimate estimate = results_scalar_estimate(results, scalar);
        if (estimate.error > 0)
            notation_estimate(&words, estimate);
        else
            text_add(&words, "%.4g", estimate.value); // exact, or the same in all replicas
        html_words(page, text_words(&words));
        text_put(page, " ");
        html_unit(page, scalar->unit);
        text_free(&words);
    }
    text_put(page, "</td>");
}

// `species` NULL for the last label: the only species, or all of them.
static void put_row(Text *page, const Results *results, const char *stage, int row,
                    const char *species) {
    const ResultScalar *cells[COLUMN_COUNT];
    for (int c = 0; c < COLUMN_COUNT; c++) {
        char name[3 * RESULT_NAME];
        snprintf(name, sizeof name, "%s_%s%s%s", COLUMNS[c], ROWS[row].direction,
                 species ? "_" : "", species ? species : "");
        cells[c] = results_find_scalar(results, stage, name);
    }
    if (!cells[1]) return;
    text_put(page, "<tr><td>");
    if (species) html_words(page, species);
    text_add(page, "%s%s</td>", species ? ", " : "", ROWS[row].words);
    for (int c = 0; c < COLUMN_COUNT; c++) put_cell(page, results, cells[c]);
    text_put(page, "<td class=\"a\">");
    if (begins_with(cells[1]->about, "Upper bound")) text_put(page, "upper bound: still falling");
    text_put(page, "</td></tr>\n");
}

static void put_table(Text *page, const Results *results, const ResultSeries *series) {
    text_put(page, "<h3>Diffusion tensor <small>(stage ");
    html_words(page, series->stage);
    text_put(page, ")</small></h3>\n<table>\n<tr><th>Direction</th><th class=\"n\">Alone</th><th "
                   "class=\"n\">Long times</th><th class=\"n\">Fitted from</th><th "
                   "class=\"a\"></th></tr>\n");
    for (size_t l = 0; l < series->axis[0].count; l++) {
        const bool last = l + 1 == series->axis[0].count;
        for (int r = 0; r < ROW_COUNT; r++) {
            put_row(page, results, series->stage, r, last ? NULL : series->axis[0].labels[l]);
        }
    }
    text_put(page, "</table>\n<p class=\"under\">Half the slope of the mean squared displacement "
                   "against t, of one direction, from where it has settled to the last lag. Body "
                   "axis and director are those of the time origin: once the bodies have turned, "
                   "all directions of an isotropic suspension have one coefficient; in a nematic "
                   "those of the director are the tensor.</p>\n");
}

void tensor_table(Text *page, const Results *results) {
    for (size_t i = 0; i < results->series_count; i++) {
        const ResultSeries *series = &results->series[i];
        if (strcmp(series->observable, "directional_displacement") != 0) continue;
        if (series->axes != 3 || !series->axis[0].labels) continue;
        put_table(page, results, series);
    }
}
