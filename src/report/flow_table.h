// SPDX-License-Identifier: GPL-3.0-or-later
// The flow curves of a sweep as one table: a row per point, what a rheometer tells beside each
// other. Inside report/ only.
#pragma once

#include "base/text.h"
#include "results/results.h"

#include <stdbool.h>

enum { FLOW_COLUMNS = 5 };

typedef struct FlowTable {
    size_t columns;
    const ResultSeries *column[FLOW_COLUMNS]; // all of the same points
    const char *symbol[FLOW_COLUMNS];
} FlowTable;

// False unless this is the viscosity over the points of a sweep; then its stage's columns.
bool flow_table_of(FlowTable *table, const Results *results, const ResultSeries *viscosity);

void flow_table_put(Text *page, const Results *results); // nothing of other runs
