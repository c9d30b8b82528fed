// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the results of a run for the commands that show them.
#include "stored.h"

#include "base/text.h"
#include "store/store.h"

#include <sys/stat.h>
#include <unistd.h>

static bool is_there(const char *directory, const char *name) {
    Text path = {0};
    text_add(&path, "%s/%s", directory, name);
    const bool there = text_status(&path) == OK && access(text_words(&path), F_OK) == 0;
    text_free(&path);
    return there;
}

static bool is_file(const char *path) {
    struct stat about;
    return stat(path, &about) == 0 && S_ISREG(about.st_mode);
}

Status stored_results(Results **out, const char *directory) {
    if (is_file(directory)) return store_read_results(out, directory);
    if (is_there(directory, "plan.yaml") && !is_there(directory, "results.h5"))
        return status_fail(BAD_DATA,
                           "the run in '%s' has not ended, and results come at its end; if it was "
                           "stopped, the same 'perrin run' goes on with it",
                           directory);
    Text path = {0};
    text_add(&path, "%s/results.h5", directory);
    Status status = text_status(&path);
    if (status == OK) status = store_read_results(out, text_words(&path));
    text_free(&path);
    return status;
}
