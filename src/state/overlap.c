// SPDX-License-Identifier: GPL-3.0-or-later
// The health check on overlaps: every pair of hard bodies that share space, by linked cells. It
// shares no code with the engines that it watches over. Soft spheres have an energy instead.
#include "base/memory.h"
#include "state/state.h"

#include <math.h>

typedef struct Cells {
    int64_t number[3];
    int64_t *first; // [cells], particle or -1
    int64_t *next;  // [count]
} Cells;

static double reach_of(const State *state, size_t i) {
    Body body = species_body(&state->system.species[state->species_of[i]]);
    body.diameter = state->diameter[i];
    return shape_reach(&body);
}

// Cells at least as wide as the longest body, and so wide that there is about one for each particle
// at most; fewer than three along an axis are made one, where the nearest image alone is looked at.
static void choose_cells(Cells *cells, const State *state) {
    const double room = box_volume(&state->box) / (double)state->count;
    double width = state->box.dimension == 2 ? sqrt(room) : cbrt(room);
    for (size_t i = 0; i < state->count; i++) width = fmax(width, reach_of(state, i));
    for (int a = 0; a < 3; a++) {
        const double fit = a < state->box.dimension ? state->box.edge[a] / width : 1;
        cells->number[a] = fit < 3 ? 1 : (int64_t)fit;
    }
}

static int64_t cell_along(const Cells *cells, const State *state, int axis, size_t i) {
    const double fraction = state->position[axis][i] / state->box.edge[axis];
    const int64_t cell = (int64_t)(fraction * (double)cells->number[axis]);
    return cell < 0 ? 0 : cell >= cells->number[axis] ? cells->number[axis] - 1 : cell;
}

static int64_t cell_index(const Cells *cells, const int64_t at[3]) {
    return (at[2] * cells->number[1] + at[1]) * cells->number[0] + at[0];
}

static Status fill_cells(Cells *cells, const State *state) {
    const size_t total =
        (size_t)cells->number[0] * (size_t)cells->number[1] * (size_t)cells->number[2];
    TRY(NEW_ARRAY(cells->first, total));
    TRY(NEW_ARRAY(cells->next, state->count));
    for (size_t c = 0; c < total; c++) cells->first[c] = -1;
    for (size_t i = 0; i < state->count; i++) {
        int64_t at[3] = {0, 0, 0};
        for (int a = 0; a < state->box.dimension; a++) at[a] = cell_along(cells, state, a, i);
        const int64_t cell = cell_index(cells, at);
        cells->next[i] = cells->first[cell];
        cells->first[cell] = (int64_t)i;
    }
    return OK;
}

static bool is_hard(const State *state, size_t i) {
    return shape_is_hard((ShapeKind)state->system.species[state->species_of[i]].shape);
}

static double overlap_depth(const State *state, size_t i, size_t j) {
    if (!is_hard(state, i) || !is_hard(state, j)) return 0;
    double r[3] = {0, 0, 0};
    for (int a = 0; a < state->box.dimension; a++) {
        r[a] = state->position[a][i] - state->position[a][j];
    }
    box_nearest_image(&state->box, r);
    const double contact = (state->diameter[i] + state->diameter[j]) / 2;
    return 1 - sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / contact;
}

// Steps -1, 0, 1 along an axis, or only 0 where there is one cell.
static int reach(const Cells *cells, int axis) {
    return cells->number[axis] > 1 ? 1 : 0;
}

static void search_round(const Cells *cells, const State *state, size_t i, double depth,
                         double *deepest, uint64_t *pairs) {
    int64_t home[3] = {0, 0, 0};
    for (int a = 0; a < state->box.dimension; a++) home[a] = cell_along(cells, state, a, i);
    for (int dz = -reach(cells, 2); dz <= reach(cells, 2); dz++) {
        for (int dy = -reach(cells, 1); dy <= reach(cells, 1); dy++) {
            for (int dx = -reach(cells, 0); dx <= reach(cells, 0); dx++) {
                const int step[3] = {dx, dy, dz};
                int64_t at[3];
                for (int a = 0; a < 3; a++) {
                    at[a] = (home[a] + step[a] + cells->number[a]) % cells->number[a];
                }
                int64_t j = cells->first[cell_index(cells, at)];
                for (; j >= 0; j = cells->next[j]) {
                    if (j <= (int64_t)i) continue;
                    const double found = overlap_depth(state, i, (size_t)j);
                    *deepest = fmax(*deepest, found);
                    *pairs += found > depth;
                }
            }
        }
    }
}

Status state_deepest_overlap(const State *state, double depth, double *deepest, uint64_t *pairs) {
    Cells cells = {.first = NULL};
    choose_cells(&cells, state);
    const Status status = fill_cells(&cells, state);
    double worst = 0;
    uint64_t found = 0;
    for (size_t i = 0; status == OK && i < state->count; i++) {
        search_round(&cells, state, i, depth, &worst, &found);
    }
    *deepest = worst;
    if (pairs) *pairs = found;
    memory_free(cells.first);
    memory_free(cells.next);
    return status;
}
