// SPDX-License-Identifier: GPL-3.0-or-later
// A text that grows by doubling.
#include "base/text.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Room for `more` bytes and the '\0' behind them; false, with a sticking error, if there is none.
static bool text_reserve(Text *text, size_t more) {
    if (text->status != OK) return false;
    if (more < text->capacity - text->length) return true;
    size_t capacity = text->capacity ? text->capacity : 256;
    while (capacity <= text->length + more) capacity *= 2;
    char *bytes = realloc(text->bytes, capacity);
    if (!bytes) {
        text->status = status_fail(NO_MEMORY, "no memory for a text of %zu bytes", capacity);
        return false;
    }
    text->bytes = bytes;
    text->capacity = capacity;
    return true;
}

void text_bytes(Text *text, const char *bytes, size_t n) {
    if (!text_reserve(text, n)) return;
    memcpy(text->bytes + text->length, bytes, n);
    text->length += n;
    text->bytes[text->length] = '\0';
}

void text_put(Text *text, const char *words) {
    text_bytes(text, words, strlen(words));
}

void text_add(Text *text, const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length >= 0 && text_reserve(text, (size_t)length)) {
        vsnprintf(text->bytes + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
}

Status text_status(const Text *text) {
    return text->status;
}

const char *text_words(const Text *text) {
    return text->bytes ? text->bytes : "";
}

void text_free(Text *text) {
    free(text->bytes);
    *text = (Text){0};
}
