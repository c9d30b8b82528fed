// SPDX-License-Identifier: GPL-3.0-or-later
// The neighbours of the particles of one cell, several candidates at a time. Particles lie sorted
// by cell, so candidates are a few spans of consecutive slots.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"

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
    unsigned bits = lanes_bits(lanes_less(r2, range * range));
    if (to - from < LANES) bits &= (1u << (to - from)) - 1;
    if (slot - from < LANES) bits &= ~(1u << (slot - from));
    return bits;
}

// Of the LANES slots from `from` on, those after `slot`: a pair is in the half list once.
KERNEL unsigned later_slots(uint32_t slot, uint32_t from) {
    if (from > slot) return ~0u;
    return slot - from < LANES - 1 ? ~0u << (slot - from + 1) : 0;
}

KERNEL size_t list_slot(const int dimension, Engine *engine, uint32_t slot, const Span *spans,
                        int count, size_t end) {
    NeighbourList *list = &engine->list;
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    for (int s = 0; s < count; s++) {
        for (uint32_t from = spans[s].from; from < spans[s].to; from += LANES) {
            Lanes contact2;
            const unsigned bits = near_slots(dimension, engine, slot, from, spans[s].to, &contact2);
            lanes_pack_numbers(list->neighbour + end, bits, from * row, row);
            lanes_pack(list->contact2 + end, bits, contact2);
            end += (unsigned)__builtin_popcount(bits);
            const unsigned half = bits & later_slots(slot, from);
            if (!half) continue;
            const int pairs = __builtin_popcount(half);
            lanes_pack_numbers(list->second + list->pairs, half, from * row, row);
            lanes_pack(list->pair_contact2 + list->pairs, half, contact2);
            for (int k = 0; k < pairs; k++) list->first[list->pairs + (size_t)k] = slot * row;
            list->pairs += (size_t)pairs;
        }
    }
    return end;
}

// Lists all particles of a cell against the spans around it; returns the new end of the list of
// neighbours. Lists of particles are padded to whole blocks with the one that nothing meets.
KERNEL size_t list_cell(const int dimension, Engine *engine, size_t cell, const Span *spans,
                        int count, size_t end) {
    const uint32_t row = dimension == 2 ? ROW_2D : ROW_3D;
    for (uint32_t slot = engine->cell_start[cell]; slot < engine->cell_start[cell + 1]; slot++) {
        engine->list.start[slot] = (uint32_t)end;
        end = list_slot(dimension, engine, slot, spans, count, end);
        for (; end % BLOCK; end++) {
            engine->list.neighbour[end] = (uint32_t)engine->count * row;
            engine->list.contact2[end] = 0;
        }
    }
    return end;
}
