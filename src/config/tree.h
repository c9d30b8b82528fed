// SPDX-License-Identifier: GPL-3.0-or-later
// A run file as a tree of maps, lists and words that know where they were written. The only file
// pair that knows YAML; built from libyaml's events, since its documents have lost the anchors,
// aliases and tags that are refused here. Inside config/ only.
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum NodeKind { NODE_WORD, NODE_LIST, NODE_MAP } NodeKind;

typedef struct Node Node;
struct Node {
    NodeKind kind;
    bool quoted;        // a word in quotes: text, never a number
    char *text;         // of a word
    char *key;          // of an entry of a map, else NULL
    const char *source; // file name, or KEY=VALUE of --set (line 0); borrowed
    int line, column;   // counted from 1: of the key where there is one, else of the value
    size_t count;       // of entries
    Node *first, *next; // entries of this, neighbour in the parent
};

// A document of one map. `name` and `text` are borrowed; the name until the tree is freed.
Status tree_read(Node **out, const char *name, const char *text, size_t length);

// A value of any kind, such as the default of an option in run-file notation.
Status tree_read_value(Node **out, const char *name, const char *text);

// Puts the value of "a.b.c=VALUE" into the tree, making maps on the way. In a list of stages the
// name of a stage picks one.
Status tree_set(Node *root, const char *assignment);

// Puts a word in the place "a.b.c", in the same way; sentences about it give the place of `from`.
Status tree_put(Node *root, const char *path, const Node *from, const char *word);

void tree_free(Node *node);

Node *tree_find(const Node *map, const char *key); // NULL if none

// BAD_DATA with "FILE:LINE:COLUMN: error: ..." or "--set KEY=VALUE: error: ...".
Status tree_fail(const Node *node, const char *format, ...) __attribute__((format(printf, 2, 3)));

enum { QUOTE_SIZE = 48 };
// What a stranger wrote, fit for a sentence: shortened, control characters replaced.
const char *tree_quote(char out[QUOTE_SIZE], const char *text);

// A file read whole, up to the size limit of run files. The text is the caller's to memory_free.
Status tree_read_file(const char *path, char **text, size_t *length);
