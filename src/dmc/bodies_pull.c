// SPDX-License-Identifier: GPL-3.0-or-later
// Trials of a pulled sphere among bodies with an axis: one in as many as there are particles.
#include "dmc/bodies.h"

#include "dmc/bodies_move.h"

void bodies_pull_trial(Bodies *bodies, int64_t trial, MoveTally *moves) {
    const size_t i = bodies->pull.particle;
    const PullTrial drawn = pull_trial(&bodies->pull, bodies->key, trial, 3);
    const Pose before = bodies->pose[i];
    MoveTally *tally = &moves[bodies->state->species_of[i]];
    for (int a = 0; a < 3; a++) {
        bodies->pose[i].place[a] += bodies_whole(drawn.shift[a] * bodies->units_per_d[a]);
    }
    bodies->row[i] = bodies_row(bodies, i);
    const bool free = !bodies->kernel->overlaps(bodies, i);
    tally->trials++;
    tally->unhindered += free;
    if (free && drawn.afforded >= 0) {
        tally->accepted++;
        tally->parallel += drawn.shift[0] * drawn.shift[0];
        tally->perpendicular += drawn.shift[1] * drawn.shift[1] + drawn.shift[2] * drawn.shift[2];
        bodies->kernel->anchor(bodies, i);
        return;
    }
    bodies->pose[i] = before;
    bodies->row[i] = bodies_row(bodies, i);
}
