// SPDX-License-Identifier: GPL-3.0-or-later
// Text from a stranger's file may hold anything; what we write is valid UTF-8.
#pragma once

#include <stddef.h>

// Bytes (1 to 4) of the character that begins here; 0 if none does.
size_t utf8_length(const char *text);

// Characters of valid UTF-8.
size_t utf8_letters(const char *text);
