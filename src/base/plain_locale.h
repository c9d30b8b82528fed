// SPDX-License-Identifier: GPL-3.0-or-later
// The decimal point is a point in all that Perrin reads and writes, whatever locale the program
// that uses it as a library has chosen. A locale belongs to a thread: each enters for itself.
#pragma once

#include <locale.h>

typedef struct PlainLocale {
    locale_t before, plain;
} PlainLocale;

// From here to the end of the block.
#define IN_PLAIN_LOCALE                                                                            \
    __attribute__((cleanup(plain_locale_leave), unused)) PlainLocale plain_locale =                \
        plain_locale_enter()

PlainLocale plain_locale_enter(void);
void plain_locale_leave(PlainLocale *locale);
