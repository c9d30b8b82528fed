// SPDX-License-Identifier: GPL-3.0-or-later
// Aligned, zeroed, checked allocation.
#include "base/memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void *memory_new(size_t count, size_t size) {
    size_t bytes = 0;
    const bool overflow = __builtin_mul_overflow(count, size, &bytes) ||
                          __builtin_add_overflow(bytes, MEMORY_ALIGNMENT, &bytes);
    bytes -= bytes % MEMORY_ALIGNMENT; // aligned_alloc wants a multiple; at least one line remains
    void *pointer = overflow ? NULL : aligned_alloc(MEMORY_ALIGNMENT, bytes);
    if (!pointer) {
        status_fail(NO_MEMORY, "out of memory: cannot allocate %zu elements of %zu bytes", count,
                    size);
        return NULL;
    }
    return memset(pointer, 0, bytes);
}

void memory_free(void *pointer) {
    free(pointer);
}
