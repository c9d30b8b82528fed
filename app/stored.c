// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the results of a run for the commands that show them.
#include "stored.h"

#include "base/text.h"
#include "store/store.h"

Status stored_results(Results **out, const char *directory) {
    Text path = {0};
    text_add(&path, "%s/results.h5", directory);
    Status status = text_status(&path);
    if (status == OK) status = store_read_results(out, text_words(&path));
    text_free(&path);
    return status;
}
