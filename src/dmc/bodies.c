// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of bodies with an axis, and of spheres among them: spherocylinders with spheres, or
// platelets with spheres.
#include "dmc/bodies.h"

#include "base/memory.h"
#include "dmc/bodies_move.h"

#include <string.h>

// What is possible

static Status check_pair(const Species *a, const Species *b) {
    if (overlap_is_known((ShapeKind)a->shape, (ShapeKind)b->shape)) return OK;
    return status_fail(BAD_DATA,
                       "Monte Carlo of bodies with an axis does not know how a %s (%s) and a %s "
                       "(%s) overlap: spherocylinders with spheres or platelets with spheres",
                       shape_names[a->shape], a->name, shape_names[b->shape], b->name);
}

// Beyond half an edge a body could meet two images of another.
static Status check_reach(const Box *box, double reach) {
    for (int a = 0; a < 3; a++) {
        if (2 * reach < box->edge[a]) continue;
        return status_fail(BAD_DATA,
                           "the longest body, %g d, must be shorter than half of every edge of the "
                           "box, %g d: more particles, please",
                           reach, box->edge[a]);
    }
    return OK;
}

static Status check(const System *system) {
    double reach = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        for (size_t t = 0; t <= s; t++) {
            TRY(check_pair(&system->species[t], &system->species[s]));
        }
        const Body body = species_body(&system->species[s]);
        reach = fmax(reach, shape_reach(&body));
    }
    const Box box = system_box(system);
    return check_reach(&box, reach);
}

// To and from the State

static const double UNITS = 0x1p32; // of places, in an edge

static Status allocate(Bodies *bodies, size_t count) {
    TRY(NEW_ARRAY(bodies->axis, count));
    TRY(NEW_ARRAY(bodies->body, count));
    for (int a = 0; a < 3; a++) TRY(NEW_ARRAY(bodies->place[a], count));
    return OK;
}

static void load(Bodies *bodies) {
    const State *state = bodies->state;
    for (int a = 0; a < 3; a++) {
        bodies->unit[a] = state->box.edge[a] / UNITS;
        bodies->units_per_d[a] = UNITS / state->box.edge[a];
        for (size_t i = 0; i < bodies->count; i++) {
            bodies->place[a][i] = ((int64_t)state->image[a][i] << 32) +
                                  bodies_whole(state->position[a][i] / bodies->unit[a]);
            bodies->axis[i][a] = state->orientation[a][i];
        }
    }
}

static void set_sizes(Bodies *bodies, double scale) {
    const State *state = bodies->state;
    bodies->scale = scale;
    for (size_t i = 0; i < bodies->count; i++) {
        Body body = species_body(&state->system.species[state->species_of[i]]);
        body.diameter = scale * state->diameter[i];
        body.length *= scale;
        bodies->body[i] = body;
    }
}

static double longest(const Bodies *bodies) {
    double reach = 0;
    for (size_t i = 0; i < bodies->count; i++) reach = fmax(reach, shape_reach(&bodies->body[i]));
    return reach;
}

static void discard(Chain *chain) {
    Bodies *bodies = (Bodies *)chain;
    for (int a = 0; a < 3; a++) memory_free(bodies->place[a]);
    memory_free(bodies->axis);
    memory_free(bodies->body);
    memory_free(bodies);
}

static Status prepare(Bodies *bodies, State *state) {
    TRY(allocate(bodies, state->count));
    load(bodies);
    set_sizes(bodies, 1);
    return check_reach(&state->box, longest(bodies));
}

static Status create(Chain **out, const ChainSettings *settings, State *state, RngKey key) {
    TRY(check(&state->system));
    Bodies *bodies = NULL;
    TRY(NEW(bodies));
    bodies->chain.kind = &chain_of_bodies;
    bodies->settings = *settings;
    bodies->key = key;
    bodies->state = state;
    bodies->count = state->count;
    const Status status = prepare(bodies, state);
    if (status != OK)
        discard(&bodies->chain);
    else
        *out = &bodies->chain;
    return status;
}

static void publish(Chain *chain) {
    const Bodies *bodies = (const Bodies *)chain;
    State *state = bodies->state;
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < bodies->count; i++) {
            const int64_t place = bodies->place[a][i];
            state->position[a][i] = (double)(uint32_t)place * bodies->unit[a];
            state->image[a][i] = (int32_t)(place >> 32);
            state->orientation[a][i] = bodies->axis[i][a];
        }
    }
}

static void set_amplitude(Chain *chain, size_t species, const Amplitude *amplitude) {
    ((Bodies *)chain)->amplitude[species] = *amplitude;
}

// Moves

// Pairs are looked at from the lower id, so that rounding cannot make a pair overlap that the
// partner's trial found apart.
static bool pair_overlaps(const Bodies *bodies, size_t i, size_t j, const int64_t place[3],
                          const double axis[3]) {
    const bool forward = i < j;
    double r[3];
    for (int a = 0; a < 3; a++) {
        const int32_t apart = (int32_t)((uint32_t)bodies->place[a][j] - (uint32_t)place[a]);
        r[a] = (forward ? 1 : -1) * (double)apart * bodies->unit[a];
    }
    const Body *body = bodies->body;
    return forward ? overlap_of(&body[i], axis, &body[j], bodies->axis[j], r)
                   : overlap_of(&body[j], bodies->axis[j], &body[i], axis, r);
}

static bool anything_overlaps(const Bodies *bodies, size_t i, const int64_t place[3],
                              const double axis[3]) {
    for (size_t j = 0; j < bodies->count; j++) {
        if (j != i && pair_overlaps(bodies, i, j, place, axis)) return true;
    }
    return false;
}

static void try_move(Bodies *bodies, const Draws *draws, size_t k, Tally *tally) {
    const size_t i = draws->body[k];
    const size_t species = bodies->state->species_of[i];
    const Amplitude *amplitude = &bodies->amplitude[species];
    MoveTally *moves = &tally->moves[species];
    double *u = bodies->axis[i];
    Proposal proposal;
    if (shape_is_oriented(bodies->body[i].shape))
        bodies_propose_oriented(bodies, bodies_turn_is_mixed(&bodies->settings), amplitude, draws,
                                k, u, &proposal);
    else
        bodies_propose_ball(bodies, amplitude, draws, k, u, &proposal);

    int64_t place[3];
    for (int a = 0; a < 3; a++) place[a] = bodies->place[a][i] + proposal.shift[a];
    moves->trials++;
    if (anything_overlaps(bodies, i, place, proposal.axis)) return;
    bodies_count_accepted(moves, &proposal, u);
    for (int a = 0; a < 3; a++) bodies->place[a][i] = place[a];
    memcpy(u, proposal.axis, sizeof proposal.axis);
}

static void draw_block(const Bodies *bodies, uint64_t block, Draws *draws) {
    uint32_t words[RNG_BLOCK], ids[2 * TRIALS];
    double normals[3][2 * TRIALS];
    rng_words(bodies->key, bodies->settings.stream, block, words);
    if (bodies->settings.gaussian) {
        for (uint32_t i = 0; i < 2 * TRIALS; i++) ids[i] = i;
        rng_normals(bodies->key, bodies->settings.stream, block, ids, 2 * TRIALS, 3,
                    (double *const[]){normals[0], normals[1], normals[2]});
    }
    bodies_draw(draws, &bodies->settings, bodies->count, words, normals);
}

static Status run(Chain *chain, int64_t trials, Tally *tally) {
    Bodies *bodies = (Bodies *)chain;
    int64_t *step = &bodies->state->step;
    const int64_t end = *step + trials;
    Draws draws;
    while (*step < end) {
        draw_block(bodies, (uint64_t)*step / TRIALS, &draws);
        do try_move(bodies, &draws, (size_t)(*step % TRIALS), tally);
        while (++*step < end && *step % TRIALS != 0);
    }
    return OK;
}

static bool rescale(Chain *chain, double scale) {
    Bodies *bodies = (Bodies *)chain;
    const double before = bodies->scale;
    set_sizes(bodies, scale);
    bool fits =
        2 * longest(bodies) < fmin(fmin(bodies->state->box.edge[0], bodies->state->box.edge[1]),
                                   bodies->state->box.edge[2]);
    for (size_t i = 0; fits && i < bodies->count; i++) {
        const int64_t place[3] = {bodies->place[0][i], bodies->place[1][i], bodies->place[2][i]};
        for (size_t j = 0; fits && j < i; j++) {
            fits = !pair_overlaps(bodies, i, j, place, bodies->axis[i]);
        }
    }
    if (!fits) set_sizes(bodies, before);
    return fits;
}

static size_t memory(const System *system) {
    return sizeof(Bodies) +
           (size_t)system->particles * (sizeof(Body) + 3 * sizeof(int64_t) + 3 * sizeof(double));
}

const ChainKind chain_of_bodies = {
    .check = check,
    .create = create,
    .set_amplitude = set_amplitude,
    .run = run,
    .publish = publish,
    .rescale = rescale,
    .free = discard,
    .memory = memory,
};
