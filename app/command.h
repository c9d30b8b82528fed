// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program is a row in commands.def and a file with `const Command command_NAME`.
// Its flags are a table: the same rows parse the command line and give the help, the man page and
// the shell completion.
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Flag {
    char letter;          // 'o', or 0 for none
    const char *name;     // "output"
    const char *argument; // "DIR"; NULL for a switch
    const char *about;    // one sentence
} Flag;

enum { OPERANDS_MOST = 16, FLAGS_MOST = 16, GIVEN_MOST = 64 };

typedef struct Arguments {
    size_t operands;
    const char *operand[OPERANDS_MOST];
    size_t given;
    struct {
        const char *flag; // name
        const char *value;
    } flag[GIVEN_MOST];
} Arguments;

typedef struct Command {
    const char *name;
    const char *operands; // as help shows them: "FILE.yaml", "DIR [QUANTITY]"
    const char *about;    // one sentence
    const Flag *flags;    // ended by a Flag without a name; NULL for none
    size_t least, most;   // operands
    Status (*run)(const Arguments *arguments);
} Command;

bool argument_given(const Arguments *arguments, const char *flag);
const char *argument_value(const Arguments *arguments, const char *flag); // the last; NULL if none

// Becomes: extern const Command command_run, command_check, ...
#define COMMAND(id) extern const Command command_##id;
#include "commands.def"
#undef COMMAND
