// SPDX-License-Identifier: GPL-3.0-or-later
// The program: finds the command, reads its flags by its table, runs it, tells what went wrong.
#include "command.h"

#include "manual.h"

#include "base/nearest.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Becomes: &command_run, &command_check, ..., NULL
static const Command *const commands[] = {
#define COMMAND(id) &command_##id,
#include "commands.def"
#undef COMMAND
    NULL,
};

static const Command *command_named(const char *name) {
    for (size_t i = 0; commands[i]; i++) {
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    }
    return NULL;
}

static void print_summary(FILE *out) {
    fputs("Perrin: Brownian dynamics of hard colloids in real physical time.\n\nusage:\n", out);
    for (size_t i = 0; commands[i]; i++) {
        char call[64];
        snprintf(call, sizeof call, "%s %s", commands[i]->name, commands[i]->operands);
        fprintf(out, "  perrin %-24s %s\n", call, commands[i]->about);
    }
    fputs("\n'perrin COMMAND --help' lists the flags of a command.\n", out);
}

static size_t flag_count(const Command *command) {
    size_t count = 0;
    while (command->flags && command->flags[count].name) count++;
    return count;
}

static void print_help(const Command *command, FILE *out) {
    fprintf(out, "usage: perrin %s%s%s%s\n\n%s\n", command->name,
            flag_count(command) ? " [FLAGS]" : "", command->operands[0] ? " " : "",
            command->operands, command->about);
    for (size_t i = 0; i < flag_count(command); i++) {
        const Flag *flag = &command->flags[i];
        char name[64];
        snprintf(name, sizeof name, "--%s%s%s", flag->name, flag->argument ? " " : "",
                 flag->argument ? flag->argument : "");
        if (i == 0) fputs("\n", out);
        if (flag->letter)
            fprintf(out, "  -%c, %-24s %s\n", flag->letter, name, flag->about);
        else
            fprintf(out, "      %-24s %s\n", name, flag->about);
    }
}

bool argument_given(const Arguments *arguments, const char *flag) {
    for (size_t i = 0; i < arguments->given; i++) {
        if (strcmp(arguments->flag[i].flag, flag) == 0) return true;
    }
    return false;
}

const char *argument_value(const Arguments *arguments, const char *flag) {
    const char *value = NULL;
    for (size_t i = 0; i < arguments->given; i++) {
        if (strcmp(arguments->flag[i].flag, flag) == 0) value = arguments->flag[i].value;
    }
    return value;
}

// getopt's tables from ours; the value of a long option is FLAG_BASE + its row.
enum { FLAG_BASE = 1000, FLAG_HELP = 2000 };

static void fill_getopt(const Command *command, struct option *longs, char *shorts) {
    *shorts++ = ':';
    size_t i = 0;
    for (; i < flag_count(command); i++) {
        const Flag *flag = &command->flags[i];
        longs[i] = (struct option){flag->name, flag->argument ? required_argument : no_argument,
                                   NULL, FLAG_BASE + (int)i};
        if (flag->letter) *shorts++ = flag->letter;
        if (flag->letter && flag->argument) *shorts++ = ':';
    }
    longs[i++] = (struct option){"help", no_argument, NULL, FLAG_HELP};
    longs[i] = (struct option){0};
    strcpy(shorts, "h");
}

static const Flag *flag_found(const Command *command, int code) {
    if (code >= FLAG_BASE) return &command->flags[code - FLAG_BASE];
    for (size_t i = 0; i < flag_count(command); i++) {
        if (command->flags[i].letter == code) return &command->flags[i];
    }
    return NULL;
}

static Status keep_flag(Arguments *arguments, const Flag *flag, const char *value) {
    if (arguments->given == GIVEN_MOST) {
        return status_fail(BAD_USAGE, "more than %d flags", GIVEN_MOST);
    }
    arguments->flag[arguments->given].flag = flag->name;
    arguments->flag[arguments->given++].value = value;
    return OK;
}

static Status keep_operands(const Command *command, Arguments *arguments, int argc, char **argv) {
    for (int i = optind; i < argc; i++) {
        if (arguments->operands == command->most) {
            return status_fail(BAD_USAGE, "'%s' is one argument too many; usage: perrin %s %s",
                               argv[i], command->name, command->operands);
        }
        arguments->operand[arguments->operands++] = argv[i];
    }
    if (arguments->operands >= command->least) return OK;
    return status_fail(BAD_USAGE, "perrin %s wants more; usage: perrin %s %s", command->name,
                       command->name, command->operands);
}

static Status unknown_flag(const Command *command, const char *flag) {
    return status_fail(BAD_USAGE, "perrin %s does not know the flag '%s'; try 'perrin %s --help'",
                       command->name, flag, command->name);
}

static Status read_arguments(const Command *command, Arguments *arguments, bool *help, int argc,
                             char **argv) {
    struct option longs[FLAGS_MOST + 2];
    char shorts[2 * FLAGS_MOST + 3];
    fill_getopt(command, longs, shorts);
    int code;
    while ((code = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
        if (code == FLAG_HELP || code == 'h')
            *help = true;
        else if (code == '?')
            return unknown_flag(command, argv[optind - 1]);
        else if (code == ':') {
            return status_fail(BAD_USAGE, "the flag '%s' wants a value", argv[optind - 1]);
        } else
            TRY(keep_flag(arguments, flag_found(command, code), optarg));
    }
    return *help ? OK : keep_operands(command, arguments, argc, argv);
}

static Status run_command(const Command *command, int argc, char **argv) {
    Arguments arguments = {.operands = 0};
    bool help = false;
    TRY(read_arguments(command, &arguments, &help, argc, argv));
    if (help)
        print_help(command, stdout);
    else
        TRY(command->run(&arguments));
    // A result that did not reach the reader is a failure: a full disk behind a pipe or a '>'.
    if (fflush(stdout) != 0 || ferror(stdout)) {
        return status_fail_errno(IO_FAILED, "cannot write to standard output");
    }
    return OK;
}

static Status unknown_command(const char *name) {
    const char *names[sizeof commands / sizeof *commands];
    size_t count = 0;
    for (; commands[count]; count++) names[count] = commands[count]->name;
    const size_t nearest = nearest_word(name, names, count);
    if (nearest < count) {
        return status_fail(BAD_USAGE, "there is no command '%s'; did you mean '%s'?", name,
                           names[nearest]);
    }
    return status_fail(BAD_USAGE, "there is no command '%s'; try 'perrin help'", name);
}

static Status run_program(int argc, char **argv) {
    if (argc < 2) {
        print_summary(stderr);
        return status_fail(BAD_USAGE, "which command?");
    }
    const char *name = argv[1];
    if (strcmp(name, "help") == 0 || strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        const bool manual = argc > 2 && strcmp(argv[2], "--man") == 0;
        manual ? manual_write(stdout) : print_summary(stdout);
        return OK;
    }
    if (strcmp(name, "--version") == 0) name = "version";
    const Command *command = command_named(name);
    if (!command) return unknown_command(name);
    return run_command(command, argc - 1, argv + 1);
}

// Sentences about a place in a run file begin with it, as compilers' do; others with our name.
static void tell(const char *sentence) {
    const bool located = strstr(sentence, ": error: ") != NULL;
    const bool colour = isatty(STDERR_FILENO) && !getenv("NO_COLOR");
    if (located)
        fprintf(stderr, "%s\n", sentence);
    else
        fprintf(stderr, "perrin: %serror:%s %s\n", colour ? "\033[31m" : "",
                colour ? "\033[0m" : "", sentence);
}

int main(int argc, char **argv) {
    const Status status = run_program(argc, argv);
    if (status != OK) tell(status_sentence());
    return (int)status;
}
