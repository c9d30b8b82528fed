// SPDX-License-Identifier: GPL-3.0-or-later
// Writing the frames of a trajectory: pwrite into room that was allocated on the disk when the
// file was made, and the frame's CRC-32C last. A frame counts only with its checksum, so one torn
// by a kill or a loss of power is seen, and written again.
#include "store/trajectory.h"

#include "base/crc32c.h"
#include "base/memory.h"
#include "store/frame.h"
#include "store/inside.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_NAME_SIZE = 40 };

struct Trajectory {
    int file;
    char *path;
    Layout layout;
    int64_t next;   // frame to be written
    bool broken;    // something failed: the kernel may have lost pages, nothing can be promised
    FrameData mine; // the frame being written
    FrameData disk; // the one that an earlier run left in its place
};

// ENOSPC shows here, not in the middle of the run.
static Status allocate(int file, uint64_t size, const char *path) {
    int reason;
    do reason = posix_fallocate(file, 0, (off_t)size);
    while (reason == EINTR);
    if (reason == 0) return OK;
    errno = reason;
    return status_fail_errno(IO_FAILED, "cannot get %.4g MB of disk for '%s'", (double)size * 1e-6,
                             path);
}

static Status fill(int file, const Layout *layout, const Image *image, const char *path) {
    const Seal seal = layout_seal(layout, image);
    TRY(allocate(file, seal.size, path));
    TRY(disk_write(file, image->bytes, layout->header, 0, path));
    return disk_write(file, &seal, sizeof seal, (off_t)image->end, path);
}

static Status make_file(const Folder *folder, const char *name, const Layout *layout,
                        const Image *image, const char *path) {
    int file;
    TRY(disk_create(folder, name, &file));
    const Status status = fill(file, layout, image, path);
    if (status == OK) return disk_publish(folder, name, file);
    disk_discard(folder, name, file);
    return status;
}

// The file must begin and end with the very bytes that this run would give it.
static Status compare_header(int file, const Layout *layout, const Image *image, const char *path) {
    const Seal seal = layout_seal(layout, image);
    Seal there;
    size_t size;
    TRY(disk_size(file, &size, path));
    if (size < sizeof there) return status_fail(BAD_DATA, "'%s' was cut off", path);
    TRY(disk_read(file, &there, sizeof there, (off_t)(size - sizeof there), path));
    TRY(seal_check(&there, SEAL_TRAJECTORY, size, path));
    unsigned char *header = malloc(layout->header);
    if (!header) return status_fail(NO_MEMORY, "out of memory: the header of '%s'", path);
    Status status = disk_read(file, header, layout->header, 0, path);
    if (status == OK && (memcmp(&there, &seal, sizeof seal) != 0 ||
                         memcmp(header, image->bytes, layout->header) != 0)) {
        status = status_fail(BAD_DATA,
                             "'%s' is not the trajectory of this run: it was changed, or "
                             "another version of perrin wrote it",
                             path);
    }
    free(header);
    return status;
}

// The frames that the checkpoint counts as done are there and whole.
static Status check_done(Trajectory *trajectory, int64_t done) {
    for (int64_t frame = 0; frame < done; frame++) {
        bool there = false;
        TRY(frame_read(&trajectory->disk, trajectory->file, &trajectory->layout, frame,
                       trajectory->path, &there));
        if (there) continue;
        return status_fail(BAD_DATA, "'%s' is damaged: frame %lld is not whole", trajectory->path,
                           (long long)frame);
    }
    return OK;
}

static Status open_file(Trajectory *trajectory, const Folder *folder, const char *name,
                        const Image *image, int64_t done) {
    const Layout *layout = &trajectory->layout;
    if (!disk_has(folder, name)) {
        if (done > 0) {
            return status_fail(BAD_DATA, "'%s' is missing: the checkpoint counts on %lld frames",
                               trajectory->path, (long long)done);
        }
        TRY(make_file(folder, name, layout, image, trajectory->path));
    }
    TRY(disk_open(folder, name, O_RDWR, &trajectory->file));
    TRY(compare_header(trajectory->file, layout, image, trajectory->path));
    return check_done(trajectory, done);
}

static Status build_locked(Layout *layout, Image *image, const State *state) {
    store_take_hdf5();
    const Status status = layout_build(layout, image, state);
    store_give_hdf5();
    return status;
}

static Status open_in(Trajectory *trajectory, Store *store, const State *state, int64_t done) {
    char name[FILE_NAME_SIZE];
    snprintf(name, sizeof name, "replica-%04llu.h5",
             (unsigned long long)trajectory->layout.replica);
    Image image;
    Status status = build_locked(&trajectory->layout, &image, state);
    Folder folder = {.descriptor = -1};
    if (status == OK) status = disk_folder_open(&folder, &store->folder, "trajectory", true);
    if (status == OK) {
        trajectory->path = disk_path(&folder, name);
        status = trajectory->path ? OK : NO_MEMORY;
    }
    if (status == OK) status = frame_create(&trajectory->mine, state->count, state->oriented);
    if (status == OK) status = frame_create(&trajectory->disk, state->count, state->oriented);
    if (status == OK) status = open_file(trajectory, &folder, name, &image, done);
    disk_folder_close(&folder);
    image_free(&image);
    return status;
}

static void release(Trajectory *trajectory) {
    if (trajectory->file >= 0) close(trajectory->file);
    frame_free(&trajectory->mine);
    frame_free(&trajectory->disk);
    free(trajectory->path);
    memory_free(trajectory);
}

Status trajectory_open(Trajectory **out, Store *store, size_t replica, const State *state,
                       int64_t frames, int64_t done) {
    ASSERT(frames > 0 && done >= 0 && done <= frames);
    Trajectory *trajectory = NULL;
    TRY(NEW(trajectory));
    trajectory->file = -1;
    trajectory->next = done;
    trajectory->layout =
        (Layout){.plan = store->plan, .replica = replica, .frames = (uint64_t)frames};
    const Status status = open_in(trajectory, store, state, done);
    if (status == OK)
        *out = trajectory;
    else
        release(trajectory);
    return status;
}

static Status compare_or_write(Trajectory *trajectory) {
    const int64_t frame = trajectory->next;
    bool there = false;
    TRY(frame_read(&trajectory->disk, trajectory->file, &trajectory->layout, frame,
                   trajectory->path, &there));
    if (!there) {
        return frame_write(&trajectory->mine, trajectory->file, &trajectory->layout, frame,
                           trajectory->path);
    }
    if (frame_same(&trajectory->mine, &trajectory->disk)) return OK;
    return status_fail(UNHEALTHY,
                       "frame %lld of '%s' differs from the one that the interrupted run "
                       "wrote there: this machine or build does not repeat its numbers",
                       (long long)frame, trajectory->path);
}

Status trajectory_write(Trajectory *trajectory, const State *state, int64_t step, double time) {
    ASSERT(trajectory->next < (int64_t)trajectory->layout.frames);
    if (trajectory->broken) {
        return status_fail(IO_FAILED, "cannot write '%s': an earlier write failed",
                           trajectory->path);
    }
    frame_take(&trajectory->mine, state, step, time);
    const Status status = compare_or_write(trajectory);
    trajectory->broken = status != OK;
    if (status == OK) trajectory->next++;
    return status;
}

Status trajectory_sync(Trajectory *trajectory) {
    if (trajectory->broken) {
        return status_fail(IO_FAILED, "cannot bring '%s' to the disk: an earlier write failed",
                           trajectory->path);
    }
    const Status status = disk_sync(trajectory->file, trajectory->path);
    trajectory->broken = status != OK;
    return status;
}

Status trajectory_close(Trajectory *trajectory) {
    if (!trajectory) return OK;
    Status status = trajectory->broken ? OK : trajectory_sync(trajectory);
    const Status closed = disk_close(trajectory->file, trajectory->path);
    if (status == OK) status = closed;
    trajectory->file = -1;
    release(trajectory);
    return status;
}
