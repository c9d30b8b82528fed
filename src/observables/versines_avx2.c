// SPDX-License-Identifier: GPL-3.0-or-later
// versines_kernel.h for the instruction set that this file is named for.
#include "observables/versines_kernel.h"

double versines_sum_avx2(const double *x, size_t count, double turns) {
    return versines_sum_kernel(x, count, turns);
}
