// SPDX-License-Identifier: GPL-3.0-or-later
// One window of event-driven dynamics: predict all collisions in it, carry them out in order,
// move to its end. Compiled once per instruction set; dimension and flight are folded constants.
//
// Every particle has a virtual origin X: its place at time s of the window is X + v s. A collision
// at s that changes v by k changes X by -k s, so no particle needs a clock of its own.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"
#include "edbd/list_kernel.h"
#include "edbd/sketch.h"

#include <string.h>

static const uint32_t COLLISIONS_MOST = 1000; // of one particle in one window: it hangs
static const double CONTACT_DEPTH = 1e-12;    // deeper overlaps at a collision are counted
static const uint32_t FETCH_STEP = 4;         // buckets between the steps of fetching ahead

// Diameters at time s of the window: scale(s) = scale + rate s.
typedef struct Growth {
    double scale, rate;
} Growth;

// The gap of a pair as time goes on: r^2 - contact^2 = c + 2 b t + a t^2.
typedef struct Gap {
    double a, b, c;
} Gap;

KERNEL double nearest(double r, double edge) {
    return r > edge / 2 ? r - edge : r < -edge / 2 ? r + edge : r;
}

// From one particle to the nearest image of another: of their virtual origins, and of velocities.
// Of images across the edges of y, those of a sheared box move (Weysser, thesis, eqs. 2.12 to 2.14,
// with the whole strain in place of that since the last step).
KERNEL void separate(const int dimension, const int flight, const Engine *engine, uint32_t i,
                     uint32_t j, double r[3], double v[3]) {
    const Motion *now = &engine->now;
    for (int a = 0; a < dimension; a++) {
        r[a] = now->place[a][i] - now->place[a][j];
        v[a] = now->velocity[a][i] - now->velocity[a][j];
    }
    if (flight == SHEARED) {
        const double half = engine->edge[1] / 2;
        if (__builtin_expect((r[1] > half) | (r[1] < -half), 0)) {
            r[0] -= r[1] > 0 ? engine->offset : -engine->offset;
            v[0] -= r[1] > 0 ? engine->image_velocity : -engine->image_velocity;
        }
    }
    for (int a = 0; a < dimension; a++) r[a] = nearest(r[a], engine->edge[a]);
}

// From time s on.
KERNEL Gap gap_of(const int dimension, const int flight, const Engine *engine, uint32_t i,
                  uint32_t j, double s, Growth growth) {
    double r[3], v[3], r2 = 0, rv = 0, v2 = 0;
    separate(dimension, flight, engine, i, j, r, v);
    for (int a = 0; a < dimension; a++) {
        const double x = r[a] + v[a] * s;
        r2 = a == 0 ? x * x : r2 + x * x;
        rv = a == 0 ? x * v[a] : rv + x * v[a];
        v2 = a == 0 ? v[a] * v[a] : v2 + v[a] * v[a];
    }
    const double contact = engine->radius[i] + engine->radius[j], contact2 = contact * contact;
    if (flight != GROWING) return (Gap){.a = v2, .b = rv, .c = r2 - contact2};
    const double scale = growth.scale + growth.rate * s;
    return (Gap){.a = v2 - contact2 * (growth.rate * growth.rate),
                 .b = rv - contact2 * (scale * growth.rate),
                 .c = r2 - contact2 * (scale * scale)};
}

// Does it close within `left`? Pairs that approach, and either overlap by then or have passed
// through a real contact before. A pair that overlaps already and approaches meets now; one that
// overlaps and recedes is left to do so. With growth a pair may also meet without approaching.
KERNEL int gap_closes(const int flight, Gap gap, double left) {
    const double end = gap.b + gap.a * left;
    const int approaching = gap.b < 0;
    const int overlaps = gap.c + left * (gap.b + end) < 0;
    const int turned = (0 < end) & (gap.a * gap.c < gap.b * gap.b);
    if (flight != GROWING) return approaching & (overlaps | turned);
    return (approaching | (0 < gap.c)) & (overlaps | (turned & approaching));
}

// How long until a closing gap is closed; this form of the root does not cancel.
KERNEL double gap_time(Gap gap) {
    const double square = gap.b * gap.b - gap.a * gap.c;
    const double time = gap.c / (sqrt(square > 0 ? square : 0) - gap.b);
    return time > 0 ? time : 0;
}

KERNEL uint32_t bucket_at(const Engine *engine, double time) {
    const double slice = time * engine->buckets_per_time;
    const uint32_t last = engine->buckets - 1;
    return slice < last ? (uint32_t)slice : last;
}

KERNEL void event_link(Engine *engine, uint32_t number) {
    Event *event = &engine->events[number];
    uint32_t *bucket = &engine->bucket[bucket_at(engine, event->time)];
    event->next = *bucket;
    *bucket = number;
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

// A pair becomes an event if it meets between time s and the end of the window: when, or never.
KERNEL double predict(const int dimension, const int flight, Engine *engine, uint32_t i, uint32_t j,
                      double s, Growth growth) {
    const Gap gap = gap_of(dimension, flight, engine, i, j, s, growth);
    if (!gap_closes(flight, gap, engine->settings.window - s)) return INFINITY;
    const double time = s + gap_time(gap);
    event_put(engine, time, i, j);
    return time;
}

KERNEL void predict_all(const int dimension, const int flight, Engine *engine, Growth growth,
                        const Sieve *sieve) {
    const NeighbourList *list = &engine->list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    size_t hits = 0;
    for (size_t p = 0; p < list->near; p += WIDE) {
        const uint32_t *first = list->near_first + p, *second = list->near_second + p;
        const Rows i = {engine->sketch, {first, first + HALF}, 1};
        const Rows j = {engine->sketch, {second, second + HALF}, 1};
        const Wides contact2 = *(const Wides *)(list->near_contact2 + p);
        const unsigned bits = may_meet(dimension, flight == SHEARED, sieve, &i, &j, contact2, NULL);
        wides_pack_u32(list->hit_first + hits, bits, first);
        wides_pack_u32(list->hit_second + hits, bits, second);
        hits += (unsigned)__builtin_popcount(bits);
    }
    for (size_t h = 0; h < hits; h++) {
        predict(dimension, flight, engine, list->hit_first[h] / row, list->hit_second[h] / row, 0,
                growth);
    }
}

// The displacement of a particle from its anchor, which goes with the flow: at a place on its way,
// at time t.
KERNEL void watch(const int dimension, const int flight, Engine *engine, uint32_t slot,
                  const double place[3], double t) {
    double d2 = 0;
    for (int a = 0; a < dimension; a++) {
        double d = place[a] - engine->list.anchor[a][slot];
        if (flight == SHEARED && a == 0) d -= (engine->list.strain + engine->rate * t) * place[1];
        d2 += d * d;
    }
    if (d2 > engine->list.farthest2) engine->list.farthest2 = d2;
}

KERNEL void record(const Engine *engine, const Event *event) {
    CollisionLog *log = engine->log;
    const uint32_t p = engine->id[event->first], q = engine->id[event->second];
    if (log->count < log->capacity) {
        log->records[log->count] = (CollisionRecord){.low = p < q ? p : q,
                                                     .high = p < q ? q : p,
                                                     .step = engine->state->step,
                                                     .window = engine->window,
                                                     .time = event->time};
    }
    log->count++;
}

KERNEL void count_overlap(Engine *engine, double r2, double contact2) {
    if (r2 >= contact2 * (1 - 2 * CONTACT_DEPTH)) return;
    const double depth = 1 - sqrt(r2 / contact2);
    engine->tally.corrected++;
    if (depth > engine->tally.deepest_contact) engine->tally.deepest_contact = depth;
}

// A particle changes its velocity by k r at time t, and its virtual origin to match.
KERNEL void kick(const int dimension, const Engine *engine, uint32_t slot, double k,
                 const double r[3], double t) {
    double place[3], velocity[3];
    for (int a = 0; a < dimension; a++) {
        const double change = k * r[a];
        place[a] = engine->now.place[a][slot] - change * t;
        velocity[a] = engine->now.velocity[a][slot] + change;
        engine->now.place[a][slot] = place[a];
        engine->now.velocity[a][slot] = velocity[a];
    }
    sketch_one(dimension, engine, slot, place, velocity);
}

// Sums of r_a r_c over collisions, weighted by momentum: xx xy yy in 2D; xx xy xz yy, yz zz in 3D.
typedef struct Exchange {
    Quad low, high;
} Exchange;

KERNEL void exchange_add(const int dimension, Exchange *sums, const double r[3], double momentum) {
    const Quad weight = {momentum, momentum, momentum, momentum};
    if (dimension == 2) {
        sums->low += weight * ((Quad){r[0], r[0], r[1], 0} * (Quad){r[0], r[1], r[1], 0});
        return;
    }
    sums->low += weight * ((Quad){r[0], r[0], r[0], r[1]} * (Quad){r[0], r[1], r[2], r[1]});
    sums->high += weight * ((Quad){r[1], r[2], 0, 0} * (Quad){r[2], r[2], 0, 0});
}

KERNEL Exchange exchange_open(const int dimension, const Tally *tally) {
    const double(*sum)[3] = tally->exchange;
    if (dimension == 2) return (Exchange){.low = {sum[0][0], sum[0][1], sum[1][1], 0}};
    return (Exchange){.low = {sum[0][0], sum[0][1], sum[0][2], sum[1][1]},
                      .high = {sum[1][2], sum[2][2], 0, 0}};
}

KERNEL void exchange_close(const int dimension, const Exchange *sums, Tally *tally) {
    double(*sum)[3] = tally->exchange;
    sum[0][0] = sums->low[0];
    sum[0][1] = sum[1][0] = sums->low[1];
    sum[1][1] = sums->low[dimension == 2 ? 2 : 3];
    if (dimension == 2) return;
    sum[0][2] = sum[2][0] = sums->low[2];
    sum[1][2] = sum[2][1] = sums->high[0];
    sum[2][2] = sums->high[1];
}

// A collision that was carried out: what it changed, and whom its partners may meet after it.
typedef struct Outcome {
    uint32_t number; // of the event, of which this is a copy
    Event event;
    double place[2][3], velocity[2][3]; // before it
    double r[3], momentum;              // between the partners, exchanged along r
    double r2, contact2;
    uint32_t *may_meet; // a bit for each neighbour, in blocks of those of both
    uint32_t blocks;    // 0: nobody is left to be looked at
} Outcome;

KERNEL uint32_t partner(const Outcome *outcome, int p) {
    return p == 0 ? outcome->event.first : outcome->event.second;
}

// How a partner comes to it, and how far it got.
KERNEL void remember(const int dimension, const int flight, Engine *engine, Outcome *outcome,
                     int p) {
    const uint32_t slot = partner(outcome, p);
    const double t = outcome->event.time;
    double place[3];
    for (int a = 0; a < dimension; a++) {
        outcome->place[p][a] = engine->now.place[a][slot];
        outcome->velocity[p][a] = engine->now.velocity[a][slot];
        place[a] = outcome->place[p][a] + outcome->velocity[p][a] * t;
    }
    watch(dimension, flight, engine, slot, place, t);
}

// The elastic collision (Weysser, thesis, eq. 2.5, divided by r^2 as it must be): momentum
// -2 m_i m_j/(m_i + m_j) b r/r^2 goes to i, its mirror image to j; r = r_i - r_j, b = r.v.
KERNEL void collide(const int dimension, const int flight, Engine *engine, Growth growth,
                    Outcome *outcome) {
    const uint32_t slots[2] = {partner(outcome, 0), partner(outcome, 1)};
    const double t = outcome->event.time;
    double r[3], v[3], r2 = 0, b = 0;
    separate(dimension, flight, engine, slots[0], slots[1], r, v);
    for (int a = 0; a < dimension; a++) {
        r[a] += v[a] * t;
        r2 = a == 0 ? r[a] * r[a] : r2 + r[a] * r[a];
        b = a == 0 ? r[a] * v[a] : b + r[a] * v[a];
        outcome->r[a] = r[a];
    }
    const double scale = flight == GROWING ? growth.scale + growth.rate * t : 1;
    const double contact = (engine->radius[slots[0]] + engine->radius[slots[1]]) * scale;
    if (flight == GROWING) b -= contact * contact / scale * growth.rate;

    const double mass[2] = {engine->mass[slots[0]], engine->mass[slots[1]]};
    const double k = -2 * b / (r2 * (mass[0] + mass[1]));
    for (int p = 0; p < 2; p++) {
        remember(dimension, flight, engine, outcome, p);
        kick(dimension, engine, slots[p], p == 0 ? k * mass[1] : -(k * mass[0]), r, t);
        engine->stamp[slots[p]]++;
    }
    outcome->momentum = k * mass[1] * mass[0];
    outcome->r2 = r2;
    outcome->contact2 = contact * contact;
}

// A collision that stands.
KERNEL void count_collision(const int dimension, Engine *engine, const Outcome *outcome,
                            Exchange *sums) {
    exchange_add(dimension, sums, outcome->r, outcome->momentum);
    count_overlap(engine, outcome->r2, outcome->contact2);
    engine->tally.collisions++;
    if (engine->log) record(engine, &outcome->event);
    if (engine->stamp[outcome->event.first] > COLLISIONS_MOST ||
        engine->stamp[outcome->event.second] > COLLISIONS_MOST)
        engine->hung = 1;
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

// The link to the earliest event of a bucket that still stands, or NULL; drops the void ones.
KERNEL uint32_t *earliest(Engine *engine, uint32_t *bucket) {
    uint32_t *best = NULL;
    for (uint32_t *link = bucket; *link != NO_EVENT;) {
        const Event *event = &engine->events[*link];
        if (event_is_void(engine, event)) {
            engine->tally.stale++;
            event_drop(engine, link);
            continue;
        }
        if (!best || event_before(engine, event, &engine->events[*best])) best = link;
        link = &engine->events[*link].next;
    }
    return best;
}

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

// Neighbours in time are anywhere in space, and what they need in memory: asked for some buckets
// ahead, it is near when its turn comes. In three steps, each of which reads what the last fetched.
KERNEL void fetch_ahead(const int dimension, const Engine *engine, uint32_t b) {
    const Event *events = engine->events;
    if (b + 3 * FETCH_STEP >= engine->buckets) return;
    const uint32_t *soon = engine->bucket + b + FETCH_STEP;
    if (soon[2 * FETCH_STEP] != NO_EVENT) fetch(events + soon[2 * FETCH_STEP]);
    for (uint32_t e = soon[FETCH_STEP]; e != NO_EVENT; e = events[e].next) {
        fetch_particle(dimension, engine, events[e].first);
        fetch_particle(dimension, engine, events[e].second);
    }
    for (uint32_t e = soon[0]; e != NO_EVENT; e = events[e].next) {
        fetch_neighbours(engine, events[e].first);
        fetch_neighbours(engine, events[e].second);
    }
}

// The number of the earliest event from bucket b on, which is taken out, or NO_EVENT.
KERNEL uint32_t take_earliest(const int dimension, Engine *engine, uint32_t *b) {
    for (; *b < engine->buckets; ++*b) {
        uint32_t *link = earliest(engine, &engine->bucket[*b]);
        if (!link) {
            if (engine->fetches) fetch_ahead(dimension, engine, *b);
            continue;
        }
        const uint32_t number = *link;
        event_drop(engine, link);
        return number;
    }
    return NO_EVENT;
}

// As if the collision had not been; it is an event again.
KERNEL void take_back(const int dimension, Engine *engine, const Outcome *outcome) {
    for (int p = 0; p < 2; p++) {
        const uint32_t slot = partner(outcome, p);
        for (int a = 0; a < dimension; a++) {
            engine->now.place[a][slot] = outcome->place[p][a];
            engine->now.velocity[a][slot] = outcome->velocity[p][a];
        }
        sketch_one(dimension, engine, slot, outcome->place[p], outcome->velocity[p]);
        engine->stamp[slot]--;
    }
    event_link(engine, outcome->number);
}

// Of the neighbour with this number; steps of whole blocks always find 0.
KERNEL uint32_t place_in_block(uint32_t n) {
    return (int)HALF < (int)HALF_BLOCK ? n % HALF_BLOCK : 0;
}

// Whom may the partners meet in the rest of the window? The neighbours of both are tested at once,
// those of one in each half of a register.
KERNEL void look_round(const int dimension, const int flight, const Engine *engine,
                       const Sieve *sieve, Outcome *outcome) {
    const NeighbourList *list = &engine->list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D, none = list->start[engine->count];
    const uint32_t slots[2] = {partner(outcome, 0), partner(outcome, 1)};
    const uint32_t own[2] = {slots[0] * row, slots[1] * row};
    const float gone = (float)(outcome->event.time * engine->half_per_window);
    const Rows i = {engine->sketch, {&own[0], &own[1]}, 0};
    uint32_t at[2] = {list->start[slots[0]], list->start[slots[1]]};
    const uint32_t end[2] = {list->start[slots[0] + 1], list->start[slots[1] + 1]};
    uint32_t blocks = 0;
    for (; at[0] < end[0] || at[1] < end[1]; at[0] += HALF, at[1] += HALF) {
        const uint32_t *rows[2];
        const float *contact2[2];
        for (int p = 0; p < 2; p++) {
            const uint32_t n = at[p] < end[p] ? at[p] : none;
            rows[p] = list->blocks[n / HALF_BLOCK].row + place_in_block(n);
            contact2[p] = list->blocks[n / HALF_BLOCK].contact2 + place_in_block(n);
        }
        const Rows j = {engine->sketch, {rows[0], rows[1]}, 1};
        outcome->may_meet[blocks++] = may_meet(dimension, flight == SHEARED, sieve, &i, &j,
                                               wides_load_halves(contact2[0], contact2[1]), &gone);
    }
    outcome->blocks = blocks;
}

// Is a slot a partner of this one?
KERNEL int takes_part(const Outcome *outcome, uint32_t slot) {
    return (slot == outcome->event.first) | (slot == outcome->event.second);
}

// The events that follow from a collision. The one after it, if any, was carried out meanwhile:
// does it stand? It is taken back where an event comes before it, and where one of its partners is
// among those that are to be looked at as they were.
KERNEL int follow(const int dimension, const int flight, Engine *engine, Growth growth,
                  Outcome *outcome, const Outcome *next) {
    const NeighbourList *list = &engine->list;
    const uint32_t shift = dimension == 2 ? 2 : 3;
    int stands = next->number != NO_EVENT;
    for (uint32_t block = 0; block < outcome->blocks; block++) {
        for (unsigned bits = outcome->may_meet[block]; bits; bits &= bits - 1) {
            const int k = __builtin_ctz(bits);
            const uint32_t i = partner(outcome, k / HALF);
            const uint32_t n = list->start[i] + block * HALF + (uint32_t)k % HALF;
            const uint32_t j = list->blocks[n / HALF_BLOCK].row[n % HALF_BLOCK] >> shift;
            const int disturbed = stands && takes_part(next, j);
            if (disturbed) take_back(dimension, engine, next);
            const double time =
                predict(dimension, flight, engine, i, j, outcome->event.time, growth);
            const int overtaken = stands && !disturbed && time <= next->event.time;
            if (overtaken) take_back(dimension, engine, next);
            if (disturbed | overtaken) stands = 0;
        }
    }
    outcome->blocks = 0;
    return stands;
}

// In order, but what follows from a collision is found out while the next one is on its way: the
// processor would otherwise have to guess whether anything does, and wait for the answer. That one
// is almost always right, and else taken back.
KERNEL void carry_out(const int dimension, const int flight, Engine *engine, Growth growth,
                      const Sieve *sieve) {
    Exchange sums = exchange_open(dimension, &engine->tally);
    Outcome outcomes[2] = {{.may_meet = engine->list.hit_first},
                           {.may_meet = engine->list.hit_second}};
    Outcome *last = &outcomes[0], *next = &outcomes[1];
    for (uint32_t b = 0; !engine->hung;) {
        next->number = take_earliest(dimension, engine, &b);
        if (next->number == NO_EVENT && last->blocks == 0) break;
        if (next->number != NO_EVENT) {
            next->event = engine->events[next->number];
            collide(dimension, flight, engine, growth, next);
            look_round(dimension, flight, engine, sieve, next);
        }
        if (follow(dimension, flight, engine, growth, last, next)) {
            count_collision(dimension, engine, next, &sums);
            Outcome *const other = last;
            last = next;
            next = other;
        } else {
            b = bucket_at(engine, last->event.time);
        }
    }
    exchange_close(dimension, &sums, &engine->tally);
}

// Back into [0, edge); the anchor goes along, for the distance to it must not jump.
KERNEL void fold_axis(const Engine *engine, uint32_t slot, int axis) {
    const double edge = engine->edge[axis];
    double *place = engine->now.place[axis] + slot, *anchor = engine->list.anchor[axis] + slot;
    int32_t *image = &engine->state->image[axis][engine->id[slot]];
    if (*place < 0) {
        *place += edge;
        *anchor += edge;
        --*image;
    }
    if (*place >= edge) { // also after a tiny negative number was rounded to the edge
        *place -= edge;
        *anchor -= edge;
        ++*image;
    }
}

// Whoever leaves a sheared box across y comes back displaced and with the velocity of the image.
// Image counts along x take the whole turns, so that the unfolded place does not jump.
KERNEL void fold_sheared(const Engine *engine, uint32_t slot) {
    int32_t *image_x = &engine->state->image[0][engine->id[slot]];
    const int32_t *image_y = &engine->state->image[1][engine->id[slot]], before = *image_y;
    fold_axis(engine, slot, 1);
    const int32_t up = *image_y - before;
    if (up == 0) return;
    engine->now.place[0][slot] -= up * engine->offset;
    engine->now.velocity[0][slot] -= up * engine->image_velocity;
    engine->list.anchor[0][slot] -= up * (engine->offset - engine->list.strain * engine->edge[1]);
    *image_x -= up * engine->turns;
}

// Those of the particles from `slot` on whose bits are set.
KERNEL void fold(const int dimension, const int flight, const Engine *engine, uint32_t slot,
                 unsigned bits) {
    for (; bits; bits &= bits - 1) {
        const uint32_t stray = slot + (uint32_t)__builtin_ctz(bits);
        if (flight == SHEARED) fold_sheared(engine, stray);
        for (int a = 0; a < dimension; a++) fold_axis(engine, stray, a);
    }
}

// LANES particles from `slot` on to the end of the window; the bits of those who left the box.
KERNEL unsigned move(const int dimension, const int flight, const Engine *engine, uint32_t slot,
                     Lanes *farthest2) {
    const double w = engine->settings.window;
    Lanes place[3], away2 = {0};
    unsigned strays = 0;
    for (int a = 0; a < dimension; a++) {
        place[a] = lanes_load(engine->now.place[a] + slot) +
                   lanes_load(engine->now.velocity[a] + slot) * w;
        lanes_store(engine->now.place[a] + slot, place[a]);
        strays |= lanes_outside(place[a], engine->edge[a]);
    }
    for (int a = 0; a < dimension; a++) {
        Lanes away = place[a] - lanes_load(engine->list.anchor[a] + slot);
        if (flight == SHEARED && a == 0) away -= place[1] * engine->list.strain;
        away2 = a == 0 ? away * away : away2 + away * away;
    }
    *farthest2 = lanes_larger(*farthest2, away2);
    return strays;
}

// LANES particles from `slot` on as they enter the next window: with a velocity from a Gaussian of
// variance kT/m per direction (Weysser, thesis, eq. 2.7, corrected), about that of the flow, where
// they are drawn anew.
KERNEL Lanes velocity_drawn(const int flight, const Engine *engine, uint32_t slot, int axis) {
    Lanes velocity = lanes_widen(engine->normals[axis] + slot) * lanes_load(engine->thermal + slot);
    if (flight == SHEARED && axis == 0)
        velocity += lanes_load(engine->now.place[1] + slot) * engine->next_rate;
    lanes_store(engine->now.velocity[axis] + slot, velocity);
    return velocity;
}

// WIDE particles from `slot` on.
KERNEL void open_block(const int dimension, const int flight, const int redraw,
                       const Engine *engine, uint32_t slot) {
    const double w = engine->settings.window;
    Wides now[3], then[3];
    for (int a = 0; a < dimension; a++) {
        Lanes place[2], velocity[2];
        for (uint32_t k = 0; k < 2; k++) {
            const uint32_t at = slot + LANES * k;
            place[k] = lanes_load(engine->now.place[a] + at);
            velocity[k] = redraw ? velocity_drawn(flight, engine, at, a)
                                 : lanes_load(engine->now.velocity[a] + at);
        }
        now[a] = wides_narrow(place[0], place[1]);
        then[a] = wides_narrow(place[0] + velocity[0] * (2 * w), place[1] + velocity[1] * (2 * w));
    }
    sketch_put(dimension, engine, slot, now, then);
}

// Out of this window and into the next one.
KERNEL void move_all(const int dimension, const int flight, const int redraw, Engine *engine) {
    const uint32_t slots = (uint32_t)engine->slots;
    Lanes farthest2 = {0};
    for (uint32_t slot = 0; slot < slots; slot += WIDE) {
        unsigned strays = move(dimension, flight, engine, slot, &farthest2);
        strays |= move(dimension, flight, engine, slot + LANES, &farthest2) << LANES;
        if (__builtin_expect(strays != 0, 0)) fold(dimension, flight, engine, slot, strays);
        open_block(dimension, flight, redraw, engine, slot);
    }
    for (int k = 0; k < LANES; k++) {
        if (farthest2[k] > engine->list.farthest2) engine->list.farthest2 = farthest2[k];
    }
}

// The images above move on for a window.
KERNEL void shear(Engine *engine) {
    Box *box = &engine->state->box;
    box_shear(box, engine->image_velocity * engine->settings.window);
    engine->offset = box->offset;
    engine->turns = (int32_t)box->turns;
    engine->list.strain += engine->rate * engine->settings.window;
}

// Works on a copy of the engine's own fields: what is written to rows and lists cannot be it, so
// they stay in registers.
KERNEL void run(const int dimension, const int flight, Engine *engine) {
    Engine own = *engine;
    const Growth growth = {.scale = own.scale, .rate = own.growth};
    own.events_used = 0;
    memset(own.stamp, 0, own.slots * sizeof *own.stamp);
    memset(own.bucket, 0xff, own.buckets * sizeof *own.bucket);
    const Sieve sieve = sieve_of(dimension, flight == SHEARED, &own);
    predict_all(dimension, flight, &own, growth, &sieve);
    carry_out(dimension, flight, &own, growth, &sieve);
    if (flight == SHEARED) shear(&own);
    if (own.redraw)
        move_all(dimension, flight, 1, &own);
    else
        move_all(dimension, flight, 0, &own);
    *engine = own;
}

// What a window begins with, where there is none before it.
KERNEL void open_flight(const int dimension, const int flight, const int redraw,
                        const Engine *engine) {
    for (uint32_t slot = 0; slot < engine->slots; slot += WIDE) {
        open_block(dimension, flight, redraw, engine, slot);
    }
}

KERNEL void open_all(const int dimension, const Engine *engine) {
    const Engine own = *engine;
    if (own.redraw && own.sheared)
        open_flight(dimension, SHEARED, 1, &own);
    else if (own.redraw)
        open_flight(dimension, AT_REST, 1, &own);
    else
        open_flight(dimension, AT_REST, 0, &own);
}

// Of one whose velocity was changed since.
KERNEL void sketch_again(const int dimension, const Engine *engine, uint32_t slot) {
    double place[3], velocity[3];
    for (int a = 0; a < dimension; a++) {
        place[a] = engine->now.place[a][slot];
        velocity[a] = engine->now.velocity[a][slot];
    }
    sketch_one(dimension, engine, slot, place, velocity);
}

// Becomes: the two kernels of an instruction set.
#define ENGINE_KERNEL(path)                                                                        \
    ENGINE_KERNEL_OF(2, path)                                                                      \
    ENGINE_KERNEL_OF(3, path)
#define ENGINE_KERNEL_OF(dimension, path)                                                          \
    static void run_##dimension(Engine *engine) {                                                  \
        run(dimension, AT_REST, engine);                                                           \
    }                                                                                              \
    static void grow_##dimension(Engine *engine) {                                                 \
        run(dimension, GROWING, engine);                                                           \
    }                                                                                              \
    static void shear_##dimension(Engine *engine) {                                                \
        run(dimension, SHEARED, engine);                                                           \
    }                                                                                              \
    static void open_##dimension(Engine *engine) {                                                 \
        open_all(dimension, engine);                                                               \
    }                                                                                              \
    static void sketch_##dimension(Engine *engine, uint32_t slot) {                                \
        sketch_again(dimension, engine, slot);                                                     \
    }                                                                                              \
    static void pair_##dimension(Engine *engine, size_t cell, const Span *spans, int count) {      \
        pair_cell(dimension, engine, cell, spans, count);                                          \
    }                                                                                              \
    static void prune_##dimension(Engine *engine) {                                                \
        prune_pairs(dimension, engine);                                                            \
    }                                                                                              \
    const EngineKernel engine_kernel_##dimension##d_##path = {                                     \
        .run_window = run_##dimension,                                                             \
        .run_growing = grow_##dimension,                                                           \
        .run_sheared = shear_##dimension,                                                          \
        .open_window = open_##dimension,                                                           \
        .sketch = sketch_##dimension,                                                              \
        .pair_cell = pair_##dimension,                                                             \
        .prune = prune_##dimension,                                                                \
    };
