// SPDX-License-Identifier: GPL-3.0-or-later
// One window of event-driven dynamics: predict all collisions in it, carry them out in order,
// move to its end. Compiled once per instruction set; dimension and growth are folded constants.
//
// Every particle has a virtual origin X: its place at time s of the window is X + v s. A collision
// at s that changes v by k changes X by -k s, so no particle needs a clock of its own.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"
#include "edbd/list_kernel.h"

#include <string.h>

static const uint32_t COLLISIONS_MOST = 1000; // of one particle in one window: it hangs
static const double CONTACT_DEPTH = 1e-12;    // deeper overlaps at a collision are counted

// The gap of a pair as time goes on: r^2 - contact^2 = c + 2 b t + a t^2.
typedef struct Gap {
    Lanes a, b, c;
} Gap;

// Diameters at time s of the window: scale(s) = scale + rate s.
typedef struct Growth {
    double scale, rate;
} Growth;

KERNEL void take_nearest(const int dimension, const Engine *engine, Lanes r[3]) {
    for (int a = 0; a < dimension; a++) {
        r[a] = lanes_nearest(r[a], lanes_all(engine->edge[a]), lanes_all(engine->edge[a] / 2));
    }
}

// From separations at time s.
KERNEL Gap gap_of(const int dimension, const int growing, const Lanes r[3], const Lanes v[3],
                  Lanes contact2, double s, Growth growth) {
    Lanes r2 = {0}, rv = {0}, v2 = {0};
    for (int a = 0; a < dimension; a++) {
        r2 = a == 0 ? r[a] * r[a] : r2 + r[a] * r[a];
        rv = a == 0 ? r[a] * v[a] : rv + r[a] * v[a];
        v2 = a == 0 ? v[a] * v[a] : v2 + v[a] * v[a];
    }
    if (!growing) return (Gap){.a = v2, .b = rv, .c = r2 - contact2};
    const double scale = growth.scale + growth.rate * s;
    return (Gap){.a = v2 - contact2 * lanes_all(growth.rate * growth.rate),
                 .b = rv - contact2 * lanes_all(scale * growth.rate),
                 .c = r2 - contact2 * lanes_all(scale * scale)};
}

// Pairs that meet within `left`: approaching, and either overlapping by then or having passed
// through a real contact before. A pair that overlaps already and approaches meets now; one that
// overlaps and recedes is left to do so. With growth a pair may also meet without approaching.
KERNEL Where gap_closes(const int growing, Gap gap, double left) {
    const Lanes zero = {0}, w = lanes_all(left);
    const Lanes end = gap.b + gap.a * w;
    const Where approaching = lanes_less(gap.b, zero);
    const Where overlaps = lanes_less(gap.c + w * (gap.b + end), zero);
    const Where turned = lanes_less(zero, end) & lanes_less(gap.a * gap.c, gap.b * gap.b);
    if (!growing) return approaching & (overlaps | turned);
    return (approaching | lanes_less(zero, gap.c)) & (overlaps | (turned & approaching));
}

// How long until a closing gap is closed; this form of the root does not cancel.
KERNEL Lanes gap_time(Gap gap) {
    const Lanes root = lanes_sqrt(lanes_positive(gap.b * gap.b - gap.a * gap.c));
    return lanes_positive(gap.c / (root - gap.b));
}

KERNEL uint32_t *bucket_of(Engine *engine, double time) {
    const double slice = time * engine->buckets_per_time;
    const uint32_t last = engine->buckets - 1;
    return &engine->bucket[slice < last ? (uint32_t)slice : last];
}

KERNEL void event_put(Engine *engine, double time, uint32_t first, uint32_t second) {
    uint32_t number = engine->free_event;
    if (number != NO_EVENT) {
        engine->free_event = engine->events[number].next;
    } else if (engine->events_used < engine->event_capacity) {
        number = engine->events_used++;
    } else {
        engine->outgrown = 1;
        return;
    }
    uint32_t *bucket = bucket_of(engine, time);
    engine->events[number] = (Event){.time = time,
                                     .first = first,
                                     .second = second,
                                     .stamps = engine->stamp[first] + engine->stamp[second],
                                     .next = *bucket};
    *bucket = number;
}

KERNEL void event_drop(Engine *engine, uint32_t *link) {
    const uint32_t number = *link;
    *link = engine->events[number].next;
    engine->events[number].next = engine->free_event;
    engine->free_event = number;
}

KERNEL Gap pair_gap(const int dimension, const int growing, const Engine *engine,
                    const uint32_t *first, const uint32_t *second, Lanes contact2, Growth growth) {
    const double *i[LANES], *j[LANES];
    for (int k = 0; k < LANES; k++) {
        i[k] = engine->rows + first[k];
        j[k] = engine->rows + second[k];
    }
    Lanes r[3], v[3];
    lanes_separate(dimension, i, j, r, v);
    take_nearest(dimension, engine, r);
    return gap_of(dimension, growing, r, v, contact2, 0, growth);
}

// Which pairs of the list meet in this window; returns how many are in list->hits.
KERNEL size_t find_hits(const int dimension, const int growing, Engine *engine, Growth growth) {
    const NeighbourList *list = &engine->list;
    size_t hits = 0;
    for (size_t p = 0; p < list->near; p += LANES) {
        const Gap gap =
            pair_gap(dimension, growing, engine, list->near_first + p, list->near_second + p,
                     lanes_load(list->near_contact2 + p), growth);
        const unsigned bits = lanes_bits(gap_closes(growing, gap, engine->settings.window));
        lanes_pack_numbers(list->hits + hits, bits, (uint32_t)p, 1);
        hits += (unsigned)__builtin_popcount(bits);
    }
    return hits;
}

KERNEL void predict_all(const int dimension, const int growing, Engine *engine, Growth growth) {
    const NeighbourList *list = &engine->list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    const size_t hits = find_hits(dimension, growing, engine, growth);
    for (size_t k = 0; k < LANES; k++) list->hits[hits + k] = 0; // fills the last LANES
    for (size_t h = 0; h < hits; h += LANES) {
        uint32_t first[LANES], second[LANES];
        double contact2[LANES];
        for (size_t k = 0; k < LANES; k++) {
            const uint32_t pair = list->hits[h + k];
            first[k] = list->near_first[pair];
            second[k] = list->near_second[pair];
            contact2[k] = list->near_contact2[pair];
        }
        double time[LANES];
        const Gap gap =
            pair_gap(dimension, growing, engine, first, second, lanes_load_at(contact2), growth);
        lanes_store_at(time, gap_time(gap));
        const size_t lanes = hits - h < LANES ? hits - h : LANES;
        for (size_t k = 0; k < lanes; k++) {
            event_put(engine, time[k], first[k] / row, second[k] / row);
        }
    }
}

// After its collision at time s: whom does `slot` meet in the rest of the window?
KERNEL void predict_one(const int dimension, const int growing, Engine *engine, uint32_t slot,
                        double s, Growth growth) {
    const NeighbourList *list = &engine->list;
    const size_t row = dimension == 2 ? ROW_2D : ROW_3D;
    for (size_t n = list->start[slot]; n < list->start[slot + 1]; n += LANES) {
        const double *i[LANES], *j[LANES];
        for (int k = 0; k < LANES; k++) {
            i[k] = engine->rows + row * slot;
            j[k] = engine->rows + list->neighbour[n + (size_t)k];
        }
        Lanes r[3], v[3];
        lanes_separate(dimension, i, j, r, v);
        take_nearest(dimension, engine, r);
        for (int a = 0; a < dimension; a++) r[a] += v[a] * lanes_all(s);
        const Gap gap = gap_of(dimension, growing, r, v, lanes_load(list->contact2 + n), s, growth);
        unsigned bits = lanes_bits(gap_closes(growing, gap, engine->settings.window - s));
        if (!bits) continue;
        double time[LANES];
        lanes_store_at(time, lanes_all(s) + gap_time(gap));
        for (; bits; bits &= bits - 1) {
            const int k = __builtin_ctz(bits);
            event_put(engine, time[k], slot, list->neighbour[n + (size_t)k] / (uint32_t)row);
        }
    }
}

// The displacement of a particle from its anchor, at a place on its way.
KERNEL void watch(const int dimension, Engine *engine, uint32_t slot, const double place[3]) {
    const double *anchor = engine->list.anchor + (size_t)ANCHOR * slot;
    double d2 = 0;
    for (int a = 0; a < dimension; a++) d2 += (place[a] - anchor[a]) * (place[a] - anchor[a]);
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

// A particle changes its velocity by `change` at time t, and its virtual origin to match. One store
// per row: the loads of whole rows that follow would wait for smaller ones.
KERNEL void kick(const int dimension, double *row, const double change[3], double t) {
    if (dimension == 2) {
        const Quad both = {change[0], change[1], change[0], change[1]};
        *(Quad *)row += both * (Quad){-t, -t, 1, 1};
        return;
    }
    const Quad velocity = {change[0], change[1], change[2], 0};
    const Quad low = *(const Quad *)row + velocity * (Quad){-t, -t, -t, -t};
    const Quad high = *(const Quad *)(row + 4) + velocity;
#if LANES == 8
    lanes_store(row, __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7));
#else
    *(Quad *)row = low;
    *(Quad *)(row + 4) = high;
#endif
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

// The elastic collision (Weysser, thesis, eq. 2.5, divided by r^2 as it must be): momentum
// -2 m_i m_j/(m_i + m_j) b r/r^2 goes to i, its mirror image to j; r = r_i - r_j, b = r.v.
KERNEL void collide(const int dimension, const int growing, Engine *engine, const Event *event,
                    Growth growth, Exchange *sums) {
    const size_t row = dimension == 2 ? ROW_2D : ROW_3D, velocity = row / 2;
    const uint32_t slot_i = event->first, slot_j = event->second;
    double *i = engine->rows + row * slot_i, *j = engine->rows + row * slot_j;
    const double t = event->time;
    double r[3], place_i[3], place_j[3], r2 = 0, b = 0;
    for (int a = 0; a < dimension; a++) {
        const double v = i[velocity + (size_t)a] - j[velocity + (size_t)a];
        const double edge = engine->edge[a], x = i[a] - j[a];
        r[a] = (x > edge / 2 ? x - edge : x < -edge / 2 ? x + edge : x) + v * t;
        r2 = a == 0 ? r[a] * r[a] : r2 + r[a] * r[a];
        b = a == 0 ? r[a] * v : b + r[a] * v;
        place_i[a] = i[a] + i[velocity + (size_t)a] * t;
        place_j[a] = j[a] + j[velocity + (size_t)a] * t;
    }
    const double scale = growing ? growth.scale + growth.rate * t : 1;
    const double contact = (engine->radius[slot_i] + engine->radius[slot_j]) * scale;
    if (growing) b -= contact * contact / scale * growth.rate;
    count_overlap(engine, r2, contact * contact);
    watch(dimension, engine, slot_i, place_i);
    watch(dimension, engine, slot_j, place_j);

    const double mass_i = engine->mass[slot_i], mass_j = engine->mass[slot_j];
    const double k = -2 * b / (r2 * (mass_i + mass_j));
    const double k_i = k * mass_j, k_j = -(k * mass_i), momentum = k * mass_j * mass_i;
    double change_i[3], change_j[3];
    for (int a = 0; a < dimension; a++) {
        change_i[a] = k_i * r[a];
        change_j[a] = k_j * r[a];
    }
    exchange_add(dimension, sums, r, momentum);
    kick(dimension, i, change_i, t);
    kick(dimension, j, change_j, t);
    engine->tally.collisions++;
    if (engine->log) record(engine, event);
    const uint32_t stamp_i = ++engine->stamp[slot_i], stamp_j = ++engine->stamp[slot_j];
    if (stamp_i > COLLISIONS_MOST || stamp_j > COLLISIONS_MOST) engine->hung = 1;
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

KERNEL void carry_out(const int dimension, const int growing, Engine *engine, Growth growth) {
    Exchange sums = exchange_open(dimension, &engine->tally);
    for (uint32_t b = 0; b < engine->buckets && !engine->hung; b++) {
        uint32_t *link;
        while (engine->bucket[b] != NO_EVENT && (link = earliest(engine, &engine->bucket[b]))) {
            const Event event = engine->events[*link];
            event_drop(engine, link);
            collide(dimension, growing, engine, &event, growth, &sums);
            if (engine->hung) break;
            predict_one(dimension, growing, engine, event.first, event.time, growth);
            predict_one(dimension, growing, engine, event.second, event.time, growth);
        }
    }
    exchange_close(dimension, &sums, &engine->tally);
}

// Back into [0, edge); the anchor goes along, for the distance to it must not jump.
KERNEL void fold(Engine *engine, double *row, uint32_t slot, int axis) {
    const double edge = engine->edge[axis];
    double *anchor = engine->list.anchor + (size_t)ANCHOR * slot;
    int32_t *image = &engine->state->image[axis][engine->id[slot]];
    if (row[axis] < 0) {
        row[axis] += edge;
        anchor[axis] += edge;
        --*image;
    }
    if (row[axis] >= edge) { // also after a tiny negative number was rounded to the edge
        row[axis] -= edge;
        anchor[axis] -= edge;
        ++*image;
    }
}

// To the end of the window: a row in 3D, a row or two in 2D, as many as a register holds.
KERNEL void move_rows(const int dimension, Engine *engine, uint32_t slot, Quad *farthest) {
    const double w = engine->settings.window, *edge = engine->edge;
    const Quad least = {0, 0, dimension == 2 ? -INFINITY : 0, -INFINITY};
    const Quad bound = {edge[0], edge[1], dimension == 2 ? INFINITY : edge[2], INFINITY};
    double *row = engine->rows + (size_t)(dimension == 2 ? ROW_2D : ROW_3D) * slot;
    Quad place = *(const Quad *)row;
    if (dimension == 2)
        place += __builtin_shufflevector(place, place, 2, 3, 2, 3) * (Quad){w, w};
    else
        place += *(const Quad *)(row + 4) * (Quad){w, w, w};
    *(Quad *)row = place;
    const Quad away = place - *(const Quad *)(engine->list.anchor + (size_t)ANCHOR * slot);
    Quad away2 = away * away;
    if (dimension == 2)
        away2 += __builtin_shufflevector(away2, away2, 1, 0, 2, 3);
    else
        away2 += __builtin_shufflevector(away2, away2, 1, 0, 3, 2);
    if (dimension == 3) away2 += __builtin_shufflevector(away2, away2, 2, 3, 0, 1);
    quad_keep_larger(farthest, &away2);
    if (__builtin_expect(!quad_strays(&place, &least, &bound), 1)) return;
    for (int a = 0; a < dimension; a++) fold(engine, row, slot, a);
}

#if LANES == 8
// As move_rows, two rows of 2D at a time; `slot` is even.
KERNEL void move_two_rows(Engine *engine, uint32_t slot, Lanes *farthest) {
    const double w = engine->settings.window, *edge = engine->edge, big = INFINITY;
    const Lanes least = {0, 0, -big, -big, 0, 0, -big, -big};
    const Lanes bound = {edge[0], edge[1], big, big, edge[0], edge[1], big, big};
    double *row = engine->rows + (size_t)ROW_2D * slot;
    Lanes place = lanes_load(row);
    place += __builtin_shufflevector(place, place, 2, 3, 2, 3, 6, 7, 6, 7) *
             (Lanes){w, w, 0, 0, w, w, 0, 0};
    lanes_store(row, place);
    const Lanes away = place - lanes_load(engine->list.anchor + (size_t)ANCHOR * slot);
    Lanes away2 = away * away;
    away2 += __builtin_shufflevector(away2, away2, 1, 0, 2, 3, 5, 4, 6, 7);
    *farthest = (Lanes)_mm512_max_pd((__m512d)*farthest, (__m512d)away2);
    const unsigned inside = lanes_less(place, bound) & (unsigned)~lanes_less(place, least);
    if (__builtin_expect((inside & 0xffu) == 0xffu, 1)) return;
    for (uint32_t k = 0; k < 2; k++) {
        for (int a = 0; a < 2; a++) fold(engine, row + ROW_2D * k, slot + k, a);
    }
}
#endif

KERNEL void move_all(const int dimension, Engine *engine) {
    Quad farthest = {0};
    uint32_t slot = 0;
#if LANES == 8
    Lanes farthest_two = {0};
    const uint32_t even = dimension == 2 ? (uint32_t)engine->count & ~1u : 0;
    for (; slot < even; slot += 2) move_two_rows(engine, slot, &farthest_two);
    farthest[0] = fmax(farthest_two[0], farthest_two[4]);
#endif
    for (; slot < engine->count; slot++) move_rows(dimension, engine, slot, &farthest);
    if (farthest[0] > engine->list.farthest2) engine->list.farthest2 = farthest[0];
}

// Velocities from a Gaussian of variance kT/m per direction (Weysser, thesis, eq. 2.7, corrected).
KERNEL void redraw_all(const int dimension, Engine *engine) {
    for (size_t slot = 0; slot < engine->count; slot++) {
        double *velocity = engine->rows + (dimension == 2 ? ROW_2D * slot + 2 : ROW_3D * slot + 4);
        for (int a = 0; a < dimension; a++) {
            velocity[a] = engine->column[a][slot] * engine->thermal[slot];
        }
    }
}

// Works on a copy of the engine's own fields: what is written to rows and lists cannot be it, so
// they stay in registers.
KERNEL void run(const int dimension, const int growing, Engine *engine) {
    Engine own = *engine;
    const Growth growth = {.scale = own.scale, .rate = own.growth};
    own.events_used = 0;
    own.free_event = NO_EVENT;
    memset(own.stamp, 0, (own.count + 1) * sizeof *own.stamp);
    memset(own.bucket, 0xff, own.buckets * sizeof *own.bucket);
    predict_all(dimension, growing, &own, growth);
    carry_out(dimension, growing, &own, growth);
    move_all(dimension, &own);
    *engine = own;
}

// Becomes: the two kernels of an instruction set.
#define ENGINE_KERNEL(path)                                                                        \
    ENGINE_KERNEL_OF(2, path)                                                                      \
    ENGINE_KERNEL_OF(3, path)
#define ENGINE_KERNEL_OF(dimension, path)                                                          \
    static void run_##dimension(Engine *engine) {                                                  \
        run(dimension, 0, engine);                                                                 \
    }                                                                                              \
    static void grow_##dimension(Engine *engine) {                                                 \
        run(dimension, 1, engine);                                                                 \
    }                                                                                              \
    static void redraw_##dimension(Engine *engine) {                                               \
        redraw_all(dimension, engine);                                                             \
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
        .redraw = redraw_##dimension,                                                              \
        .pair_cell = pair_##dimension,                                                             \
        .prune = prune_##dimension,                                                                \
    };
