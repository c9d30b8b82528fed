// SPDX-License-Identifier: GPL-3.0-or-later
// The plain, slow twin of the chain of bodies.
#include "reference_bodies.h"

#include "base/memory.h"
#include "dmc/bodies_move.h"

#include <string.h>

struct ReferenceBodies {
    Bodies bodies; // of which only sizes, poses and amplitudes are used
};

Status reference_bodies_create(ReferenceBodies **out, const ChainSettings *settings, State *state,
                               RngKey key) {
    TRY(NEW(*out));
    Bodies *bodies = &(*out)->bodies;
    *bodies = (Bodies){.settings = *settings, .key = key, .state = state, .count = state->count};
    TRY(NEW_ARRAY(bodies->pose, state->count));
    TRY(NEW_ARRAY(bodies->body, state->count));
    TRY(NEW(bodies->draws));
    for (int a = 0; a < 3; a++) {
        bodies->unit[a] = state->box.edge[a] / 0x1p32;
        bodies->units_per_d[a] = 0x1p32 / state->box.edge[a];
        for (size_t i = 0; i < state->count; i++) {
            bodies->pose[i].place[a] = (int64_t)state->image[a][i] * (INT64_C(1) << 32) +
                                       bodies_whole(state->position[a][i] / bodies->unit[a]);
            bodies->pose[i].axis[a] = state->orientation[a][i];
        }
    }
    for (size_t i = 0; i < state->count; i++) {
        bodies->body[i] = species_body(&state->system.species[state->species_of[i]]);
        bodies->body[i].diameter = state->diameter[i];
    }
    return OK;
}

void reference_bodies_free(ReferenceBodies *reference) {
    memory_free(reference->bodies.pose);
    memory_free(reference->bodies.body);
    memory_free(reference->bodies.draws);
    memory_free(reference);
}

void reference_bodies_set_amplitude(ReferenceBodies *reference, size_t species,
                                    const Amplitude *amplitude) {
    reference->bodies.amplitude[species] = *amplitude;
}

static bool anything_overlaps(const Bodies *bodies, size_t i, const Pose *pose) {
    for (size_t j = 0; j < bodies->count; j++) {
        if (j != i && bodies_pair_overlaps(bodies, i, pose, j)) return true;
    }
    return false;
}

static void try_move(Bodies *bodies, size_t k, Tally *tally) {
    const size_t i = bodies->draws->body[k], species = bodies->state->species_of[i];
    const Amplitude *amplitude = &bodies->amplitude[species];
    const int mixed = bodies_turn_is_mixed(&bodies->settings);
    Pose *now = &bodies->pose[i], then;
    Proposal proposal;
    if (shape_is_oriented(bodies->body[i].shape))
        bodies_propose_oriented(bodies, mixed, amplitude, bodies->draws, k, now->axis, &proposal);
    else
        bodies_propose_ball(bodies, amplitude, bodies->draws, k, now->axis, &proposal);
    for (int a = 0; a < 3; a++) {
        then.place[a] = now->place[a] + proposal.shift[a];
        then.axis[a] = proposal.axis[a];
    }
    tally->moves[species].trials++;
    if (anything_overlaps(bodies, i, &then)) return;
    bodies_count_accepted(&tally->moves[species], &proposal, now->axis);
    *now = then;
}

static void draw(Bodies *bodies, int64_t block) {
    uint32_t words[RNG_BLOCK], ids[2 * TRIALS];
    double x[2 * TRIALS], y[2 * TRIALS], z[2 * TRIALS];
    double *const normals[3] = {x, y, z};
    for (uint32_t i = 0; i < 2 * TRIALS; i++) ids[i] = i;
    rng_words(bodies->key, bodies->settings.stream, (uint64_t)block, words);
    rng_normals(bodies->key, bodies->settings.stream, (uint64_t)block, ids, 2 * TRIALS, 3, normals);
    bodies_draw(bodies->draws, &bodies->settings, bodies->count, words, normals);
}

static void publish(Bodies *bodies) {
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

void reference_bodies_run(ReferenceBodies *reference, int64_t trials, Tally *tally) {
    Bodies *bodies = &reference->bodies;
    int64_t *step = &bodies->state->step;
    const int64_t end = *step + trials;
    for (int64_t drawn = -1; *step < end; ++*step) {
        if (*step / TRIALS != drawn) draw(bodies, drawn = *step / TRIALS);
        try_move(bodies, (size_t)(*step % TRIALS), tally);
    }
    publish(bodies);
}
