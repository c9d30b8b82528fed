// SPDX-License-Identifier: GPL-3.0-or-later
// Trials of a pulled ball: one in as many as there are particles, so they go by the rules alone,
// without lists.
#include "dmc/balls.h"

#include <math.h>

static double rise_in_kt(const Balls *balls, uint32_t i, const uint32_t to[4]) {
    if (!balls->soft) return balls_overlap_anywhere(balls, i, to) ? INFINITY : 0;
    const int64_t rise =
        balls_energy_anywhere(balls, i, to) - balls_energy_anywhere(balls, i, balls->ball[i].place);
    return (double)rise / ENERGY_UNITS;
}

static void carry_out(Balls *balls, uint32_t i, const uint32_t to[4], const int64_t move[3]) {
    Ball *ball = &balls->ball[i];
    for (int a = 0; a < 3; a++) {
        const int64_t edges = (int64_t)ball->place[a] + move[a] - (int64_t)to[a];
        ball->image[a] += (int32_t)(edges >> 32);
        ball->place[a] = to[a];
        if (balls->soft) balls->column[a][i] = to[a];
    }
    const uint64_t radius = balls->coarse[i] & 0xffffull << 48;
    balls->coarse[i] = balls_coarse(to) | radius;
}

static bool has_left_anchor(const Balls *balls, const Ball *ball) {
    static const double SURE = 0.9999; // of single precision
    return balls_distance2(balls, ball->place, ball->anchor) >= SURE * (double)balls->leash2;
}

bool balls_pull_trial(Balls *balls, int64_t trial, MoveTally *moves) {
    const uint32_t i = (uint32_t)balls->pull.particle;
    const Ball *ball = &balls->ball[i];
    const PullTrial drawn = pull_trial(&balls->pull, balls->key, trial, balls->dimension);
    _Alignas(16) uint32_t to[4] = {0};
    int64_t move[3] = {0};
    MoveTally *tally = &moves[ball->species];
    for (int a = 0; a < balls->dimension; a++) {
        move[a] = (int64_t)rint(drawn.shift[a] / balls->unit[a]);
        to[a] = ball->place[a] + (uint32_t)move[a];
    }
    const double rise = rise_in_kt(balls, i, to);
    tally->trials++;
    tally->unhindered += rise <= drawn.thermal;
    if (rise > drawn.afforded) return true;
    tally->accepted++;
    tally->parallel += drawn.shift[0] * drawn.shift[0];
    tally->perpendicular += drawn.shift[1] * drawn.shift[1] + drawn.shift[2] * drawn.shift[2];
    carry_out(balls, i, to, move);
    return !has_left_anchor(balls, ball) || balls_refresh(balls, i);
}
