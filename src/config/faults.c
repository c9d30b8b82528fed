// SPDX-License-Identifier: GPL-3.0-or-later
// Gathers sentences by lines, since what a call tells may itself have been gathered.
#include "config/faults.h"

#include <stdbool.h>
#include <string.h>

// Settings that two stages use may have been read twice.
static bool is_kept(const Faults *faults, const char *line, size_t length) {
    for (const char *kept = faults->sentences; *kept;) {
        const size_t other = strcspn(kept, "\n");
        if (other == length && memcmp(kept, line, length) == 0) return true;
        kept += other + (kept[other] == '\n');
    }
    return false;
}

static void keep_line(Faults *faults, const char *line, size_t length) {
    if (is_kept(faults, line, length)) return;
    const size_t used = strlen(faults->sentences), newline = used > 0;
    if (faults->count >= FAULTS_MOST || used + newline + length >= FAULTS_SIZE) return;
    if (newline) faults->sentences[used] = '\n';
    memcpy(faults->sentences + used + newline, line, length);
    faults->sentences[used + newline + length] = '\0';
    faults->count++;
}

Status faults_keep(Faults *faults, Status status) {
    if (status != BAD_DATA) return status;
    for (const char *line = status_sentence(); *line;) {
        const size_t length = strcspn(line, "\n");
        keep_line(faults, line, length);
        line += length + (line[length] == '\n');
    }
    return OK;
}

Status faults_tell(const Faults *faults) {
    return faults->count == 0 ? OK : status_fail(BAD_DATA, "%s", faults->sentences);
}
