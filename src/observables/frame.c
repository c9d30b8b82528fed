// SPDX-License-Identifier: GPL-3.0-or-later
// From where a correlation function is seen.
#include "observables/frame.h"

const char *const frame_names[] = {"box", "centre-of-mass", NULL};

Status frame_check(const char *observable, int64_t frame, const Clock *clock) {
    if (frame == FRAME_BOX || !clock->drive) return OK;
    return status_fail(BAD_DATA,
                       "%s: frame = centre-of-mass is of stages at rest, and stage '%s' is driven; "
                       "leave it out",
                       observable, clock->stage);
}

void frame_centre(int64_t frame, const State *state, double centre[3]) {
    for (int a = 0; a < 3; a++) centre[a] = 0;
    if (frame == FRAME_BOX) return;
    double mass = 0;
    for (size_t i = 0; i < state->count; i++) mass += state->mass[i];
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++)
            centre[a] += state->mass[i] * state_unfolded(state, a, i);
        centre[a] /= mass;
    }
}
