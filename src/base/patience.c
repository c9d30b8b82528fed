// SPDX-License-Identifier: GPL-3.0-or-later
// Whether what a thread works on is still wanted.
#include "base/patience.h"

#include <stddef.h>

static _Thread_local const atomic_int *ended;

void patience_set(const atomic_int *stop) {
    ended = stop;
}

Status patience_check(void) {
    if (!ended || !atomic_load(ended)) return OK;
    return status_fail(INTERRUPTED, "stopped within a step that begins anew");
}
