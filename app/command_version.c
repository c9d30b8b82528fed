// SPDX-License-Identifier: GPL-3.0-or-later
// perrin version: what this program is and was built from.
#include "command.h"

#include "base/cpu.h"
#include "base/version.h"

#include <stdio.h>

static Status print_version(const Arguments *arguments) {
    (void)arguments;
    printf("perrin %s (commit %s)\n", version_number(), version_commit());
    printf("compiler: %s\nflags: %s\nvector path: %s\n", version_compiler(), version_flags(),
           cpu_path_name(cpu_path()));
    puts("licence: GPL-3.0-or-later");
    return OK;
}

const Command command_version = {
    .name = "version",
    .operands = "",
    .about = "Say which version this is and how it was built.",
    .run = print_version,
};
