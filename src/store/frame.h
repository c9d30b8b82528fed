// SPDX-License-Identifier: GPL-3.0-or-later
// One frame of a trajectory, in memory and in its file. Internal to the store.
#pragma once

#include "store/disk.h"
#include "store/layout.h"

typedef struct FrameData {
    size_t count;
    double *position;    // [count][3], folded, in d
    int32_t *image;      // [count][3]
    double *orientation; // [count][3], unit vectors; NULL where no species has a body axis
    double edges[3][3];
    double strain;
    int64_t step;
    double time;
} FrameData;

Status frame_create(FrameData *frame, size_t count, bool oriented);
void frame_free(FrameData *frame);
void frame_take(FrameData *frame, const State *state, int64_t step, double time);
bool frame_same(const FrameData *a, const FrameData *b); // bit for bit

// The data first, their checksum last.
Status frame_write(const FrameData *frame, int file, const Layout *layout, int64_t index,
                   const char *path);
// `there` is false where no frame was written, or not wholly.
Status frame_read(FrameData *frame, int file, const Layout *layout, int64_t index, const char *path,
                  bool *there);
