// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over lines of wave numbers, eight at a time: the inner loops of mode-coupling theory, with
// the same order of additions on every instruction set. Lines are padded with zeros to whole
// vectors and aligned. Inside mct/ only.
#pragma once

#include <stddef.h>

// A line length with room for `count`.
static inline size_t lines_stride(size_t count) {
    return (count + 7) / 8 * 8;
}

typedef struct Lines {
    // sum_m a[m] b[m]
    double (*dot)(const double *a, const double *b, size_t stride);
    // sums[0..3] = j0.phi, j0.x, j2.x, j1.y
    void (*dots)(const double *const j[3], const double *phi, const double *x, const double *y,
                 size_t stride, double sums[4]);
    // sum[m] += p a[m] + r b[m]
    void (*add)(double *sum, double p, const double *a, double r, const double *b, size_t stride);
    // sum[m] += sum_l moment[l][m] (newer[l][m] - older[l][m]), l = 0..terms-1; the lines l of the
    // three follow each other at these distances, in units of doubles.
    void (*history)(double *sum, size_t stride, size_t terms, const double *moment,
                    ptrdiff_t moment_step, const double *newer, const double *older,
                    ptrdiff_t step);
} Lines;

const Lines *lines(void); // for this processor

extern const Lines lines_portable, lines_avx2, lines_avx512;
