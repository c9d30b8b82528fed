// SPDX-License-Identifier: GPL-3.0-or-later
// Aligned, zeroed, checked allocation.
#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

// Large arrays are read at random, and of huge pages the processor knows more addresses.
static const size_t HUGE_FROM = 4 << 20, SMALL_PAGE = 4096; // bytes

// Asks for huge pages; where there are none it does not matter.
static void want_huge_pages(void *pointer, size_t bytes) {
    const size_t before_page = -(uintptr_t)pointer % SMALL_PAGE;
    madvise((char *)pointer + before_page, bytes - before_page, MADV_HUGEPAGE);
}

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
    if (bytes >= HUGE_FROM) want_huge_pages(pointer, bytes);
    return memset(pointer, 0, bytes);
}

void memory_free(void *pointer) {
    free(pointer);
}
