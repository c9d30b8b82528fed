// SPDX-License-Identifier: GPL-3.0-or-later
// Escaping for HTML and SVG.
#include "report/html.h"

#include "report/notation.h"
#include "report/utf8.h"

static void put_character(Text *page, const char *c, size_t length) {
    if (*c == '&')
        text_put(page, "&amp;");
    else if (*c == '<')
        text_put(page, "&lt;");
    else if (*c == '>')
        text_put(page, "&gt;");
    else if (*c == '"')
        text_put(page, "&quot;");
    else if (length == 0)
        text_put(page, "\xef\xbf\xbd"); // the replacement character
    else if ((unsigned char)*c < 0x20 && *c != '\n' && *c != '\t')
        text_put(page, " ");
    else
        text_bytes(page, c, length);
}

void html_words(Text *page, const char *words) {
    for (const char *c = words; *c;) {
        const size_t length = utf8_length(c);
        put_character(page, c, length);
        c += length ? length : 1;
    }
}

void html_unit(Text *page, const char *unit) {
    Text typeset = {0};
    notation_unit(&typeset, unit);
    html_words(page, text_words(&typeset));
    text_free(&typeset);
}

void html_name(Text *page, const char *name) {
    Text spaced = {0};
    notation_name(&spaced, name);
    html_words(page, text_words(&spaced));
    text_free(&spaced);
}
