// SPDX-License-Identifier: GPL-3.0-or-later
// Whom a pull is on, and what every method that pulls asks of the system.
#pragma once

#include "propagator/drive.h"
#include "rng/rng.h"
#include "state/state.h"

// Index of the tracer's species; species_count if there is none of this name.
size_t tracer_species(const Pull *pull, const System *system);
size_t tracer_particle(const Pull *pull, const System *system); // its id

// BAD_DATA with a sentence if the species is not one particle beside a bath, or the axis not there.
Status tracer_check(const Pull *pull, const System *system);
// BAD_DATA with a sentence if a strongly pulled tracer would come into its own wake.
Status tracer_check_box(const Pull *pull, const System *system);

// Where the next trajectory begins: the tracer changes places with a particle of its shape and
// size, drawn at random; where there is none, it goes to a random place where it touches nothing. A
// pure function of the key, the state's step and the configuration. UNHEALTHY with a sentence if no
// place is found.
Status tracer_take_another_place(State *state, size_t tracer, RngKey key);

// Is there another particle of the tracer's shape and size to change places with?
bool tracer_has_alike(const Pull *pull, const System *system);
// Scaled-particle theory: the chance that the tracer touches nothing at a random place in a bath in
// equilibrium without it; -1 where the theory does not hold (a spread of sizes, bodies with an
// axis).
double tracer_chance_of_room(const Pull *pull, const System *system);
enum { TRACER_ATTEMPTS = 1000000 }; // random places that are tried
// Of the edge along the force: where a trajectory ends unless it is told otherwise.
#define TRACER_DISTANCE 0.75

// From masses, as a thermostat gives them; else from the shapes, as Monte Carlo takes them: the
// free diffusion coefficient of the tracer, in D0.
double tracer_free_diffusion(const Pull *pull, const System *system, bool thermostatted);
