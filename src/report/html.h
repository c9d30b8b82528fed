// SPDX-License-Identifier: GPL-3.0-or-later
// Text inside a page.
#pragma once

#include "base/text.h"

void html_words(Text *page, const char *words); // escaped; always valid UTF-8
void html_unit(Text *page, const char *unit);   // typeset and escaped
void html_name(Text *page, const char *name);   // long_time_diffusion: long time diffusion
