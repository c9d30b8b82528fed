// SPDX-License-Identifier: GPL-3.0-or-later
// The three ways in which results are printed. Each adds what is selected to the text.
#pragma once

#include "base/text.h"
#include "report/select.h"

void show_table(Text *text, const Results *results, const Selection *selection);
void show_csv(Text *text, const Results *results, const Selection *selection);
void show_json(Text *text, const Results *results, const Selection *selection);

// The index along each axis of an element of a series; the last axis runs fastest.
void show_indices(const ResultSeries *series, size_t element, size_t index[RESULT_AXES]);
