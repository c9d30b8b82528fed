// SPDX-License-Identifier: GPL-3.0-or-later
// JSON numbers and strings.
#include "report/json.h"

#include "base/number.h"
#include "report/utf8.h"

#include <math.h>

void json_number(Text *text, double value) {
    char digits[NUMBER_SIZE];
    text_put(text, isfinite(value) ? number_write(digits, value) : "null");
}

static void put_escaped(Text *text, unsigned char c) {
    if (c == '"' || c == '\\')
        text_add(text, "\\%c", c);
    else if (c == '\n')
        text_put(text, "\\n");
    else if (c == '\t')
        text_put(text, "\\t");
    else
        text_add(text, "\\u%04x", c);
}

void json_string(Text *text, const char *words) {
    text_put(text, "\"");
    for (const char *c = words; *c;) {
        const size_t length = utf8_length(c);
        const unsigned char first = (unsigned char)*c;
        if (length == 0)
            text_put(text, "\\ufffd");
        else if (first < 0x20 || first == '"' || first == '\\' || first == 0x7f)
            put_escaped(text, first);
        else
            text_bytes(text, c, length);
        c += length ? length : 1;
    }
    text_put(text, "\"");
}
