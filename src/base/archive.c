// SPDX-License-Identifier: GPL-3.0-or-later
// Saving and loading through one description.
#include "base/archive.h"

#include <stdlib.h>
#include <string.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "archives are little-endian and copied as they lie in memory"
#endif

Archive archive_writer(void) {
    return (Archive){.loading = false};
}

Archive archive_reader(const void *bytes, size_t size) {
    return (Archive){.bytes = (unsigned char *)bytes, .size = size, .loading = true};
}

void archive_free(Archive *archive) {
    if (!archive->loading) free(archive->bytes);
    *archive = (Archive){0};
}

static bool grow(Archive *archive, size_t more) {
    if (more <= archive->capacity - archive->size) return true;
    size_t capacity = archive->capacity ? archive->capacity : 4096;
    while (capacity - archive->size < more) {
        if (__builtin_mul_overflow(capacity, (size_t)2, &capacity)) return false;
    }
    unsigned char *bytes = realloc(archive->bytes, capacity);
    if (!bytes) return false;
    archive->bytes = bytes;
    archive->capacity = capacity;
    return true;
}

static void load(Archive *archive, void *values, size_t size) {
    if (size > archive->size - archive->position) {
        archive->status = status_fail(BAD_DATA,
                                      "stored state ends too early: %zu bytes wanted at "
                                      "byte %zu of %zu",
                                      size, archive->position, archive->size);
        return;
    }
    if (size > 0) memcpy(values, archive->bytes + archive->position, size);
    archive->position += size;
}

static void save(Archive *archive, const void *values, size_t size) {
    if (!grow(archive, size)) {
        archive->status = status_fail(NO_MEMORY, "out of memory: cannot save a state of %zu bytes",
                                      archive->size);
        return;
    }
    if (size > 0) memcpy(archive->bytes + archive->size, values, size);
    archive->size += size;
}

void archive_bytes(Archive *archive, void *bytes, size_t size) {
    if (archive->status != OK) return;
    if (archive->loading)
        load(archive, bytes, size);
    else
        save(archive, bytes, size);
}

void archive_f64(Archive *archive, double *values, size_t count) {
    archive_bytes(archive, values, count * sizeof *values);
}

void archive_i64(Archive *archive, int64_t *values, size_t count) {
    archive_bytes(archive, values, count * sizeof *values);
}

void archive_u64(Archive *archive, uint64_t *values, size_t count) {
    archive_bytes(archive, values, count * sizeof *values);
}

void archive_i32(Archive *archive, int32_t *values, size_t count) {
    archive_bytes(archive, values, count * sizeof *values);
}

void archive_tag(Archive *archive, uint64_t tag) {
    uint64_t found = tag;
    archive_u64(archive, &found, 1);
    archive_require(archive, found == tag, "a part of it is not where it should be");
}

void archive_require(Archive *archive, bool truth, const char *what) {
    if (archive->status != OK || !archive->loading || truth) return;
    archive->status = status_fail(BAD_DATA, "stored state cannot be used: %s", what);
}

Status archive_status(const Archive *archive, bool complete) {
    if (archive->status != OK) return archive->status;
    if (complete && archive->loading && archive->position != archive->size) {
        return status_fail(BAD_DATA, "stored state has %zu bytes too many",
                           archive->size - archive->position);
    }
    return OK;
}
