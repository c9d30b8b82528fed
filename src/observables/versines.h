// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of 1 - cos over many angles: what a self-intermediate scattering function has lost. To full
// precision where it has lost little, and the same bits on every cpu_path.
#pragma once

#include "numerics/turn.h"

#include <stddef.h>

// The sum of 1 - cos(2 pi turns x[i]); `count` is a multiple of LANES, x is aligned to them.
double versines_sum(const double *x, size_t count, double turns);

// An instance for each instruction set.
double versines_sum_portable(const double *x, size_t count, double turns);
double versines_sum_avx2(const double *x, size_t count, double turns);
double versines_sum_avx512(const double *x, size_t count, double turns);
