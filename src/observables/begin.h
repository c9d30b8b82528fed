// SPDX-License-Identifier: GPL-3.0-or-later
// How every `create` ends, and what several checks ask.
#pragma once

#include "observables/observables.h"

// Gives the observer out, or frees it where there was no room for all of it.
static inline Status observer_begin(Observer **out, Observer *made, Status status) {
    if (status == OK)
        *out = made;
    else
        made->kind->free(made);
    return status;
}

// BAD_DATA where the stage is sheared, with what to take in its place.
Status observer_check_rest(const char *observable, const char *instead, const Clock *clock);
