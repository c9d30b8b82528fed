// SPDX-License-Identifier: GPL-3.0-or-later
// A text that grows as it is written. Errors stick: when memory runs out further writing does
// nothing, and text_status tells.
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct Text {
    char *bytes;   // always ends in '\0' once something is written
    size_t length; // without the '\0'
    size_t capacity;
    Status status;
} Text; // {0} is an empty text

void text_add(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_put(Text *text, const char *words);             // as they stand
void text_bytes(Text *text, const char *bytes, size_t n); // of which none is '\0'
Status text_status(const Text *text);
const char *text_words(const Text *text); // "" if empty; borrowed
void text_free(Text *text);
