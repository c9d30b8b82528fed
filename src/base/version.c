// SPDX-License-Identifier: GPL-3.0-or-later
// What the build system says about the build.
#include "base/version.h"

#include "base/commit.h" // written by tools/commit.cmake

const char *version_number(void) {
    return PERRIN_VERSION;
}
const char *version_commit(void) {
    return PERRIN_COMMIT;
}
const char *version_flags(void) {
    return PERRIN_FLAGS;
}

const char *version_compiler(void) {
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "gcc " __VERSION__;
#endif
}
