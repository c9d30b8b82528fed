// SPDX-License-Identifier: GPL-3.0-or-later
// Where everything lies in a trajectory file, as its seal says. Internal to the store.
#pragma once

#include "state/state.h"
#include "store/image.h"
#include "store/seal.h"

typedef struct Layout {
    uint64_t plan;    // hash of its text
    uint64_t replica; //
    uint64_t dimension;
    uint64_t particles;
    uint64_t frames;
    uint64_t header;                  // bytes before the first frame's
    uint64_t species, diameter, mass; // places in the file, in bytes from its beginning
    uint64_t position, image, edges, step, time, crc;
    uint64_t orientation; // 0: no species has a body axis
    uint64_t strain;      // 0: of a version that had no shear
} Layout;

// The H5MD file up to the frames, and where they go. `layout` has plan, replica and frames set.
Status layout_build(Layout *layout, Image *image, const State *state);

Seal layout_seal(const Layout *layout, const Image *image);

// Takes the layout out of a seal; BAD_DATA if a part of it would lie outside the file.
Status layout_check(Layout *layout, const Seal *seal, const char *path);
