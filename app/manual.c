// SPDX-License-Identifier: GPL-3.0-or-later
// The man page, in the man macros of troff.
#include "manual.h"

#include "command.h"

#include "base/version.h"

// Becomes: &command_run, &command_check, ..., NULL
static const Command *const commands[] = {
#define COMMAND(id) &command_##id,
#include "commands.def"
#undef COMMAND
    NULL,
};

// A '-' is a hyphen to troff; what is typed needs "\-". A line must not begin with '.' or '\''.
static void put_typed(const char *text, FILE *out) {
    for (; *text; text++) {
        if (*text == '-' || *text == '\\') fputc('\\', out);
        fputc(*text, out);
    }
}

static void put_flag(const Flag *flag, FILE *out) {
    fputs(".TP\n\\fB", out);
    if (flag->letter) fprintf(out, "\\-%c\\fR, \\fB", flag->letter);
    fputs("\\-\\-", out);
    put_typed(flag->name, out);
    fprintf(out, "\\fR%s%s\n", flag->argument ? " " : "", flag->argument ? flag->argument : "");
    put_typed(flag->about, out);
    fputc('\n', out);
}

static void put_command(const Command *command, FILE *out) {
    fprintf(out, ".SS perrin %s %s\n", command->name, command->operands);
    put_typed(command->about, out);
    fputc('\n', out);
    for (const Flag *flag = command->flags; flag && flag->name; flag++) put_flag(flag, out);
}

static void put_synopsis(FILE *out) {
    fputs(".SH SYNOPSIS\n", out);
    for (size_t i = 0; commands[i]; i++) {
        fprintf(out, "%s.B perrin %s\n", i ? ".br\n" : "", commands[i]->name);
        fprintf(out, "%s%s\n", commands[i]->flags ? "[FLAGS] " : "", commands[i]->operands);
    }
}

static void put_ending(FILE *out) {
    static const struct {
        int code;
        const char *meaning;
    } codes[] = {
        {0, "Done."},
        {BAD_USAGE, "The command line makes no sense."},
        {BAD_DATA, "A run file or a stored file cannot be used."},
        {UNHEALTHY, "A health limit is broken; the files say which."},
        {NO_MEMORY, "Not enough memory."},
        {LOCKED, "Another process has the directory, or it holds another plan."},
        {IO_FAILED, "Disk or file system."},
        {INTERRUPTED, "Stopped after a checkpoint; the same command resumes."},
    };
    fputs(".SH EXIT STATUS\n", out);
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        fprintf(out, ".TP\n.B %d\n%s\n", codes[i].code, codes[i].meaning);
    }
    fputs(
        ".SH SIGNALS\n"
        "The first SIGINT, SIGTERM or SIGUSR1 makes a run write a checkpoint and stop; a second\n"
        "SIGINT ends it at once. SIGUSR2 makes it write a checkpoint and go on.\n"
        ".SH ENVIRONMENT\n"
        ".TP\n.B NO_COLOR\nNo colour, even on a terminal.\n"
        ".TP\n.B PERRIN_CPU\nportable, avx2 or avx512: lowers the choice of instruction set; the\n"
        "results are the same.\n"
        ".SH SEE ALSO\n.BR gnuplot (1)\n",
        out);
}

void manual_write(FILE *out) {
    fprintf(out, ".TH PERRIN 1 \"\" \"perrin %s\" \"User commands\"\n", version_number());
    fputs(".SH NAME\nperrin \\- Brownian dynamics of hard colloids in real physical time\n", out);
    put_synopsis(out);
    fputs(
        ".SH DESCRIPTION\n"
        "Runs what a run file describes: packs hard discs or spheres, lets them move by Brownian\n"
        "or Newtonian dynamics, measures, averages over replicas, and writes numbers, HDF5 files\n"
        "and a page of figures. Results go to standard output, talk to standard error.\n"
        ".SH COMMANDS\n",
        out);
    for (size_t i = 0; commands[i]; i++) put_command(commands[i], out);
    put_ending(out);
}
