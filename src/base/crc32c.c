// SPDX-License-Identifier: GPL-3.0-or-later
// CRC-32C, a nibble at a time from a table or by the instruction of SSE 4.2.
#include "base/crc32c.h"

#include "base/cpu.h"

#include <string.h>

// Remainders of the sixteen nibbles for the reflected polynomial 0x82f63b78.
static const uint32_t nibble[16] = {
    0x00000000, 0x105ec76f, 0x20bd8ede, 0x30e349b1, 0x417b1dbc, 0x5125dad3, 0x61c69362, 0x7198540d,
    0x82f63b78, 0x92a8fc17, 0xa24bb5a6, 0xb21572c9, 0xc38d26c4, 0xd3d3e1ab, 0xe330a81a, 0xf36e6f75,
};

static uint32_t crc_by_table(uint32_t crc, const unsigned char *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        crc = (crc >> 4) ^ nibble[crc & 15];
        crc = (crc >> 4) ^ nibble[crc & 15];
    }
    return crc;
}

#if defined(__x86_64__)
__attribute__((target("sse4.2"))) static uint32_t
crc_by_instruction(uint32_t crc, const unsigned char *bytes, size_t size) {
    uint64_t wide = crc;
    for (; size >= 8; bytes += 8, size -= 8) {
        uint64_t word;
        memcpy(&word, bytes, 8);
        wide = __builtin_ia32_crc32di(wide, word);
    }
    crc = (uint32_t)wide;
    for (size_t i = 0; i < size; i++) crc = __builtin_ia32_crc32qi(crc, bytes[i]);
    return crc;
}

static uint32_t crc_update(uint32_t crc, const unsigned char *bytes, size_t size) {
    if (cpu_path() != CPU_PORTABLE) return crc_by_instruction(crc, bytes, size);
    return crc_by_table(crc, bytes, size);
}
#else
static uint32_t crc_update(uint32_t crc, const unsigned char *bytes, size_t size) {
    return crc_by_table(crc, bytes, size);
}
#endif

uint32_t crc32c(uint32_t before, const void *bytes, size_t size) {
    return ~crc_update(~before, bytes, size);
}
