// SPDX-License-Identifier: GPL-3.0-or-later
// perrin run: does what the run file says, or goes on where it was stopped.
#include "command.h"

#include "runner.h"

#include "base/memory.h"
#include "config/config.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 4096 };

// "dir/glass.yaml" runs in ./glass: the file's stem, in the working directory.
static Status stem(char directory[PATH_SIZE], const char *path) {
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const size_t length = dot && dot != name ? (size_t)(dot - name) : strlen(name);
    if (length == 0 || length >= PATH_SIZE - 8) {
        return status_fail(BAD_USAGE, "'%s' has no stem to name the output by; use -o DIR", path);
    }
    memcpy(directory, name, length);
    // A file without an extension would name a directory like itself.
    strcpy(directory + length, dot && dot != name ? "" : ".out");
    return OK;
}

static Status run_file(const Arguments *arguments) {
    const char *settings[GIVEN_MOST];
    ConfigOverrides overrides = {.settings = settings};
    for (size_t i = 0; i < arguments->given; i++) {
        if (strcmp(arguments->flag[i].flag, "set") != 0) continue;
        settings[overrides.count++] = arguments->flag[i].value;
    }
    char directory[PATH_SIZE];
    SessionWishes wishes = {.directory = argument_value(arguments, "output"),
                            .must_resume = argument_given(arguments, "resume")};
    TRY(runner_threads(argument_value(arguments, "threads"), &wishes.threads));
    if (!wishes.directory) {
        TRY(stem(directory, arguments->operand[0]));
        wishes.directory = directory;
    }
    ConfigPoints *points = NULL;
    TRY(config_read_points(&points, arguments->operand[0], &overrides));
    const Status status = runner_run(points, &wishes, argument_given(arguments, "quiet"));
    config_free_points(points);
    return status;
}

static const Flag flags[] = {
    {'o', "output", "DIR", "write here; the default is the stem of the file's name"},
    {'t', "threads", "N", "run on N threads; the default is one per processor"},
    {'s', "set", "KEY=VALUE", "override a key of the run file; may be given again"},
    {0, "resume", NULL, "refuse to start anew: there must be something to resume"},
    {'q', "quiet", NULL, "no progress and no summary"},
    {0},
};

const Command command_run = {
    .name = "run",
    .operands = "FILE.yaml",
    .about = "Run a run file; a run that was stopped is resumed.",
    .flags = flags,
    .least = 1,
    .most = 1,
    .run = run_file,
};
