// SPDX-License-Identifier: GPL-3.0-or-later
// Runs gnuplot, as a child process without a shell, on a script that lies beside its numbers.
#pragma once

#include "base/status.h"
#include "base/text.h"

// Runs FOLDER/SCRIPT with FOLDER as working directory. A sentence that names gnuplot's complaint,
// or says that there is no gnuplot.
Status gnuplot_run(const char *folder, const char *script);

void gnuplot_quoted(Text *script, const char *words); // 'words', taken literally by gnuplot
