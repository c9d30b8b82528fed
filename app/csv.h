// SPDX-License-Identifier: GPL-3.0-or-later
// Small tables of words as people write them: comma-separated, a header row, quotes where a cell
// has a comma, lines that begin with # are comments.
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct Csv {
    char path[512];
    char *text;
    size_t columns, rows; // the header is not a row
    char **header;        // [columns], into text
    char **cells;         // [rows][columns], into text; "" where a line is short
} Csv;

Status csv_read(Csv **out, const char *path);
void csv_free(Csv *csv);

// The cell of a column, "" if there is no such column.
const char *csv_cell(const Csv *csv, size_t row, const char *column);

// BAD_DATA with path and row unless the cell is a number; an empty one is `fallback`.
Status csv_number(const Csv *csv, size_t row, const char *column, double fallback, double *value);

// The whole file, '\0'-ended, the caller's to memory_free.
Status csv_read_text(const char *path, char **text);
