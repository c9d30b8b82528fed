// SPDX-License-Identifier: GPL-3.0-or-later
// The last bytes of our HDF5 files, behind what HDF5 looks at: what kind of file it is, and
// checksums, so that our own readers know it whole before anything in it is believed. Internal to
// the store.
#pragma once

#include "base/status.h"

#include <stdint.h>

enum { SEAL_VERSION = 1, SEAL_WORDS = 20, SEAL_SIZE = 256 };

typedef enum SealKind { SEAL_RESULTS, SEAL_TRAJECTORY } SealKind;

typedef struct Seal {
    char magic[8];
    uint32_t version;
    uint32_t endian_tag;
    uint64_t size;              // of the whole file
    uint64_t words[SEAL_WORDS]; // as the kind of file needs them
    uint32_t contents_crc;      // of what the kind of file says
    uint32_t seal_crc;          // of the bytes before it
    unsigned char rest[SEAL_SIZE - 32 - 8 * SEAL_WORDS];
} Seal;

_Static_assert(sizeof(Seal) == SEAL_SIZE, "the seal fills its room");

// `words` and contents_crc are for the caller to set before seal_finish.
Seal seal_new(SealKind kind, uint64_t file_size);
void seal_finish(Seal *seal);

// BAD_DATA with a sentence unless this is the seal of a whole file of this kind.
Status seal_check(const Seal *seal, SealKind kind, uint64_t file_size, const char *path);
