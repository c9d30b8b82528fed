// SPDX-License-Identifier: GPL-3.0-or-later
// Option tables: one row per run-file key. The same row parses, checks, fills the default, writes
// plan.yaml, answers `perrin explain KEY` and generates the reference manual. A module that can be
// set from the run file declares its plain settings struct and the table that describes it; only
// config/ knows YAML.
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef enum OptionType {
    OPTION_REAL,     // double
    OPTION_INTEGER,  // int64_t
    OPTION_BOOLEAN,  // int64_t, 0 or 1; true/false in the run file
    OPTION_CHOICE,   // int64_t, an index into `choices`
    OPTION_TEXT,     // char[OPTION_TEXT_SIZE]
    OPTION_REALS,    // OptionReals, a list of numbers
    OPTION_CHOICES,  // OptionReals-like: uint64_t bit set, a list of words from `choices`
    OPTION_DURATION, // double, wall-clock seconds; "600 s", "10 min", "2 h"
} OptionType;

enum { OPTION_TEXT_SIZE = 256, OPTION_LIST_SIZE = 64 };

typedef struct OptionReals {
    int64_t count;
    double values[OPTION_LIST_SIZE];
} OptionReals;

typedef struct Option {
    const char *name; // a dot goes into a nested map: "times.first"; its rows stand together
    OptionType type;
    size_t offset;      // of the field in the settings struct
    double fallback;    // default of a number, choice, boolean or duration
    double least, most; // inclusive range of a number, of each element of a list; both 0: any
    const char *unit;   // "" for a pure number
    const char *about;  // one sentence
    const char *const *choices; // NULL-ended, of a choice
    const char *fallback_text;  // default of a text or a list, in run-file notation; NULL: empty
    int required;               // 1: there is no default
} Option;

// A table and the size of the struct it describes.
typedef struct OptionTable {
    const Option *rows;
    size_t count;
    size_t size;
} OptionTable;

#define OPTION_TABLE(rows_, type_)                                                                 \
    ((OptionTable){                                                                                \
        .rows = (rows_), .count = sizeof(rows_) / sizeof *(rows_), .size = sizeof(type_)})
