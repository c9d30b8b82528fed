// SPDX-License-Identifier: GPL-3.0-or-later
// Who may meet whom: particles sorted by cell (which also puts neighbours next to each other in
// memory), then all pairs nearer than contact + skin.
#include "edbd/engine.h"

#include "base/memory.h"
#include "numerics/vector.h"

#include <math.h>
#include <string.h>

// Skins in d, found by measurement: wide ones cost pairs, narrow ones rebuilding.
static const double SKIN[2][2] = {
    {0.80, 0.65}, // 2D, 3D, velocities kept for many windows
    {0.50, 0.50}, // or drawn in every window
};
static const double SKIN_WINDOWS = 16;       // least skin, in thermal flights of one window
static const double INNER_SKIN_WINDOWS = 48; // the inner skin, in the same,
static const double INNER_SKIN_MOST = 0.3;   // where that is below this part of the outer
static const float NEVER = -1e30F;           // contact distance squared of pairs that never meet

typedef struct Grid {
    int cells[3];
    double per_length[3];
    double lean; // of the edge along y, towards x
} Grid;

// Cells at least `range` wide; fewer than three along an axis would be neighbours twice: take one.
static Grid grid_of(const Engine *engine, double range) {
    Grid grid = {.cells = {1, 1, 1}, .lean = engine->offset / engine->edge[1]};
    for (int a = 0; a < engine->dimension; a++) {
        const double wide = a == 0 ? range * box_widening(&engine->state->box) : range;
        double cells = floor(engine->edge[a] / wide);
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

// In which a particle is: along the edges of the box, the second of which leans.
static int cell_at(const Engine *engine, const Grid *grid, size_t slot) {
    double *const *place = engine->now.place;
    const double x = place[0][slot] - grid->lean * place[1][slot], edge = engine->edge[0];
    int cell = 0;
    for (int a = engine->dimension - 1; a > 0; a--) {
        cell = (cell + cell_along(grid, a, place[a][slot])) * grid->cells[a - 1];
    }
    return cell + cell_along(grid, 0, x < 0 ? x + edge : x < edge ? x : x - edge);
}

static void count_cells(Engine *engine, const Grid *grid) {
    memset(engine->cell_start, 0, (grid_size(grid) + 1) * sizeof *engine->cell_start);
    for (size_t slot = 0; slot < engine->count; slot++) {
        const int cell = cell_at(engine, grid, slot);
        engine->cell_of[slot] = (uint32_t)cell;
        engine->cell_start[cell + 1]++;
    }
    for (size_t c = 0; c < grid_size(grid); c++) {
        engine->cell_start[c + 1] += engine->cell_start[c];
    }
}

static void swap_in_sorted(Engine *engine) {
    const Motion now = engine->now;
    uint32_t *id = engine->id;
    engine->now = engine->spare;
    engine->id = engine->spare_id;
    engine->spare = now;
    engine->spare_id = id;
}

static void reorder(const double *from, double *to, const uint32_t *order, size_t count) {
    for (size_t slot = 0; slot < count; slot++) to[order[slot]] = from[slot];
}

// From one array to another, which takes its place.
static void reorder_through(double **array, double **other, const uint32_t *order, size_t count) {
    double *const from = *array;
    reorder(from, *other, order, count);
    *array = *other;
    *other = from;
}

static void sort_by_cell(Engine *engine, const Grid *grid) {
    uint32_t *order = engine->cell_of; // becomes: the new slot of each
    for (size_t slot = 0; slot < engine->count; slot++) {
        order[slot] = engine->cell_start[engine->cell_of[slot]]++;
        engine->spare_id[order[slot]] = engine->id[slot];
    }
    for (size_t c = grid_size(grid); c > 0; c--) engine->cell_start[c] = engine->cell_start[c - 1];
    engine->cell_start[0] = 0;
    for (int a = 0; a < engine->dimension; a++) {
        reorder(engine->now.place[a], engine->spare.place[a], order, engine->count);
        reorder(engine->now.velocity[a], engine->spare.velocity[a], order, engine->count);
    }
    swap_in_sorted(engine);
    // From slot to slot is near in memory; from the State's order it would not be.
    double **const other = &engine->list.origin[0]; // is made anew with the list
    reorder_through(&engine->radius, other, order, engine->count);
    reorder_through(&engine->mass, other, order, engine->count);
    reorder_through(&engine->thermal, other, order, engine->count);
}

static void copy_places(const Engine *engine, double *const to[3]) {
    for (int a = 0; a < engine->dimension; a++) {
        memcpy(to[a], engine->now.place[a], engine->count * sizeof(double));
    }
}

static void place_anchors(Engine *engine) {
    copy_places(engine, engine->list.anchor);
    engine->list.farthest2 = 0;
    engine->list.strain = 0;
}

// From where a particle was when the list was made, flow apart; it may have been folded since.
static void displacement_of(const Engine *engine, size_t slot, double d[3]) {
    double *const *place = engine->now.place, *const *origin = engine->list.origin;
    for (int a = 0; a < engine->dimension; a++) d[a] = place[a][slot] - origin[a][slot];
    const double above = rint(d[1] / engine->edge[1]);
    const double y = place[1][slot] - above * engine->edge[1];
    d[0] -= above * engine->offset + (engine->list.strain_before + engine->list.strain) * y;
    for (int a = 0; a < engine->dimension; a++)
        d[a] -= engine->edge[a] * rint(d[a] / engine->edge[a]);
}

// As the crow flies.
static double largest_displacement(const Engine *engine) {
    double farthest2 = 0;
    for (size_t slot = 0; slot < engine->count; slot++) {
        double d[3] = {0, 0, 0};
        displacement_of(engine, slot, d);
        farthest2 = fmax(farthest2, vector_dot(d, d));
    }
    return sqrt(farthest2);
}

static void fill_columns(Engine *engine) {
    const double *const from[4] = {engine->now.place[0], engine->now.place[1],
                                   engine->dimension == 3 ? engine->now.place[2] : engine->radius,
                                   engine->radius};
    for (int a = 0; a <= engine->dimension; a++) {
        for (size_t slot = 0; slot < engine->count; slot++) {
            engine->column[a][slot] = (float)from[a][slot];
        }
    }
}

static Status grow_floats(float **floats, size_t used, size_t capacity) {
    float *more = NULL;
    TRY(NEW_ARRAY(more, capacity));
    if (used) memcpy(more, *floats, used * sizeof *more);
    memory_free(*floats);
    *floats = more;
    return OK;
}

// Room for more numbers, of which the first `used` are kept.
static Status grow_numbers(uint32_t **numbers, size_t used, size_t capacity) {
    uint32_t *more = NULL;
    TRY(NEW_ARRAY(more, capacity));
    if (used) memcpy(more, *numbers, used * sizeof *more);
    memory_free(*numbers);
    *numbers = more;
    return OK;
}

static Status grow_pairs(NeighbourList *list, size_t pairs) {
    if (pairs <= list->pair_capacity) return OK;
    const size_t capacity = pairs + pairs / 8 + 4 * BLOCK;
    TRY(grow_numbers(&list->first, list->pairs, capacity));
    TRY(grow_numbers(&list->second, list->pairs, capacity));
    TRY(grow_floats(&list->pair_contact2, list->pairs, capacity));
    TRY(grow_numbers(&list->hit_first, 0, 2 * capacity)); // of both ways
    TRY(grow_numbers(&list->hit_second, 0, capacity));
    if (list->pruned) {
        TRY(grow_numbers(&list->pruned_first, 0, capacity));
        TRY(grow_numbers(&list->pruned_second, 0, capacity));
        TRY(grow_floats(&list->pruned_contact2, 0, capacity));
    }
    list->pair_capacity = capacity;
    return OK;
}

static Status grow_blocks(NeighbourList *list, size_t blocks) {
    if (blocks <= list->block_capacity) return OK;
    const size_t capacity = blocks + blocks / 8 + BLOCK;
    memory_free(list->blocks);
    list->block_capacity = 0;
    TRY(NEW_ARRAY(list->blocks, capacity));
    list->block_capacity = capacity;
    return OK;
}

static int wrap(int cell, int cells) {
    return cell < 0 ? cell + cells : cell >= cells ? cell - cells : cell;
}

// Adds the slots of a cell to the spans, of which neighbouring cells along x make one.
static int add_span(const Engine *engine, size_t cell, Span *spans, int count) {
    const Span span = {engine->cell_start[cell], engine->cell_start[cell + 1]};
    if (span.from == span.to) return count;
    if (count > 0 && spans[count - 1].to == span.from)
        spans[count - 1].to = span.to;
    else
        spans[count++] = span;
    return count;
}

// A cell and half of its neighbours, so that every pair of cells comes once.
static int spans_after(const Engine *engine, const Grid *grid, size_t cell, Span spans[14]) {
    int at[3], reach[3], count = 0;
    for (int a = 0; a < 3; a++) {
        at[a] = (int)(cell % (size_t)grid->cells[a]);
        cell /= (size_t)grid->cells[a];
        reach[a] = grid->cells[a] > 1;
    }
    for (int z = 0; z <= reach[2]; z++) {
        for (int y = z > 0 ? -reach[1] : 0; y <= reach[1]; y++) {
            const size_t row = (size_t)wrap(at[2] + z, grid->cells[2]) * (size_t)grid->cells[1] +
                               (size_t)wrap(at[1] + y, grid->cells[1]);
            for (int x = z > 0 || y > 0 ? -reach[0] : 0; x <= reach[0]; x++) {
                count = add_span(
                    engine, row * (size_t)grid->cells[0] + (size_t)wrap(at[0] + x, grid->cells[0]),
                    spans, count);
            }
        }
    }
    return count;
}

// Room for the pairs of a cell's particles, were all candidates in range.
static Status make_room(Engine *engine, size_t cell, const Span *spans, int count) {
    const size_t own = engine->cell_start[cell + 1] - engine->cell_start[cell];
    size_t candidates = BLOCK;
    for (int s = 0; s < count; s++) candidates += spans[s].to - spans[s].from;
    return grow_pairs(&engine->list, engine->list.pairs + own * candidates + 2 * BLOCK);
}

static Status list_pairs(Engine *engine, const Grid *grid) {
    NeighbourList *list = &engine->list;
    const uint32_t nobody = (uint32_t)(engine->count * engine->row);
    list->pairs = 0;
    for (size_t cell = 0; cell < grid_size(grid); cell++) {
        if (engine->cell_start[cell] == engine->cell_start[cell + 1]) continue;
        Span spans[14];
        const int count = spans_after(engine, grid, cell, spans);
        TRY(make_room(engine, cell, spans, count));
        engine->kernel->pair_cell(engine, cell, spans, count);
    }
    list->pair_start[engine->count] = (uint32_t)list->pairs;
    for (; list->pairs % BLOCK; list->pairs++) {
        list->first[list->pairs] = list->second[list->pairs] = nobody;
        list->pair_contact2[list->pairs] = NEVER;
    }
    return OK;
}

// Where the neighbours of each particle begin, in whole blocks. `before` counts those that come
// before it, and becomes: where these begin, behind those that come after it.
static Status start_neighbours(Engine *engine, uint32_t *before) {
    NeighbourList *list = &engine->list;
    const uint32_t shift = engine->row == ROW_2D ? 2 : 3;
    memset(before, 0, engine->count * sizeof *before);
    for (size_t p = 0; p < list->pair_start[engine->count]; p++) before[list->second[p] >> shift]++;
    uint32_t end = 0;
    for (size_t slot = 0; slot < engine->count; slot++) {
        const uint32_t after = list->pair_start[slot + 1] - list->pair_start[slot];
        const uint32_t all = before[slot] + after;
        list->start[slot] = end;
        before[slot] = end + after;
        end += (all + HALF_BLOCK - 1) / HALF_BLOCK * HALF_BLOCK;
    }
    list->start[engine->count] = end;
    return grow_blocks(list, end / HALF_BLOCK + 1);
}

// The last block of each particle, which neighbours do not fill, and that after all.
static void clear_last_blocks(Engine *engine) {
    NeighbourList *list = &engine->list;
    Neighbours none;
    for (int k = 0; k < HALF_BLOCK; k++) {
        none.row[k] = (uint32_t)(engine->count * engine->row);
        none.contact2[k] = NEVER;
    }
    list->blocks[list->start[engine->count] / HALF_BLOCK] = none;
    for (size_t slot = engine->count; slot > 0; slot--) {
        const uint32_t end = list->start[slot] / HALF_BLOCK;
        if (end > 0) list->blocks[end - 1] = none;
    }
}

static void put_neighbour(const NeighbourList *list, uint32_t n, uint32_t row, float contact2) {
    Neighbours *block = &list->blocks[n / HALF_BLOCK];
    block->row[n % HALF_BLOCK] = row;
    block->contact2[n % HALF_BLOCK] = contact2;
}

// The half list, seen from both partners of each pair: those after a particle, then those before.
static Status list_neighbours(Engine *engine) {
    NeighbourList *list = &engine->list;
    const uint32_t shift = engine->row == ROW_2D ? 2 : 3;
    const size_t pairs = list->pair_start[engine->count];
    uint32_t *before = engine->cell_of; // no longer needed
    TRY(start_neighbours(engine, before));
    clear_last_blocks(engine);
    for (size_t p = 0; p < pairs; p++) {
        const uint32_t first = list->first[p], second = list->second[p], slot = first >> shift;
        const uint32_t after = list->start[slot] + (uint32_t)p - list->pair_start[slot];
        put_neighbour(list, after, second, list->pair_contact2[p]);
        put_neighbour(list, before[second >> shift]++, first, list->pair_contact2[p]);
    }
    return OK;
}

// The skin: wide enough for many windows, never so wide that two images of one particle are near.
// Where diameters are yet to grow, the lists are as long as they will be: particles that fly far
// between collisions then stay longer in their reach.
static double skin_of(const Engine *engine) {
    double shortest = engine->edge[0];
    for (int a = 0; a < engine->dimension; a++) shortest = fmin(shortest, engine->edge[a]);
    const bool diffusive = engine->settings.redraw && engine->settings.windows_per_step == 1;
    const double skin = SKIN[diffusive][engine->dimension - 2];
    const double room = fmax(0, engine->largest * (1 - engine->scale));
    const double wanted =
        fmax(skin + room, SKIN_WINDOWS * engine->fastest * engine->settings.window);
    return fmin(wanted, shortest / 2 - engine->largest * engine->scale);
}

void list_prune(Engine *engine) {
    NeighbourList *list = &engine->list;
    list->spent = largest_displacement(engine);
    list->strain_before += list->strain;
    list->inner_scale = engine->scale;
    place_anchors(engine);
    engine->kernel->prune(engine);
    const uint32_t nobody = (uint32_t)(engine->count * engine->row);
    for (; list->near % BLOCK; list->near++) {
        list->near_first[list->near] = list->near_second[list->near] = nobody;
        list->near_contact2[list->near] = NEVER;
    }
}

// Without pruning the near pairs are all pairs.
static void see_all_pairs(NeighbourList *list) {
    list->near = list->pairs;
    list->near_first = list->first;
    list->near_second = list->second;
    list->near_contact2 = list->pair_contact2;
}

static void choose_skins(Engine *engine) {
    NeighbourList *list = &engine->list;
    const double inner = INNER_SKIN_WINDOWS * engine->fastest * engine->settings.window;
    list->skin = skin_of(engine);
    list->pruned = inner < INNER_SKIN_MOST * list->skin;
    list->inner_skin = list->pruned ? inner : list->skin;
}

Status list_build(Engine *engine) {
    NeighbourList *list = &engine->list;
    if (list->skin == 0 || list->scale != engine->scale) choose_skins(engine);
    list->scale = list->inner_scale = engine->scale;
    list->spent = list->strain_before = 0;
    list->age = 0;
    const Grid grid = grid_that_fits(engine, engine->largest * engine->scale + list->skin);
    count_cells(engine, &grid);
    sort_by_cell(engine, &grid);
    place_anchors(engine);
    copy_places(engine, list->origin);
    fill_columns(engine);
    engine->tally.rebuilds++;
    engine->redraw = 0;
    engine->kernel->open_window(engine);
    TRY(list_pairs(engine, &grid));
    TRY(list_neighbours(engine));
    see_all_pairs(list);
    if (!list->pruned) return OK;
    list->near_first = list->pruned_first;
    list->near_second = list->pruned_second;
    list->near_contact2 = list->pruned_contact2;
    list_prune(engine);
    return OK;
}

// With the pairs out of the list farther apart than contact + skin when it was made, and particles
// displaced by u since, flow apart, a pair can meet after a strain g only if
//     contact + skin < |S r| + 2 u,  |S r| <= contact (|g|/2 + sqrt(1 + g^2/4)),
// S undoing the strain. What the second adds to contact:
static double strained(const Engine *engine, double strain) {
    const double g = fabs(strain);
    return engine->largest * engine->scale * (g / 2 + g * g / 8);
}

// Between two moments at which displacements are looked at, flight is straight, but the flow that
// is taken off it is not: by less than this part of them.
static double bent(const Engine *engine) {
    return 1 + fabs(engine->rate) * engine->settings.window;
}

// Displacements since pruning add to those before, whose flow was taken off at another y.
double list_outer_reach(const Engine *engine) {
    const NeighbourList *list = &engine->list;
    const double skin = list->skin - engine->largest * (engine->scale - list->scale) -
                        strained(engine, list->strain_before + list->strain);
    return (skin / 2 - list->spent) / (bent(engine) * (1 + fabs(list->strain_before)));
}

double list_reach(const Engine *engine) {
    const NeighbourList *list = &engine->list;
    const double skin = list->inner_skin - engine->largest * (engine->scale - list->inner_scale) -
                        strained(engine, list->strain);
    return fmin(skin / 2 / bent(engine), list_outer_reach(engine));
}

void list_take_room(Engine *engine) {
    Room *room = &engine->room;
    NeighbourList *list = &engine->list;
    engine->cells_most = 2 * engine->count + 27;
    for (int a = 0; a < engine->dimension; a++) {
        TAKE_ARRAY(room, list->anchor[a], engine->slots);
        TAKE_ARRAY(room, list->origin[a], engine->slots);
    }
    TAKE_ARRAY(room, list->start, engine->count + 1);
    TAKE_ARRAY(room, list->pair_start, engine->count + 1);
    TAKE_ARRAY(room, engine->cell_of, engine->count + 1);
    TAKE_ARRAY(room, engine->cell_start, engine->cells_most + 1);
}

void list_free(Engine *engine) {
    NeighbourList *list = &engine->list;
    memory_free(list->first);
    memory_free(list->second);
    memory_free(list->pair_contact2);
    memory_free(list->hit_first);
    memory_free(list->hit_second);
    memory_free(list->pruned_first);
    memory_free(list->pruned_second);
    memory_free(list->pruned_contact2);
    memory_free(list->blocks);
}
