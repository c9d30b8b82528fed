// SPDX-License-Identifier: GPL-3.0-or-later
// perrin show: the results of a run as a table, as JSON or as CSV, on standard output.
#include "command.h"
#include "stored.h"

#include "report/report.h"

#include <stdio.h>

static const Flag flags[] = {
    {.name = "json", .about = "one JSON object: run, quantities, series"},
    {.name = "csv", .about = "comma-separated values: all quantities, or the points of one series"},
    {.name = NULL},
};

static Status choose_format(ShowFormat *format, const Arguments *arguments) {
    const bool json = argument_given(arguments, "json"), csv = argument_given(arguments, "csv");
    if (json && csv) return status_fail(BAD_USAGE, "--json and --csv exclude each other");
    *format = json ? SHOW_JSON : csv ? SHOW_CSV : SHOW_TABLE;
    return OK;
}

static Status print_results(const Results *results, ShowFormat format, const char *quantity) {
    Text text = {0};
    const Status status = report_show(&text, results, format, quantity);
    if (status == OK) fputs(text_words(&text), stdout);
    text_free(&text);
    return status;
}

static Status show(const Arguments *arguments) {
    ShowFormat format = SHOW_TABLE;
    TRY(choose_format(&format, arguments));
    Results *results = NULL;
    TRY(stored_results(&results, arguments->operand[0]));
    const char *quantity = arguments->operands > 1 ? arguments->operand[1] : NULL;
    const Status status = print_results(results, format, quantity);
    results_free(results);
    return status;
}

const Command command_show = {
    .name = "show",
    .operands = "DIR [QUANTITY]",
    .about = "Print the results: all quantities, or the one quantity or series of that name.",
    .flags = flags,
    .least = 1,
    .most = 2,
    .run = show,
};
