// SPDX-License-Identifier: GPL-3.0-or-later
// Text files, whole or not at all.
#include "report/files.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static Status cannot_write(const char *path) {
    return status_fail_errno(IO_FAILED, "cannot write %s", path);
}

static Status write_new(const char *path, const char *words) {
    FILE *file = fopen(path, "w");
    if (!file) return cannot_write(path);
    const bool written = fputs(words, file) >= 0 && fflush(file) == 0 && fsync(fileno(file)) == 0;
    const Status status = written ? OK : cannot_write(path);
    if (fclose(file) != 0 && status == OK) return cannot_write(path);
    return status;
}

Status file_replace(const char *path, const char *words) {
    Text temporary = {0};
    text_add(&temporary, "%s.new", path);
    Status status = text_status(&temporary);
    if (status == OK) status = write_new(text_words(&temporary), words);
    if (status == OK && rename(text_words(&temporary), path) != 0) status = cannot_write(path);
    if (status != OK) unlink(text_words(&temporary));
    text_free(&temporary);
    return status;
}

Status file_read(Text *words, const char *path) {
    FILE *file = fopen(path, "r");
    if (!file) return status_fail_errno(IO_FAILED, "cannot read %s", path);
    char piece[4096];
    size_t count;
    while ((count = fread(piece, 1, sizeof piece, file)) > 0) text_bytes(words, piece, count);
    const Status status =
        ferror(file) ? status_fail_errno(IO_FAILED, "cannot read %s", path) : text_status(words);
    fclose(file);
    return status;
}
