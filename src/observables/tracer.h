// SPDX-License-Identifier: GPL-3.0-or-later
// Which particle a pull is on.
#pragma once

#include "propagator/propagator.h"

#include <string.h>

// Index of the tracer's species, which the propagator has checked to be there.
static inline size_t tracer_species(const Pull *pull, const System *system) {
    size_t s = 0;
    while (s + 1 < system->species_count && strcmp(system->species[s].name, pull->species) != 0)
        s++;
    return s;
}

static inline size_t tracer_particle(const Pull *pull, const System *system) {
    size_t counts[SPECIES_MOST], particle = 0;
    system_counts(system, counts);
    for (size_t s = 0; s < tracer_species(pull, system); s++) particle += counts[s];
    return particle;
}
