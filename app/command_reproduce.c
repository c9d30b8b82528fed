// SPDX-License-Identifier: GPL-3.0-or-later
// perrin reproduce: lists the gallery, or runs figures of the papers and holds them against what
// is published, exact, or computed independently.
#include "command.h"

#include "gallery.h"
#include "runner.h"

static Status reproduce_entry(const Gallery *gallery, const char *name,
                              const Arguments *arguments) {
    GalleryRun run = {.full = argument_given(arguments, "full")};
    const char *output = argument_value(arguments, "output");
    char folder[GALLERY_PATH];
    size_t missed = 0, count = 0;
    TRY(runner_threads(argument_value(arguments, "threads"), &run.threads));
    TRY(gallery_entry(gallery, name, run.entry));
    snprintf(folder, sizeof folder, "%s%s", name, run.full ? "-full" : "");
    TRY(gallery_path(run.directory, output ? output : "reproduced", folder));
    TRY(gallery_run(&run));
    TRY(gallery_judge(&run, stdout, &missed, &count));
    printf("%s: %zu of %zu expectations met; figure and tables are in %s\n\n", name, count - missed,
           count, run.directory);
    const Status drawn = gallery_draw(&run);
    if (missed == 0) return drawn;
    return status_fail(UNHEALTHY, "%s: %zu of %zu values are not what is expected", name, missed,
                       count);
}

static Status reproduce(const Arguments *arguments) {
    Gallery gallery;
    TRY(gallery_find(&gallery));
    if (arguments->operands == 0) return gallery_list(&gallery, stdout);
    char sentence[STATUS_SENTENCE_SIZE]; // of an entry: those after it may have others
    Status worst = OK;
    for (size_t i = 0; i < arguments->operands; i++) {
        const Status status = reproduce_entry(&gallery, arguments->operand[i], arguments);
        if (status != OK && status != UNHEALTHY) return status;
        if (status == OK) continue;
        worst = status; // a missed expectation does not keep others from theirs
        snprintf(sentence, sizeof sentence, "%s", status_sentence());
    }
    return worst == OK ? OK : status_fail(worst, "%s", sentence);
}

static const Flag flags[] = {
    {'o', "output", "DIR", "write into DIR/NAME; the default DIR is ./reproduced"},
    {'t', "threads", "N", "run on N threads; the default is one per processor"},
    {0, "full", NULL, "with the statistics of the papers: hours"},
    {0},
};

const Command command_reproduce = {
    .name = "reproduce",
    .operands = "[NAME...]",
    .about = "List the gallery, or run figures of the papers and judge them.",
    .flags = flags,
    .least = 0,
    .most = OPERANDS_MOST,
    .run = reproduce,
};
