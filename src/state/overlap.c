// SPDX-License-Identifier: GPL-3.0-or-later
// The health check on overlaps: every pair of hard bodies that share space, by linked cells. It
// shares no code with the engines that it watches over. Soft spheres have an energy instead.
#include "base/memory.h"
#include "shapes/overlap.h"
#include "state/state.h"

#include <math.h>

typedef struct Cells {
    int64_t number[3];
    int64_t *first; // [cells], particle or -1
    int64_t *next;  // [count]
} Cells;

static Body body_of(const State *state, size_t i) {
    Body body = species_body(&state->system.species[state->species_of[i]]);
    body.diameter = state->diameter[i];
    return body;
}

static double reach_of(const State *state, size_t i) {
    const Body body = body_of(state, i);
    return shape_reach(&body);
}

// Cells at least as wide as the longest body, and so wide that there is about one for each particle
// at most; fewer than three along an axis are made one, where the nearest image alone is looked at.
static void choose_cells(Cells *cells, const State *state) {
    const double room = box_volume(&state->box) / (double)state->count;
    double width = state->box.dimension == 2 ? sqrt(room) : cbrt(room);
    for (size_t i = 0; i < state->count; i++) width = fmax(width, reach_of(state, i));
    for (int a = 0; a < 3; a++) {
        const double wide = a == 0 ? width * box_widening(&state->box) : width;
        const double fit = a < state->box.dimension ? state->box.edge[a] / wide : 1;
        cells->number[a] = fit < 3 ? 1 : (int64_t)fit;
    }
}

static void cell_at(const Cells *cells, const State *state, size_t i, int64_t at[3]) {
    const double r[3] = {state->position[0][i], state->position[1][i], state->position[2][i]};
    double fraction[3];
    box_fractions(&state->box, r, fraction);
    for (int a = 0; a < 3; a++) {
        const int64_t cell = (int64_t)(fraction[a] * (double)cells->number[a]);
        at[a] = cell < 0 ? 0 : cell >= cells->number[a] ? cells->number[a] - 1 : cell;
    }
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
        int64_t at[3];
        cell_at(cells, state, i, at);
        const int64_t cell = cell_index(cells, at);
        cells->next[i] = cells->first[cell];
        cells->first[cell] = (int64_t)i;
    }
    return OK;
}

static double length_of(const double r[3]) {
    return sqrt(vector_dot(r, r));
}

// Infinitely thin discs have no depth. Instead: how much of the chords that they cut from their
// common line the two share, over the mean diameter; of coplanar ones, which cut none, the depth of
// discs in a plane.
static double platelet_depth(const Body *a, const double u[3], const Body *b, const double v[3],
                             const double r[3]) {
    const double ra = a->diameter / 2, rb = b->diameter / 2;
    if (!platelet_overlap(ra, u, rb, v, r)) return 0;
    double w[3];
    vector_cross(u, v, w);
    const double sine2 = vector_dot(w, w), ru = vector_dot(r, u), rv = vector_dot(r, v);
    if (sine2 == 0) return 1 - length_of(r) / (ra + rb);
    const double half_a = sqrt(ra * ra - rv * rv / sine2);
    const double half_b = sqrt(rb * rb - ru * ru / sine2);
    const double apart = fabs(vector_dot(r, w)) / sqrt(sine2);
    const double shared = fmin(half_a + half_b - apart, 2 * fmin(half_a, half_b));
    return shared / (ra + rb);
}

// 1 - distance/contact, the distance being that of the segments inside two rods, of the disc of a
// platelet and the centre of a sphere, of the centres of two balls.
static double body_depth(const Body *a, const double u[3], const Body *b, const double v[3],
                         const double r[3]) {
    const bool a_is_flat = a->shape == SHAPE_PLATELET, b_is_flat = b->shape == SHAPE_PLATELET;
    if (a_is_flat && b_is_flat) return platelet_depth(a, u, b, v, r);
    if (a_is_flat) return 1 - 2 * sqrt(platelet_distance2(r, u, a->diameter / 2)) / b->diameter;
    if (b_is_flat) return 1 - 2 * sqrt(platelet_distance2(r, v, b->diameter / 2)) / a->diameter;
    const double distance2 = spherocylinder_distance2(r, u, a->length / 2, v, b->length / 2);
    return 1 - 2 * sqrt(distance2) / (a->diameter + b->diameter);
}

static void axis_of(const State *state, size_t i, double axis[3]) {
    for (int a = 0; a < 3; a++) axis[a] = state->orientation[a][i];
}

// r leads from i to j.
static double oriented_depth(const State *state, size_t i, size_t j, const double r[3]) {
    const Body a = body_of(state, i), b = body_of(state, j);
    double u[3], v[3];
    axis_of(state, i, u);
    axis_of(state, j, v);
    return body_depth(&a, u, &b, v, r);
}

static bool is_hard(const State *state, size_t i) {
    return shape_is_hard((ShapeKind)state->system.species[state->species_of[i]].shape);
}

static double overlap_depth(const State *state, size_t i, size_t j) {
    if (!is_hard(state, i) || !is_hard(state, j)) return 0;
    double r[3] = {0, 0, 0};
    for (int a = 0; a < state->box.dimension; a++) {
        r[a] = state->position[a][j] - state->position[a][i];
    }
    box_nearest_image(&state->box, r);
    if (state->oriented) return oriented_depth(state, i, j, r);
    return 1 - length_of(r) / ((state->diameter[i] + state->diameter[j]) / 2);
}

// Steps -1, 0, 1 along an axis, or only 0 where there is one cell.
static int reach(const Cells *cells, int axis) {
    return cells->number[axis] > 1 ? 1 : 0;
}

static void search_round(const Cells *cells, const State *state, size_t i, double depth,
                         double *deepest, uint64_t *pairs) {
    int64_t home[3];
    cell_at(cells, state, i, home);
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
