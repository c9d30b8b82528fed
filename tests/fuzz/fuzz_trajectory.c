// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a trajectory: frames, or one sentence. The checksums of the seal at the end are put
// right first, so that the fuzzer gets to what they protect.
#define _GNU_SOURCE // memfd_create
#include "base/crc32c.h"
#include "store/trajectory.h"

#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size);

// docs/file-format.md: the seal, and where it says its size and the length of the header.
enum { SEAL = 256, SIZE = 16, HEADER = 64, CONTENTS_CRC = 184, SEAL_CRC = 188, FILE_MOST = 8192 };

static void put_right(unsigned char *file, uint64_t size) {
    unsigned char *seal = file + size - SEAL;
    uint64_t header;
    memcpy(seal, "PERRINTR", 8);
    memcpy(seal + SIZE, &size, sizeof size);
    memcpy(&header, seal + HEADER, sizeof header);
    const uint32_t contents = header < size ? crc32c(0, file, header) : 0;
    memcpy(seal + CONTENTS_CRC, &contents, sizeof contents);
    const uint32_t crc = crc32c(0, seal, SEAL_CRC);
    memcpy(seal + SEAL_CRC, &crc, sizeof crc);
}

static void read_frames(const char *path) {
    TrajectoryFile *file = NULL;
    if (trajectory_file_open(&file, path) != OK) {
        ASSERT(status_sentence()[0] != '\0');
        return;
    }
    const TrajectoryContents contents = trajectory_file_contents(file);
    for (int64_t k = 0; k < contents.frames && k < 8; k++) {
        TrajectoryFrame frame;
        bool there;
        if (trajectory_file_frame(file, k, &frame, &there) != OK) break;
    }
    trajectory_file_close(file);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size) {
    unsigned char image[FILE_MOST];
    char path[64];
    if (size < SEAL || size > sizeof image) return 0;
    memcpy(image, bytes, size);
    put_right(image, size);
    const int file = memfd_create("trajectory", 0);
    if (file < 0) return 0;
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    if (write(file, image, size) == (ssize_t)size) read_frames(path);
    close(file);
    return 0;
}
