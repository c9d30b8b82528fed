// SPDX-License-Identifier: GPL-3.0-or-later
// Room for the lists and cells of the chain of bodies; the kernels fill them.
#include "dmc/bodies.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { ROOM_AT_FIRST = 32, CELL_ROOM_AT_FIRST = 32 };

static size_t whole_blocks(size_t count) {
    return (count + LIST_BLOCK - 1) / LIST_BLOCK * LIST_BLOCK;
}

static void choose_cells(Bodies *bodies) {
    BodyCells *cells = &bodies->lists.cells;
    const double grown = bodies->lists.scale / bodies->scale;
    const double width = 1.001 * (grown * bodies->longest + bodies->lists.skin);
    const double most = fmax(4, cbrt((double)bodies->count)); // about one body in each
    cells->total = 1;
    for (int a = 0; a < 3; a++) {
        const double fit = bodies->state->box.edge[a] / width;
        cells->number[a] = fit < 4 ? 1 : (uint32_t)fmin(fit, most);
        cells->total *= cells->number[a];
    }
    if (cells->total == 1) cells->room = whole_blocks(bodies->count);
}

static void free_room(BodyLists *lists) {
    memory_free(lists->near);
    memory_free(lists->cells.held);
    memory_free(lists->cells.id);
    lists->near = lists->cells.held = lists->cells.id = NULL;
    for (int a = 0; a < 3; a++) {
        memory_free(lists->cells.place[a]);
        lists->cells.place[a] = NULL;
    }
}

static Status make_room(Bodies *bodies) {
    BodyLists *lists = &bodies->lists;
    BodyCells *cells = &lists->cells;
    free_room(lists);
    TRY(NEW_ARRAY(lists->near, bodies->count * lists->room));
    TRY(NEW_ARRAY(cells->held, cells->total));
    TRY(NEW_ARRAY(cells->id, cells->total * cells->room));
    for (int a = 0; a < 3; a++) TRY(NEW_ARRAY(cells->place[a], cells->total * cells->room));
    return OK;
}

Status bodies_lists_create(Bodies *bodies) {
    BodyLists *lists = &bodies->lists;
    lists->room = ROOM_AT_FIRST;
    lists->cells.room = CELL_ROOM_AT_FIRST;
    TRY(NEW_ARRAY(lists->held, bodies->count));
    TRY(NEW_ARRAY(lists->anchor, bodies->count));
    TRY(NEW_ARRAY(lists->candidate, bodies->count + LIST_BLOCK));
    TRY(NEW_ARRAY(lists->cells.cell, bodies->count));
    TRY(NEW_ARRAY(lists->cells.at, bodies->count));
    return bodies_lists_build(bodies, bodies->scale);
}

void bodies_lists_free(Bodies *bodies) {
    BodyLists *lists = &bodies->lists;
    free_room(lists);
    memory_free(lists->held);
    memory_free(lists->anchor);
    memory_free(lists->candidate);
    memory_free(lists->cells.cell);
    memory_free(lists->cells.at);
}

static void fill(Bodies *bodies) {
    BodyLists *lists = &bodies->lists;
    bodies->stale = false;
    memset(lists->held, 0, bodies->count * sizeof *lists->held);
    memset(lists->cells.held, 0, lists->cells.total * sizeof *lists->cells.held);
    for (size_t i = 0; i < bodies->count; i++) lists->cells.cell[i] = UINT32_MAX;
    for (size_t i = 0; i < bodies->count && !bodies->stale; i++) {
        bodies->kernel->anchor(bodies, i);
    }
}

Status bodies_lists_build(Bodies *bodies, double scale) {
    BodyLists *lists = &bodies->lists;
    const size_t room = lists->room, cell_room = lists->cells.room, total = lists->cells.total;
    bodies->stale = true; // void until they are filled
    bodies_choose_skin(bodies, scale);
    choose_cells(bodies);
    if (!lists->near || room != lists->room || cell_room != lists->cells.room ||
        total != lists->cells.total) {
        TRY(make_room(bodies));
    }
    fill(bodies);
    while (bodies->stale) {
        lists->room *= 2;
        lists->cells.room *= 2;
        TRY(make_room(bodies));
        fill(bodies);
    }
    return OK;
}
