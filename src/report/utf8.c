// SPDX-License-Identifier: GPL-3.0-or-later
// UTF-8 by the table of well-formed byte sequences (Unicode, table 3-7).
#include "report/utf8.h"

#include <stdbool.h>

static bool continues(unsigned char byte) {
    return (byte & 0xc0) == 0x80;
}

size_t utf8_length(const char *text) {
    const unsigned char *b = (const unsigned char *)text;
    if (b[0] < 0x80) return b[0] != 0;
    if (b[0] >= 0xc2 && b[0] <= 0xdf) return continues(b[1]) ? 2 : 0;
    if (b[0] >= 0xe0 && b[0] <= 0xef) {
        const bool overlong = b[0] == 0xe0 && b[1] < 0xa0, surrogate = b[0] == 0xed && b[1] > 0x9f;
        return continues(b[1]) && continues(b[2]) && !overlong && !surrogate ? 3 : 0;
    }
    if (b[0] >= 0xf0 && b[0] <= 0xf4) {
        const bool overlong = b[0] == 0xf0 && b[1] < 0x90, beyond = b[0] == 0xf4 && b[1] > 0x8f;
        const bool whole = continues(b[1]) && continues(b[2]) && continues(b[3]);
        return whole && !overlong && !beyond ? 4 : 0;
    }
    return 0;
}

size_t utf8_letters(const char *text) {
    size_t letters = 0;
    for (const char *c = text; *c; c++) letters += !continues((unsigned char)*c);
    return letters;
}
