// SPDX-License-Identifier: GPL-3.0-or-later
// When do two particles meet? Four pairs at a time, in double precision: what decides a trajectory.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"

// Diameters at time s of the window: scale(s) = scale + rate s.
typedef struct Growth {
    double scale, rate;
} Growth;

// Four particles: virtual origins and velocities.
typedef struct Movers {
    Quad place[3], velocity[3];
} Movers;

// The gaps of four pairs as time goes on: r^2 - contact^2 = c + 2 b t + a t^2.
typedef struct Gap {
    Quad a, b, c;
} Gap;

KERNEL Movers movers_at(const int dimension, const Engine *engine, const uint32_t slot[4]) {
    Movers movers;
    for (int a = 0; a < dimension; a++) {
        movers.place[a] = quads_gather(engine->now.place[a], slot);
        movers.velocity[a] = quads_gather(engine->now.velocity[a], slot);
    }
    return movers;
}

// From particles to the nearest images of others: of their virtual origins, and of velocities.
// Of images across the edges of y, those of a sheared box move (Weysser, thesis, eqs. 2.12 to 2.14,
// with the whole strain in place of that since the last step).
KERNEL void separate(const int dimension, const int flight, const Engine *engine, const Movers *i,
                     const Movers *j, Quad r[3], Quad v[3]) {
    for (int a = 0; a < dimension; a++) {
        r[a] = i->place[a] - j->place[a];
        v[a] = i->velocity[a] - j->velocity[a];
    }
    if (flight == SHEARED) {
        const double half = engine->edge[1] / 2;
        const QuadBits above = r[1] > half, below = r[1] < -half;
        r[0] = quads_choose(above, r[0] - engine->offset,
                            quads_choose(below, r[0] + engine->offset, r[0]));
        v[0] = quads_choose(above, v[0] - engine->image_velocity,
                            quads_choose(below, v[0] + engine->image_velocity, v[0]));
    }
    for (int a = 0; a < dimension; a++) {
        const double edge = engine->edge[a];
        r[a] = quads_choose(r[a] > edge / 2, r[a] - edge,
                            quads_choose(r[a] < -edge / 2, r[a] + edge, r[a]));
    }
}

KERNEL Quad contact_of(const Engine *engine, const uint32_t i[4], const uint32_t j[4]) {
    return quads_gather(engine->radius, i) + quads_gather(engine->radius, j);
}

// From times s on.
KERNEL Gap gap_of(const int dimension, const int flight, const Engine *engine, const uint32_t i[4],
                  const uint32_t j[4], Quad s, Growth growth) {
    const Movers first = movers_at(dimension, engine, i), second = movers_at(dimension, engine, j);
    Quad r[3], v[3], r2 = {0}, rv = {0}, v2 = {0};
    separate(dimension, flight, engine, &first, &second, r, v);
    for (int a = 0; a < dimension; a++) {
        const Quad x = r[a] + v[a] * s;
        r2 = a == 0 ? x * x : r2 + x * x;
        rv = a == 0 ? x * v[a] : rv + x * v[a];
        v2 = a == 0 ? v[a] * v[a] : v2 + v[a] * v[a];
    }
    const Quad contact = contact_of(engine, i, j), contact2 = contact * contact;
    if (flight != GROWING) return (Gap){.a = v2, .b = rv, .c = r2 - contact2};
    const Quad scale = growth.scale + growth.rate * s;
    return (Gap){.a = v2 - contact2 * (growth.rate * growth.rate),
                 .b = rv - contact2 * (scale * growth.rate),
                 .c = r2 - contact2 * (scale * scale)};
}

// Does it close within `left`? Pairs that approach, and either overlap by then or have passed
// through a real contact before. A pair that overlaps already and approaches meets now; one that
// overlaps and recedes is left to do so. With growth a pair may also meet without approaching.
KERNEL QuadBits gap_closes(const int flight, const Gap *gap, Quad left) {
    const Quad end = gap->b + gap->a * left;
    const QuadBits approaching = gap->b < 0;
    const QuadBits overlaps = gap->c + left * (gap->b + end) < 0;
    const QuadBits turned = (0 < end) & (gap->a * gap->c < gap->b * gap->b);
    if (flight != GROWING) return approaching & (overlaps | turned);
    return (approaching | (0 < gap->c)) & (overlaps | (turned & approaching));
}

// How long until a closing gap is closed; this form of the root does not cancel.
KERNEL Quad gap_time(const Gap *gap) {
    const Quad zero = {0}, square = gap->b * gap->b - gap->a * gap->c;
    const Quad root = quads_sqrt(quads_choose(square > 0, square, zero));
    const Quad time = gap->c / (root - gap->b);
    return quads_choose(time > 0, time, zero);
}

// When do four pairs meet, from times s on? INFINITY: not in this window.
KERNEL Quad meeting_times(const int dimension, const int flight, const Engine *engine,
                          const uint32_t i[4], const uint32_t j[4], Quad s, Growth growth) {
    const Gap gap = gap_of(dimension, flight, engine, i, j, s, growth);
    const QuadBits closes = gap_closes(flight, &gap, engine->settings.window - s);
    const Quad never = {INFINITY, INFINITY, INFINITY, INFINITY};
    return quads_choose(closes, s + gap_time(&gap), never);
}
