// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the compiled loops this processor can run.
#include "mct/lines.h"

#include "base/cpu.h"

const Lines *lines(void) {
#if defined(__x86_64__)
    static const Lines *const paths[CPU_PATHS] = {&lines_portable, &lines_avx2, &lines_avx512};
    return paths[cpu_path()];
#else
    return &lines_portable;
#endif
}
