// SPDX-License-Identifier: GPL-3.0-or-later
// What people and machines read of a run: the table of `perrin show`, and the page with figures.
// Everything comes from a Results; nothing here computes physics.
#pragma once

#include "base/text.h"
#include "results/results.h"

typedef enum ShowFormat { SHOW_TABLE, SHOW_JSON, SHOW_CSV } ShowFormat;

// The results as text. `quantity` is a full name, STAGE/NAME, or an end that only one name has, or
// NULL for everything. BAD_USAGE with the nearest names if there is none such, or several.
Status report_show(Text *text, const Results *results, ShowFormat format, const char *quantity);

// Writes DIRECTORY/report.html, one page that needs no other file, and DIRECTORY/figures with the
// gnuplot script, the numbers (CSV) and the picture (SVG) of each figure. Without gnuplot the page
// is written all the same and says what is missing.
Status report_write(const Results *results, const char *directory);
