// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of particles: making, saving, checking.
#include "state/state.h"

#include "base/memory.h"

#include <math.h>

static Status allocate(State *state) {
    TRY(NEW_ARRAY(state->species_of, state->count));
    TRY(NEW_ARRAY(state->diameter, state->count));
    TRY(NEW_ARRAY(state->mass, state->count));
    for (int a = 0; a < 3; a++) {
        TRY(NEW_ARRAY(state->position[a], state->count));
        TRY(NEW_ARRAY(state->velocity[a], state->count));
        TRY(NEW_ARRAY(state->image[a], state->count));
        if (state->oriented) TRY(NEW_ARRAY(state->orientation[a], state->count));
    }
    return OK;
}

Status state_create(State **out, const System *system) {
    State *state = NULL;
    TRY(NEW(state));
    *state = (State){.box = system_box(system),
                     .system = *system,
                     .oriented = system_is_oriented(system),
                     .count = (size_t)system->particles};
    const Status status = allocate(state);
    if (status != OK) {
        state_free(state);
        return status;
    }
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    size_t particle = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        for (size_t k = 0; k < counts[s]; k++, particle++) {
            state->species_of[particle] = (uint8_t)s;
            state->mass[particle] = system->species[s].mass;
            if (state->oriented) state->orientation[2][particle] = 1;
        }
    }
    *out = state;
    return OK;
}

void state_place(State *state, const Box *box, const double *position, const int32_t *image,
                 const double *orientation) {
    state->box = *box;
    for (size_t i = 0; i < state->count; i++) {
        for (size_t a = 0; a < 3; a++) {
            state->position[a][i] = position[3 * i + a];
            state->image[a][i] = image[3 * i + a];
            if (state->oriented) state->orientation[a][i] = orientation[3 * i + a];
        }
        state->image[0][i] -= (int32_t)(state->image[1][i] * box->turns);
    }
}

void state_free(State *state) {
    if (!state) return;
    memory_free(state->species_of);
    memory_free(state->diameter);
    memory_free(state->mass);
    for (int a = 0; a < 3; a++) {
        memory_free(state->position[a]);
        memory_free(state->velocity[a]);
        memory_free(state->image[a]);
        memory_free(state->orientation[a]);
    }
    memory_free(state);
}

double state_packing_fraction(const State *state) {
    double filled = 0;
    for (size_t i = 0; i < state->count; i++) {
        Body body = species_body(&state->system.species[state->species_of[i]]);
        body.diameter = state->diameter[i];
        filled += shape_volume(&body);
    }
    return filled / box_volume(&state->box);
}

static const int64_t STEPS_MOST = INT64_MAX / 2;      // no run gets there, and none may overflow
static const uint64_t STATE_TAG = 0x5354415445303032; // "STATE002"

void state_archive(State *state, Archive *archive) {
    uint64_t count = state->count;
    archive_tag(archive, STATE_TAG);
    archive_u64(archive, &count, 1);
    archive_require(archive, count == state->count, "it has another number of particles");
    archive_f64(archive, state->diameter, state->count);
    for (int a = 0; a < state->box.dimension; a++) {
        archive_f64(archive, state->position[a], state->count);
        archive_f64(archive, state->velocity[a], state->count);
        archive_i32(archive, state->image[a], state->count);
        if (state->oriented) archive_f64(archive, state->orientation[a], state->count);
    }
    box_archive(&state->box, archive);
    archive_f64(archive, &state->shear_rate, 1);
    archive_i64(archive, &state->step, 1);
    archive_require(archive, isfinite(state->shear_rate), "its shear rate is no number");
    archive_require(archive, state->step >= 0 && state->step <= STEPS_MOST,
                    "its step count cannot be");
    if (archive->loading && archive->status == OK && state_validate(state) != OK) {
        archive->status = BAD_DATA;
    }
}

static const double DRIFT_MOST = 1e-9; // of the length of a body axis from 1

static double axis_drift(const State *state, size_t i) {
    double square = 0;
    for (int a = 0; a < 3; a++) square += state->orientation[a][i] * state->orientation[a][i];
    return fabs(sqrt(square) - 1);
}

double state_orientation_drift(const State *state) {
    double drift = 0;
    for (size_t i = 0; state->oriented && i < state->count; i++) {
        drift = fmax(drift, axis_drift(state, i));
    }
    return drift;
}

static Status validate_place(const State *state, size_t i) {
    for (int a = 0; a < state->box.dimension; a++) {
        const double x = state->position[a][i];
        if (x >= 0 && x <= state->box.edge[a] && isfinite(state->velocity[a][i])) continue;
        return status_fail(UNHEALTHY,
                           "particle %zu: coordinate %c = %g (box edge %g), velocity %g: not "
                           "finite or not in the box",
                           i, 'x' + a, x, state->box.edge[a], state->velocity[a][i]);
    }
    return OK;
}

static Status validate_body(const State *state, size_t i) {
    if (!(state->diameter[i] > 0 && isfinite(state->diameter[i]))) {
        return status_fail(UNHEALTHY, "particle %zu: diameter %g is not a positive number", i,
                           state->diameter[i]);
    }
    if (!state->oriented || axis_drift(state, i) <= DRIFT_MOST) return OK;
    return status_fail(UNHEALTHY,
                       "particle %zu: its body axis (%g, %g, %g) has length 1 only within %.3g", i,
                       state->orientation[0][i], state->orientation[1][i], state->orientation[2][i],
                       axis_drift(state, i));
}

Status state_validate(const State *state) {
    for (size_t i = 0; i < state->count; i++) {
        TRY(validate_place(state, i));
        TRY(validate_body(state, i));
    }
    return OK;
}
