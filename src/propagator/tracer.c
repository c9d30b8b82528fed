// SPDX-License-Identifier: GPL-3.0-or-later
// The tracer of a pull: one particle, of a species of its own, after those of the bath.
#include "propagator/tracer.h"

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

Status tracer_check(const Pull *pull, const System *system) {
    const size_t s = tracer_species(pull, system);
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    if (s == system->species_count)
        return status_fail(BAD_DATA, "pull = {species: %s}: there is no such species in the system",
                           pull->species);
    if (counts[s] != 1)
        return status_fail(
            BAD_DATA,
            "pull = {species: %s}: these are %zu particles, and the force is on one, "
            "the tracer; make it a species of its own with count: 1",
            pull->species, counts[s]);
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

// The tracer goes 3/4 of the edge, and what it has left behind must have closed in the rest.
Status tracer_check_box(const Pull *pull, const System *system) {
    static const double STRONG = 1, EDGE_LEAST = 12; // Peclet number; in tracer diameters
    const Box box = system_box(system);
    const double diameter = system->species[tracer_species(pull, system)].diameter;
    const double edge = box.edge[pull->axis];
    if (pull->peclet < STRONG || edge >= EDGE_LEAST * diameter) return OK;
    return status_fail(BAD_DATA,
                       "pull = {peclet: %g}: the box is %.3g d long along %s, so that the tracer "
                       "would meet its own wake; make it at least %.3g d long, with more particles "
                       "or an aspect such as [2, 1, 1]",
                       pull->peclet, edge, drive_pull_axes[pull->axis], EDGE_LEAST * diameter);
}

double tracer_free_diffusion(const Pull *pull, const System *system, bool thermostatted) {
    const Species *tracer = &system->species[tracer_species(pull, system)];
    if (thermostatted) return system->species[0].mass / tracer->mass;
    return species_diffusion(tracer).parallel / system_reference_diffusion(system);
}
