// SPDX-License-Identifier: GPL-3.0-or-later
// The report's own files.
#pragma once

#include "base/text.h"

// The file has these words or what it had before: written under a temporary name, then renamed.
Status file_replace(const char *path, const char *words);
Status file_read(Text *words, const char *path);
