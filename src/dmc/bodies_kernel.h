// SPDX-License-Identifier: GPL-3.0-or-later
// The hot loop of the chain of bodies, compiled once per instruction set and kind of mixture: draw,
// propose, look at those near, accept.
//
// Most pairs are settled in single precision, several at a time, whichever way they fall: the
// margins are what rounding can do at most, so that "surely" means surely. The exact function in
// doubles is asked about the few that are left, and so has the last word on every pair.
#include "dmc/bodies_lanes.h"
#include "dmc/bodies_move.h"

// 2^-24 is half a unit in the last place of a float near 1. Multiples of it that bound the error of
// the bounds below, by counting operations, are a third of this at most.
static const float ROUNDING = 256 * 0x1p-24f;

// The body that is tried, in every lane.
typedef struct Tried {
    BodyRow row;
    float unit[3];
} Tried;

typedef struct Separation {
    Floats r[3], r2;
} Separation;

KERNEL Floats dot(const Floats a[3], const Floats b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

KERNEL Separation separation(const Tried *tried, const Ints place[3]) {
    Separation apart;
    for (int a = 0; a < 3; a++) {
        apart.r[a] = floats_of(place[a] - tried->row.place[a]) * tried->unit[a];
    }
    apart.r2 = dot(apart.r, apart.r);
    return apart;
}

// Square of the distance of the segments, as spherocylinder_distance2. An error of s or t shows in
// second order only, so that a rough reciprocal will do.
KERNEL Floats rods_distance2(const Floats r[3], const Floats u[3], Floats core_u, const Floats v[3],
                             Floats core_v) {
    const Floats ru = dot(r, u), rv = dot(r, v), uv = dot(u, v);
    const Floats sine2 = floats_larger(1 - uv * uv, floats_all(1e-12f));
    const Floats s = floats_within((ru - uv * rv) * floats_reciprocal(sine2), core_u);
    const Floats t = floats_within(s * uv - rv, core_v);
    const Floats again = floats_within(t * uv + ru, core_u);
    Floats x[3];
    for (int a = 0; a < 3; a++) x[a] = r[a] + t * v[a] - again * u[a];
    return dot(x, x);
}

// The chords of Eppenga and Frenkel (platelet.h), all times sin^2.
typedef struct Chords {
    Floats u2, v2; // squares of the half chords
    Floats apart2; // square of how far their middles are apart
    Floats ru, rv; // heights of the centres over the planes
    Floats w2;     // sin^2
    Floats scale2; // that errors are relative to
} Chords;

KERNEL Chords chords(const Separation *apart, const Floats u[3], Floats radius_u, const Floats v[3],
                     Floats radius_v) {
    const Floats *r = apart->r;
    const Floats w[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                         u[0] * v[1] - u[1] * v[0]};
    const Floats along = dot(r, w);
    Chords c = {.ru = dot(r, u), .rv = dot(r, v), .w2 = dot(w, w), .apart2 = along * along};
    c.u2 = radius_u * radius_u * c.w2 - c.rv * c.rv;
    c.v2 = radius_v * radius_v * c.w2 - c.ru * c.ru;
    c.scale2 = apart->r2 + radius_u * radius_u + radius_v * radius_v;
    return c;
}

// Two bits for each lane.
typedef struct Verdict {
    unsigned surely, perhaps; // overlap; neither: surely not
} Verdict;

KERNEL Verdict rods_verdict(const Separation *apart, const Floats u[3], Floats core_u,
                            const Floats v[3], Floats core_v, Floats contact) {
    const Floats d2 = rods_distance2(apart->r, u, core_u, v, core_v);
    const Floats cores = core_u + core_v;
    const Floats error = ROUNDING * (apart->r2 + cores * cores + contact * contact);
    const Floats beyond = d2 - contact * contact;
    const unsigned surely = floats_below(beyond, -error);
    return (Verdict){surely, floats_below(beyond, error) & ~surely};
}

// |r.w| < sqrt(u2) + sqrt(v2), squared twice.
KERNEL Verdict discs_verdict(const Separation *apart, const Floats u[3], Floats radius_u,
                             const Floats v[3], Floats radius_v) {
    const Chords c = chords(apart, u, radius_u, v, radius_v);
    const Floats error = ROUNDING * c.scale2, error2 = 8 * error * c.scale2;
    const Floats shorter = floats_smaller(c.u2, c.v2);
    const Floats x = c.apart2 - c.u2 - c.v2, y = x * x - 4 * c.u2 * c.v2;
    const unsigned surely_cut = floats_below(error, shorter);
    const unsigned surely_meet = floats_below(x, -error) | floats_below(y, -error2);
    const unsigned surely = surely_cut & surely_meet;
    const unsigned never =
        floats_below(shorter, -error) | (floats_below(error, x) & floats_below(error2, y));
    return (Verdict){surely, ~(surely | never)};
}

// Platelets and spheres: those with a sphere are for the exact function if near enough.
KERNEL Verdict flat_verdict(const int mixed, const Separation *apart, const Tried *tried,
                            const Floats u[3], Floats radius_u, const Rows *rows, Floats radius_v) {
    const Verdict discs = discs_verdict(apart, u, radius_u, rows->axis, radius_v);
    if (!mixed) return discs;
    const Floats contact = radius_u + radius_v;
    const unsigned balls = floats_below(rows->core * tried->row.core, floats_all(0.5f));
    const unsigned near = floats_below(apart->r2, contact * contact * 1.001f);
    return (Verdict){discs.surely & ~balls, (discs.perhaps & ~balls) | (near & balls)};
}

KERNEL Verdict verdict(const int flat, const int mixed, const Tried *tried, const Rows *rows) {
    const Separation apart = separation(tried, rows->place);
    Floats u[3];
    for (int a = 0; a < 3; a++) u[a] = floats_all(tried->row.axis[a]);
    const Floats radius = floats_all(tried->row.radius), core = floats_all(tried->row.core);
    const Floats other_radius = mixed ? rows->radius : radius;
    const Floats other_core = mixed ? rows->core : core;
    if (flat) return flat_verdict(mixed, &apart, tried, u, radius, rows, other_radius);
    return rods_verdict(&apart, u, core, rows->axis, other_core, radius + other_radius);
}

KERNEL bool one_overlaps(const Bodies *bodies, size_t i, const Pose *pose, const uint32_t *ids,
                         unsigned bits) {
    for (; bits; bits &= bits - 1) {
        if (bodies_pair_overlaps(bodies, i, pose, ids[__builtin_ctz(bits)])) return true;
    }
    return false;
}

KERNEL unsigned lanes_up_to(size_t count) {
    return count >= WIDTH ? (1u << (WIDTH - 1) << 1) - 1 : (1u << count) - 1;
}

// Looks at `count` bodies by their numbers; room to read whole vectors of them is needed.
KERNEL bool overlaps_any_of(const int flat, const int mixed, const Bodies *bodies, size_t i,
                            const Pose *pose, const Tried *tried, const uint32_t *ids,
                            size_t count) {
    for (size_t k = 0; k < count; k += WIDTH) {
        const Rows rows = rows_load(bodies->row, ids + k);
        const Verdict found = verdict(flat, mixed, tried, &rows);
        const unsigned valid = lanes_up_to(count - k);
        if (found.surely & valid) return true;
        if (one_overlaps(bodies, i, pose, ids + k, found.perhaps & valid)) return true;
    }
    return false;
}

// Who is near

KERNEL BodyRow row_at(const Bodies *bodies, size_t i, const Pose *pose) {
    BodyRow row = bodies->row[i];
    for (int a = 0; a < 3; a++) {
        row.place[a] = (int32_t)(uint32_t)pose->place[a];
        row.axis[a] = (float)pose->axis[a];
    }
    return row;
}

KERNEL Tried tried_row(const Bodies *bodies, BodyRow row) {
    Tried tried = {.row = row};
    for (int a = 0; a < 3; a++) tried.unit[a] = (float)bodies->unit[a];
    return tried;
}

// May the discs be nearer than `skin`? Along any direction n they are at least
// |r.n| - R_u |u x n| - R_v |v x n| apart: tried are both normals, the line common to the planes,
// and the line of the centres.
KERNEL unsigned discs_near(const Separation *apart, const Floats u[3], Floats radius_u,
                           const Floats v[3], Floats radius_v, Floats skin) {
    const Chords c = chords(apart, u, radius_u, v, radius_v);
    const Floats w = floats_sqrt(c.w2), r = floats_sqrt(apart->r2);
    const Floats ru = floats_absolute(c.ru), rv = floats_absolute(c.rv);
    const Floats error = ROUNDING * apart->r2; // at least that of the differences
    const Floats side_u = floats_sqrt(floats_larger(apart->r2 - c.ru * c.ru, error) + error);
    const Floats side_v = floats_sqrt(floats_larger(apart->r2 - c.rv * c.rv, error) + error);
    return floats_below(ru, radius_v * w + skin) & floats_below(rv, radius_u * w + skin) &
           floats_below(floats_sqrt(c.apart2), (radius_u + radius_v + skin) * w + 0.001f * skin) &
           floats_below(apart->r2, radius_u * side_u + radius_v * side_v + skin * r);
}

KERNEL unsigned near_lanes(const int flat, const Tried *tried, const Rows *rows, float swell,
                           float skin) {
    const Separation apart = separation(tried, rows->place);
    Floats u[3];
    for (int a = 0; a < 3; a++) u[a] = floats_all(tried->row.axis[a]);
    const Floats radius = floats_all(swell * tried->row.radius), core = floats_all(tried->row.core);
    const Floats other = swell * rows->radius, wide = floats_all(skin);
    const Floats contact = radius + other + skin;
    if (!flat) {
        const Floats d2 = rods_distance2(apart.r, u, swell * core, rows->axis, swell * rows->core);
        const Floats cores = swell * (core + rows->core);
        return floats_below(d2 - ROUNDING * (apart.r2 + cores * cores), contact * contact);
    }
    const unsigned balls = floats_below(core * rows->core, floats_all(0.5f));
    return (floats_below(apart.r2, contact * contact) & balls) |
           (discs_near(&apart, u, radius, rows->axis, other, wide) & ~balls);
}

KERNEL uint32_t cell_along(const BodyCells *cells, int axis, int32_t place) {
    return (uint32_t)((uint64_t)(uint32_t)place * cells->number[axis] >> 32);
}

KERNEL void leave_cell(BodyCells *cells, size_t i) {
    const uint32_t cell = cells->cell[i];
    if (cell == UINT32_MAX) return;
    const size_t hole = cell * cells->room + cells->at[i];
    const size_t last = cell * cells->room + --cells->held[cell];
    for (int a = 0; a < 3; a++) cells->place[a][hole] = cells->place[a][last];
    cells->id[hole] = cells->id[last];
    cells->at[cells->id[hole]] = cells->at[i];
}

KERNEL bool enter_cell(BodyCells *cells, size_t i, const int32_t place[3]) {
    uint32_t cell = 0;
    for (int a = 2; a >= 0; a--) cell = cell * cells->number[a] + cell_along(cells, a, place[a]);
    cells->cell[i] = cell;
    if (cells->held[cell] == cells->room) return false;
    cells->at[i] = cells->held[cell]++;
    const size_t slot = cell * cells->room + cells->at[i];
    for (int a = 0; a < 3; a++) cells->place[a][slot] = place[a];
    cells->id[slot] = (uint32_t)i;
    return true;
}

// Adds the bodies of a cell whose anchored centres are near to the candidates.
KERNEL size_t search_cell(const BodyLists *lists, size_t cell, size_t i, const Tried *tried,
                          float reach2, size_t found) {
    const BodyCells *cells = &lists->cells;
    const size_t first = cell * cells->room, held = cells->held[cell];
    const Ints itself = (Ints){0} + (int32_t)i;
    for (size_t k = 0; k < held; k += WIDTH) {
        Ints place[3];
        for (int a = 0; a < 3; a++) place[a] = ints_load(cells->place[a] + first + k);
        const Separation apart = separation(tried, place);
        const unsigned others = ~ints_equal(ints_load(cells->id + first + k), itself);
        const unsigned bits =
            floats_below(apart.r2, floats_all(reach2)) & others & lanes_up_to(held - k);
        ids_pack(lists->candidate + found, bits, cells->id + first + k);
        found += (unsigned)__builtin_popcount(bits);
    }
    return found;
}

// The home cell and its neighbours; along an axis of one cell there are none.
KERNEL size_t search_cells(const BodyLists *lists, size_t i, const Tried *tried, float reach2) {
    const BodyCells *cells = &lists->cells;
    size_t found = 0;
    if (cells->total == 1) return search_cell(lists, 0, i, tried, reach2, 0);
    uint32_t home[3];
    int side[3];
    for (int a = 0; a < 3; a++) {
        home[a] = cell_along(cells, a, tried->row.place[a]);
        side[a] = cells->number[a] > 1;
    }
    for (int z = -side[2]; z <= side[2]; z++) {
        for (int y = -side[1]; y <= side[1]; y++) {
            for (int x = -side[0]; x <= side[0]; x++) {
                const int step[3] = {x, y, z};
                uint32_t cell = 0;
                for (int a = 2; a >= 0; a--) {
                    const uint32_t number = cells->number[a];
                    cell = cell * number + (home[a] + number + (uint32_t)step[a]) % number;
                }
                found = search_cell(lists, cell, i, tried, reach2, found);
            }
        }
    }
    return found;
}

KERNEL bool list_holds(const uint32_t *ids, size_t held, uint32_t id) {
    const Ints wanted = (Ints){0} + (int32_t)id;
    for (size_t k = 0; k < held; k += WIDTH) {
        if (ints_equal(ints_load(ids + k), wanted) & lanes_up_to(held - k)) return true;
    }
    return false;
}

KERNEL void list_add(Bodies *bodies, size_t i, uint32_t id) {
    BodyLists *lists = &bodies->lists;
    if (lists->held[i] == lists->room)
        bodies->stale = true;
    else
        lists->near[i * lists->room + lists->held[i]++] = id;
}

KERNEL void list_both_ways(Bodies *bodies, size_t i, uint32_t id) {
    BodyLists *lists = &bodies->lists;
    list_add(bodies, i, id);
    if (list_holds(lists->near + id * lists->room, lists->held[id], (uint32_t)i)) return;
    list_add(bodies, id, (uint32_t)i);
}

KERNEL void anchor(const int flat, Bodies *bodies, size_t i) {
    BodyLists *lists = &bodies->lists;
    const BodyRow row = bodies->row[i];
    const Tried tried = tried_row(bodies, row);
    const float swell = lists->swell;
    const float longest = swell * (float)bodies->longest;
    const float skin = lists->skin + ROUNDING * (longest + lists->skin), reach = longest + skin;
    lists->anchor[i] = row;
    lists->held[i] = 0;
    leave_cell(&lists->cells, i);
    if (!enter_cell(&lists->cells, i, row.place)) {
        bodies->stale = true;
        return;
    }
    if (!(lists->skin > 0)) return;
    const size_t found = search_cells(lists, i, &tried, reach * reach * 1.00001f);
    for (size_t k = 0; k < found; k += WIDTH) {
        const uint32_t *ids = lists->candidate + k;
        const Rows rows = rows_load(lists->anchor, ids);
        unsigned bits = near_lanes(flat, &tried, &rows, swell, skin);
        for (bits &= lanes_up_to(found - k); bits; bits &= bits - 1) {
            list_both_ways(bodies, i, ids[__builtin_ctz(bits)]);
        }
    }
}

// Square of at most how far any point of the core is from where it was anchored: the centre's
// displacement and the rim's add up.
KERNEL float strayed(const int flat, const Tried *tried, const BodyRow *from, float swell) {
    const BodyRow *to = &tried->row;
    float place2 = 0, turn2 = 0;
    for (int a = 0; a < 3; a++) {
        const float x =
            (float)(int32_t)((uint32_t)to->place[a] - (uint32_t)from->place[a]) * tried->unit[a];
        const float y = to->axis[a] - from->axis[a];
        place2 += x * x;
        turn2 += y * y;
    }
    const float rim = flat ? to->radius * to->core : to->core;
    return __builtin_sqrtf(place2) + swell * rim * __builtin_sqrtf(turn2);
}

// Trials

// All whose anchored centres are near enough: resting bodies have not strayed far from theirs.
KERNEL bool overlaps_nearby(const int flat, const int mixed, const Bodies *bodies, size_t i,
                            const Pose *pose, const Tried *tried) {
    const BodyLists *lists = &bodies->lists;
    const float reach = 1.0001f * (float)(bodies->longest + lists->rest);
    const size_t found = search_cells(lists, i, tried, reach * reach);
    return overlaps_any_of(flat, mixed, bodies, i, pose, tried, lists->candidate, found);
}

// Beyond its leash a body may meet others than those on its list.
KERNEL bool trial_overlaps(const int flat, const int mixed, const Bodies *bodies, size_t i,
                           const Pose *pose, const Tried *tried, float *way) {
    const BodyLists *lists = &bodies->lists;
    *way = strayed(flat, tried, &lists->anchor[i], lists->swell);
    if (*way > lists->leash) return overlaps_nearby(flat, mixed, bodies, i, pose, tried);
    return overlaps_any_of(flat, mixed, bodies, i, pose, tried, lists->near + i * lists->room,
                           lists->held[i]);
}

// Trial k of the block, of body i; whether it was accepted.
KERNEL bool try_move(const int flat, const int mixed, Bodies *bodies, const Draws *draws, size_t k,
                     size_t i, Tally *tally) {
    const size_t species = bodies->state->species_of[i];
    const Amplitude *amplitude = &bodies->amplitude[species];
    Pose *now = &bodies->pose[i], then;
    Proposal proposal;
    if (!mixed || shape_is_oriented(bodies->body[i].shape))
        bodies_propose_oriented(bodies, bodies_turn_is_mixed(&bodies->settings), amplitude, draws,
                                k, now->axis, &proposal);
    else
        bodies_propose_ball(bodies, amplitude, draws, k, now->axis, &proposal);
    for (int a = 0; a < 3; a++) {
        then.place[a] = now->place[a] + proposal.shift[a];
        then.axis[a] = proposal.axis[a];
    }
    const Tried tried = tried_row(bodies, row_at(bodies, i, &then));
    MoveTally *moves = &tally->moves[species];
    moves->trials++;
    float way;
    if (trial_overlaps(flat, mixed, bodies, i, &then, &tried, &way)) return false;
    bodies_count_accepted(moves, &proposal, now->axis);
    *now = then;
    bodies->row[i] = tried.row;
    if (way > bodies->lists.rest) anchor(flat, bodies, i);
    return true;
}

KERNEL size_t try_moves(const int flat, const int mixed, Bodies *bodies, const Draws *draws,
                        size_t from, size_t to, Tally *tally) {
    size_t k = from;
    for (; k < to && !bodies->stale; k++) {
        try_move(flat, mixed, bodies, draws, k, draws->body[k], tally);
    }
    return k - from;
}

static void draw(Draws *draws, const ChainSettings *settings, size_t count, const uint32_t *words,
                 double *const normals[3]) {
    bodies_draw(draws, settings, count, words, normals);
}

// Becomes: static size_t try_moves_rods(Bodies *...), static void anchor_rods, ...
#define INSTANCE(name, flat, mixed)                                                                \
    static size_t try_moves_##name(Bodies *bodies, const Draws *draws, size_t from, size_t to,     \
                                   Tally *tally) {                                                 \
        return try_moves(flat, mixed, bodies, draws, from, to, tally);                             \
    }                                                                                              \
    static bool try_body_##name(Bodies *bodies, const Draws *draws, size_t k, size_t i,            \
                                Tally *tally) {                                                    \
        return try_move(flat, mixed, bodies, draws, k, i, tally);                                  \
    }                                                                                              \
    static void anchor_##name(Bodies *bodies, size_t i) {                                          \
        anchor(flat, bodies, i);                                                                   \
    }                                                                                              \
    static bool overlaps_##name(Bodies *bodies, size_t i) {                                        \
        const Tried tried = tried_row(bodies, bodies->row[i]);                                     \
        float way;                                                                                 \
        return trial_overlaps(flat, mixed, bodies, i, &bodies->pose[i], &tried, &way);             \
    }
INSTANCE(rods, 0, 0)
INSTANCE(rods_and_balls, 0, 1)
INSTANCE(discs, 1, 0)
INSTANCE(discs_and_balls, 1, 1)
#undef INSTANCE

#define ROW(name)                                                                                  \
    { draw, try_moves_##name, try_body_##name, anchor_##name, overlaps_##name }
#define BODIES_KERNEL(path)                                                                        \
    const BodiesKernel bodies_kernels_##path[2][2] = {{ROW(rods), ROW(rods_and_balls)},            \
                                                      {ROW(discs), ROW(discs_and_balls)}};
