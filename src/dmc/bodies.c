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
                       "species '%s' and '%s': how a %s and a %s overlap is not known; mix "
                       "spherocylinders with spheres, or platelets with spheres",
                       a->name, b->name, shape_names[a->shape], shape_names[b->shape]);
}

// Beyond half an edge a body could meet two images of another.
static Status check_reach(const Box *box, double reach) {
    for (int a = 0; a < 3; a++) {
        if (2 * reach < box->edge[a]) continue;
        return status_fail(
            BAD_DATA,
            "the longest body, %g d, is not shorter than half of an edge of the box, "
            "%g d, so that it could meet two images of another; take more particles",
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
    TRY(NEW_ARRAY(bodies->pose, count));
    TRY(NEW_ARRAY(bodies->body, count));
    TRY(NEW_ARRAY(bodies->row, count));
    return NEW(bodies->draws);
}

static void load(Bodies *bodies) {
    const State *state = bodies->state;
    for (int a = 0; a < 3; a++) {
        bodies->unit[a] = state->box.edge[a] / UNITS;
        bodies->units_per_d[a] = UNITS / state->box.edge[a];
        for (size_t i = 0; i < bodies->count; i++) {
            bodies->pose[i].place[a] = (int64_t)state->image[a][i] * (INT64_C(1) << 32) +
                                       bodies_whole(state->position[a][i] / bodies->unit[a]);
            bodies->pose[i].axis[a] = state->orientation[a][i];
        }
    }
}

BodyRow bodies_row(const Bodies *bodies, size_t i) {
    const Pose *pose = &bodies->pose[i];
    const Body *body = &bodies->body[i];
    BodyRow row = {.radius = (float)(body->diameter / 2), .core = (float)(body->length / 2)};
    if (bodies->flat) row.core = body->shape == SHAPE_PLATELET;
    for (int a = 0; a < 3; a++) {
        row.place[a] = (int32_t)(uint32_t)pose->place[a];
        row.axis[a] = (float)pose->axis[a];
    }
    return row;
}

static void set_sizes(Bodies *bodies, double scale) {
    const State *state = bodies->state;
    bodies->scale = scale;
    bodies->longest = 0;
    bodies->lists.swell = (float)(bodies->lists.scale / scale * 1.00001);
    for (size_t i = 0; i < bodies->count; i++) {
        Body body = species_body(&state->system.species[state->species_of[i]]);
        body.diameter = scale * state->diameter[i];
        body.length *= scale;
        bodies->body[i] = body;
        bodies->row[i] = bodies_row(bodies, i);
        bodies->longest = fmax(bodies->longest, shape_reach(&body));
    }
}

// Are all bodies of one size, and have an axis?
static bool are_alike(const Bodies *bodies) {
    const Body *first = &bodies->body[0];
    for (size_t i = 0; i < bodies->count; i++) {
        const Body *body = &bodies->body[i];
        if (body->shape != first->shape || body->diameter != first->diameter ||
            body->length != first->length) {
            return false;
        }
    }
    return true;
}

static bool has_platelets(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        if (system->species[s].shape == SHAPE_PLATELET) return true;
    }
    return false;
}

static const BodiesKernel *choose_kernel(const Bodies *bodies) {
    const int mixed = !are_alike(bodies);
    switch (cpu_path()) {
#if defined(__x86_64__)
    case CPU_AVX512:
        return &bodies_kernels_avx512[bodies->flat][mixed];
    case CPU_AVX2:
        return &bodies_kernels_avx2[bodies->flat][mixed];
#endif
    default:
        return &bodies_kernels_portable[bodies->flat][mixed];
    }
}

static void discard(Chain *chain) {
    Bodies *bodies = (Bodies *)chain;
    bodies_lists_free(bodies);
    memory_free(bodies->pose);
    memory_free(bodies->body);
    memory_free(bodies->row);
    memory_free(bodies->draws);
    memory_free(bodies);
}

// The first that overlaps another, or the count.
static size_t first_overlapping(Bodies *bodies) {
    size_t i = 0;
    while (i < bodies->count && !bodies->kernel->overlaps(bodies, i)) i++;
    return i;
}

static Status check_start(Bodies *bodies) {
    const size_t i = first_overlapping(bodies);
    if (i == bodies->count) return OK;
    return status_fail(UNHEALTHY, "particle %zu overlaps another where Monte Carlo begins", i);
}

static Status prepare(Bodies *bodies, State *state) {
    TRY(allocate(bodies, state->count));
    load(bodies);
    set_sizes(bodies, bodies->settings.scale > 0 ? bodies->settings.scale : 1);
    TRY(check_reach(&state->box, bodies->longest));
    bodies->kernel = choose_kernel(bodies);
    TRY(bodies_lists_create(bodies));
    return check_start(bodies);
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
    bodies->flat = has_platelets(&state->system);
    bodies->drawn = -1;
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
            const int64_t place = bodies->pose[i].place[a];
            state->position[a][i] = (double)(uint32_t)place * bodies->unit[a];
            state->image[a][i] = (int32_t)(place >> 32);
            state->orientation[a][i] = bodies->pose[i].axis[a];
        }
    }
}

static void set_amplitude(Chain *chain, size_t species, const Amplitude *amplitude) {
    Bodies *bodies = (Bodies *)chain;
    bodies->amplitude[species] = *amplitude;
    if (!bodies_skin_suits(bodies)) bodies->stale = true;
}

// Moves

static void draw_block(Bodies *bodies, int64_t block) {
    uint32_t words[RNG_BLOCK], ids[2 * TRIALS];
    double x[2 * TRIALS], y[2 * TRIALS], z[2 * TRIALS];
    double *const normals[3] = {x, y, z};
    if (bodies->drawn == block) return;
    bodies->drawn = block;
    rng_words(bodies->key, bodies->settings.stream, (uint64_t)block, words);
    if (bodies->settings.gaussian) {
        for (uint32_t i = 0; i < 2 * TRIALS; i++) ids[i] = i;
        rng_normals(bodies->key, bodies->settings.stream, (uint64_t)block, ids, 2 * TRIALS, 3,
                    normals);
    }
    bodies->kernel->draw(bodies->draws, &bodies->settings, bodies->count, words, normals);
}

static Status renew_lists(Bodies *bodies) {
    return bodies->stale ? bodies_lists_build(bodies, fmax(bodies->lists.scale, bodies->scale))
                         : OK;
}

static const ChainPull *pull_of(const Bodies *bodies) {
    return bodies->pulled ? &bodies->pull : NULL;
}

// Lists that do not serve any more stop the trials after one that was made, so that none is at the
// beginning of a cycle twice.
static Status begin_cycle(Bodies *bodies, int64_t step, Tally *tally) {
    if (!pull_is_due(pull_of(bodies), step, bodies->count)) return OK;
    TRY(renew_lists(bodies));
    bodies_pull_trial(bodies, step, tally->moves);
    return OK;
}

static Status run(Chain *chain, int64_t trials, Tally *tally) {
    Bodies *bodies = (Bodies *)chain;
    int64_t *step = &bodies->state->step;
    const int64_t end = *step + trials;
    while (*step < end) {
        TRY(begin_cycle(bodies, *step, tally));
        TRY(renew_lists(bodies));
        const int64_t block = *step / TRIALS, from = *step % TRIALS;
        const int64_t left = end - *step, most = TRIALS - from < left ? TRIALS - from : left;
        draw_block(bodies, block);
        const Draws *draws = bodies->draws;
        const size_t calm = pull_calm(pull_of(bodies), *step, bodies->count, draws->body + from,
                                      UINT32_MAX, (size_t)most);
        const size_t made =
            bodies->kernel->try_moves(bodies, draws, (size_t)from, (size_t)from + calm, tally);
        *step += (int64_t)(calm > 0 ? made : 1);
    }
    return OK;
}

static void pull(Chain *chain, const ChainPull *given) {
    Bodies *bodies = (Bodies *)chain;
    bodies->pulled = given != NULL;
    if (given) bodies->pull = *given;
}

// Sizes

static const double AHEAD = 1.02; // what lists are made for, of the scale asked for

static bool has_room(const Bodies *bodies) {
    const double *edge = bodies->state->box.edge;
    return 2 * bodies->longest < fmin(fmin(edge[0], edge[1]), edge[2]);
}

// Lists are made for bodies somewhat larger than asked for, so that slow growth needs new ones
// rarely.
static bool set_scale(Bodies *bodies, double scale) {
    const BodyLists *lists = &bodies->lists;
    set_sizes(bodies, scale);
    if (!has_room(bodies)) return false;
    if (!bodies->stale && scale <= lists->scale && scale >= lists->scale / AHEAD / AHEAD) {
        return true;
    }
    return bodies_lists_build(bodies, AHEAD * scale) == OK;
}

static void set_scale_back(Bodies *bodies, double scale) {
    set_sizes(bodies, scale);
    bodies->stale |= scale > bodies->lists.scale;
}

static bool rescale(Chain *chain, double scale) {
    Bodies *bodies = (Bodies *)chain;
    const double before = bodies->scale;
    if (set_scale(bodies, scale) && first_overlapping(bodies) == bodies->count) return true;
    set_scale_back(bodies, before);
    return false;
}

// Trials of this body alone, until one is accepted: then it overlaps nothing.
static bool part(Bodies *bodies, size_t i) {
    static const int ATTEMPTS = 30;
    Tally unread = {0};
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        if (renew_lists(bodies) != OK) return false;
        const int64_t step = bodies->state->step++;
        draw_block(bodies, step / TRIALS);
        if (bodies->kernel->try_body(bodies, bodies->draws, (size_t)(step % TRIALS), i, &unread)) {
            return true;
        }
    }
    return false;
}

// One that cannot part may be left by whom it overlaps.
static bool part_all(Bodies *bodies) {
    bool sure = true;
    for (size_t i = 0; i < bodies->count; i++) {
        if (bodies->kernel->overlaps(bodies, i)) sure &= part(bodies, i);
    }
    return sure || first_overlapping(bodies) == bodies->count;
}

// Where nothing overlaps at the larger size, nothing does at the smaller one.
static bool squeeze(Chain *chain, double scale) {
    Bodies *bodies = (Bodies *)chain;
    const double before = bodies->scale;
    if (set_scale(bodies, scale) && part_all(bodies)) return true;
    set_scale_back(bodies, before);
    return false;
}

static size_t memory(const System *system) {
    enum { IDS = 64 }; // on lists and in cells
    return sizeof(Bodies) + sizeof(Draws) +
           (size_t)system->particles *
               (sizeof(Body) + sizeof(Pose) + 2 * sizeof(BodyRow) + IDS * sizeof(uint32_t));
}

const ChainKind chain_of_bodies = {
    .check = check,
    .create = create,
    .set_amplitude = set_amplitude,
    .pull = pull,
    .run = run,
    .publish = publish,
    .rescale = rescale,
    .squeeze = squeeze,
    .free = discard,
    .memory = memory,
};
