// SPDX-License-Identifier: GPL-3.0-or-later
// How two plans differ, for one who wants to resume a run with a changed run file. Compares the
// plans as they are written: what is not written is not in a plan.
#include "config/config.h"

#include "base/memory.h"
#include "base/text.h"
#include "config/tree.h"

#include <string.h>

enum { PATH_SIZE = 256 };

static void flatten(const Node *node, Text *text) {
    if (node->kind == NODE_WORD) {
        text_put(text, node->text);
        return;
    }
    text_put(text, node->kind == NODE_LIST ? "[" : "{");
    for (const Node *entry = node->first; entry; entry = entry->next) {
        if (entry->key) text_add(text, "%s: ", entry->key);
        flatten(entry, text);
        if (entry->next) text_put(text, ", ");
    }
    text_put(text, node->kind == NODE_LIST ? "]" : "}");
}

// "protocol.quiescent" for a stage, else "path.key".
static void extend(char path[PATH_SIZE], const char *parent, const Node *entry) {
    const Node *stage = tree_find(entry, "stage");
    const char *name = entry->key ? entry->key : stage ? stage->text : "";
    snprintf(path, PATH_SIZE, "%s%s%s", parent, parent[0] && name[0] ? "." : "", name);
}

// What an entry stands for: a key, a stage, an observable with or without settings.
static const char *label(const Node *entry) {
    if (entry->key) return entry->key;
    if (entry->kind == NODE_WORD) return entry->text;
    const Node *stage = tree_find(entry, "stage");
    return stage ? stage->text : entry->first ? entry->first->key : "";
}

static const Node *counterpart(const Node *parent, const Node *entry) {
    for (const Node *other = parent->first; other; other = other->next) {
        if (strcmp(label(other), label(entry)) == 0) return other;
    }
    return NULL;
}

// Lists of stages and of observables are compared entry by entry, lists of numbers as a whole.
static bool has_parts(const Node *node) {
    const bool list_of_maps =
        node->kind == NODE_LIST && (!node->first || node->first->kind == NODE_MAP);
    return node->kind == NODE_MAP || list_of_maps;
}

static void tell(const char *path, const Node *a, const Node *b, Text *text) {
    Text was = {0}, now = {0};
    if (a) flatten(a, &was);
    if (b) flatten(b, &now);
    if (!a || !b || strcmp(text_words(&was), text_words(&now)) != 0)
        text_add(text, "%s: %s%s, %s%s\n", path, a ? "was " : "was not there", text_words(&was),
                 b ? "now " : "is not there now", text_words(&now));
    text_free(&was);
    text_free(&now);
}

static void compare(const char *path, const Node *a, const Node *b, Text *text) {
    if (!has_parts(a) || !has_parts(b)) {
        tell(path, a, b, text);
        return;
    }
    char below[PATH_SIZE];
    for (const Node *entry = a->first; entry; entry = entry->next) {
        const Node *other = counterpart(b, entry);
        extend(below, path, entry);
        if (other)
            compare(below, entry, other, text);
        else
            tell(below, entry, NULL, text);
    }
    for (const Node *entry = b->first; entry; entry = entry->next) {
        extend(below, path, entry);
        if (!counterpart(a, entry)) tell(below, NULL, entry, text);
    }
}

static Status plan_tree(const Plan *plan, Node **out) {
    char *text = NULL;
    TRY(config_write(plan, &text));
    const Status status = tree_read(out, "plan", text, strlen(text));
    memory_free(text);
    return status;
}

Status config_difference(const Plan *a, const Plan *b, char **out) {
    Node *tree_a = NULL, *tree_b = NULL;
    Text text = {0};
    Status status = plan_tree(a, &tree_a);
    if (status == OK) status = plan_tree(b, &tree_b);
    if (status == OK) {
        text_put(&text, "");
        compare("", tree_a, tree_b, &text);
        status = text_status(&text);
    }
    tree_free(tree_a);
    tree_free(tree_b);
    *out = status == OK ? text.bytes : NULL;
    if (status != OK) text_free(&text);
    return status;
}
