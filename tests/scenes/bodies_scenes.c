// SPDX-License-Identifier: GPL-3.0-or-later
// Suspensions of bodies with an axis to try chains on.
#include "bodies_scenes.h"

#include "shapes/overlap.h"

#include <math.h>
#include <string.h>

System bodies_system(ShapeKind shape, double length, int64_t particles, double number_density) {
    System system = {.dimension = 3,
                     .particles = particles,
                     .number_density = number_density,
                     .species_count = 1};
    system.species[0] = (Species){
        .name = "body", .shape = shape, .diameter = 1, .length = length, .mass = 1, .fraction = 1};
    return system;
}

static bool pair_overlaps(const State *state, size_t i, size_t j, double scale) {
    double r[3], u[3], v[3];
    for (int a = 0; a < 3; a++) {
        r[a] = state->position[a][j] - state->position[a][i];
        u[a] = state->orientation[a][i];
        v[a] = state->orientation[a][j];
    }
    box_nearest_image(&state->box, r);
    Body a = species_body(&state->system.species[state->species_of[i]]);
    Body b = species_body(&state->system.species[state->species_of[j]]);
    a.diameter = scale * state->diameter[i], a.length *= scale;
    b.diameter = scale * state->diameter[j], b.length *= scale;
    return overlap_of(&a, u, &b, v, r);
}

size_t bodies_overlaps(const State *state, double scale) {
    size_t overlaps = 0;
    for (size_t i = 0; i < state->count; i++) {
        for (size_t j = 0; j < i; j++) overlaps += pair_overlaps(state, i, j, scale);
    }
    return overlaps;
}

static void put_at_random(State *state, size_t i, Rng *rng) {
    double square = 0;
    for (int a = 0; a < 3; a++) {
        state->position[a][i] = state->box.edge[a] * rng_uniform(rng);
        state->orientation[a][i] = rng_normal(rng);
        square += state->orientation[a][i] * state->orientation[a][i];
    }
    for (int a = 0; a < 3; a++) state->orientation[a][i] /= sqrt(square);
    if (shape_is_oriented((ShapeKind)state->system.species[state->species_of[i]].shape)) return;
    for (int a = 0; a < 3; a++) state->orientation[a][i] = a == 2;
}

static bool meets_one_before(const State *state, size_t i, double scale) {
    for (size_t j = 0; j < i; j++) {
        if (pair_overlaps(state, i, j, scale)) return true;
    }
    return false;
}

State *bodies_state(const System *system, RngKey key, double scale) {
    State *state = NULL;
    ASSERT(state_create(&state, system) == OK);
    Rng rng = rng_open(key, STREAM_PACKING, 0, 0);
    int attempts = 0;
    for (size_t i = 0; i < state->count; i++) {
        state->diameter[i] = system->species[state->species_of[i]].diameter;
        do {
            put_at_random(state, i, &rng);
            ASSERT(attempts++ < 1000000);
        } while (meets_one_before(state, i, scale));
    }
    return state;
}

// Steps that about half of the trials survive, or a twentieth of a diameter.
static void set_steps(Chain *chain, const System *system, double step) {
    for (size_t s = 0; s < system->species_count; s++) {
        const double core = system->species[s].length > 1 ? system->species[s].length : 1;
        const Amplitude amplitude = {
            .parallel = step, .perpendicular = step, .rotation = fmin(0.4, 2 * step / core)};
        chain_set_amplitude(chain, s, &amplitude);
    }
}

static double acceptance(const Tally *tally, const System *system) {
    double trials = 0, accepted = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        trials += (double)tally->moves[s].trials;
        accepted += (double)tally->moves[s].accepted;
    }
    return accepted / trials;
}

State *bodies_grown(const System *system, RngKey key) {
    State *state = bodies_state(system, key, 0.35);
    double scale = 0.35, growth = 0.02, step = 0.2;
    const ChainSettings settings = {
        .stream = STREAM_SQUEEZING, .rotation = ROTATION_MIXED, .scale = scale};
    Chain *chain = NULL;
    ASSERT(chain_create(&chain, &settings, state, key) == OK);
    while (scale < 1) {
        Tally tally = {0};
        set_steps(chain, system, step);
        ASSERT(chain_run(chain, 4 * (int64_t)state->count, &tally) == OK);
        step = fmin(0.4, fmax(0.02, step * (acceptance(&tally, system) > 0.5 ? 1.1 : 0.9)));
        const double wish = fmin(1, scale * (1 + growth));
        const bool fits = chain_rescale(chain, wish);
        if (fits) scale = wish;
        growth = fits ? fmin(0.02, growth * 1.5) : fmax(1e-5, growth / 2);
    }
    chain_publish(chain);
    chain_free(chain);
    state->step = 0;
    return state;
}
