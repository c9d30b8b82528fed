// SPDX-License-Identifier: GPL-3.0-or-later
// wave_sum_kernel.h for the instruction set that this file is named for.
#include "observables/wave_sum_kernel.h"

WaveSum wave_sum_portable(const double *x, const double *y, size_t count, double a, double b) {
    return wave_sum_kernel(x, y, count, a, b);
}
