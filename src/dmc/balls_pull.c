// SPDX-License-Identifier: GPL-3.0-or-later
// Trials of a pulled ball: one in as many as there are particles, so they go by the rules alone,
// without lists.
#include "dmc/balls.h"

#include <math.h>

static double rise_in_kt(const Balls *balls, uint32_t i, const uint32_t to[3]) {
    if (!balls->soft) return balls_overlap_anywhere(balls, i, to) ? INFINITY : 0;
    uint32_t from[3];
    balls_fractions(balls->ball[i].place, from);
    const int64_t rise =
        balls_energy_anywhere(balls, i, to) - balls_energy_anywhere(balls, i, from);
    return (double)rise / ENERGY_UNITS;
}

static void carry_out(Balls *balls, uint32_t i, const uint32_t to[3], const int64_t move[3]) {
    const uint64_t radius = balls->coarse[i] & 0xffffull << 48;
    for (int a = 0; a < 3; a++) balls->ball[i].place[a] += move[a];
    balls->coarse[i] = balls_coarse(to) | radius;
}

bool balls_pull_trial(Balls *balls, int64_t trial, MoveTally *moves) {
    const uint32_t i = (uint32_t)balls->pull.particle;
    const Ball *ball = &balls->ball[i];
    const PullTrial drawn = pull_trial(&balls->pull, balls->key, trial, balls->dimension);
    uint32_t to[3] = {0};
    int64_t move[3] = {0};
    MoveTally *tally = &moves[ball->species];
    for (int a = 0; a < balls->dimension; a++) {
        move[a] = (int64_t)rint(drawn.shift[a] / balls->unit[a]);
        to[a] = (uint32_t)(ball->place[a] + move[a]);
    }
    const double rise = rise_in_kt(balls, i, to);
    tally->trials++;
    tally->unhindered += rise <= drawn.thermal;
    if (rise > drawn.afforded) return true;
    tally->accepted++;
    tally->parallel += drawn.shift[0] * drawn.shift[0];
    tally->perpendicular += drawn.shift[1] * drawn.shift[1] + drawn.shift[2] * drawn.shift[2];
    carry_out(balls, i, to, move);
    return !balls_leaves_anchor(balls, i, to) || balls_refresh(balls, i);
}
