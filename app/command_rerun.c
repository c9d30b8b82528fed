// SPDX-License-Identifier: GPL-3.0-or-later
// perrin rerun: repeats a run from the plan that its own results carry.
#include "command.h"

#include "runner.h"

#include "base/memory.h"
#include "config/config.h"
#include "store/store.h"

#include <stdio.h>
#include <string.h>

static Status run_again(const Arguments *arguments, const Results *results) {
    const char *text = results_find_fact(results, "plan");
    if (!text) {
        return status_fail(BAD_DATA, "%s does not say what was run", arguments->operand[0]);
    }
    SessionWishes wishes = {.directory = argument_value(arguments, "output")};
    if (!wishes.directory) wishes.directory = "rerun";
    TRY(runner_threads(argument_value(arguments, "threads"), &wishes.threads));
    ConfigPoints *points = NULL;
    TRY(config_read_points_text(&points, arguments->operand[0], text, strlen(text)));
    const Status status = runner_run(points, &wishes, argument_given(arguments, "quiet"));
    config_free_points(points);
    return status;
}

static Status rerun(const Arguments *arguments) {
    Results *results = NULL;
    TRY(store_read_results(&results, arguments->operand[0]));
    const Status status = run_again(arguments, results);
    results_free(results);
    return status;
}

static const Flag flags[] = {
    {'o', "output", "DIR", "write here; the default is ./rerun"},
    {'t', "threads", "N", "run on N threads; the default is one per processor"},
    {'q', "quiet", NULL, "no progress and no summary"},
    {0},
};

const Command command_rerun = {
    .name = "rerun",
    .operands = "results.h5",
    .about = "Repeat a run from its own output.",
    .flags = flags,
    .least = 1,
    .most = 1,
    .run = rerun,
};
