// SPDX-License-Identifier: GPL-3.0-or-later
// The particles at one instant: structure of arrays, in the order of particle ids. It determines
// the future: a run continued from a State has the bits of one never stopped. Only packing and
// the propagators receive `State *`; everyone else `const State *`.
#pragma once

#include "base/archive.h"
#include "state/system.h"

typedef struct State {
    Box box;
    System system;          // what this is a sample of
    size_t count;           // particles
    bool oriented;          // some species has a body axis
    uint8_t *species_of;    // [count], index into system.species; sorted by species
    double *diameter;       // [count], in d
    double *mass;           // [count], in m
    double *position[3];    // [3][count], folded into [0, edge), in d; z = 0 in 2D
    double *velocity[3];    // [3][count], in sqrt(kT/m)
    int32_t *image[3];      // [3][count], of which image of the particle is followed: see below
    double *orientation[3]; // [3][count], unit vectors along the body axes, z for particles without
                            // one; NULL unless `oriented`
    double shear_rate;      // of the flow that the velocities contain, v_x = shear_rate y, in
                            // sqrt(kT/m)/d
    int64_t step; // thermostat intervals, windows or trial moves since the replica began: addresses
                  // the random numbers
} State;

// Allocates the arrays, sets box, species and masses; diameters, positions are for packing.
Status state_create(State **out, const System *system);
void state_free(State *state);

// Unfolded coordinate along an axis, in d: that of the image followed since the start, which moves
// without jumps. Under shear its flow is shear_rate times its own y, whichever image it is; so the
// non-affine displacement since a time at which the strain was g0 (box_strain) is, with the
// displacements dX, dY and the unfolded Y of now,
//     dX - (strain - g0) Y, dY         (Weysser, thesis, eq. 5.64).
static inline double state_unfolded(const State *state, int axis, size_t particle) {
    const double home =
        state->position[axis][particle] + state->image[axis][particle] * state->box.edge[axis];
    return axis == 0 ? home + state->image[1][particle] * box_displacement(&state->box) : home;
}

// Velocity without the flow, in sqrt(kT/m).
static inline double state_peculiar_velocity(const State *state, int axis, size_t particle) {
    const double velocity = state->velocity[axis][particle];
    return axis == 0 ? velocity - state->shear_rate * state->position[1][particle] : velocity;
}

// Puts the particles where a stored configuration has them, in rows of three: folded positions,
// image counts and, where they have axes, orientations; image counts are those of the box that
// leans by its offset, without whole turns. Velocities stay what they are.
void state_place(State *state, const Box *box, const double *position, const int32_t *image,
                 const double *orientation);

double state_packing_fraction(const State *state);
void state_archive(State *state, Archive *archive); // all but the system, which the plan has

// BAD_DATA or UNHEALTHY with a sentence unless all is finite, in the box, and body axes have length
// 1 within 1e-9.
Status state_validate(const State *state);

double state_orientation_drift(const State *state); // the largest | |u| - 1 |; 0 without axes

// The deepest overlap, as 1 - distance/contact over all pairs of hard bodies (of two platelets: the
// length of chord that they share over the mean diameter); 0 if none. Linked cells, O(count); the
// health check at output. `pairs`, if not NULL, is the number of pairs deeper than `depth`.
Status state_deepest_overlap(const State *state, double depth, double *deepest, uint64_t *pairs);
