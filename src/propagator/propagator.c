// SPDX-License-Identifier: GPL-3.0-or-later
// The table of propagators.
#include "propagator/propagator.h"

#include <string.h>

// Becomes: &propagator_event_driven, &propagator_newtonian, ..., NULL
const PropagatorKind *const propagator_kinds[] = {
#define PROPAGATOR(id) &propagator_##id,
#include "propagator/propagators.def"
#undef PROPAGATOR
    NULL,
};

const PropagatorKind *propagator_kind_named(const char *name) {
    for (size_t i = 0; propagator_kinds[i]; i++) {
        if (strcmp(propagator_kinds[i]->name, name) == 0) return propagator_kinds[i];
    }
    return NULL;
}
