// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a run file, kept with its text, so that a plan is read when its turn comes.
#include "config/points.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

struct ConfigPoints {
    char *name, *text; // of the run file
    size_t length;
    ConfigOverrides overrides;
    bool must_fit; // this machine
    Sweep sweep;
};

void config_free_points(ConfigPoints *points) {
    if (!points) return;
    sweep_free(&points->sweep);
    memory_free(points->name);
    memory_free(points->text);
    memory_free(points);
}

size_t config_point_count(const ConfigPoints *points) {
    return sweep_points(&points->sweep);
}

size_t config_sweep_keys(const ConfigPoints *points) {
    return points->sweep.keys;
}

const SweepKey *config_sweep_key(const ConfigPoints *points, size_t key) {
    return &points->sweep.key[key];
}

void config_point_name(const ConfigPoints *points, size_t point, char name[POINT_NAME_SIZE]) {
    size_t index[SWEEP_KEYS_MOST], length = 0;
    sweep_indices(&points->sweep, point, index);
    name[0] = '\0';
    for (size_t k = 0; k < points->sweep.keys && length < POINT_NAME_SIZE; k++) {
        const SweepKey *key = &points->sweep.key[k];
        length += (size_t)snprintf(name + length, POINT_NAME_SIZE - length, "%s%s=%s", k ? "_" : "",
                                   key->name, key->words[index[k]]);
    }
}

Status config_point_plan(Plan **out, const ConfigPoints *points, size_t point) {
    ConfigOverrides overrides = points->overrides;
    overrides.point = point + 1;
    return config_read_plan(out, points->name, points->text, points->length, &overrides,
                            points->must_fit);
}

static Status read_sweep(ConfigPoints *points) {
    Node *root = NULL;
    TRY(tree_read(&root, points->name, points->text, points->length));
    Status status = OK;
    for (size_t i = 0; i < points->overrides.count && status == OK; i++) {
        status = tree_set(root, points->overrides.settings[i]);
    }
    if (status == OK) status = sweep_read(&points->sweep, root);
    tree_free(root);
    return status;
}

// Nothing begins before all points are known to be right.
static Status check_points(const ConfigPoints *points) {
    for (size_t point = 0; point < config_point_count(points); point++) {
        Plan *plan = NULL;
        TRY(config_point_plan(&plan, points, point));
        memory_free(plan);
    }
    return OK;
}

static Status finish_reading(ConfigPoints **out, ConfigPoints *points) {
    Status status = read_sweep(points);
    if (status == OK) status = check_points(points);
    if (status == OK)
        *out = points;
    else
        config_free_points(points);
    return status;
}

static Status new_points(ConfigPoints **out, const char *name) {
    TRY(NEW(*out));
    const Status status = NEW_ARRAY((*out)->name, strlen(name) + 1);
    if (status == OK)
        strcpy((*out)->name, name);
    else
        config_free_points(*out);
    return status;
}

Status config_read_points(ConfigPoints **out, const char *path, const ConfigOverrides *overrides) {
    ConfigPoints *points = NULL;
    *out = NULL;
    TRY(new_points(&points, path));
    if (overrides) points->overrides = *overrides;
    points->must_fit = true;
    const Status status = tree_read_file(path, &points->text, &points->length);
    if (status == OK) return finish_reading(out, points);
    config_free_points(points);
    return status;
}

Status config_read_points_text(ConfigPoints **out, const char *name, const char *text,
                               size_t length) {
    ConfigPoints *points = NULL;
    *out = NULL;
    TRY(new_points(&points, name));
    const Status status = NEW_ARRAY(points->text, length + 1);
    if (status != OK) {
        config_free_points(points);
        return status;
    }
    memcpy(points->text, text, length);
    points->length = length;
    return finish_reading(out, points);
}

static void write_sweep(const Sweep *sweep, Text *text) {
    if (sweep->keys > 0) text_put(text, "\nsweep:\n");
    for (size_t k = 0; k < sweep->keys; k++) {
        const SweepKey *key = &sweep->key[k];
        text_add(text, "  %s: [", key->path);
        for (size_t i = 0; i < key->count; i++) {
            text_add(text, "%s%s", i ? ", " : "", key->words[i]);
        }
        text_put(text, "]\n");
    }
}

Status config_write_points(const ConfigPoints *points, char **out) {
    Plan *plan = NULL;
    char *first = NULL;
    *out = NULL;
    TRY(config_point_plan(&plan, points, 0));
    Status status = config_write(plan, &first);
    memory_free(plan);
    if (status != OK) return status;
    Text text = {0};
    text_put(&text, first);
    memory_free(first);
    write_sweep(&points->sweep, &text);
    status = text_status(&text);
    if (status == OK)
        *out = text.bytes;
    else
        text_free(&text);
    return status;
}
