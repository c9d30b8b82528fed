// SPDX-License-Identifier: GPL-3.0-or-later
// trajectory/replica-NNNN.h5: an ordinary H5MD 1.1 file whose header HDF5 builds once in memory
// and whose frames are written here, each with a CRC-32C as commit word. No HDF5 call is made
// after the opening, so no failure of it can hit a run.
#pragma once

#include "state/state.h"
#include "store/store.h"

typedef struct Trajectory Trajectory;

// Opens the trajectory of a replica for its frames done, done + 1, ... of `frames` in all; makes
// the file, with room for all, if there is none. `done` frames must be there and whole. Frames
// that are already there beyond these are compared when they are written again.
// `state` gives what stays: count, species, shapes, diameters, masses.
Status trajectory_open(Trajectory **out, Store *store, size_t replica, const State *state,
                       int64_t frames, int64_t done);

// The next frame. `step`: rising through the file; `time` in d^2/D0 or as the stage has it.
// UNHEALTHY if a frame of an earlier run is there and differs.
Status trajectory_write(Trajectory *trajectory, const State *state, int64_t step, double time);

Status trajectory_sync(Trajectory *trajectory);  // durable: before a checkpoint
Status trajectory_close(Trajectory *trajectory); // syncs; frees in any case; NULL is allowed

// A trajectory of ours, for reading.
typedef struct TrajectoryFile TrajectoryFile;

typedef struct TrajectoryContents {
    int dimension;
    size_t particles;
    int64_t frames;         // room in the file
    bool oriented;          // frames have body axes
    const double *diameter; // [particles], in d
    const double *mass;     // [particles], in m
    const int32_t *species; // [particles]
} TrajectoryContents;

typedef struct TrajectoryFrame {
    const double *position;    // [particles][3], folded, in d
    const int32_t *image;      // [particles][3]
    const double *orientation; // [particles][3], unit vectors; NULL unless oriented
    double edges[3][3];        // of the box, in d; [1][0] is the offset of a sheared one
    double strain;
    int64_t step;
    double time;
} TrajectoryFrame;

Status trajectory_file_open(TrajectoryFile **out, const char *path);
void trajectory_file_close(TrajectoryFile *file);
TrajectoryContents trajectory_file_contents(const TrajectoryFile *file);

// A frame, valid until the next call; `there` is false where none was written, or not wholly.
Status trajectory_file_frame(TrajectoryFile *file, int64_t index, TrajectoryFrame *frame,
                             bool *there);
