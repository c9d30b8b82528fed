// SPDX-License-Identifier: GPL-3.0-or-later
// The neighbours of the particles of one cell, several candidates at a time. Particles lie sorted
// by cell, so candidates are a few spans of consecutive slots.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"
#include "edbd/sketch.h"

static const double ROUNDED_UP = 1 + 1e-6; // for contact distances kept in single precision

// Candidates of a cell side by side, whatever spans they come from, and after them some that are
// near to nobody. Returns how many there are.
KERNEL uint32_t line_up(const int dimension, const Engine *engine, const Span *spans, int count) {
    static const float FAR_AWAY = 1e15F;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    uint32_t lined = 0;
    for (int s = 0; s < count; s++) {
        for (uint32_t from = spans[s].from; from < spans[s].to; from += WIDE) {
            const uint32_t to = lined + from - spans[s].from;
            for (int a = 0; a <= dimension; a++) {
                wides_store_at(engine->lined[a] + to, wides_load_at(engine->column[a] + from));
            }
            wides_pack_numbers(engine->lined_row + to, (1u << WIDE) - 1, from * row, row);
        }
        lined += spans[s].to - spans[s].from;
    }
    for (int a = 0; a <= dimension; a++) {
        wides_store_at(engine->lined[a] + lined, wides_all(a < dimension ? FAR_AWAY : 0));
    }
    return lined;
}

// Which of the candidates from `from` on are near `slot`, one bit each. Places and radii are in
// single precision, so a few more are found than are near.
KERNEL unsigned near_slots(const int dimension, const int sheared, const Engine *engine,
                           uint32_t slot, uint32_t from, Wides *contact2) {
    const float *const *column = (const float *const *)engine->column;
    const float *const *lined = (const float *const *)engine->lined;
    const float skin = (float)(engine->list.skin * ROUNDED_UP + engine->place_error);
    Wides r[3], r2 = {0};
    for (int a = 0; a < dimension; a++) r[a] = column[a][slot] - wides_load_at(lined[a] + from);
    if (sheared)
        r[0] = wides_lean(r[0], r[1], wides_all((float)engine->edge[1] * 0.5f),
                          wides_all((float)engine->offset));
    for (int a = 0; a < dimension; a++) {
        r[a] = wides_nearest(r[a], wides_all((float)engine->edge[a]));
        r2 = a == 0 ? r[a] * r[a] : r2 + r[a] * r[a];
    }
    const Wides contact = column[dimension][slot] + wides_load_at(lined[dimension] + from);
    const Wides range = contact * (float)(engine->scale * ROUNDED_UP) + skin;
    *contact2 = contact * contact;
    return wides_less(r2, range * range);
}

// The pairs of the particles of a cell with those after them in it and in the cells after it, of
// which spans[0] begins with the cell itself.
KERNEL void pair_cell_in(const int dimension, const int sheared, Engine *engine, size_t cell,
                         const Span *spans, int count) {
    const Engine own = *engine; // a copy, which what is written to the list cannot be: see run()
    const NeighbourList *list = &own.list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D, begin = own.cell_start[cell];
    const uint32_t lined = line_up(dimension, &own, spans, count);
    size_t pairs = list->pairs;
    for (uint32_t slot = begin; slot < own.cell_start[cell + 1]; slot++) {
        list->pair_start[slot] = (uint32_t)pairs;
        for (uint32_t from = slot - begin + 1; from < lined; from += WIDE) {
            Wides contact2;
            const unsigned bits = near_slots(dimension, sheared, &own, slot, from, &contact2);
            wides_pack_u32(list->second + pairs, bits, own.lined_row + from);
            wides_pack(list->pair_contact2 + pairs, bits, contact2);
            for (int k = 0; k < WIDE; k++) list->first[pairs + (size_t)k] = slot * row;
            pairs += (unsigned)__builtin_popcount(bits);
        }
    }
    engine->list.pairs = pairs;
}

KERNEL void pair_cell(const int dimension, Engine *engine, size_t cell, const Span *spans,
                      int count) {
    if (engine->sheared)
        pair_cell_in(dimension, 1, engine, cell, spans, count);
    else
        pair_cell_in(dimension, 0, engine, cell, spans, count);
}

// The pairs of the half list that may meet soon: nearer than contact + the inner skin.
KERNEL void prune_pairs_in(const int dimension, const int sheared, Engine *engine) {
    const Engine own = *engine;
    const NeighbourList *list = &own.list;
    const Sieve sieve = sieve_of(dimension, sheared, &own);
    const float skin = (float)(list->inner_skin * ROUNDED_UP + own.place_error);
    size_t near = 0;
    for (size_t p = 0; p < list->pairs; p += WIDE) {
        const uint32_t *first = list->first + p, *second = list->second + p;
        const Rows i = {own.sketch, {first, first + HALF}, 1};
        const Rows j = {own.sketch, {second, second + HALF}, 1};
        const Wides contact2 = *(const Wides *)(list->pair_contact2 + p);
        const Wides range = wides_sqrt(contact2) * (float)(own.scale * ROUNDED_UP) + skin;
        const unsigned bits =
            wides_less(distance2(dimension, sheared, &sieve, &i, &j), range * range);
        wides_pack_u32(list->near_first + near, bits, first);
        wides_pack_u32(list->near_second + near, bits, second);
        wides_pack(list->near_contact2 + near, bits, contact2);
        near += (unsigned)__builtin_popcount(bits);
    }
    engine->list.near = near;
}

KERNEL void prune_pairs(const int dimension, Engine *engine) {
    if (engine->sheared)
        prune_pairs_in(dimension, 1, engine);
    else
        prune_pairs_in(dimension, 0, engine);
}
