// SPDX-License-Identifier: GPL-3.0-or-later
// The neighbours of the particles of one cell, several candidates at a time. Particles lie sorted
// by cell, so candidates are a few spans of consecutive slots.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"

static const double ROUNDED_UP = 1 + 1e-6; // for contact distances kept in single precision

// Which of the candidates from slot `from` on are near `slot`, one bit each.
KERNEL unsigned near_slots(const int dimension, const Engine *engine, uint32_t slot, uint32_t from,
                           uint32_t to, Lanes *contact2) {
    Lanes r2 = {0};
    for (int a = 0; a < dimension; a++) {
        const Lanes r = lanes_nearest(lanes_all(engine->column[a][slot]) -
                                          lanes_load_at(engine->column[a] + from),
                                      lanes_all(engine->edge[a]), lanes_all(engine->edge[a] / 2));
        r2 = a == 0 ? r * r : r2 + r * r;
    }
    const Lanes contact = lanes_all(engine->radius[slot]) + lanes_load_at(engine->radius + from);
    const Lanes range = contact * lanes_all(engine->scale) + lanes_all(engine->list.skin);
    *contact2 = contact * contact;
    const unsigned bits = lanes_bits(lanes_less(r2, range * range));
    return to - from < LANES ? bits & ((1u << (to - from)) - 1) : bits;
}

// Adds the pairs of `slot` with the candidates of a span to the half list.
KERNEL void pair_span(const int dimension, Engine *engine, uint32_t slot, Span span) {
    NeighbourList *list = &engine->list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    for (uint32_t from = span.from; from < span.to; from += LANES) {
        Lanes contact2;
        const unsigned bits = near_slots(dimension, engine, slot, from, span.to, &contact2);
        lanes_pack_numbers(list->second + list->pairs, bits, from * row, row);
        lanes_pack_floats(list->pair_contact2 + list->pairs, bits, contact2);
        for (int k = 0; k < LANES; k++) list->first[list->pairs + (size_t)k] = slot * row;
        list->pairs += (unsigned)__builtin_popcount(bits);
    }
}

// The pairs of the particles of a cell with those after them in it and in the cells after it, of
// which spans[0] begins with the cell itself.
KERNEL void pair_cell(const int dimension, Engine *engine, size_t cell, const Span *spans,
                      int count) {
    Engine own = *engine; // a copy, which what is written to the list cannot be: see run()
    for (uint32_t slot = own.cell_start[cell]; slot < own.cell_start[cell + 1]; slot++) {
        pair_span(dimension, &own, slot, (Span){slot + 1, spans[0].to});
        for (int s = 1; s < count; s++) pair_span(dimension, &own, slot, spans[s]);
    }
    engine->list.pairs = own.list.pairs;
}

// The pairs of the half list that may meet soon: nearer than contact + the inner skin.
KERNEL void prune_pairs(const int dimension, Engine *engine) {
    const Engine own = *engine;
    const NeighbourList *list = &own.list;
    size_t near = 0;
    for (size_t p = 0; p < list->pairs; p += LANES) {
        const double *i[LANES], *j[LANES];
        for (size_t k = 0; k < LANES; k++) {
            i[k] = own.rows + list->first[p + k];
            j[k] = own.rows + list->second[p + k];
        }
        Lanes r[3], v[3], r2 = {0};
        lanes_separate(dimension, i, j, r, v);
        for (int a = 0; a < dimension; a++) {
            r[a] = lanes_nearest(r[a], lanes_all(own.edge[a]), lanes_all(own.edge[a] / 2));
            r2 = a == 0 ? r[a] * r[a] : r2 + r[a] * r[a];
        }
        const Lanes contact2 = lanes_widen(list->pair_contact2 + p);
        const Lanes range =
            lanes_sqrt(contact2) * lanes_all(own.scale * ROUNDED_UP) + lanes_all(list->inner_skin);
        const unsigned bits = lanes_bits(lanes_less(r2, range * range));
        lanes_pack_u32(list->near_first + near, bits, list->first + p);
        lanes_pack_u32(list->near_second + near, bits, list->second + p);
        lanes_pack_floats(list->near_contact2 + near, bits, contact2);
        near += (unsigned)__builtin_popcount(bits);
    }
    engine->list.near = near;
}
