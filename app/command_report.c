// SPDX-License-Identifier: GPL-3.0-or-later
// perrin report: (re)writes the page and the figures of a run from its results.
#include "command.h"

#include "report/report.h"
#include "store/store.h"

#include <stdio.h>

static Status write_report(const char *directory, const char *results_path) {
    Results *results = NULL;
    TRY(store_read_results(&results, results_path));
    const Status status = report_write(results, directory);
    results_free(results);
    return status;
}

static Status report(const Arguments *arguments) {
    const char *directory = arguments->operand[0];
    Text path = {0};
    text_add(&path, "%s/results.h5", directory);
    Status status = text_status(&path);
    if (status == OK) status = write_report(directory, text_words(&path));
    text_free(&path);
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
