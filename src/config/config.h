// SPDX-License-Identifier: GPL-3.0-or-later
// Between run files and Plans, both ways; the only place that knows YAML. Whatever is wrong with a
// run file is told in one sentence with file, line and column.
#pragma once

#include "protocol/plan.h"

#include <stdio.h>

// Values that replace those of the run file: "system.particles=500" from --set. A stage is found
// by its name: "protocol.quiescent.time=10".
typedef struct ConfigOverrides {
    size_t count;
    const char *const *settings;
} ConfigOverrides;

// A Plan with every default filled and every check passed, and small enough for the memory of this
// machine. `overrides` may be NULL. The plan is the caller's to
// memory_free.
Status config_read(Plan **out, const char *path, const ConfigOverrides *overrides);

// The same from a text under a name for sentences, such as the plan.yaml that a file carries. It
// need not fit this machine.
Status config_read_text(Plan **out, const char *name, const char *text, size_t length,
                        const ConfigOverrides *overrides);

// A run file with every value written out, commented with units. Reading it gives an equal Plan.
// The text is the caller's to memory_free.
Status config_write(const Plan *plan, char **text);

// How b differs from a: a line "key: was X, now Y" for each difference, "" for equal plans.
Status config_difference(const Plan *a, const Plan *b, char **text);

// What a key, observable, method, shape or unit means; all keys for NULL. BAD_USAGE with the
// nearest known word for an unknown one.
Status config_explain(const char *word, FILE *out);

// The reference of the run file in Markdown: docs/run-file.md.
void config_manual(FILE *out);
