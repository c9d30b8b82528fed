// SPDX-License-Identifier: GPL-3.0-or-later
// The temperature that velocities have.
#include "observables/temperature.h"

// Twice the kinetic energy along an axis, in the frame of the centre of mass and of the flow.
static double relative_motion(const State *state, int axis) {
    double mass = 0, momentum = 0, square = 0;
    for (size_t i = 0; i < state->count; i++) {
        const double v = state_peculiar_velocity(state, axis, i);
        mass += state->mass[i];
        momentum += state->mass[i] * v;
        square += state->mass[i] * v * v;
    }
    return square - momentum * momentum / mass;
}

double temperature_relative(const State *state) {
    double sum = 0;
    for (int a = 0; a < state->box.dimension; a++) sum += relative_motion(state, a);
    const double freedoms = (double)state->box.dimension * ((double)state->count - 1);
    return freedoms > 0 ? sum / freedoms : 1;
}
