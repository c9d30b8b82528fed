// SPDX-License-Identifier: GPL-3.0-or-later
// The table of observables.
#include "observables/observables.h"

#include <string.h>

// Becomes: &observable_mean_squared_displacement, ..., NULL
const ObservableKind *const observable_kinds[] = {
#define OBSERVABLE(id) &observable_##id,
#include "observables/observables.def"
#undef OBSERVABLE
    NULL,
};

const ObservableKind *observable_kind_named(const char *name) {
    for (size_t i = 0; observable_kinds[i]; i++) {
        if (strcmp(observable_kinds[i]->name, name) == 0) return observable_kinds[i];
    }
    return NULL;
}
