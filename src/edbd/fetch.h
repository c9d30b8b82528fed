// SPDX-License-Identifier: GPL-3.0-or-later
// Of more particles than the cache has room for: what events will need is asked for before its
// turn.
#pragma once

#include "edbd/calendar.h"

static const uint32_t FETCH_STEP = 32; // buckets between the steps of fetching ahead

// Asks memory for a line that is soon needed.
KERNEL void fetch(const void *line) {
    __builtin_prefetch(line);
}

// All of a particle that a collision reads, but whom it has for neighbours.
KERNEL void fetch_particle(const int dimension, const Engine *engine, uint32_t slot) {
    for (int a = 0; a < dimension; a++) {
        fetch(engine->now.place[a] + slot);
        fetch(engine->now.velocity[a] + slot);
        fetch(engine->list.anchor[a] + slot);
    }
    fetch(engine->radius + slot);
    fetch(engine->mass + slot);
    fetch(engine->stamp + slot);
    fetch(engine->sketch + (size_t)slot * (dimension == 2 ? ROW_2D : ROW_3D));
    fetch(engine->list.start + slot);
}

KERNEL void fetch_neighbours(const Engine *engine, uint32_t slot) {
    const uint32_t *start = engine->list.start + slot;
    for (uint32_t n = start[0]; n < start[1]; n += HALF_BLOCK) {
        fetch(engine->list.blocks + n / HALF_BLOCK);
    }
}

// What the events of a bucket need, in three steps, each of which reads what the last fetched.
KERNEL void fetch_bucket(const int dimension, const Engine *engine, uint32_t b, int step) {
    const Event *events = engine->events;
    if (step == 0) {
        fetch(events + engine->bucket[b]);
        return;
    }
    for (uint32_t e = engine->bucket[b]; e != NO_EVENT; e = events[e].next) {
        const uint32_t slots[2] = {events[e].first, events[e].second};
        for (int p = 0; p < 2; p++) {
            if (step == 1)
                fetch_particle(dimension, engine, slots[p]);
            else
                fetch_neighbours(engine, slots[p]);
        }
    }
}

// Neighbours in time are anywhere in space, and what they need in memory: asked for some buckets
// ahead, it is near when its turn comes. Buckets from b to `end` have been seen to.
KERNEL void fetch_ahead(const int dimension, const Engine *engine, uint32_t b, uint32_t end) {
    if (end + 3 * FETCH_STEP > engine->buckets) return;
    for (int step = 0; step < 3; step++) {
        const uint32_t ahead = (uint32_t)(3 - step) * FETCH_STEP;
        for (uint32_t at = b + ahead; (at = occupied_from(engine, at, end + ahead)) < end + ahead;
             at++) {
            fetch_bucket(dimension, engine, at, step);
        }
    }
}
