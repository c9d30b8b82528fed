// SPDX-License-Identifier: GPL-3.0-or-later
// Between run files and Plans, both ways; the only place that knows YAML. Whatever is wrong with a
// run file is told, a sentence with file, line and column for each fault, a line each.
#pragma once

#include "protocol/plan.h"

#include <stdio.h>

// Values that replace those of the run file: "system.particles=500" from --set. A stage is found
// by its name: "protocol.quiescent.time=10".
typedef struct ConfigOverrides {
    size_t count;
    const char *const *settings;
    size_t point; // of the file's sweep, counted from 1; 0: a file with a sweep is refused
} ConfigOverrides;

// A Plan with every default filled and every check passed, and small enough for the memory of this
// machine. `overrides` may be NULL. The plan is the caller's to
// memory_free.
Status config_read(Plan **out, const char *path, const ConfigOverrides *overrides);

// The same from a text under a name for sentences, such as the plan.yaml that a file carries. It
// need not fit this machine.
Status config_read_text(Plan **out, const char *name, const char *text, size_t length,
                        const ConfigOverrides *overrides);

// A key of `sweep:` and the words that it takes.
typedef struct SweepKey {
    char path[OPTION_TEXT_SIZE]; // "system.packing_fraction"
    const char *name;            // its last word, or the whole where two keys end alike
    const char *unit;            // "" for a pure number
    bool numbers;                // all words are numbers
    size_t count;
    char (*words)[OPTION_TEXT_SIZE];
} SweepKey;

enum { SWEEP_KEYS_MOST = 3, POINT_NAME_SIZE = 200 };

// The points of a run file: every combination of the values of its `sweep:`, the last key fastest;
// a single one, without a name, where it sweeps nothing.
typedef struct ConfigPoints ConfigPoints;

// Every point's plan has been read and checked as by config_read. The overrides are borrowed.
Status config_read_points(ConfigPoints **out, const char *path, const ConfigOverrides *overrides);
Status config_read_points_text(ConfigPoints **out, const char *name, const char *text,
                               size_t length);
void config_free_points(ConfigPoints *points);

size_t config_point_count(const ConfigPoints *points);
size_t config_sweep_keys(const ConfigPoints *points); // 0: it sweeps nothing
const SweepKey *config_sweep_key(const ConfigPoints *points, size_t key);

// "packing_fraction=0.7_step=0.05", fit for a folder.
void config_point_name(const ConfigPoints *points, size_t point, char name[POINT_NAME_SIZE]);
Status config_point_plan(Plan **out, const ConfigPoints *points, size_t point);

// A run file of all points: that of the first, and the sweep.
Status config_write_points(const ConfigPoints *points, char **text);

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
