// SPDX-License-Identifier: GPL-3.0-or-later
// One window of event-driven dynamics: predict all collisions in it, carry them out in order,
// move to its end. Compiled once per instruction set; dimension and flight are folded constants.
//
// Every particle has a virtual origin X: its place at time s of the window is X + v s. A collision
// at s that changes v by k changes X by -k s, so no particle needs a clock of its own.
#pragma once

#include "edbd/calendar.h"
#include "edbd/engine.h"
#include "edbd/fetch.h"
#include "edbd/lanes.h"
#include "edbd/list_kernel.h"
#include "edbd/pairs.h"
#include "edbd/sketch.h"

#include <string.h>

static const uint32_t COLLISIONS_MOST = 1000; // of one particle in one window: it hangs
static const double CONTACT_DEPTH = 1e-12;    // deeper overlaps at a collision are counted
static const uint32_t MEMBER = 1u << 24;      // codes of neighbours of one collision of a batch

// Pairs become events if they meet in the window.
KERNEL void predict_hits(const int dimension, const int flight, Engine *engine, Growth growth,
                         size_t hits) {
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    uint32_t *const first = engine->list.hit_first, *const second = engine->list.hit_second;
    for (size_t h = hits; h < hits + 4; h++) first[h] = second[h] = 0; // lanes nobody looks at
    for (size_t h = 0; h < hits; h += 4) {
        uint32_t i[4], j[4];
        for (size_t k = 0; k < 4; k++) i[k] = first[h + k] / row, j[k] = second[h + k] / row;
        const Quad time = meeting_times(dimension, flight, engine, i, j, (Quad){0}, growth);
        for (size_t k = 0; k < 4 && h + k < hits; k++) {
            if (time[k] < INFINITY) event_put(engine, time[k], i[k], j[k]);
        }
    }
}

KERNEL void predict_all(const int dimension, const int flight, Engine *engine, Growth growth,
                        const Sieve *sieve) {
    const NeighbourList *list = &engine->list;
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
    predict_hits(dimension, flight, engine, growth, hits);
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

// The next few collisions, which are carried out side by side: nobody takes part in two of them.
// The first stands; the others do as long as nothing that follows from those before them comes
// between.
enum { BATCH = 4 };
typedef struct Batch {
    uint32_t count;
    uint32_t number[BATCH], bucket[BATCH]; // of the events
    uint32_t slot[2][BATCH];               // partners
    Quad time;
    Movers before[2], after[2];
    FourFloats row[2][BATCH][2]; // sketches after it, one behind the other in 2D
    Quad r[3], momentum;         // between the partners, exchanged along r
    Quad r2, contact2;
    size_t hits; // of those whom they may meet after it
} Batch;

// The farthest displacement of partners p from their anchors, which go with the flow.
KERNEL Quad watch(const int dimension, const int flight, const Engine *engine, const Batch *batch,
                  int p, Quad farthest2) {
    const Quad t = batch->time;
    Quad place[3], away2 = {0};
    for (int a = 0; a < dimension; a++) {
        place[a] = batch->before[p].place[a] + batch->before[p].velocity[a] * t;
    }
    for (int a = 0; a < dimension; a++) {
        Quad away = place[a] - quads_gather(engine->list.anchor[a], batch->slot[p]);
        if (flight == SHEARED && a == 0)
            away -= (engine->list.strain + engine->rate * t) * place[1];
        away2 = a == 0 ? away * away : away2 + away * away;
    }
    return quads_choose(away2 > farthest2, away2, farthest2);
}

// Partners p change their velocities by k r, and their virtual origins to match.
KERNEL void kick(const int dimension, const Engine *engine, Batch *batch, int p, Quad k) {
    const double way = 2 * engine->settings.window;
    Quad now[4] = {{0}}, then[4] = {{0}};
    for (int a = 0; a < dimension; a++) {
        const Quad change = k * batch->r[a];
        now[a] = batch->before[p].place[a] - change * batch->time;
        batch->after[p].place[a] = now[a];
        batch->after[p].velocity[a] = batch->before[p].velocity[a] + change;
        then[a] = now[a] + batch->after[p].velocity[a] * way;
    }
    sketch_quads(dimension, now, then, batch->row[p]);
}

// The elastic collisions (Weysser, thesis, eq. 2.5, divided by r^2 as it must be): momentum
// -2 m_i m_j/(m_i + m_j) b r/r^2 goes to i, its mirror image to j; r = r_i - r_j, b = r.v.
KERNEL void collide(const int dimension, const int flight, const Engine *engine, Growth growth,
                    Batch *batch, Quad *farthest2) {
    const Quad t = batch->time;
    Quad v[3], r2 = {0}, b = {0};
    for (int p = 0; p < 2; p++) {
        batch->before[p] = movers_at(dimension, engine, batch->slot[p]);
        *farthest2 = watch(dimension, flight, engine, batch, p, *farthest2);
    }
    separate(dimension, flight, engine, &batch->before[0], &batch->before[1], batch->r, v);
    for (int a = 0; a < dimension; a++) {
        batch->r[a] += v[a] * t;
        r2 = a == 0 ? batch->r[a] * batch->r[a] : r2 + batch->r[a] * batch->r[a];
        b = a == 0 ? batch->r[a] * v[a] : b + batch->r[a] * v[a];
    }
    Quad contact = contact_of(engine, batch->slot[0], batch->slot[1]);
    if (flight == GROWING) {
        const Quad scale = growth.scale + growth.rate * t;
        contact *= scale;
        b -= contact * contact / scale * growth.rate;
    }
    const Quad mass[2] = {quads_gather(engine->mass, batch->slot[0]),
                          quads_gather(engine->mass, batch->slot[1])};
    const Quad k = -2 * b / (r2 * (mass[0] + mass[1]));
    kick(dimension, engine, batch, 0, k * mass[1]);
    kick(dimension, engine, batch, 1, -(k * mass[0]));
    batch->momentum = k * mass[1] * mass[0];
    batch->r2 = r2;
    batch->contact2 = contact * contact;
}

KERNEL void put_mover(const int dimension, const Engine *engine, uint32_t slot,
                      const Movers *movers, uint32_t m) {
    for (int a = 0; a < dimension; a++) {
        engine->now.place[a][slot] = movers->place[a][m];
        engine->now.velocity[a][slot] = movers->velocity[a][m];
    }
}

// Collision m of a batch happens.
KERNEL void settle(const int dimension, const Engine *engine, const Batch *batch, uint32_t m) {
    const size_t parts = dimension == 2 ? 1 : 2;
    FourFloats *const sketch = (FourFloats *)engine->sketch;
    for (int p = 0; p < 2; p++) {
        const uint32_t slot = batch->slot[p][m];
        put_mover(dimension, engine, slot, &batch->after[p], m);
        for (size_t k = 0; k < parts; k++) sketch[slot * parts + k] = batch->row[p][m][k];
    }
}

// A collision that stands.
KERNEL void count_collision(const int dimension, Engine *engine, const Batch *batch, uint32_t m,
                            Exchange *sums) {
    const Event *event = &engine->events[batch->number[m]];
    double r[3];
    for (int a = 0; a < dimension; a++) r[a] = batch->r[a][m];
    exchange_add(dimension, sums, r, batch->momentum[m]);
    count_overlap(engine, batch->r2[m], batch->contact2[m]);
    engine->tally.collisions++;
    if (engine->log) record(engine, event);
    if (engine->stamp[event->first] > COLLISIONS_MOST ||
        engine->stamp[event->second] > COLLISIONS_MOST)
        engine->hung = 1;
}

// One event more, from bucket b, unless it is void. Stamps void those of its partners to come.
KERNEL void collect_one(Engine *engine, uint32_t b, uint32_t number, Batch *batch) {
    const Event *event = &engine->events[number];
    const uint32_t stands = !event_is_void(engine, event), m = batch->count;
    batch->number[m] = number;
    batch->bucket[m] = b;
    batch->slot[0][m] = event->first;
    batch->slot[1][m] = event->second;
    batch->time[m] = event->time;
    engine->stamp[event->first] += stands;
    engine->stamp[event->second] += stands;
    batch->count += stands;
}

// Of a bucket that holds several. Is anybody left in it?
KERNEL int collect_crowd(Engine *engine, uint32_t b, Batch *batch) {
    while (batch->count < BATCH) {
        uint32_t *link = earliest(engine, &engine->bucket[b], batch->count == 0);
        if (!link) break;
        const uint32_t number = *link;
        event_drop(engine, link);
        collect_one(engine, b, number, batch);
    }
    return engine->bucket[b] != NO_EVENT;
}

// Takes out the next events, from bucket b on. Void ones are out for good where nothing that voided
// them can be taken back: as long as the batch is empty.
KERNEL void collect(const int dimension, Engine *engine, uint32_t b, Batch *batch) {
    const uint32_t words = engine->buckets / BITS, begin = b;
    uint32_t word = b / BITS;
    uint64_t bits = engine->occupied[word] & UINT64_MAX << b % BITS;
    batch->count = 0;
    while (batch->count < BATCH) {
        while (bits == 0 && ++word < words) bits = engine->occupied[word];
        if (bits == 0) break;
        b = word * BITS + (uint32_t)__builtin_ctzll(bits);
        const uint32_t number = engine->bucket[b], before = batch->count;
        int stays;
        if (__builtin_expect(engine->events[number].next == NO_EVENT, 1)) {
            collect_one(engine, b, number, batch);
            stays = before > 0 && batch->count == before;
        } else {
            stays = collect_crowd(engine, b, batch);
        }
        engine->occupied[word] &= ~((uint64_t)!stays << b % BITS);
        bits &= bits - 1;
    }
    if (engine->fetches) fetch_ahead(dimension, engine, begin, b);
}

// Lanes that nobody looks at.
KERNEL void fill_up(Batch *batch) {
    for (uint32_t m = batch->count; m < BATCH; m++) {
        batch->slot[0][m] = batch->slot[0][0];
        batch->slot[1][m] = batch->slot[1][0];
        batch->time[m] = batch->time[0];
    }
}

// As if the collisions from m on had not been; they are events again.
KERNEL void take_back(const int dimension, Engine *engine, Batch *batch, uint32_t m) {
    for (uint32_t q = m; q < batch->count; q++) {
        for (int p = 0; p < 2; p++) {
            const uint32_t slot = batch->slot[p][q];
            double place[3], velocity[3];
            for (int a = 0; a < dimension; a++) {
                place[a] = batch->before[p].place[a][q];
                velocity[a] = batch->before[p].velocity[a][q];
            }
            put_mover(dimension, engine, slot, &batch->before[p], q);
            sketch_one(dimension, engine, slot, place, velocity);
            engine->stamp[slot]--;
        }
        event_link(engine, batch->number[q]);
    }
    batch->count = m;
}

// Of the neighbour with this number; steps of whole blocks always find 0.
KERNEL uint32_t place_in_block(uint32_t n) {
    return (int)HALF < (int)HALF_BLOCK ? n % HALF_BLOCK : 0;
}

// Whom may the partners in collision m of a batch meet in the rest of the window? The neighbours of
// both are tested at once, those of one in each half of a register.
KERNEL void look_round(const int dimension, const int flight, const Engine *engine,
                       const Sieve *sieve, Batch *batch, uint32_t m) {
    const NeighbourList *list = &engine->list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D, none = list->start[engine->count];
    const uint32_t slots[2] = {batch->slot[0][m], batch->slot[1][m]};
    const uint32_t own[2] = {slots[0] * row, slots[1] * row};
    const float gone = (float)(batch->time[m] * engine->half_per_window);
    const Rows i = {engine->sketch, {&own[0], &own[1]}, 0};
    uint32_t at[2] = {list->start[slots[0]], list->start[slots[1]]};
    const uint32_t end[2] = {list->start[slots[0] + 1], list->start[slots[1] + 1]};
    for (uint32_t code = m * MEMBER; at[0] < end[0] || at[1] < end[1];
         code += WIDE, at[0] += HALF, at[1] += HALF) {
        const uint32_t *rows[2];
        const float *contact2[2];
        for (int p = 0; p < 2; p++) {
            const uint32_t n = at[p] < end[p] ? at[p] : none;
            rows[p] = list->blocks[n / HALF_BLOCK].row + place_in_block(n);
            contact2[p] = list->blocks[n / HALF_BLOCK].contact2 + place_in_block(n);
        }
        const Rows j = {engine->sketch, {rows[0], rows[1]}, 1};
        const unsigned bits = may_meet(dimension, flight == SHEARED, sieve, &i, &j,
                                       wides_load_halves(contact2[0], contact2[1]), &gone);
        wides_pack_numbers(list->hit_first + batch->hits, bits, code, 1);
        batch->hits += (unsigned)__builtin_popcount(bits);
    }
}

// The first collision of a batch after m that a slot takes part in, or all of them.
KERNEL uint32_t takes_part(const Batch *batch, uint32_t m, uint32_t slot) {
    const unsigned any = fours_equal(batch->slot[0], slot) | fours_equal(batch->slot[1], slot);
    return (uint32_t)__builtin_ctz((any | 1u << batch->count) & ~((2u << m) - 1));
}

// Whom a code of look_round() means: a partner in collision m, and a neighbour.
typedef struct Hit {
    uint32_t m, i, j;
} Hit;

KERNEL Hit hit_of(const int dimension, const NeighbourList *list, const Batch *batch,
                  uint32_t code) {
    const uint32_t shift = dimension == 2 ? 2 : 3, m = code / MEMBER, k = code % MEMBER;
    const uint32_t i = batch->slot[k % WIDE / HALF][m];
    const uint32_t n = list->start[i] + k / WIDE * HALF + k % HALF;
    return (Hit){.m = m, .i = i, .j = list->blocks[n / HALF_BLOCK].row[n % HALF_BLOCK] >> shift};
}

// The events of four of the hits from h on, up to one that must be looked at as it was. Returns how
// many were dealt with.
KERNEL size_t follow_four(const int dimension, const int flight, Engine *engine, Growth growth,
                          Batch *batch, size_t h) {
    uint32_t m[4], i[4], j[4];
    Quad s;
    const size_t some = batch->hits - h < 4 ? batch->hits - h : 4;
    for (size_t k = 0; k < 4; k++) {
        const Hit hit =
            hit_of(dimension, &engine->list, batch, engine->list.hit_first[h + (k < some ? k : 0)]);
        m[k] = hit.m, i[k] = hit.i, j[k] = hit.j;
        s[k] = batch->time[hit.m];
    }
    const Quad times = meeting_times(dimension, flight, engine, i, j, s, growth);
    for (size_t k = 0; k < some; k++) {
        if (m[k] >= batch->count) return batch->hits - h;
        const uint32_t disturbed = takes_part(batch, m[k], j[k]);
        if (disturbed < batch->count) {
            take_back(dimension, engine, batch, disturbed);
            return k;
        }
        const double time = times[k];
        if (time < INFINITY) event_put(engine, time, i[k], j[k]);
        const uint32_t before = batch->count;
        while (batch->count > m[k] + 1 && time <= batch->time[batch->count - 1]) {
            take_back(dimension, engine, batch, batch->count - 1);
        }
        if (batch->count != before) return k + 1;
    }
    return some;
}

// The events that follow from the collisions of a batch. A collision is taken back where an event
// comes before it, and where one of its partners is among those that are to be looked at as they
// were.
KERNEL void follow(const int dimension, const int flight, Engine *engine, Growth growth,
                   Batch *batch) {
    for (size_t h = 0; h < batch->hits;) {
        h += follow_four(dimension, flight, engine, growth, batch, h);
    }
}

// The collisions of a batch, and what follows from them.
KERNEL void carry_out_batch(const int dimension, const int flight, Engine *engine, Growth growth,
                            const Sieve *sieve, Batch *batch, Quad *farthest2) {
    fill_up(batch);
    collide(dimension, flight, engine, growth, batch, farthest2);
    batch->hits = 0;
    for (uint32_t m = 0; m < batch->count; m++) {
        settle(dimension, engine, batch, m);
        look_round(dimension, flight, engine, sieve, batch, m);
    }
    follow(dimension, flight, engine, growth, batch);
}

// In order, a few at a time: what a collision changes decides only now and then about the next
// ones, and the processor would have to wait for each.
KERNEL void carry_out(const int dimension, const int flight, Engine *engine, Growth growth,
                      const Sieve *sieve) {
    const uint64_t before = engine->tally.collisions;
    Exchange sums = exchange_open(dimension, &engine->tally);
    Quad farthest2 = {0};
    Batch batch;
    for (uint32_t b = 0; !engine->hung; b = batch.bucket[batch.count - 1]) {
        collect(dimension, engine, b, &batch);
        if (batch.count == 0) break;
        carry_out_batch(dimension, flight, engine, growth, sieve, &batch, &farthest2);
        for (uint32_t m = 0; m < batch.count; m++) {
            count_collision(dimension, engine, &batch, m, &sums);
        }
    }
    for (int m = 0; m < BATCH; m++) {
        if (farthest2[m] > engine->list.farthest2) engine->list.farthest2 = farthest2[m];
    }
    engine->tally.stale += engine->events_used - (engine->tally.collisions - before);
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
    memset(own.occupied, 0, own.buckets / 8);
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
