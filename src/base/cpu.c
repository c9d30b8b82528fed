// SPDX-License-Identifier: GPL-3.0-or-later
// Run-time choice of the instruction set.
#include "base/cpu.h"

#include <stdlib.h>
#include <string.h>

static CpuPath best_path(void) {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
        return CPU_AVX512;
    }
    if (__builtin_cpu_supports("avx2")) return CPU_AVX2;
#endif
    return CPU_PORTABLE;
}

CpuPath cpu_path(void) {
    const CpuPath best = best_path();
    const char *wish = getenv("PERRIN_CPU");
    for (int path = 0; wish && path < (int)best; path++) {
        if (strcmp(wish, cpu_path_name((CpuPath)path)) == 0) return (CpuPath)path;
    }
    return best;
}

const char *cpu_path_name(CpuPath path) {
    static const char *const names[CPU_PATHS] = {"portable", "avx2", "avx512"};
    return names[path];
}
