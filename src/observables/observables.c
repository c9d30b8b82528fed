// SPDX-License-Identifier: GPL-3.0-or-later
// The table of observables.
#include "observables/observables.h"

#include "observables/begin.h"
#include "observables/lags.h"

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

// The settings of an observable have their lags where its waiting times are.
static void describe_waits(const ObservableKind *kind, const Settings *settings, const Clock *clock,
                           Text *lines) {
    for (size_t i = 0; i < kind->options.count; i++) {
        const Option *row = &kind->options.rows[i];
        if (strcmp(row->name, "waiting_times") != 0) continue;
        const unsigned char *waits = settings->bytes + row->offset;
        lags_describe((const LagSettings *)(waits - offsetof(LagSettings, waiting_times)), clock,
                      lines);
    }
}

Status observable_describe(const ObservableKind *kind, const Settings *settings,
                           const System *system, const Clock *clock, Text *lines) {
    if (kind->describe) TRY(kind->describe(settings, system, lines));
    describe_waits(kind, settings, clock, lines);
    return OK;
}

Status observer_check_rest(const char *observable, const char *instead, const Clock *clock) {
    if (!clock->drive || !(drive_kinds(clock->drive) & DRIVE_FLOW)) return OK;
    return status_fail(BAD_DATA, "%s is of a stage at rest, and stage '%s' is sheared; take %s",
                       observable, clock->stage, instead);
}
