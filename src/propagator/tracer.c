// SPDX-License-Identifier: GPL-3.0-or-later
// The tracer of a pull: one particle, of a species of its own, after those of the bath.
#include "propagator/tracer.h"

#include "base/constants.h"
#include "base/nearest.h"
#include "shapes/overlap.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

size_t tracer_species(const Pull *pull, const System *system) {
    size_t s = 0;
    while (s < system->species_count && strcmp(system->species[s].name, pull->species) != 0) s++;
    return s;
}

size_t tracer_particle(const Pull *pull, const System *system) {
    size_t counts[SPECIES_MOST], particle = 0;
    system_counts(system, counts);
    for (size_t s = 0; s < tracer_species(pull, system); s++) particle += counts[s];
    return particle;
}

static Status unknown_species(const Pull *pull, const System *system) {
    const char *names[SPECIES_MOST];
    char all[256] = "";
    size_t length = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        names[s] = system->species[s].name;
        if (length < sizeof all)
            length += (size_t)snprintf(all + length, sizeof all - length, "%s%s", s ? ", " : "",
                                       names[s]);
    }
    const size_t meant = nearest_word(pull->species, names, system->species_count);
    if (meant < system->species_count)
        return status_fail(
            BAD_DATA,
            "pull = {species: %s}: there is no such species in the system; did you mean %s?",
            pull->species, names[meant]);
    return status_fail(BAD_DATA,
                       "pull = {species: %s}: there is no such species in the system; its "
                       "species are %s",
                       pull->species, all);
}

// A single particle among the others is the tracer that was meant.
static Status not_single(const Pull *pull, const System *system, const size_t *counts) {
    const size_t named = counts[tracer_species(pull, system)];
    size_t s = 1;
    while (s < system->species_count && counts[s] != 1) s++;
    if (s < system->species_count)
        return status_fail(BAD_DATA,
                           "pull = {species: %s}: these are %zu particles, and the force is on "
                           "one, the tracer; of %s there is one: pull that",
                           pull->species, named, system->species[s].name);
    return status_fail(BAD_DATA,
                       "pull = {species: %s}: these are %zu particles, and the force is on one, "
                       "the tracer; make it a species of its own with count: 1",
                       pull->species, named);
}

Status tracer_check(const Pull *pull, const System *system) {
    const size_t s = tracer_species(pull, system);
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    if (s == system->species_count) return unknown_species(pull, system);
    if (counts[s] != 1) return not_single(pull, system, counts);
    if (s == 0)
        return status_fail(BAD_DATA,
                           "pull = {species: %s}: steps and times go by the first species, which "
                           "must be one of the bath; name the tracer after it",
                           pull->species);
    if (shape_is_oriented((ShapeKind)system->species[s].shape))
        return status_fail(BAD_DATA, "pull = {species: %s}: a %s has a body axis; pull a sphere",
                           pull->species, shape_names[system->species[s].shape]);
    if (pull->axis < system->dimension) return OK;
    return status_fail(BAD_DATA, "pull = {axis: z}: the system has two dimensions; use x or y");
}

// What the tracer sweeps is as wide as it and its neighbours are, across: its diameter, or the mean
// of that and the largest of the bath where it is the smaller one.
static double tracer_width(const Pull *pull, const System *system) {
    const size_t tracer = tracer_species(pull, system);
    double largest = system->species[tracer].diameter;
    for (size_t s = 0; s < system->species_count; s++)
        largest = fmax(largest, system->species[s].diameter);
    return (system->species[tracer].diameter + largest) / 2;
}

// The tracer goes 3/4 of the edge, and what it has left behind must have closed in the rest.
Status tracer_check_box(const Pull *pull, const System *system) {
    static const double STRONG = 1, EDGE_LEAST = 12; // Peclet number; in widths
    const Box box = system_box(system);
    const double width = tracer_width(pull, system);
    const double edge = box.edge[pull->axis];
    if (pull->peclet < STRONG || edge >= EDGE_LEAST * width) return OK;
    const int axis = (int)pull->axis, dimension = (int)system->dimension;
    char aspect[16] = "";
    for (int a = 0, used = 0; a < dimension; a++)
        used += snprintf(aspect + used, sizeof aspect - (size_t)used, "%s%c", a > 0 ? ", " : "",
                         a == axis ? '2' : '1');
    return status_fail(BAD_DATA,
                       "pull = {peclet: %g}: the box is %.3g d long along %s, so that the tracer "
                       "would meet its own wake; make it at least %.3g d long, with more particles "
                       "or an aspect such as [%s]",
                       pull->peclet, edge, drive_pull_axes[axis], EDGE_LEAST * width, aspect);
}

double tracer_free_diffusion(const Pull *pull, const System *system, bool thermostatted) {
    const Species *tracer = &system->species[tracer_species(pull, system)];
    if (thermostatted) return system->species[0].mass / tracer->mass;
    return species_diffusion(tracer).parallel / system_reference_diffusion(system);
}

// Another place

static bool is_alike(const State *state, size_t i, size_t j) {
    const Species *species = state->system.species;
    return i != j && state->diameter[i] == state->diameter[j] &&
           species[state->species_of[i]].shape == species[state->species_of[j]].shape;
}

// Which of those like the tracer, from 0 on; the count if it is none of so many.
static size_t find_alike(const State *state, size_t tracer, uint64_t which) {
    size_t i = 0;
    for (uint64_t seen = 0; i < state->count; i++) {
        if (is_alike(state, i, tracer) && seen++ == which) break;
    }
    return i;
}

static void change_places(State *state, size_t i, size_t j) {
    for (int a = 0; a < 3; a++) {
        const double place = state->position[a][i];
        const int32_t image = state->image[a][i];
        state->position[a][i] = state->position[a][j];
        state->image[a][i] = state->image[a][j];
        state->position[a][j] = place;
        state->image[a][j] = image;
    }
}

static Body body_of(const State *state, size_t i) {
    Body body = species_body(&state->system.species[state->species_of[i]]);
    body.diameter = state->diameter[i];
    return body;
}

// Would it touch nothing there, nor where an engine's rounding puts it? Soft spheres count as hard.
static bool is_free(const State *state, size_t tracer, const double place[3]) {
    static const double CLEAR = 1 + 1e-6;
    Body own = body_of(state, tracer);
    own.diameter *= CLEAR;
    for (size_t i = 0; i < state->count; i++) {
        const Body other = body_of(state, i);
        double r[3], axis[3] = {0, 0, 1};
        for (int a = 0; a < 3; a++) {
            r[a] = state->position[a][i] - place[a];
            if (state->oriented) axis[a] = state->orientation[a][i];
        }
        box_nearest_image(&state->box, r);
        if (i != tracer && overlap_of(&own, (double[3]){0, 0, 1}, &other, axis, r)) return false;
    }
    return true;
}

static Status insert(State *state, size_t tracer, Rng *rng) {
    for (int k = 0; k < TRACER_ATTEMPTS; k++) {
        double place[3] = {0};
        for (int a = 0; a < state->box.dimension; a++) {
            place[a] = rng_uniform(rng) * state->box.edge[a];
        }
        if (!is_free(state, tracer, place)) continue;
        for (int a = 0; a < 3; a++) state->position[a][tracer] = place[a];
        return OK;
    }
    return status_fail(UNHEALTHY,
                       "the tracer's next trajectory begins at a random place, and of %d none had "
                       "room for it; leave out the period, so that each replica is a trajectory",
                       (int)TRACER_ATTEMPTS);
}

bool tracer_has_alike(const Pull *pull, const System *system) {
    const size_t tracer = tracer_species(pull, system);
    const Species *own = &system->species[tracer];
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *other = &system->species[s];
        if (s != tracer && counts[s] > 0 && other->shape == own->shape &&
            other->spread == SPREAD_NONE && own->spread == SPREAD_NONE &&
            other->diameter == own->diameter)
            return true;
    }
    return false;
}

// sum[n] of diameter^n over the bath per volume, in units in which sum[dimension] is its packing
// fraction. False if it is not of discs or spheres of given sizes.
static bool bath_sums(const Pull *pull, const System *system, double sum[4]) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    const Box box = system_box(system);
    const double unit = PI / (system->dimension == 2 ? 4 : 6) / box_volume(&box);
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        if (shape_is_oriented((ShapeKind)species->shape) || species->spread != SPREAD_NONE)
            return false;
        if (s == tracer_species(pull, system)) continue;
        for (int n = 0; n < 4; n++) {
            sum[n] += unit * (double)counts[s] * pow(species->diameter, n);
        }
    }
    return true;
}

// Lebowitz, Helfand & Praestgaard, J. Chem. Phys. 43, 774 (1965): the work of making a hole.
double tracer_chance_of_room(const Pull *pull, const System *system) {
    double sum[4] = {0};
    if (!bath_sums(pull, system, sum)) return -1;
    const double d = system->species[tracer_species(pull, system)].diameter;
    const double room = 1 - sum[system->dimension];
    const double x0 = sum[0] / room, x1 = sum[1] / room, x2 = sum[2] / room;
    if (system->dimension == 2) return room * exp(-2 * x1 * d - (x0 + x1 * x1) * d * d);
    const double surface = 3 * x1 + 4.5 * x2 * x2;
    const double pressure = x0 + 3 * x1 * x2 + 3 * x2 * x2 * x2;
    return room * exp(-d * (3 * x2 + d * (surface + d * pressure)));
}

Status tracer_take_another_place(State *state, size_t tracer, RngKey key) {
    Rng rng = rng_open(key, STREAM_TRACER, (uint64_t)state->step, tracer);
    uint64_t alike = 0;
    for (size_t i = 0; i < state->count; i++) alike += is_alike(state, i, tracer);
    if (alike == 0) return insert(state, tracer, &rng);
    change_places(state, tracer, find_alike(state, tracer, rng_below(&rng, alike)));
    return OK;
}
