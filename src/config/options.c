// SPDX-License-Identifier: GPL-3.0-or-later
// One row of an option table does it all: this file reads, checks and writes the value that a row
// describes, and finds what an unknown key was meant to be.
#include "config/options.h"

#include "base/nearest.h"
#include "base/number.h"
#include "config/faults.h"
#include "config/sections.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 128 };

static const struct {
    const char *name;
    double seconds;
} duration_units[] = {{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}};
enum { DURATION_UNITS = sizeof duration_units / sizeof *duration_units };

const Option *option_named(const OptionTable *table, const char *name) {
    for (size_t i = 0; i < table->count; i++) {
        if (strcmp(table->rows[i].name, name) == 0) return &table->rows[i];
    }
    return NULL;
}

const Option *option_may_be_map(const OptionTable *table, const Option *row) {
    const size_t length = strlen(row->name);
    for (size_t i = 0; i < table->count; i++) {
        const char *name = table->rows[i].name;
        if (strncmp(name, row->name, length) == 0 && name[length] == '.') return &table->rows[i];
    }
    return NULL;
}

static void *field(const Option *row, void *settings) {
    return (char *)settings + row->offset;
}

static bool has_range(const Option *row) {
    return row->least != 0 || row->most != 0;
}

static void describe_range(const Option *row, Text *text) {
    char least[NUMBER_SIZE], most[NUMBER_SIZE];
    if (has_range(row)) {
        text_add(text, " from %s to %s", number_write(least, row->least),
                 number_write(most, row->most));
    }
    if (row->type == OPTION_DURATION)
        text_add(text, " s");
    else if (row->unit[0] != '\0')
        text_add(text, " (%s)", row->unit);
}

static void list_choices(const Option *row, Text *text) {
    for (size_t i = 0; row->choices[i]; i++) {
        text_add(text, "%s%s", i ? ", " : "", row->choices[i]);
    }
}

void option_describe(const Option *row, Text *text) {
    switch (row->type) {
    case OPTION_REAL:
        text_add(text, "a number");
        break;
    case OPTION_INTEGER:
        text_add(text, "a whole number");
        break;
    case OPTION_BOOLEAN:
        text_add(text, "true or false");
        break;
    case OPTION_CHOICE:
        text_add(text, "one of ");
        break;
    case OPTION_TEXT:
        text_add(text, "a text of one line");
        break;
    case OPTION_REALS:
        text_add(text, "a list of numbers");
        break;
    case OPTION_CHOICES:
        text_add(text, "a list of words from ");
        break;
    case OPTION_DURATION:
        text_add(text, "a duration such as 600 s, 10 min or 2 h,");
        break;
    }
    if (row->choices) list_choices(row, text);
    describe_range(row, text);
}

// "particles = many is not a whole number from 2 to 100000000"
static Status fail_kind(const Option *row, const Node *node) {
    char shown[QUOTE_SIZE];
    Text wanted = {0};
    option_describe(row, &wanted);
    Status status = text_status(&wanted);
    if (status != OK) {
        // Out of memory: the sentence is there already.
    } else if (node->kind != NODE_WORD) {
        status = tree_fail(node, "%s is a %s; expected %s", row->name,
                           node->kind == NODE_LIST ? "list" : "map", text_words(&wanted));
    } else if (node->text[0] == '\0') {
        status = tree_fail(node, "%s has no value; expected %s", row->name, text_words(&wanted));
    } else if (node->quoted) {
        status = tree_fail(node, "%s = \"%s\" is text in quotes; expected %s", row->name,
                           tree_quote(shown, node->text), text_words(&wanted));
    } else {
        status = tree_fail(node, "%s = %s is not %s", row->name, tree_quote(shown, node->text),
                           text_words(&wanted));
    }
    text_free(&wanted);
    return status;
}

static Status check_range(const Option *row, const Node *node, double value) {
    if (!has_range(row) || (value >= row->least && value <= row->most)) return OK;
    char shown[NUMBER_SIZE];
    Text range = {0};
    describe_range(row, &range);
    const Status status = tree_fail(node, "%s = %s is out of range; expected a value%s", row->name,
                                    number_write(shown, value), text_words(&range));
    text_free(&range);
    return status;
}

static bool is_bare_word(const Node *node) {
    return node->kind == NODE_WORD && !node->quoted;
}

static Status read_real(const Option *row, const Node *node, double *value) {
    if (!is_bare_word(node) || !number_read(node->text, value)) return fail_kind(row, node);
    return check_range(row, node, *value);
}

static Status read_integer(const Option *row, const Node *node, int64_t *value) {
    if (!is_bare_word(node) || !number_read_whole(node->text, value)) return fail_kind(row, node);
    return check_range(row, node, (double)*value);
}

static Status read_boolean(const Option *row, const Node *node, int64_t *value) {
    if (!is_bare_word(node)) return fail_kind(row, node);
    *value = strcmp(node->text, "true") == 0;
    return *value || strcmp(node->text, "false") == 0 ? OK : fail_kind(row, node);
}

static Status read_choice(const Option *row, const Node *node, int64_t *value) {
    if (node->kind != NODE_WORD || node->text[0] == '\0') return fail_kind(row, node);
    size_t count = 0;
    for (; row->choices[count]; count++) {
        if (strcmp(node->text, row->choices[count]) == 0) return *value = (int64_t)count, OK;
    }
    const char *hint = section_hint(node->text);
    if (hint) return tree_fail(node, "%s = %s: %s", row->name, node->text, hint);
    const size_t nearest = nearest_word(node->text, row->choices, count);
    if (nearest == count) return fail_kind(row, node);
    char shown[QUOTE_SIZE];
    return tree_fail(node, "%s = %s is unknown; did you mean %s?", row->name,
                     tree_quote(shown, node->text), row->choices[nearest]);
}

// One line that YAML takes back: no control characters, no line ends of Unicode, no byte order
// mark.
static bool is_printable(const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c < 0x20 || *c == 0x7F) return false;
        if (c[0] == 0xC2 && c[1] < 0xA0) return false; // C1
        if (c[0] == 0xE2 && c[1] == 0x80 && (c[2] == 0xA8 || c[2] == 0xA9)) return false;
        if (c[0] == 0xEF && c[1] == 0xBB && c[2] == 0xBF) return false; // U+FEFF
        if (c[0] == 0xEF && c[1] == 0xBF && c[2] >= 0xBE) return false; // U+FFFE, U+FFFF
    }
    return true;
}

static Status read_text(const Option *row, const Node *node, char text[OPTION_TEXT_SIZE]) {
    if (node->kind != NODE_WORD) return fail_kind(row, node);
    if (!is_printable(node->text))
        return tree_fail(node, "%s has more than one line or a control character", row->name);
    const size_t length = strlen(node->text);
    if (length >= OPTION_TEXT_SIZE)
        return tree_fail(node, "%s is %zu bytes long; at most %d have room", row->name, length,
                         OPTION_TEXT_SIZE - 1);
    memset(text, 0, OPTION_TEXT_SIZE);
    memcpy(text, node->text, length);
    return OK;
}

// A single number stands for a list of one.
static Status read_reals(const Option *row, const Node *node, OptionReals *reals) {
    if (node->kind == NODE_MAP) return fail_kind(row, node);
    *reals = (OptionReals){0};
    const Node *element = node->kind == NODE_LIST ? node->first : node;
    for (; element; element = node->kind == NODE_LIST ? element->next : NULL) {
        if (reals->count == OPTION_LIST_SIZE)
            return tree_fail(element, "%s has more than %d numbers", row->name, OPTION_LIST_SIZE);
        Option of_element = *row;
        of_element.type = OPTION_REAL;
        TRY(read_real(&of_element, element, &reals->values[reals->count]));
        reals->count++;
    }
    return OK;
}

static Status read_choices(const Option *row, const Node *node, uint64_t *set) {
    if (node->kind == NODE_MAP) return fail_kind(row, node);
    *set = 0;
    const Node *element = node->kind == NODE_LIST ? node->first : node;
    for (; element; element = node->kind == NODE_LIST ? element->next : NULL) {
        int64_t choice = 0;
        Option of_element = *row;
        of_element.type = OPTION_CHOICE;
        TRY(read_choice(&of_element, element, &choice));
        *set |= UINT64_C(1) << choice;
    }
    return OK;
}

static Status read_duration(const Option *row, const Node *node, double *seconds) {
    if (node->kind != NODE_WORD) return fail_kind(row, node);
    const size_t digits = strcspn(node->text, " smhd"); // "600 s" or "600s"
    const char *unit = node->text + digits + strspn(node->text + digits, " ");
    char number[NUMBER_SIZE] = "";
    if (digits < sizeof number) memcpy(number, node->text, digits);
    double value = 0;
    if (!number_read(number, &value)) return fail_kind(row, node);
    for (size_t i = 0; i < DURATION_UNITS; i++) {
        if (strcmp(unit, duration_units[i].name) != 0) continue;
        *seconds = value * duration_units[i].seconds;
        return check_range(row, node, *seconds);
    }
    char shown[QUOTE_SIZE];
    return tree_fail(node, "%s = %s needs a unit of time: s, min, h or d, as in 600 s", row->name,
                     tree_quote(shown, node->text));
}

Status option_read(const Option *row, const Node *node, void *settings) {
    void *value = field(row, settings);
    switch (row->type) {
    case OPTION_REAL:
        return read_real(row, node, value);
    case OPTION_INTEGER:
        return read_integer(row, node, value);
    case OPTION_BOOLEAN:
        return read_boolean(row, node, value);
    case OPTION_CHOICE:
        return read_choice(row, node, value);
    case OPTION_TEXT:
        return read_text(row, node, value);
    case OPTION_REALS:
        return read_reals(row, node, value);
    case OPTION_CHOICES:
        return read_choices(row, node, value);
    case OPTION_DURATION:
        return read_duration(row, node, value);
    }
    return OK;
}

static Status default_from_text(const Option *row, void *settings) {
    Node *node = NULL;
    TRY(tree_read_value(&node, row->name, row->fallback_text));
    const Status status = option_read(row, node, settings);
    tree_free(node);
    return status;
}

Status options_default(const OptionTable *table, void *settings) {
    for (size_t i = 0; i < table->count; i++) {
        const Option *row = &table->rows[i];
        void *value = field(row, settings);
        switch (row->type) {
        case OPTION_REAL:
        case OPTION_DURATION:
            *(double *)value = row->fallback;
            break;
        case OPTION_INTEGER:
        case OPTION_BOOLEAN:
        case OPTION_CHOICE:
            *(int64_t *)value = (int64_t)row->fallback;
            break;
        case OPTION_TEXT:
            memset(value, 0, OPTION_TEXT_SIZE);
            break;
        case OPTION_REALS:
            *(OptionReals *)value = (OptionReals){0};
            break;
        case OPTION_CHOICES:
            *(uint64_t *)value = 0;
            break;
        }
        if (row->fallback_text) TRY(default_from_text(row, settings));
    }
    return OK;
}

static void write_quoted(const char *words, Text *text) {
    text_add(text, "\"");
    for (const char *c = words; *c; c++)
        text_add(text, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
    text_add(text, "\"");
}

static void write_list(const Option *row, const void *value, Text *text) {
    char number[NUMBER_SIZE];
    const char *comma = "";
    text_add(text, "[");
    if (row->type == OPTION_REALS) {
        const OptionReals *reals = value;
        for (int64_t i = 0; i < reals->count; i++, comma = ", ")
            text_add(text, "%s%s", comma, number_write(number, reals->values[i]));
    } else {
        for (size_t i = 0; row->choices[i]; i++) {
            if (!(*(const uint64_t *)value >> i & 1)) continue;
            text_add(text, "%s%s", comma, row->choices[i]);
            comma = ", ";
        }
    }
    text_add(text, "]");
}

void option_write(const Option *row, const void *settings, Text *text) {
    const void *value = (const char *)settings + row->offset;
    char number[NUMBER_SIZE];
    switch (row->type) {
    case OPTION_REAL:
        text_add(text, "%s", number_write(number, *(const double *)value));
        break;
    case OPTION_INTEGER:
        text_add(text, "%" PRId64, *(const int64_t *)value);
        break;
    case OPTION_BOOLEAN:
        text_add(text, *(const int64_t *)value ? "true" : "false");
        break;
    case OPTION_CHOICE:
        text_add(text, "%s", row->choices[*(const int64_t *)value]);
        break;
    case OPTION_TEXT:
        write_quoted(value, text);
        break;
    case OPTION_REALS:
    case OPTION_CHOICES:
        write_list(row, value, text);
        break;
    case OPTION_DURATION:
        text_add(text, "%s s", number_write(number, *(const double *)value));
        break;
    }
}

bool option_is_default(const Option *row, const void *settings) {
    union {
        double real;
        int64_t whole;
        uint64_t set;
        char text[OPTION_TEXT_SIZE];
        OptionReals reals;
    } fallback;
    Option alone = *row;
    alone.offset = 0;
    const OptionTable table = {&alone, 1, sizeof fallback};
    Text value = {0}, other = {0};
    const Status status = options_default(&table, &fallback);
    option_write(row, settings, &value);
    option_write(&alone, &fallback, &other);
    const bool same = status == OK && strcmp(text_words(&value), text_words(&other)) == 0;
    text_free(&value);
    text_free(&other);
    return same;
}

// The first name of `row` below `prefix`, if it lies there: "times" of "times.first" below "".
static bool name_below(const Option *row, const char *prefix, char name[PATH_SIZE]) {
    const size_t length = strlen(prefix);
    if (strncmp(row->name, prefix, length) != 0) return false;
    const char *rest = row->name + length;
    const size_t end = strcspn(rest, ".");
    ASSERT(end < PATH_SIZE);
    memcpy(name, rest, end);
    name[end] = '\0';
    return true;
}

enum { KNOWN_MOST = 64 };
typedef struct KnownKeys {
    char names[KNOWN_MOST][PATH_SIZE];
    const char *pointers[KNOWN_MOST];
    size_t count;
} KnownKeys;

static void known_add(KnownKeys *known, const char *name) {
    for (size_t i = 0; i < known->count; i++) {
        if (strcmp(known->names[i], name) == 0) return;
    }
    ASSERT(known->count < KNOWN_MOST && strlen(name) < PATH_SIZE);
    strcpy(known->names[known->count], name);
    known->pointers[known->count] = known->names[known->count];
    known->count++;
}

static void known_collect(KnownKeys *known, const OptionMap *options, const char *prefix) {
    char name[PATH_SIZE];
    for (size_t t = 0; t < options->count; t++) {
        const OptionTable *table = options->targets[t].table;
        for (size_t i = 0; i < table->count; i++) {
            if (name_below(&table->rows[i], prefix, name)) known_add(known, name);
        }
    }
    if (prefix[0] != '\0' || !options->others) return;
    for (size_t i = 0; options->others[i]; i++) known_add(known, options->others[i]);
}

static Status fail_unknown(const OptionMap *options, const Node *node, const char *prefix) {
    char shown[QUOTE_SIZE];
    tree_quote(shown, node->key);
    const char *hint = section_hint(node->key);
    if (hint) return tree_fail(node, "%s: %s", shown, hint);
    if (strchr(node->key, '.'))
        return tree_fail(node, "the key '%s' has a dot; write a map in a map, as %.*s: {...}",
                         shown, (int)strcspn(shown, "."), shown);
    KnownKeys known = {.count = 0};
    known_collect(&known, options, prefix);
    const size_t nearest = nearest_word(node->key, known.pointers, known.count);
    const bool near = nearest < known.count;
    const bool slip = near && word_distance(node->key, known.names[nearest]) == 1;
    char home[SECTION_HOME_SIZE], map[SECTION_HOME_SIZE];
    const int below = prefix[0] ? (int)strlen(prefix) - 1 : 0; // without its dot
    snprintf(map, sizeof map, "%.*s%s%s", below, prefix, below ? " of " : "", options->name);
    if (!slip && section_of_key(node->key, options->targets[0].table, home))
        return tree_fail(node, "unknown key '%s' in %s; it belongs in %s", shown, map, home);
    if (near)
        return tree_fail(node, "unknown key '%s' in %s; did you mean '%s'?", shown, map,
                         known.names[nearest]);
    Text names = {0};
    for (size_t i = 0; i < known.count; i++)
        text_add(&names, "%s%s", i ? ", " : "", known.names[i]);
    const Status status = tree_fail(node, "unknown key '%s' in %s; expected %s", shown, map,
                                    known.count ? text_words(&names) : "nothing");
    text_free(&names);
    return status;
}

static bool is_other(const OptionMap *options, const char *key) {
    for (size_t i = 0; options->others && options->others[i]; i++) {
        if (strcmp(options->others[i], key) == 0) return true;
    }
    return false;
}

static bool has_rows_below(const OptionMap *options, const char *prefix) {
    char name[PATH_SIZE];
    for (size_t t = 0; t < options->count; t++) {
        const OptionTable *table = options->targets[t].table;
        for (size_t i = 0; i < table->count; i++) {
            if (name_below(&table->rows[i], prefix, name)) return true;
        }
    }
    return false;
}

static Status read_level(const OptionMap *options, const Node *map, const char *prefix);

static Status read_key(const OptionMap *options, const Node *node, const char *prefix) {
    char path[PATH_SIZE];
    const int length = snprintf(path, sizeof path, "%s%s", prefix, node->key);
    // "times.first" is written as two maps, never as a key with a dot.
    if ((size_t)length + 1 >= sizeof path || strchr(node->key, '.'))
        return fail_unknown(options, node, prefix);
    for (size_t t = 0; t < options->count; t++) {
        const Option *row = option_named(options->targets[t].table, path);
        const bool map =
            row && node->kind == NODE_MAP && option_may_be_map(options->targets[t].table, row);
        if (row && !map) return option_read(row, node, options->targets[t].settings);
    }
    if (prefix[0] == '\0' && is_other(options, node->key)) return OK;
    strcat(path, ".");
    if (!has_rows_below(options, path)) return fail_unknown(options, node, prefix);
    return read_level(options, node, path);
}

static Status read_level(const OptionMap *options, const Node *map, const char *prefix) {
    if (map->kind != NODE_MAP) {
        KnownKeys known = {.count = 0};
        known_collect(&known, options, prefix);
        return tree_fail(map, "%s is a map of keys and values, such as {%s: ...}",
                         map->key ? map->key : options->name, known.count ? known.names[0] : "key");
    }
    Faults faults = {0};
    for (const Node *node = map->first; node; node = node->next) {
        TRY(faults_keep(&faults, read_key(options, node, prefix)));
    }
    return faults_tell(&faults);
}

static const Node *find_path(const Node *map, const char *path) {
    char name[PATH_SIZE];
    const Node *node = map;
    for (const char *rest = path; node && rest; rest = strchr(rest, '.')) {
        rest += *rest == '.';
        snprintf(name, sizeof name, "%.*s", (int)strcspn(rest, "."), rest);
        node = tree_find(node, name);
    }
    return node;
}

static Status check_required(const char *name, const OptionTable *table, const Node *map) {
    Faults faults = {0};
    for (size_t i = 0; i < table->count; i++) {
        const Option *row = &table->rows[i];
        if (!row->required || find_path(map, row->name)) continue;
        TRY(faults_keep(&faults, tree_fail(map, "%s needs '%s': %s", name, row->name, row->about)));
    }
    return faults_tell(&faults);
}

// A key that is missing may be there under a wrong name: it is asked for when all others are right.
Status options_read(const OptionMap *options, const Node *map, bool complete) {
    TRY(read_level(options, map, ""));
    Faults faults = {0};
    for (size_t t = 0; complete && t < options->count; t++) {
        TRY(faults_keep(&faults, check_required(options->name, options->targets[t].table, map)));
    }
    return faults_tell(&faults);
}
