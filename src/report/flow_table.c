// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of the table of flow curves, and the table on the page.
#include "report/flow_table.h"

#include "report/html.h"
#include "report/notation.h"
#include "report/show.h"

#include <string.h>

static bool is_over_points(const ResultSeries *series) {
    for (size_t i = 0; i < series->axes; i++) {
        if (!series->axis[i].values) return false;
    }
    return series->axes > 0;
}

bool flow_table_of(FlowTable *table, const Results *results, const ResultSeries *viscosity) {
    static const struct {
        const char *name, *symbol;
    } COLUMNS[FLOW_COLUMNS] = {{"shear_stress", "σ"},
                               {"shear_viscosity", "η"},
                               {"normal_stress_difference", "σₓₓ − σ_yy"},
                               {"second_normal_stress_difference", "σ_yy − σ_zz"},
                               {"mean_pressure", "P"}};
    *table = (FlowTable){0};
    if (strcmp(viscosity->observable, "shear_viscosity") != 0 || !is_over_points(viscosity))
        return false;
    for (size_t i = 0; i < FLOW_COLUMNS; i++) {
        const ResultSeries *column =
            results_find_series(results, viscosity->stage, COLUMNS[i].name);
        if (!column || column->size != viscosity->size) continue;
        table->symbol[table->columns] = COLUMNS[i].symbol;
        table->column[table->columns++] = column;
    }
    return true;
}

static void put_unit(Text *page, const char *unit) {
    if (unit[0]) {
        text_put(page, " [");
        html_unit(page, unit);
        text_put(page, "]");
    }
    text_put(page, "</th>");
}

static void put_head(Text *page, const FlowTable *table) {
    const ResultSeries *first = table->column[0];
    text_put(page, "<h3>Flow curves <small>(stage ");
    html_words(page, first->stage);
    text_put(page, ")</small></h3>\n<table>\n<tr>");
    for (size_t i = 0; i < first->axes; i++) {
        text_put(page, "<th class=\"n\">");
        html_name(page, first->axis[i].name);
        put_unit(page, first->axis[i].unit);
    }
    for (size_t i = 0; i < table->columns; i++) {
        text_put(page, "<th class=\"n\">");
        html_words(page, table->symbol[i]);
        put_unit(page, table->column[i]->unit);
    }
    text_put(page, "</tr>\n");
}

static void put_row(Text *page, const Results *results, const FlowTable *table, size_t point) {
    size_t index[RESULT_AXES];
    show_indices(table->column[0], point, index);
    text_put(page, "<tr>");
    for (size_t i = 0; i < table->column[0]->axes; i++)
        text_add(page, "<td class=\"n\">%.6g</td>", table->column[0]->axis[i].values[index[i]]);
    for (size_t i = 0; i < table->columns; i++) {
        Text words = {0};
        notation_estimate(&words, results_series_estimate(results, table->column[i], point));
        text_put(page, "<td class=\"n\">");
        html_words(page, text_words(&words));
        text_put(page, "</td>");
        text_free(&words);
    }
    text_put(page, "</tr>\n");
}

static void put_table(Text *page, const Results *results, const FlowTable *table) {
    put_head(page, table);
    for (size_t point = 0; point < table->column[0]->size; point++)
        put_row(page, results, table, point);
    text_add(page,
             "</table>\n<p class=\"under\">Shear stress, viscosity, normal stress differences and "
             "mean pressure. In brackets the standard error over %zu replicas, in "
             "units of the last digits.</p>\n",
             results->replicas);
}

void flow_table_put(Text *page, const Results *results) {
    for (size_t i = 0; i < results->series_count; i++) {
        FlowTable table;
        if (flow_table_of(&table, results, &results->series[i])) put_table(page, results, &table);
    }
}
