// SPDX-License-Identifier: GPL-3.0-or-later
// The instance for this processor.
#include "observables/wave_sum.h"

#include "base/cpu.h"

WaveSum wave_sum(const double *x, const double *y, size_t count, double a, double b) {
    static WaveSum (*const kernels[CPU_PATHS])(const double *, const double *, size_t, double,
                                               double) = {wave_sum_portable, wave_sum_avx2,
                                                          wave_sum_avx512};
    return kernels[cpu_path()](x, y, count, a, b);
}
