// SPDX-License-Identifier: GPL-3.0-or-later
// `sweep:` in the tree of a run file: a map from keys, as paths, to lists or ranges of values.
#include "config/points.h"

#include "base/memory.h"
#include "base/nearest.h"
#include "base/number.h"
#include "config/options.h"
#include "config/sections.h"
#include "state/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS_MOST = 10000 };

size_t sweep_points(const Sweep *sweep) {
    size_t points = 1;
    for (size_t k = 0; k < sweep->keys; k++) points *= sweep->key[k].count;
    return points;
}

void sweep_indices(const Sweep *sweep, size_t point, size_t index[SWEEP_KEYS_MOST]) {
    for (size_t k = sweep->keys; k-- > 0; point /= sweep->key[k].count) {
        index[k] = point % sweep->key[k].count;
    }
}

void sweep_free(Sweep *sweep) {
    for (size_t k = 0; k < sweep->keys; k++) memory_free(sweep->key[k].words);
    *sweep = (Sweep){0};
}

// A value names a folder, so that it is a number or a plain word; no two alike.
static Status add_word(SweepKey *key, const Node *node, const char *word) {
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.";
    char shown[QUOTE_SIZE];
    double number;
    tree_quote(shown, word);
    if (strspn(word, letters) != strlen(word) || strlen(word) >= POINT_NAME_SIZE / 4 || !*word)
        return tree_fail(node, "'%s' cannot name a point; sweeps go over numbers and plain words",
                         shown);
    for (size_t i = 0; i < key->count; i++) {
        if (strcmp(key->words[i], word) == 0)
            return tree_fail(node, "%s is there twice in the sweep of %s", shown, key->path);
    }
    strcpy(key->words[key->count++], word);
    key->numbers = key->numbers && number_read(word, &number);
    return OK;
}

static Status new_words(SweepKey *key, const Node *node, size_t count) {
    if (count == 0 || count > POINTS_MOST)
        return tree_fail(node, "%zu values in the sweep of %s; from 1 to %d have room", count,
                         key->path, POINTS_MOST);
    return NEW_ARRAY(key->words, count);
}

static Status read_list(SweepKey *key, const Node *list) {
    TRY(new_words(key, list, list->count));
    for (const Node *node = list->first; node; node = node->next) {
        if (node->kind != NODE_WORD)
            return tree_fail(node, "the sweep of %s goes over single values", key->path);
        TRY(add_word(key, node, node->text));
    }
    return OK;
}

// Rounded to twelve digits, so that 0.7, 0.72, ... read as one would write them.
static double value_of_range(const SweepRange *range, int64_t i) {
    const double share = range->count > 1 ? (double)i / (double)(range->count - 1) : 0;
    const bool linear = range->spacing == SPACING_LINEAR;
    const double value = linear ? range->first + share * (range->last - range->first)
                                : range->first * pow(range->last / range->first, share);
    char digits[NUMBER_SIZE];
    double rounded = value;
    snprintf(digits, sizeof digits, "%.12g", value);
    return number_read(digits, &rounded) ? rounded : value;
}

static Status read_range(SweepKey *key, const Node *map) {
    SweepRange range;
    TRY(options_default(&section_range_options, &range));
    const OptionTarget target = {&section_range_options, &range};
    const OptionMap options = {key->path, &target, 1, NULL};
    TRY(options_read(&options, map, true));
    if (range.spacing == SPACING_LOGARITHMIC && !(range.first * range.last > 0))
        return tree_fail(map, "a logarithmic range needs first and last of one sign, not 0");
    TRY(new_words(key, map, (size_t)range.count));
    for (int64_t i = 0; i < range.count; i++) {
        char digits[NUMBER_SIZE];
        TRY(add_word(key, map, number_write(digits, value_of_range(&range, i))));
    }
    return OK;
}

static Status read_key(SweepKey *key, const Node *node) {
    char shown[QUOTE_SIZE];
    if (strlen(node->key) >= sizeof key->path || !strchr(node->key, '.'))
        return tree_fail(node, "'%s' is no path to a key; write it like system.packing_fraction",
                         tree_quote(shown, node->key));
    strcpy(key->path, node->key);
    key->numbers = true;
    if (node->kind == NODE_LIST) return read_list(key, node);
    if (node->kind == NODE_MAP) return read_range(key, node);
    return tree_fail(node, "a sweep goes over a list such as [0.5, 0.6], or a range such as "
                           "{first: 0.5, last: 0.7, count: 3}");
}

// The last word of a path tells keys apart, mostly.
static void name_keys(Sweep *sweep) {
    for (size_t k = 0; k < sweep->keys; k++) {
        SweepKey *key = &sweep->key[k];
        key->name = strrchr(key->path, '.') + 1;
        key->unit = section_unit(key->path);
        for (size_t other = 0; other < sweep->keys; other++) {
            const char *last = strrchr(sweep->key[other].path, '.') + 1;
            if (other != k && strcmp(last, strrchr(key->path, '.') + 1) == 0) key->name = key->path;
        }
    }
}

static Status read_keys(Sweep *sweep, const Node *map) {
    for (const Node *node = map->first; node; node = node->next) {
        SweepKey *key = &sweep->key[sweep->keys++]; // freed by sweep_free whatever comes
        TRY(read_key(key, node));
        if (sweep_points(sweep) > POINTS_MOST)
            return tree_fail(map, "the sweep has more than %d points", POINTS_MOST);
    }
    name_keys(sweep);
    return OK;
}

Status sweep_read(Sweep *sweep, const Node *root) {
    *sweep = (Sweep){0};
    const Node *map = tree_find(root, "sweep");
    if (!map) return OK;
    if (map->kind != NODE_MAP || map->count == 0 || map->count > SWEEP_KEYS_MOST)
        return tree_fail(map,
                         "sweep is a map from one to %d keys to their values, such as "
                         "{system.packing_fraction: [0.5, 0.6]}",
                         SWEEP_KEYS_MOST);
    const Status status = read_keys(sweep, map);
    if (status != OK) sweep_free(sweep);
    return status;
}

// A path to a species that is there: put in the tree, another would be one more, without a shape.
static Status judge_species(const Node *root, const SweepKey *key, const Node *entry) {
    char section[sizeof key->path], species[sizeof key->path], shown[QUOTE_SIZE];
    const char *names[SPECIES_MOST];
    size_t count = 0;
    if (sscanf(key->path, "%[^.].species.%[^.]", section, species) != 2) return OK;
    const Node *map = tree_find(root, section);
    if (map) map = tree_find(map, "species");
    if (!map || tree_find(map, species)) return OK;
    for (const Node *node = map->first; node && node->key && count < SPECIES_MOST;
         node = node->next)
        names[count++] = node->key;
    if (count == 0) return OK; // what is there is refused by itself
    const size_t nearest = nearest_word(species, names, count);
    return tree_fail(entry, "there is no species '%s' in %s; %s '%s'%s", tree_quote(shown, species),
                     section, nearest < count ? "did you mean" : "the first is",
                     names[nearest < count ? nearest : 0], nearest < count ? "?" : "");
}

static Status put_values(Node *root, const Sweep *sweep, size_t point) {
    size_t index[SWEEP_KEYS_MOST];
    sweep_indices(sweep, point, index);
    for (size_t k = 0; k < sweep->keys; k++) {
        const SweepKey *key = &sweep->key[k];
        const Node *entry = tree_find(tree_find(root, "sweep"), key->path);
        TRY(judge_species(root, key, entry));
        const Node *from = entry->kind == NODE_LIST ? entry->first : entry;
        for (size_t i = 0; entry->kind == NODE_LIST && i < index[k]; i++) from = from->next;
        TRY(tree_put(root, key->path, from, key->words[index[k]]));
    }
    return OK;
}

Status sweep_choose(Node *root, size_t point) {
    Sweep sweep;
    TRY(sweep_read(&sweep, root));
    Status status = OK;
    if (sweep.keys > 0 && point == 0)
        status = tree_fail(tree_find(root, "sweep"),
                           "a sweep of %zu points, where one run is wanted; `perrin run` and "
                           "`perrin check` take it",
                           sweep_points(&sweep));
    if (status == OK && sweep.keys > 0) status = put_values(root, &sweep, point - 1);
    sweep_free(&sweep);
    return status;
}
