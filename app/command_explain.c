// SPDX-License-Identifier: GPL-3.0-or-later
// perrin explain [KEY]: what a key, observable, method, shape or unit of the run file means.
#include "command.h"

#include "config/config.h"

static Status explain(const Arguments *arguments) {
    if (argument_given(arguments, "manual")) {
        config_manual(stdout);
        return OK;
    }
    return config_explain(arguments->operands ? arguments->operand[0] : NULL, stdout);
}

static const Flag flags[] = {
    {0, "manual", NULL, "print the reference of the run file, in Markdown"},
    {0},
};

const Command command_explain = {
    .name = "explain",
    .operands = "[KEY]",
    .about = "Say what a key, observable, method, shape or unit means.",
    .flags = flags,
    .most = 1,
    .run = explain,
};
