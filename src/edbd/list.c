// SPDX-License-Identifier: GPL-3.0-or-later
// Who may meet whom: particles sorted by cell (which also puts neighbours next to each other in
// memory), then all pairs nearer than contact + skin.
#include "edbd/engine.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static const double SKIN = 0.3;        // in d
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
    const int cell = (int)(x * grid->per_length[axis]);
    return cell < grid->cells[axis] ? cell : grid->cells[axis] - 1;
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
        engine->thermal[slot] = 1 / sqrt(engine->mass[slot]);
    }
}

static void place_anchors(Engine *engine) {
    for (size_t slot = 0; slot < engine->count; slot++) {
        const double *row = engine->rows + engine->row * slot;
        for (int a = 0; a < engine->dimension; a++) {
            engine->list.anchor[ANCHOR * slot + (size_t)a] = row[a];
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

static double pair_distance2(const Engine *engine, size_t p, size_t q) {
    const double *i = engine->rows + engine->row * p, *j = engine->rows + engine->row * q;
    double r2 = 0;
    for (int a = 0; a < engine->dimension; a++) {
        double r = i[a] - j[a];
        r -= engine->edge[a] * rint(r / engine->edge[a]);
        r2 += r * r;
    }
    return r2;
}

// Lists the neighbours of `slot` that lie in one cell; returns the new end of its list.
static size_t list_cell(Engine *engine, uint32_t slot, size_t cell, size_t end) {
    NeighbourList *list = &engine->list;
    for (uint32_t other = engine->cell_start[cell]; other < engine->cell_start[cell + 1]; other++) {
        if (other == slot) continue;
        const double contact = engine->radius[slot] + engine->radius[other];
        const double range = contact * engine->scale + list->skin;
        if (pair_distance2(engine, slot, other) >= range * range) continue;
        list->neighbour[end] = other;
        list->contact2[end++] = contact * contact;
        if (other < slot) continue;
        list->first[list->pairs] = slot;
        list->second[list->pairs] = other;
        list->pair_contact2[list->pairs++] = contact * contact;
    }
    return end;
}

static int wrap(int cell, int cells) {
    return cell < 0 ? cell + cells : cell >= cells ? cell - cells : cell;
}

// Room for the neighbours of one more particle, were all of the 27 cells' particles in range.
static Status make_room(Engine *engine, size_t candidates, size_t end) {
    TRY(grow_pairs(&engine->list, engine->list.pairs + candidates + BLOCK));
    return grow_neighbours(&engine->list, end, end + candidates + 2 * BLOCK);
}

static Status list_slot(Engine *engine, const Grid *grid, uint32_t slot, size_t *end) {
    size_t cell = engine->cell_of[slot], around[27], cells = 0, candidates = 0;
    int at[3], reach[3];
    for (int a = 0; a < 3; a++) {
        at[a] = (int)(cell % (size_t)grid->cells[a]);
        cell /= (size_t)grid->cells[a];
        reach[a] = grid->cells[a] > 1;
    }
    for (int z = -reach[2]; z <= reach[2]; z++) {
        for (int y = -reach[1]; y <= reach[1]; y++) {
            for (int x = -reach[0]; x <= reach[0]; x++) {
                const size_t row =
                    (size_t)wrap(at[2] + z, grid->cells[2]) * (size_t)grid->cells[1] +
                    (size_t)wrap(at[1] + y, grid->cells[1]);
                const size_t other =
                    row * (size_t)grid->cells[0] + (size_t)wrap(at[0] + x, grid->cells[0]);
                around[cells++] = other;
                candidates += engine->cell_start[other + 1] - engine->cell_start[other];
            }
        }
    }
    TRY(make_room(engine, candidates, *end));
    for (size_t c = 0; c < cells; c++) *end = list_cell(engine, slot, around[c], *end);
    return OK;
}

static Status list_pairs(Engine *engine, const Grid *grid) {
    NeighbourList *list = &engine->list;
    const uint32_t nobody = (uint32_t)engine->count;
    size_t end = 0;
    list->pairs = 0;
    for (size_t cell = 0, slot = 0; cell < grid_size(grid); cell++) {
        for (; slot < engine->cell_start[cell + 1]; slot++) engine->cell_of[slot] = (uint32_t)cell;
    }
    for (uint32_t slot = 0; slot < nobody; slot++) {
        list->start[slot] = (uint32_t)end;
        TRY(list_slot(engine, grid, slot, &end));
        for (; end % BLOCK; end++) {
            list->neighbour[end] = nobody;
            list->contact2[end] = 0;
        }
    }
    list->start[nobody] = (uint32_t)end;
    for (; list->pairs % BLOCK; list->pairs++) {
        list->first[list->pairs] = list->second[list->pairs] = nobody;
        list->pair_contact2[list->pairs] = 0;
    }
    return OK;
}

// The skin: wide enough for many windows, never so wide that two images of one particle are near.
static double skin_of(const Engine *engine) {
    double shortest = engine->edge[0];
    for (int a = 0; a < engine->dimension; a++) shortest = fmin(shortest, engine->edge[a]);
    const double wanted = fmax(SKIN, SKIN_WINDOWS * engine->fastest * engine->settings.window);
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
