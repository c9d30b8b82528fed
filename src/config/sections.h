// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of a run file: which option table stands where. Explain, the manual and the
// suggestions for unknown keys walk this list; the reader follows it. Inside config/ only.
#pragma once

#include "base/option.h"

#include <stdbool.h>
#include <stdint.h>

// {first: 0.5, last: 0.7, count: 3}, in place of a list of values.
typedef struct SweepRange {
    double first, last;
    int64_t count;
    int64_t spacing;
} SweepRange;
enum { SPACING_LINEAR, SPACING_LOGARITHMIC };

enum { SECTION_PATH_SIZE = 96, SECTION_HOME_SIZE = 192 };

typedef struct Section {
    char path[SECTION_PATH_SIZE]; // "system.species.NAME", "observe.pressure"; "" for the top
    const char *method;           // of `dynamics`: with this method only, else NULL
    const char *about;            // one sentence
    const OptionTable *table;     // NULL if the section has no keys of its own
} Section;

size_t section_count(void);
Section section_at(size_t index);

// Where a key that stands among those of `table` belongs, as "system" or "dynamics with method:
// newtonian"; false if nowhere. Of an observable's, that is not another observable: many have keys
// of the same name, and none was meant.
bool section_of_key(const char *key, const OptionTable *table, char home[SECTION_HOME_SIZE]);

// "itt.correlators" and "itt.correlators.times" begin "itt.correlators.times.first".
bool section_begins(const char *path, const char *part);

// The unit of the key at a path, "protocol.flow.shear_rate"; "" for a pure number or no key.
const char *section_unit(const char *path);

// What to say to a word of other engines, drives and theories that this version does not have, and
// to a word by which other programs call what is called otherwise here; NULL for any other word.
const char *section_hint(const char *word);

extern const OptionTable section_title_options;  // `title`, of the Plan
extern const OptionTable section_method_options; // `method` of `dynamics`, a char[OPTION_TEXT_SIZE]
extern const OptionTable section_range_options;  // of a SweepRange
extern const char *const section_root_keys[];    // NULL-ended: keys beside `title`
