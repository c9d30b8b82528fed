// SPDX-License-Identifier: GPL-3.0-or-later
// One Fourier component of the density, for a wave vector that nobody has seen before: no table of
// powers, one cosine and sine per particle. The same bits on every cpu_path.
#pragma once

#include "numerics/turn.h"

#include <stddef.h>

// A sum of exp(2 pi i turns).
typedef struct WaveSum {
    double real, imaginary;
} WaveSum;

// Over particles at x, y of turns a x + b y; `count` is a multiple of LANES, x and y are aligned to
// them.
WaveSum wave_sum(const double *x, const double *y, size_t count, double a, double b);

// An instance for each instruction set.
WaveSum wave_sum_portable(const double *x, const double *y, size_t count, double a, double b);
WaveSum wave_sum_avx2(const double *x, const double *y, size_t count, double a, double b);
WaveSum wave_sum_avx512(const double *x, const double *y, size_t count, double a, double b);
