// SPDX-License-Identifier: GPL-3.0-or-later
// What the program was built from; goes into every output.
#pragma once

const char *version_number(void); // "0.1.0"
const char *version_commit(void); // of the source, or "unknown"
const char *version_compiler(void);
const char *version_flags(void);
