// SPDX-License-Identifier: GPL-3.0-or-later
// Prints one number for the trajectories given: FNV-1a over the bits of every step, time, position
// and image (and body axis, where there are any), in order. It sees where particles went and
// nothing of how a file is laid out.
#include "store/trajectory.h"

#include <inttypes.h>
#include <stdio.h>

static void hash_bytes(uint64_t *hash, const void *bytes, size_t size) {
    static const uint64_t PRIME = 0x100000001b3;
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i++) *hash = (*hash ^ byte[i]) * PRIME;
}

static Status hash_frames(uint64_t *hash, TrajectoryFile *file) {
    const TrajectoryContents contents = trajectory_file_contents(file);
    const size_t numbers = 3 * contents.particles;
    for (int64_t i = 0; i < contents.frames; i++) {
        TrajectoryFrame frame;
        bool there = false;
        TRY(trajectory_file_frame(file, i, &frame, &there));
        if (!there) return status_fail(BAD_DATA, "frame %" PRId64 " is missing", i);
        hash_bytes(hash, &frame.step, sizeof frame.step);
        hash_bytes(hash, &frame.time, sizeof frame.time);
        hash_bytes(hash, frame.position, numbers * sizeof *frame.position);
        hash_bytes(hash, frame.image, numbers * sizeof *frame.image);
        if (!contents.oriented) continue;
        hash_bytes(hash, frame.orientation, numbers * sizeof *frame.orientation);
    }
    return OK;
}

static Status hash_trajectory(uint64_t *hash, const char *path) {
    TrajectoryFile *file = NULL;
    TRY(trajectory_file_open(&file, path));
    const Status status = hash_frames(hash, file);
    trajectory_file_close(file);
    return status;
}

int main(int argc, char **argv) {
    static const uint64_t BASIS = 0xcbf29ce484222325;
    uint64_t hash = BASIS;
    for (int i = 1; i < argc; i++) {
        const Status status = hash_trajectory(&hash, argv[i]);
        if (status == OK) continue;
        fprintf(stderr, "%s: %s\n", argv[i], status_sentence());
        return (int)status;
    }
    printf("%016" PRIx64 "\n", hash);
    return 0;
}
