// SPDX-License-Identifier: GPL-3.0-or-later
// From where a correlation function is seen.
#include "observables/frame.h"

#include "numerics/turn.h"

#include <string.h>

const char *const frame_names[] = {"box", "centre-of-mass", NULL};

Status frame_check(const char *observable, int64_t frame, unsigned drives, const Clock *clock) {
    if (frame == FRAME_BOX || !clock->drive) return OK;
    if (!(drive_kinds(clock->drive) & ~drives)) return OK;
    return status_fail(BAD_DATA,
                       "%s: frame = centre-of-mass is of stages at rest%s, and stage '%s' is "
                       "driven%s; leave it out",
                       observable, drives & DRIVE_FLOW ? " or in a flow" : "", clock->stage,
                       drives & DRIVE_FLOW ? " by a force" : "");
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

typedef int32_t LaneImages __attribute__((vector_size(LANES * sizeof(int32_t))));

KERNEL void add_images(const int32_t *image, double edge, Lanes *place) {
    LaneImages images;
    memcpy(&images, image, sizeof images);
    *place += __builtin_convertvector(images, Lanes) * edge;
}

// state_unfolded, eight particles at a time.
void frame_unfold(const State *state, int axis, double centre, size_t first, size_t count,
                  double *unfolded) {
    const double displacement = box_displacement(&state->box);
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        Lanes place;
        memcpy(&place, state->position[axis] + first + i, sizeof place);
        add_images(state->image[axis] + first + i, state->box.edge[axis], &place);
        if (axis == 0) add_images(state->image[1] + first + i, displacement, &place);
        place -= centre;
        memcpy(unfolded + i, &place, sizeof place);
    }
    for (; i < count; i++) unfolded[i] = state_unfolded(state, axis, first + i) - centre;
}
