// SPDX-License-Identifier: GPL-3.0-or-later
// CRC-32C (Castagnoli), the checksum of what is stored: as in iSCSI, RFC 3720. The processor's
// instruction where there is one; the same numbers everywhere.
#pragma once

#include <stddef.h>
#include <stdint.h>

// The checksum of bytes that follow bytes with checksum `before`; 0 before the first.
uint32_t crc32c(uint32_t before, const void *bytes, size_t size);
