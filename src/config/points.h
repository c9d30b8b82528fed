// SPDX-License-Identifier: GPL-3.0-or-later
// `sweep:` in the tree of a run file. Inside config/ only.
#pragma once

#include "config/config.h"
#include "config/tree.h"

typedef struct Sweep {
    size_t keys;
    SweepKey key[SWEEP_KEYS_MOST];
} Sweep; // {0} sweeps nothing

// The sweep of a run file, checked for itself; nothing where there is none.
Status sweep_read(Sweep *sweep, const Node *root);
void sweep_free(Sweep *sweep);
size_t sweep_points(const Sweep *sweep);
void sweep_indices(const Sweep *sweep, size_t point, size_t index[SWEEP_KEYS_MOST]);

// A plan from the text of a run file, for this machine if it must fit it.
Status config_read_plan(Plan **out, const char *name, const char *text, size_t length,
                        const ConfigOverrides *overrides, bool must_fit);

// Puts the values of a point, counted from 1, in their places. 0: there must be no sweep.
Status sweep_choose(Node *root, size_t point);
