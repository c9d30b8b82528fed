// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays aligned for vector loads, zeroed, with checked sizes.
#pragma once

#include "base/status.h"

#include <stddef.h>

enum { MEMORY_ALIGNMENT = 64 }; // one cache line, one AVX-512 register

// `count` zeroed elements of `size` bytes, 64-byte aligned, or NULL with a sentence in the status.
// A count of zero gives a valid pointer.
void *memory_new(size_t count, size_t size);
void memory_free(void *pointer);

// TRY(NEW_ARRAY(state->mass, count));
#define NEW_ARRAY(pointer, count)                                                                  \
    (((pointer) = memory_new((count), sizeof *(pointer))) ? OK : NO_MEMORY)
#define NEW(pointer) NEW_ARRAY(pointer, 1)
