// SPDX-License-Identifier: GPL-3.0-or-later
// One function describes how an object is saved and how it is loaded: each archive_* call copies
// the value out (saving) or in (loading). Errors stick: after the first, calls do nothing, and
// archive_status tells. Little-endian, 8-byte numbers; lengths are checked against what is there.
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Archive {
    unsigned char *bytes;
    size_t size;     // bytes written, or bytes there to read
    size_t capacity; // of an archive being written
    size_t position; // next byte to read
    bool loading;
    Status status;
} Archive;

Archive archive_writer(void);
Archive archive_reader(const void *bytes, size_t size); // borrows the bytes
void archive_free(Archive *archive);                    // frees what a writer holds

void archive_f64(Archive *archive, double *values, size_t count);
void archive_i64(Archive *archive, int64_t *values, size_t count);
void archive_u64(Archive *archive, uint64_t *values, size_t count);
void archive_i32(Archive *archive, int32_t *values, size_t count);
void archive_bytes(Archive *archive, void *bytes, size_t size);

// Writes `tag`, or fails the load unless it stands here: a fence between parts.
void archive_tag(Archive *archive, uint64_t tag);

// Fails the load with BAD_DATA and a sentence unless `truth` holds; nothing when saving.
void archive_require(Archive *archive, bool truth, const char *what);

// OK, or the first failure; a load must also have used every byte when `complete`.
Status archive_status(const Archive *archive, bool complete);
