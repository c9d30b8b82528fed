// SPDX-License-Identifier: GPL-3.0-or-later
// Who may meet whom: particles sorted by cell (which also puts neighbours next to each other in
// memory), then all pairs nearer than contact + skin.
#include "edbd/engine.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

// Skins in d, found by measurement: wide ones cost pairs, narrow ones rebuilding.
static const double SKIN_DIFFUSIVE[2] = {0.45, 0.30}; // 2D, 3D, velocities drawn in every window
static const double SKIN_BALLISTIC[2] = {0.70, 0.45}; // or kept for many
static const double SKIN_WINDOWS = 16; // least skin, in thermal flights of one window
static const double FAR_AWAY = 1e100;  // where the particle is that nothing meets

typedef struct Grid {
    int cells[3];
    double per_length[3];
} Grid;

// Cells at least `range` wide; fewer than three along an axis would be neighbours twice: take one.
static Grid grid_of(const Engine *engine, double range) {
    Grid grid = {.cells = {1, 1, 1}};
    for (int a = 0; a < engine->dimension; a++) {
        double cells = floor(engine->edge[a] / range);
        if (cells < 3) cells = 1;
        grid.cells[a] = (int)cells;
    }
    for (int a = 0; a < 3; a++) grid.per_length[a] = grid.cells[a] / engine->edge[a];
    return grid;
}

static size_t grid_size(const Grid *grid) {
    return (size_t)grid->cells[0] * (size_t)grid->cells[1] * (size_t)grid->cells[2];
}

static int cell_along(const Grid *grid, int axis, double x) {
    const double cell = x * grid->per_length[axis], last = grid->cells[axis] - 1;
    return cell > 0 ? (int)(cell < last ? cell : last) : 0; // whatever x is
}

// A box with more cells than particles gains nothing from them: widen until they fit.
static Grid grid_that_fits(const Engine *engine, double range) {
    Grid grid = grid_of(engine, range);
    while (grid_size(&grid) > engine->cells_most) grid = grid_of(engine, range *= 1.25);
    return grid;
}

static void count_cells(Engine *engine, const Grid *grid) {
    memset(engine->cell_start, 0, (grid_size(grid) + 1) * sizeof *engine->cell_start);
    for (size_t slot = 0; slot < engine->count; slot++) {
        const double *row = engine->rows + engine->row * slot;
        int cell = 0;
        for (int a = engine->dimension - 1; a >= 0; a--) {
            cell = cell * grid->cells[a] + cell_along(grid, a, row[a]);
        }
        engine->cell_of[slot] = (uint32_t)cell;
        engine->cell_start[cell + 1]++;
    }
    for (size_t c = 0; c < grid_size(grid); c++) {
        engine->cell_start[c + 1] += engine->cell_start[c];
    }
}

static void swap_in_sorted(Engine *engine) {
    double *rows = engine->rows;
    uint32_t *id = engine->id;
    engine->rows = engine->spare_rows;
    engine->id = engine->spare_id;
    engine->spare_rows = rows;
    engine->spare_id = id;
}

static void sort_by_cell(Engine *engine, const Grid *grid) {
    const size_t row = engine->row, cells = grid_size(grid);
    for (size_t slot = 0; slot < engine->count; slot++) {
        const uint32_t to = engine->cell_start[engine->cell_of[slot]]++;
        memcpy(engine->spare_rows + row * to, engine->rows + row * slot, row * sizeof(double));
        engine->spare_id[to] = engine->id[slot];
    }
    for (size_t c = cells; c > 0; c--) engine->cell_start[c] = engine->cell_start[c - 1];
    engine->cell_start[0] = 0;
    swap_in_sorted(engine);
    for (size_t slot = 0; slot < engine->count; slot++) {
        const uint32_t id = engine->id[slot];
        engine->radius[slot] = engine->state->diameter[id] / 2;
        engine->mass[slot] = engine->state->mass[id];
        engine->thermal[slot] = engine->thermal_of[id];
    }
}

static void place_anchors(Engine *engine) {
    for (size_t slot = 0; slot < engine->count; slot++) {
        const double *row = engine->rows + engine->row * slot;
        for (int a = 0; a < engine->dimension; a++) {
            engine->list.anchor[ANCHOR * slot + (size_t)a] = row[a];
            engine->column[a][slot] = row[a];
        }
    }
    double *nobody = engine->rows + engine->row * engine->count;
    for (size_t k = 0; k < engine->row; k++) nobody[k] = k < engine->row / 2 ? FAR_AWAY : 0;
    engine->list.farthest2 = 0;
    engine->list.age = 0;
}

static Status grow_pairs(NeighbourList *list, size_t pairs) {
    if (pairs <= list->pair_capacity) return OK;
    const size_t capacity = pairs + pairs / 4 + 4 * BLOCK;
    uint32_t *first = NULL, *second = NULL, *hits = NULL;
    double *contact2 = NULL;
    TRY(NEW_ARRAY(first, capacity));
    TRY(NEW_ARRAY(second, capacity));
    TRY(NEW_ARRAY(hits, capacity));
    TRY(NEW_ARRAY(contact2, capacity));
    if (list->pairs) {
        memcpy(first, list->first, list->pairs * sizeof *first);
        memcpy(second, list->second, list->pairs * sizeof *second);
        memcpy(contact2, list->pair_contact2, list->pairs * sizeof *contact2);
    }
    memory_free(list->first);
    memory_free(list->second);
    memory_free(list->pair_contact2);
    memory_free(list->hits);
    list->first = first;
    list->second = second;
    list->hits = hits;
    list->pair_contact2 = contact2;
    list->pair_capacity = capacity;
    return OK;
}

static Status grow_neighbours(NeighbourList *list, size_t used, size_t wanted) {
    if (wanted <= list->neighbour_capacity) return OK;
    const size_t capacity = wanted + wanted / 4 + 4 * BLOCK;
    uint32_t *neighbour = NULL;
    double *contact2 = NULL;
    TRY(NEW_ARRAY(neighbour, capacity));
    TRY(NEW_ARRAY(contact2, capacity));
    if (used) {
        memcpy(neighbour, list->neighbour, used * sizeof *neighbour);
        memcpy(contact2, list->contact2, used * sizeof *contact2);
    }
    memory_free(list->neighbour);
    memory_free(list->contact2);
    list->neighbour = neighbour;
    list->contact2 = contact2;
    list->neighbour_capacity = capacity;
    return OK;
}

static int wrap(int cell, int cells) {
    return cell < 0 ? cell + cells : cell >= cells ? cell - cells : cell;
}

// Adds the slots of a cell to the spans, of which neighbouring cells along x make one.
static int add_span(const Engine *engine, size_t cell, Span spans[27], int count) {
    const Span span = {engine->cell_start[cell], engine->cell_start[cell + 1]};
    if (span.from == span.to) return count;
    if (count > 0 && spans[count - 1].to == span.from)
        spans[count - 1].to = span.to;
    else
        spans[count++] = span;
    return count;
}

static int spans_around(const Engine *engine, const Grid *grid, size_t cell, Span spans[27]) {
    int at[3], reach[3], count = 0;
    for (int a = 0; a < 3; a++) {
        at[a] = (int)(cell % (size_t)grid->cells[a]);
        cell /= (size_t)grid->cells[a];
        reach[a] = grid->cells[a] > 1;
    }
    for (int z = -reach[2]; z <= reach[2]; z++) {
        for (int y = -reach[1]; y <= reach[1]; y++) {
            const size_t row = (size_t)wrap(at[2] + z, grid->cells[2]) * (size_t)grid->cells[1] +
                               (size_t)wrap(at[1] + y, grid->cells[1]);
            for (int x = -reach[0]; x <= reach[0]; x++) {
                count = add_span(
                    engine, row * (size_t)grid->cells[0] + (size_t)wrap(at[0] + x, grid->cells[0]),
                    spans, count);
            }
        }
    }
    return count;
}

// Room for the neighbours of a cell's particles, were all candidates in range.
static Status make_room(Engine *engine, size_t cell, const Span *spans, int count, size_t end) {
    const size_t own = engine->cell_start[cell + 1] - engine->cell_start[cell];
    size_t candidates = BLOCK;
    for (int s = 0; s < count; s++) candidates += spans[s].to - spans[s].from;
    TRY(grow_pairs(&engine->list, engine->list.pairs + own * candidates + 2 * BLOCK));
    return grow_neighbours(&engine->list, end, end + own * candidates + 2 * BLOCK);
}

static void end_lists(Engine *engine, size_t end) {
    NeighbourList *list = &engine->list;
    const uint32_t nobody = (uint32_t)(engine->count * engine->row);
    list->start[engine->count] = (uint32_t)end;
    for (; list->pairs % BLOCK; list->pairs++) {
        list->first[list->pairs] = list->second[list->pairs] = nobody;
        list->pair_contact2[list->pairs] = 0;
    }
}

static Status list_pairs(Engine *engine, const Grid *grid) {
    size_t end = 0;
    engine->list.pairs = 0;
    for (size_t cell = 0; cell < grid_size(grid); cell++) {
        if (engine->cell_start[cell] == engine->cell_start[cell + 1]) continue;
        Span spans[27];
        const int count = spans_around(engine, grid, cell, spans);
        TRY(make_room(engine, cell, spans, count, end));
        end = engine->kernel->list_cell(engine, cell, spans, count, end);
    }
    end_lists(engine, end);
    return OK;
}

// The skin: wide enough for many windows, never so wide that two images of one particle are near.
static double skin_of(const Engine *engine) {
    double shortest = engine->edge[0];
    for (int a = 0; a < engine->dimension; a++) shortest = fmin(shortest, engine->edge[a]);
    const bool diffusive = engine->settings.redraw && engine->settings.windows_per_step == 1;
    const double skin = (diffusive ? SKIN_DIFFUSIVE : SKIN_BALLISTIC)[engine->dimension - 2];
    const double wanted = fmax(skin, SKIN_WINDOWS * engine->fastest * engine->settings.window);
    return fmin(wanted, shortest / 2 - engine->largest * engine->scale);
}

Status list_build(Engine *engine) {
    NeighbourList *list = &engine->list;
    if (list->skin == 0 || list->scale != engine->scale) list->skin = skin_of(engine);
    list->scale = engine->scale;
    const Grid grid = grid_that_fits(engine, engine->largest * engine->scale + list->skin);
    count_cells(engine, &grid);
    sort_by_cell(engine, &grid);
    place_anchors(engine);
    engine->tally.rebuilds++;
    TRY(list_pairs(engine, &grid));
    return OK;
}

Status list_create(Engine *engine) {
    NeighbourList *list = &engine->list;
    engine->cells_most = 2 * engine->count + 27;
    TRY(NEW_ARRAY(list->anchor, ANCHOR * (engine->count + 1)));
    TRY(NEW_ARRAY(list->start, engine->count + 1));
    TRY(NEW_ARRAY(engine->cell_of, engine->count));
    TRY(NEW_ARRAY(engine->cell_start, engine->cells_most + 1));
    return OK;
}

void list_free(Engine *engine) {
    NeighbourList *list = &engine->list;
    memory_free(list->anchor);
    memory_free(list->first);
    memory_free(list->second);
    memory_free(list->pair_contact2);
    memory_free(list->hits);
    memory_free(list->start);
    memory_free(list->neighbour);
    memory_free(list->contact2);
    memory_free(engine->cell_of);
    memory_free(engine->cell_start);
}
