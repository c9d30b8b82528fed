// SPDX-License-Identifier: GPL-3.0-or-later
// Reading a trajectory of ours, without HDF5: the seal says where everything lies, and a frame is
// believed only with its checksum.
#include "store/trajectory.h"

#include "base/crc32c.h"
#include "base/memory.h"
#include "store/frame.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct TrajectoryFile {
    int file;
    char *path;
    Layout layout;
    FrameData frame;
    double *diameter, *mass;
    int32_t *species;
};

static Status check_header(TrajectoryFile *file, const Seal *seal) {
    unsigned char *header = malloc(file->layout.header + 1);
    if (!header) return status_fail(NO_MEMORY, "out of memory: the header of '%s'", file->path);
    Status status = disk_read(file->file, header, file->layout.header, 0, file->path);
    if (status == OK && crc32c(0, header, file->layout.header) != seal->contents_crc) {
        status = status_fail(BAD_DATA, "'%s' is damaged or was changed after perrin wrote it",
                             file->path);
    }
    free(header);
    return status;
}

static Status read_seal(TrajectoryFile *file) {
    Seal seal;
    size_t size;
    TRY(disk_size(file->file, &size, file->path));
    if (size < sizeof seal) {
        return status_fail(BAD_DATA, "'%s' is no trajectory written by perrin", file->path);
    }
    TRY(disk_read(file->file, &seal, sizeof seal, (off_t)(size - sizeof seal), file->path));
    TRY(seal_check(&seal, SEAL_TRAJECTORY, size, file->path));
    TRY(layout_check(&file->layout, &seal, file->path));
    return check_header(file, &seal);
}

static Status read_fixed(TrajectoryFile *file) {
    const Layout *layout = &file->layout;
    const size_t n = layout->particles;
    TRY(NEW_ARRAY(file->diameter, n));
    TRY(NEW_ARRAY(file->mass, n));
    TRY(NEW_ARRAY(file->species, n));
    TRY(frame_create(&file->frame, n, layout->orientation != 0));
    TRY(disk_read(file->file, file->diameter, n * 8, (off_t)layout->diameter, file->path));
    TRY(disk_read(file->file, file->mass, n * 8, (off_t)layout->mass, file->path));
    return disk_read(file->file, file->species, n * 4, (off_t)layout->species, file->path);
}

static Status open_path(TrajectoryFile *file, const char *path) {
    file->path = disk_path(NULL, path);
    if (!file->path) return NO_MEMORY;
    TRY(disk_open(NULL, path, O_RDONLY, &file->file));
    if (file->file < 0) return status_fail(BAD_DATA, "there is no file '%s'", path);
    TRY(read_seal(file));
    return read_fixed(file);
}

Status trajectory_file_open(TrajectoryFile **out, const char *path) {
    TrajectoryFile *file = NULL;
    TRY(NEW(file));
    file->file = -1;
    const Status status = open_path(file, path);
    if (status == OK)
        *out = file;
    else
        trajectory_file_close(file);
    return status;
}

void trajectory_file_close(TrajectoryFile *file) {
    if (!file) return;
    if (file->file >= 0) close(file->file);
    frame_free(&file->frame);
    memory_free(file->diameter);
    memory_free(file->mass);
    memory_free(file->species);
    free(file->path);
    memory_free(file);
}

TrajectoryContents trajectory_file_contents(const TrajectoryFile *file) {
    return (TrajectoryContents){
        .dimension = (int)file->layout.dimension,
        .particles = file->layout.particles,
        .frames = (int64_t)file->layout.frames,
        .oriented = file->layout.orientation != 0,
        .diameter = file->diameter,
        .mass = file->mass,
        .species = file->species,
    };
}

Status trajectory_file_frame(TrajectoryFile *file, int64_t index, TrajectoryFrame *frame,
                             bool *there) {
    ASSERT(index >= 0 && index < (int64_t)file->layout.frames);
    TRY(frame_read(&file->frame, file->file, &file->layout, index, file->path, there));
    *frame = (TrajectoryFrame){
        .position = file->frame.position,
        .image = file->frame.image,
        .orientation = file->frame.orientation,
        .strain = file->frame.strain,
        .step = file->frame.step,
        .time = file->frame.time,
    };
    memcpy(frame->edges, file->frame.edges, sizeof frame->edges);
    return OK;
}
