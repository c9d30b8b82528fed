// SPDX-License-Identifier: GPL-3.0-or-later
// A frame's places in the file and its checksum.
#include "store/frame.h"

#include "base/crc32c.h"
#include "base/memory.h"

#include <string.h>

Status frame_create(FrameData *frame, size_t count, bool oriented) {
    *frame = (FrameData){.count = count};
    if (oriented) TRY(NEW_ARRAY(frame->orientation, 3 * count));
    TRY(NEW_ARRAY(frame->position, 3 * count));
    return NEW_ARRAY(frame->image, 3 * count);
}

void frame_free(FrameData *frame) {
    memory_free(frame->position);
    memory_free(frame->image);
    memory_free(frame->orientation);
    *frame = (FrameData){.count = 0};
}

void frame_take(FrameData *frame, const State *state, int64_t step, double time) {
    for (size_t i = 0; i < frame->count; i++) {
        for (size_t a = 0; a < 3; a++) {
            frame->position[3 * i + a] = state->position[a][i];
            frame->image[3 * i + a] = state->image[a][i];
            if (frame->orientation) frame->orientation[3 * i + a] = state->orientation[a][i];
        }
        frame->image[3 * i] += (int32_t)(state->image[1][i] * state->box.turns);
    }
    for (int a = 0; a < 3; a++) frame->edges[a][a] = state->box.edge[a];
    frame->edges[1][0] = state->box.offset;
    frame->strain = box_strain(&state->box);
    frame->step = step;
    frame->time = time;
}

static bool same_axes(const FrameData *a, const FrameData *b) {
    if (!a->orientation) return true;
    return memcmp(a->orientation, b->orientation, 3 * a->count * sizeof *a->orientation) == 0;
}

bool frame_same(const FrameData *a, const FrameData *b) {
    return same_axes(a, b) &&
           memcmp(a->position, b->position, 3 * a->count * sizeof *a->position) == 0 &&
           memcmp(a->image, b->image, 3 * a->count * sizeof *a->image) == 0 &&
           memcmp(a->edges, b->edges, sizeof a->edges) == 0 && a->step == b->step &&
           memcmp(&a->strain, &b->strain, sizeof a->strain) == 0 &&
           memcmp(&a->time, &b->time, sizeof a->time) == 0;
}

// A piece of a frame: so many bytes in memory, and where they lie in the file.
typedef struct Piece {
    void *bytes;
    size_t size;
    uint64_t place;
} Piece;

enum { PIECES_MOST = 7 };

// How many there are.
static int list_pieces(Piece pieces[PIECES_MOST], const FrameData *frame, const Layout *layout,
                       int64_t index) {
    const uint64_t k = (uint64_t)index;
    const size_t vectors = 3 * frame->count * sizeof *frame->position;
    const size_t images = 3 * frame->count * sizeof *frame->image;
    const size_t edges = sizeof frame->edges, eight = sizeof frame->step;
    pieces[0] = (Piece){frame->position, vectors, layout->position + k * vectors};
    pieces[1] = (Piece){frame->image, images, layout->image + k * images};
    pieces[2] = (Piece){(void *)frame->edges, edges, layout->edges + k * edges};
    pieces[3] = (Piece){(void *)&frame->step, eight, layout->step + k * eight};
    pieces[4] = (Piece){(void *)&frame->time, eight, layout->time + k * eight};
    int count = 5;
    if (frame->orientation)
        pieces[count++] = (Piece){frame->orientation, vectors, layout->orientation + k * vectors};
    if (layout->strain)
        pieces[count++] = (Piece){(void *)&frame->strain, eight, layout->strain + k * eight};
    return count;
}

// Of the frame's number and all its pieces; never 0, which says that nothing was written.
static uint32_t checksum(const Piece *pieces, int count, int64_t index) {
    uint32_t crc = crc32c(0, &index, sizeof index);
    for (int i = 0; i < count; i++) crc = crc32c(crc, pieces[i].bytes, pieces[i].size);
    return crc == 0 ? 1 : crc;
}

static off_t crc_place(const Layout *layout, int64_t index) {
    return (off_t)(layout->crc + (uint64_t)index * sizeof(uint32_t));
}

Status frame_write(const FrameData *frame, int file, const Layout *layout, int64_t index,
                   const char *path) {
    Piece pieces[PIECES_MOST];
    const int count = list_pieces(pieces, frame, layout, index);
    for (int i = 0; i < count; i++) {
        TRY(disk_write(file, pieces[i].bytes, pieces[i].size, (off_t)pieces[i].place, path));
    }
    const uint32_t crc = checksum(pieces, count, index);
    return disk_write(file, &crc, sizeof crc, crc_place(layout, index), path);
}

Status frame_read(FrameData *frame, int file, const Layout *layout, int64_t index, const char *path,
                  bool *there) {
    uint32_t crc = 0;
    *there = false;
    TRY(disk_read(file, &crc, sizeof crc, crc_place(layout, index), path));
    if (crc == 0) return OK;
    Piece pieces[PIECES_MOST];
    const int count = list_pieces(pieces, frame, layout, index);
    for (int i = 0; i < count; i++) {
        TRY(disk_read(file, pieces[i].bytes, pieces[i].size, (off_t)pieces[i].place, path));
    }
    *there = crc == checksum(pieces, count, index);
    return OK;
}
