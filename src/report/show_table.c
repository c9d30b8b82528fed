// SPDX-License-Identifier: GPL-3.0-or-later
// The results as columns for people: values with their errors in brackets, then the series by
// name; a single series point by point.
#include "report/show.h"

#include "report/flow_table.h"
#include "report/notation.h"

#include <string.h>

enum { COLUMN_MOST = RESULT_AXES + FLOW_COLUMNS };

// Cells in rows of `columns`, each column as wide as its widest cell.
typedef struct Table {
    size_t columns, cells;
    Text text;    // the cells, each ending in '\n'
    size_t begin; // of the cell being written
    size_t width[COLUMN_MOST];
} Table;

static void cell_ends(Table *table) {
    const size_t column = table->cells++ % table->columns;
    const size_t width = table->text.length - table->begin;
    if (width > table->width[column]) table->width[column] = width;
    text_put(&table->text, "\n");
    table->begin = table->text.length;
}

static void cell(Table *table, const char *words) {
    text_put(&table->text, words);
    cell_ends(table);
}

// Adds the table to `text` and empties it.
static void table_ends(Text *text, Table *table) {
    static const int GAP = 2;
    const char *words = text_words(&table->text);
    for (size_t i = 0; i < table->cells; i++) {
        const int length = (int)strcspn(words, "\n");
        const bool last = (i + 1) % table->columns == 0;
        const int width = last ? length : (int)table->width[i % table->columns] + GAP;
        text_add(text, "%-*.*s", width, length, words);
        if (last) text_put(text, "\n");
        words += length + 1;
    }
    if (table->text.status != OK) text->status = table->text.status;
    text_free(&table->text);
}

static void scalar_row(Table *table, const Results *results, const ResultScalar *scalar,
                       bool among_all) {
    const Estimate estimate = results_scalar_estimate(results, scalar);
    text_add(&table->text, "%s/%s", scalar->stage, scalar->quantity);
    cell_ends(table);
    notation_estimate(&table->text, estimate);
    cell_ends(table);
    cell(table, scalar->unit);
    text_add(&table->text, "%zu", estimate.n);
    cell_ends(table);
    cell(table, among_all && selects_said_before(results, scalar) ? "" : scalar->about);
}

static void table_of_scalars(Text *text, const Results *results, const Selection *selection) {
    static const char *const HEADER[] = {"quantity", "value", "unit", "n", "about"};
    Table table = {.columns = 5};
    for (size_t i = 0; i < table.columns; i++) cell(&table, HEADER[i]);
    size_t rows = 0;
    for (size_t i = 0; i < results->scalar_count; i++) {
        if (!selects_scalar(selection, &results->scalars[i])) continue;
        scalar_row(&table, results, &results->scalars[i], selection->all);
        rows++;
    }
    if (rows > 0)
        table_ends(text, &table);
    else
        text_free(&table.text);
}

static void series_row(Table *table, const ResultSeries *series) {
    text_add(&table->text, "%s/%s", series->stage, series->observable);
    cell_ends(table);
    for (size_t i = 0; i < series->axes; i++) {
        const ResultAxis *axis = &series->axis[i];
        text_add(&table->text, "%s%s (%zu)", i ? " x " : "", axis->name, axis->count);
    }
    cell_ends(table);
    cell(table, series->unit);
    cell(table, series->about);
}

static void table_of_names(Text *text, const Results *results) {
    static const char *const HEADER[] = {"series", "axes", "unit", "about"};
    Table table = {.columns = 4};
    for (size_t i = 0; i < table.columns; i++) cell(&table, HEADER[i]);
    for (size_t i = 0; i < results->series_count; i++) series_row(&table, &results->series[i]);
    if (results->series_count > 0)
        table_ends(text, &table);
    else
        text_free(&table.text);
}

static void name_with_unit(Table *table, const char *name, const char *unit) {
    text_add(&table->text, unit[0] ? "%s [%s]" : "%s", name, unit);
    cell_ends(table);
}

static void place_of_point(Table *table, const ResultSeries *series, size_t element) {
    size_t index[RESULT_AXES];
    show_indices(series, element, index);
    for (size_t i = 0; i < series->axes; i++) {
        const ResultAxis *axis = &series->axis[i];
        if (axis->labels)
            text_put(&table->text, axis->labels[index[i]]);
        else
            text_add(&table->text, "%.6g", axis->values[index[i]]);
        cell_ends(table);
    }
}

static void names_of_axes(Table *table, const ResultSeries *series) {
    for (size_t i = 0; i < series->axes; i++)
        name_with_unit(table, series->axis[i].name, series->axis[i].unit);
}

static void series_point(Table *table, const Results *results, const ResultSeries *series,
                         size_t element) {
    place_of_point(table, series, element);
    const Estimate estimate = results_series_estimate(results, series, element);
    notation_estimate(&table->text, estimate);
    cell_ends(table);
    text_add(&table->text, "%zu", estimate.n);
    cell_ends(table);
}

static void table_of_points(Text *text, const Results *results, const ResultSeries *series) {
    text_add(text, "%s/%s: %s\n", series->stage, series->observable, series->about);
    Table table = {.columns = series->axes + 2};
    names_of_axes(&table, series);
    name_with_unit(&table, "value", series->unit);
    cell(&table, "n");
    for (size_t i = 0; i < series->size; i++) series_point(&table, results, series, i);
    table_ends(text, &table);
}

static void table_of_flow(Text *text, const Results *results, const FlowTable *flow) {
    const ResultSeries *first = flow->column[0];
    text_add(text, "\n%s, flow curves\n", first->stage);
    Table table = {.columns = first->axes + flow->columns};
    names_of_axes(&table, first);
    for (size_t c = 0; c < flow->columns; c++)
        name_with_unit(&table, flow->column[c]->observable, flow->column[c]->unit);
    for (size_t point = 0; point < first->size; point++) {
        place_of_point(&table, first, point);
        for (size_t c = 0; c < flow->columns; c++) {
            notation_estimate(&table.text,
                              results_series_estimate(results, flow->column[c], point));
            cell_ends(&table);
        }
    }
    table_ends(text, &table);
}

static void tables_of_flow(Text *text, const Results *results) {
    for (size_t i = 0; i < results->series_count; i++) {
        FlowTable flow;
        if (flow_table_of(&flow, results, &results->series[i])) table_of_flow(text, results, &flow);
    }
}

// What analysis_judge said.
static void lines_of_equilibrium(Text *text, const Results *results) {
    static const char EQUILIBRIUM[] = "equilibrium of ";
    bool first = true;
    for (size_t i = 0; i < results->fact_count; i++) {
        const ResultFact *fact = &results->facts[i];
        if (strncmp(fact->name, EQUILIBRIUM, strlen(EQUILIBRIUM)) != 0) continue;
        text_add(text, "%s%s: %s\n", first ? "\n" : "", fact->name, fact->text);
        first = false;
    }
}

static void line_of_left_out(Text *text, const Results *results) {
    const char *list = results_find_fact(results, RESULTS_NOT_SIDE_BY_SIDE);
    if (!list) return;
    text_add(text,
             "\n%s, for their axes are too many or differ (each point's folder has its own): "
             "%s\n",
             RESULTS_NOT_SIDE_BY_SIDE, list);
}

void show_table(Text *text, const Results *results, const Selection *selection) {
    table_of_scalars(text, results, selection);
    if (selection->all) {
        if (results->scalar_count && results->series_count) text_put(text, "\n");
        table_of_names(text, results);
        tables_of_flow(text, results);
        lines_of_equilibrium(text, results);
        line_of_left_out(text, results);
        return;
    }
    for (size_t i = 0; i < results->series_count; i++) {
        if (!selects_series(selection, &results->series[i])) continue;
        if (text->length > 0) text_put(text, "\n");
        table_of_points(text, results, &results->series[i]);
    }
}
