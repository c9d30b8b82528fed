// SPDX-License-Identifier: GPL-3.0-or-later
// The instance for this processor.
#include "observables/versines.h"

#include "base/cpu.h"

double versines_sum(const double *x, size_t count, double turns) {
    static double (*const kernels[CPU_PATHS])(const double *, size_t, double) = {
        versines_sum_portable, versines_sum_avx2, versines_sum_avx512};
    return kernels[cpu_path()](x, count, turns);
}
