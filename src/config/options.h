// SPDX-License-Identifier: GPL-3.0-or-later
// Between option tables and run files: defaults, reading with range checks, writing. Inside config/
// only.
#pragma once

#include "base/option.h"
#include "base/text.h"
#include "config/tree.h"

// A table and the settings it fills.
typedef struct OptionTarget {
    const OptionTable *table;
    void *settings;
} OptionTarget;

// One map of the run file: what may stand in it.
typedef struct OptionMap {
    const char *name;            // for sentences: "system", "stage 'settle'"
    const OptionTarget *targets; // [count]
    size_t count;
    const char *const *others; // NULL-ended: keys that are read elsewhere; NULL: none
} OptionMap;

Status options_default(const OptionTable *table, void *settings);

// Reads what stands in the map; what does not keeps its value. `complete`: required keys must be
// there.
Status options_read(const OptionMap *options, const Node *map, bool complete);

Status option_read(const Option *row, const Node *node, void *settings);

// The value in run-file notation.
void option_write(const Option *row, const void *settings, Text *text);

// Whether the value is the one that it has where the key is not given.
bool option_is_default(const Option *row, const void *settings);

// "a number from 0.01 to 100", "one of disc, sphere".
void option_describe(const Option *row, Text *text);

const Option *option_named(const OptionTable *table, const char *name); // NULL if none

// The first row below `row`, "structure.file" of "structure", whose value is then a word or a map;
// NULL: there is none, it is a word. Of a map that row is a text and not empty.
const Option *option_may_be_map(const OptionTable *table, const Option *row);
