// SPDX-License-Identifier: GPL-3.0-or-later
// Which entries of a Results a reader asked for.
#pragma once

#include "results/results.h"

#include <stdbool.h>

enum { FULL_NAME = 2 * RESULT_NAME + 1 };

// A scalar and a series of one name, STAGE/NAME, are selected together.
typedef struct Selection {
    bool all;
    char name[FULL_NAME];
} Selection;

// `quantity` NULL selects everything; else a full name, or an end that only one full name has.
Status select_quantity(Selection *out, const Results *results, const char *quantity);

// Species share what is said about them: has a scalar before it in its stage said the same?
bool selects_said_before(const Results *results, const ResultScalar *scalar);

bool selects_scalar(const Selection *selection, const ResultScalar *scalar);
bool selects_series(const Selection *selection, const ResultSeries *series);
