// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of versines.h, stamped once for each instruction set.
#pragma once

#include "observables/versines.h"

// Two sums, so that one need not wait for the other.
KERNEL double versines_sum_kernel(const double *x, size_t count, double turns) {
    const Lanes *lanes = (const Lanes *)x;
    const size_t rows = count / LANES;
    Lanes even = {0}, odd = {0}, versine;
    for (size_t k = 0; k < rows; k++) {
        const Lanes fraction = turns * lanes[k];
        turn_versine(&fraction, &versine);
        if (k % 2)
            odd += versine;
        else
            even += versine;
    }
    even += odd;
    return lanes_sum(&even);
}
