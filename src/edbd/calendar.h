// SPDX-License-Identifier: GPL-3.0-or-later
// The events of a window, in buckets by time. Nothing of their order in memory shows in a result.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"

KERNEL uint32_t bucket_at(const Engine *engine, double time) {
    const double slice = time * engine->buckets_per_time;
    const uint32_t last = engine->buckets - 1;
    return slice < last ? (uint32_t)slice : last;
}

// Buckets that hold somebody have their bit set; the heads of others mean nothing.
KERNEL void event_link(Engine *engine, uint32_t number) {
    Event *event = &engine->events[number];
    const uint32_t b = bucket_at(engine, event->time);
    const uint64_t there = engine->occupied[b / BITS];
    event->next = engine->bucket[b] | (there >> b % BITS & 1 ? 0 : NO_EVENT);
    engine->occupied[b / BITS] = there | (uint64_t)1 << b % BITS;
    engine->bucket[b] = number;
}

KERNEL void event_put(Engine *engine, double time, uint32_t first, uint32_t second) {
    if (engine->events_used == engine->event_capacity) {
        engine->outgrown = 1;
        return;
    }
    const uint32_t number = engine->events_used++;
    engine->events[number] = (Event){.time = time,
                                     .first = first,
                                     .second = second,
                                     .stamps = engine->stamp[first] + engine->stamp[second]};
    event_link(engine, number);
}

KERNEL void event_drop(Engine *engine, uint32_t *link) {
    *link = engine->events[*link].next;
}

KERNEL int event_is_void(const Engine *engine, const Event *event) {
    return event->stamps != engine->stamp[event->first] + engine->stamp[event->second];
}

// (time, lower id, higher id): an order that memory has no part in.
KERNEL int event_before(const Engine *engine, const Event *a, const Event *b) {
    if (a->time != b->time) return a->time < b->time;
    const uint32_t p = engine->id[a->first], q = engine->id[a->second];
    const uint32_t s = engine->id[b->first], t = engine->id[b->second];
    const uint32_t low_a = p < q ? p : q, low_b = s < t ? s : t;
    if (low_a != low_b) return low_a < low_b;
    return (p < q ? q : p) < (s < t ? t : s);
}

// The link to the earliest event of a bucket that still stands, or NULL. Void ones are dropped if
// they are so for good.
KERNEL uint32_t *earliest(Engine *engine, uint32_t *bucket, int for_good) {
    uint32_t *best = NULL;
    for (uint32_t *link = bucket; *link != NO_EVENT;) {
        const Event *event = &engine->events[*link];
        const int is_void = event_is_void(engine, event);
        if (is_void && for_good) {
            event_drop(engine, link);
            continue;
        }
        if (!is_void && (!best || event_before(engine, event, &engine->events[*best]))) best = link;
        link = &engine->events[*link].next;
    }
    return best;
}

// The first bucket from b on that holds somebody, or `end`.
KERNEL uint32_t occupied_from(const Engine *engine, uint32_t b, uint32_t end) {
    while (b < end) {
        const uint64_t bits = engine->occupied[b / BITS] >> b % BITS;
        if (bits) {
            b += (uint32_t)__builtin_ctzll(bits);
            return b < end ? b : end;
        }
        b = (b / BITS + 1) * BITS;
    }
    return end;
}
