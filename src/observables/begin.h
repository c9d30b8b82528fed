// SPDX-License-Identifier: GPL-3.0-or-later
// How every `create` ends.
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
