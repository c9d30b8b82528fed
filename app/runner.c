// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a run file in a directory: progress line, signals, summary. Talk goes to standard error.
#include "runner.h"

#include "signals.h"

#include "base/text.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

static const double TERMINAL_SECONDS = 0.2; // between progress lines
static const double PIPE_SECONDS = 10;

static void put_time(Text *line, double seconds) {
    if (!isfinite(seconds))
        text_put(line, "-");
    else if (seconds < 100)
        text_add(line, "%.0f s", seconds);
    else if (seconds < 6000)
        text_add(line, "%.0f min", seconds / 60);
    else
        text_add(line, "%.1f h", seconds / 3600);
}

static void put_progress(Text *line, const EnsembleProgress *progress) {
    text_add(line, "%3.0f %%  ", 100 * progress->fraction);
    put_time(line, progress->seconds_left);
    text_add(line, " left  %zu of %zu done  %s", progress->finished, progress->replicas,
             progress->stage);
    if (progress->stage_unit)
        text_add(line, " t = %.3g %s", progress->stage_time, progress->stage_unit);
    if (progress->rate > 0) text_add(line, "  %.3g particle steps/s", progress->rate);
}

// A line that a terminal breaks could not be written over by the next: what has no room is cut.
static void print_progress(const EnsembleProgress *progress, bool terminal) {
    struct winsize window = {.ws_col = 0};
    const bool known = terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0;
    const int room = !terminal ? INT_MAX : known && window.ws_col > 0 ? window.ws_col - 1 : 79;
    Text line = {0};
    put_progress(&line, progress);
    fprintf(stderr, terminal ? "\r%.*s\033[K" : "%.*s\n", room, text_words(&line));
    text_free(&line);
}

static void wait_a_little(void) {
    const struct timespec pause = {.tv_nsec = 20000000};
    nanosleep(&pause, NULL); // a signal ends it early, which is welcome
}

static void watch(Campaign *campaign, bool quiet) {
    const bool terminal = isatty(STDERR_FILENO);
    const double period = terminal ? TERMINAL_SECONDS : PIPE_SECONDS;
    double last = 0;
    bool stopping = false;
    while (campaign_tend(campaign)) {
        wait_a_little();
        if (signals_want_stop() && !stopping) {
            stopping = true;
            campaign_stop(campaign);
        }
        if (signals_want_checkpoint()) campaign_request_checkpoint(campaign);
        const EnsembleProgress progress = campaign_progress(campaign);
        if (quiet || progress.seconds - last < period) continue;
        last = progress.seconds;
        print_progress(&progress, terminal);
    }
    if (terminal && !quiet) fputs("\r\033[K", stderr);
}

static void print_end(const Results *results, const char *directory) {
    const char *speed = results_find_fact(results, "ns_per_particle_tick");
    const char *seconds = results_find_fact(results, "wall_seconds");
    fprintf(stderr, "done in %s s", seconds);
    fprintf(stderr, speed ? " (%s ns per particle step)\n" : "\n", speed);
    for (size_t i = 0; i < results->health_count; i++) {
        const ResultCounter *counter = &results->health[i];
        if (isnan(counter->limit)) continue;
        fprintf(stderr, "health: %s = %g (limit %g)%s\n", counter->name, counter->value,
                counter->limit, result_healthy(counter) ? "" : "  BROKEN");
    }
    fprintf(stderr, "numbers: perrin show %s\nreport:  %s/report.html\n", directory, directory);
}

// Quiet is not silent.
static void print_anew(size_t runs) {
    if (runs == 0) return;
    fprintf(stderr,
            "the structure that is read has changed: %zu run%s calculated anew; earlier results "
            "are kept as results-of-*.h5\n",
            runs, runs == 1 ? " is" : "s are");
}

static Status watch_and_finish(Campaign *campaign, const SessionWishes *wishes, bool quiet) {
    if (campaign_resumes(campaign) && !quiet) {
        fprintf(stderr, "resuming in %s\n", wishes->directory);
    }
    watch(campaign, quiet);
    Results *results = NULL;
    const char *note = NULL;
    print_anew(campaign_anew(campaign));
    const Status status = campaign_finish(campaign, &results, &note);
    if (status == INTERRUPTED) {
        char what[STATUS_SENTENCE_SIZE];
        snprintf(what, sizeof what, "%s", status_sentence());
        return status_fail(INTERRUPTED, "interrupted%s%s; the same command resumes in %s",
                           what[0] ? ": " : "", what, wishes->directory);
    }
    if (results && !quiet) print_end(results, wishes->directory);
    if (note) fprintf(stderr, "no complete report: %s\n", note); // quiet is not silent
    results_free(results);
    return status;
}

Status runner_run(const ConfigPoints *points, const SessionWishes *wishes, bool quiet) {
    Campaign *campaign = NULL;
    signals_catch();
    TRY(campaign_open(&campaign, points, wishes));
    const Status status = watch_and_finish(campaign, wishes, quiet);
    campaign_close(campaign);
    return status;
}

Status runner_threads(const char *text, int *threads) {
    *threads = 0;
    if (!text) return OK;
    char *end = NULL;
    const long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || value < 1 || value > 4096) {
        return status_fail(BAD_USAGE, "--threads %s: a whole number from 1 to 4096 is wanted",
                           text);
    }
    *threads = (int)value;
    return OK;
}
