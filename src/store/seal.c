// SPDX-License-Identifier: GPL-3.0-or-later
// Making and checking the seal of a file.
#include "store/seal.h"

#include "base/crc32c.h"

#include <stddef.h>
#include <string.h>

static const uint32_t ENDIAN_TAG = 0x01020304;

static const char *kind_magic(SealKind kind) {
    return kind == SEAL_RESULTS ? "PERRINRS" : "PERRINTR";
}

static const char *kind_words(SealKind kind) {
    return kind == SEAL_RESULTS ? "results.h5" : "trajectory";
}

static uint32_t seal_crc(const Seal *seal) {
    return crc32c(0, seal, offsetof(Seal, seal_crc));
}

Seal seal_new(SealKind kind, uint64_t file_size) {
    Seal seal = {.version = SEAL_VERSION, .endian_tag = ENDIAN_TAG, .size = file_size};
    memcpy(seal.magic, kind_magic(kind), sizeof seal.magic);
    return seal;
}

void seal_finish(Seal *seal) {
    seal->seal_crc = seal_crc(seal);
}

Status seal_check(const Seal *seal, SealKind kind, uint64_t file_size, const char *path) {
    if (memcmp(seal->magic, kind_magic(kind), sizeof seal->magic) != 0) {
        return status_fail(BAD_DATA, "'%s' is no %s written by perrin, or it was cut off", path,
                           kind_words(kind));
    }
    if (seal->seal_crc != seal_crc(seal)) {
        return status_fail(BAD_DATA, "'%s' is damaged at its end", path);
    }
    if (seal->endian_tag != ENDIAN_TAG || seal->version != SEAL_VERSION) {
        return status_fail(BAD_DATA, "'%s' has another version of the format", path);
    }
    if (seal->size != file_size) {
        return status_fail(BAD_DATA,
                           "'%s' has %llu bytes instead of %llu: it was cut off or changed", path,
                           (unsigned long long)file_size, (unsigned long long)seal->size);
    }
    return OK;
}
