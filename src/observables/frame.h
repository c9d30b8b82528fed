// SPDX-License-Identifier: GPL-3.0-or-later
// From where a correlation function is seen: from the box, in which the centre of mass of N
// particles diffuses with D0/N where all velocities are redrawn, or from the centre of mass, about
// which a glass stands still. What one sees from the box analysis/centre.c takes the diffusion out
// of, in the mean; what one sees from the centre does not know it, nor its noise.
#pragma once

#include "observables/observables.h"

enum { FRAME_BOX, FRAME_CENTRE_OF_MASS };

extern const char *const frame_names[]; // NULL-ended

#define FRAME_OPTION(Type, member)                                                                 \
    {                                                                                              \
        .name = "frame", .type = OPTION_CHOICE, .offset = offsetof(Type, member),                  \
        .fallback = FRAME_BOX, .unit = "", .choices = frame_names,                                 \
        .about = "Whether particles are seen from the box or from their centre of mass; the "      \
                 "names of what is seen from there end in _centred.",                              \
    }

// BAD_DATA with a sentence where what drives the stage is not among `drives`, bits of DriveKind:
// those that the observable takes from displacements as it takes them from that of the centre.
Status frame_check(const char *observable, int64_t frame, unsigned drives, const Clock *clock);

// The centre of mass of the unfolded particles; 0 in the frame of the box.
void frame_centre(int64_t frame, const State *state, double centre[3]);

// One coordinate of particles [first, first + count), unfolded and seen from `centre`.
void frame_unfold(const State *state, int axis, double centre, size_t first, size_t count,
                  double *unfolded);
