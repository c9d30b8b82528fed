// SPDX-License-Identifier: GPL-3.0-or-later
// The memory integral int_0^t m(t - t') f'(t') dt' on a grid whose spacing doubles from block to
// block (Fuchs et al., J. Phys.: Condens. Matter 3, 5047, 1991). The integral is cut at t/2: over
// recent times m by its averages over intervals times differences of f, over early times f by its
// averages times differences of m. Inside mct/ only.
#pragma once

#include "base/status.h"

#include <stddef.h>

// Correlators and kernels at times i step, i = 0..block, and their averages over (i - 1, i).
typedef struct History {
    size_t block; // points of a block, even
    size_t f_size, m_size, stride;
    double *f, *m, *f_mean, *m_mean; // [block + 1][size]
} History;

Status history_create(History *history, size_t block, size_t f_size, size_t m_size, size_t stride);
void history_free(History *history);

double *history_f(const History *history, size_t i);
double *history_m(const History *history, size_t i);

// Averages over interval i from its ends.
void history_average(History *history, size_t i);

// Adds to `sum`, a line, what step i knows of the integral for these lines of f and m; what is
// missing is m_mean[1] f[i] - m[i] (f[0] - f_mean[1]).
void history_known(const History *history, size_t i, size_t m_line, size_t f_line, double *sum);

// Every second point becomes the older half of the next block.
void history_decimate(History *history);
