// SPDX-License-Identifier: GPL-3.0-or-later
// perrin report: (re)writes the page and the figures of a run from its results.
#include "command.h"
#include "stored.h"

#include "report/report.h"

#include <stdio.h>

static Status report(const Arguments *arguments) {
    const char *directory = arguments->operand[0];
    Results *results = NULL;
    TRY(stored_results(&results, directory));
    const Status status = report_write(results, directory);
    results_free(results);
    if (status == OK) printf("%s/report.html\n", directory);
    return status;
}

const Command command_report = {
    .name = "report",
    .operands = "DIR",
    .about = "Write DIR/report.html and DIR/figures again from DIR/results.h5.",
    .least = 1,
    .most = 1,
    .run = report,
};
