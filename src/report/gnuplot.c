// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot as a child process: its complaints come back through a pipe.
#include "report/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { EXIT_NO_GNUPLOT = 127, SECONDS_MOST = 120, COMPLAINT_SIZE = 400 };

// In the child, between fork and exec: only calls that are safe there. Does not return.
static void become_gnuplot(const char *folder, char *script, int complaints) {
    char *const arguments[] = {"gnuplot", script, NULL};
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(complaints, STDOUT_FILENO);
    dup2(complaints, STDERR_FILENO);
    alarm(SECONDS_MOST); // outlives exec: a gnuplot that hangs ends
    if (chdir(folder) == 0) execvp(arguments[0], arguments);
    _exit(EXIT_NO_GNUPLOT);
}

// Reads to the end of the pipe; keeps the beginning, on one line.
static void read_complaint(int pipe, char complaint[COMPLAINT_SIZE]) {
    char piece[256];
    size_t kept = 0;
    ssize_t count;
    while ((count = read(pipe, piece, sizeof piece)) != 0) {
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) break;
        for (ssize_t i = 0; i < count && kept < COMPLAINT_SIZE - 1; i++) {
            const bool blank = piece[i] == '\n' || piece[i] == ' ' || piece[i] == '\t';
            if (blank && (kept == 0 || complaint[kept - 1] == ' ')) continue;
            complaint[kept++] = blank ? ' ' : piece[i];
        }
    }
    complaint[kept] = '\0';
}

static Status judge(int ended, const char *script, const char *complaint) {
    if (WIFEXITED(ended) && WEXITSTATUS(ended) == 0) return OK;
    if (WIFEXITED(ended) && WEXITSTATUS(ended) == EXIT_NO_GNUPLOT) {
        return status_fail(IO_FAILED, "gnuplot does not start; install it (Debian: gnuplot-nox)");
    }
    if (WIFSIGNALED(ended)) {
        return status_fail(IO_FAILED, "gnuplot %s was ended by signal %d", script, WTERMSIG(ended));
    }
    return status_fail(IO_FAILED, "gnuplot %s failed: %s", script, complaint);
}

Status gnuplot_run(const char *folder, const char *script) {
    char name[256], complaint[COMPLAINT_SIZE];
    int pipes[2], ended = 0;
    snprintf(name, sizeof name, "./%s", script); // never an option, whatever it is called
    if (pipe(pipes) != 0) return status_fail_errno(IO_FAILED, "cannot make a pipe to gnuplot");
    fcntl(pipes[0], F_SETFD, FD_CLOEXEC);
    const pid_t child = fork();
    if (child == 0) become_gnuplot(folder, name, pipes[1]);
    close(pipes[1]);
    if (child < 0) {
        close(pipes[0]);
        return status_fail_errno(IO_FAILED, "cannot start gnuplot");
    }
    read_complaint(pipes[0], complaint);
    close(pipes[0]);
    while (waitpid(child, &ended, 0) < 0 && errno == EINTR) continue;
    return judge(ended, script, complaint);
}

void gnuplot_quoted(Text *script, const char *words) {
    text_put(script, "'");
    for (const char *c = words; *c; c++) {
        if (*c == '\'') text_put(script, "'"); // doubled
        const bool control = (unsigned char)*c < 0x20;
        text_bytes(script, control ? " " : c, 1);
    }
    text_put(script, "'");
}
