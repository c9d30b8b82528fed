// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of wave_sum.h, stamped once for each instruction set.
#pragma once

#include "observables/wave_sum.h"

KERNEL WaveSum wave_sum_kernel(const double *x, const double *y, size_t count, double a, double b) {
    Lanes real = {0}, imaginary = {0}, cosine, sine;
    for (size_t i = 0; i < count; i += LANES) {
        const Lanes turns = a * *(const Lanes *)(x + i) + b * *(const Lanes *)(y + i);
        turn_cosine_sine(&turns, &cosine, &sine);
        real += cosine;
        imaginary += sine;
    }
    return (WaveSum){lanes_sum(&real), lanes_sum(&imaginary)};
}
