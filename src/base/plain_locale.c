// SPDX-License-Identifier: GPL-3.0-or-later
// Enters and leaves a locale whose decimal point is a point.
#include "base/plain_locale.h"

PlainLocale plain_locale_enter(void) {
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return (PlainLocale){.before = uselocale(plain), .plain = plain};
}

void plain_locale_leave(PlainLocale *locale) {
    uselocale(locale->before);
    if (locale->plain) freelocale(locale->plain);
}
