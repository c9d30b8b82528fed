// SPDX-License-Identifier: GPL-3.0-or-later
// The pieces of a JSON text (RFC 8259).
#pragma once

#include "base/text.h"

void json_number(Text *text, double value);      // null for what is not finite
void json_string(Text *text, const char *words); // quoted and escaped; always valid UTF-8
