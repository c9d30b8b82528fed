// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of lines.h, compiled once for each instruction set.
#pragma once

#include "mct/lines.h"
#include "numerics/turn.h"

// Four sums side by side, so that additions do not wait for each other.
KERNEL double line_dot(const double *a, const double *b, size_t stride) {
    const Lanes *x = (const Lanes *)a, *y = (const Lanes *)b;
    const size_t lanes = stride / LANES;
    Lanes sum[4] = {{0}};
    size_t i = 0;
    for (; i + 4 <= lanes; i += 4) {
        for (int k = 0; k < 4; k++) sum[k] += x[i + (size_t)k] * y[i + (size_t)k];
    }
    for (; i < lanes; i++) sum[0] += x[i] * y[i];
    const Lanes all = (sum[0] + sum[2]) + (sum[1] + sum[3]);
    return lanes_sum(&all);
}

KERNEL void line_dots(const double *const j[3], const double *phi, const double *x, const double *y,
                      size_t stride, double sums[4]) {
    const Lanes *j0 = (const Lanes *)j[0], *j1 = (const Lanes *)j[1], *j2 = (const Lanes *)j[2];
    const Lanes *f = (const Lanes *)phi, *g = (const Lanes *)x, *h = (const Lanes *)y;
    Lanes sum[4] = {{0}};
    for (size_t i = 0; i < stride / LANES; i++) {
        sum[0] += j0[i] * f[i];
        sum[1] += j0[i] * g[i];
        sum[2] += j2[i] * g[i];
        sum[3] += j1[i] * h[i];
    }
    for (int k = 0; k < 4; k++) sums[k] = lanes_sum(&sum[k]);
}

KERNEL void line_add(double *sum, double p, const double *a, double r, const double *b,
                     size_t stride) {
    Lanes *total = (Lanes *)sum;
    const Lanes *x = (const Lanes *)a, *y = (const Lanes *)b;
    for (size_t i = 0; i < stride / LANES; i++) total[i] += p * x[i] + r * y[i];
}

KERNEL void line_history(double *sum, size_t stride, size_t terms, const double *moment,
                         ptrdiff_t moment_step, const double *newer, const double *older,
                         ptrdiff_t step) {
    for (size_t i = 0; i < stride; i += LANES) {
        Lanes even = {0}, odd = {0};
        size_t l = 0;
        const double *m = moment + i, *n = newer + i, *o = older + i;
        for (; l + 2 <= terms; l += 2, m += 2 * moment_step, n += 2 * step, o += 2 * step) {
            even += *(const Lanes *)m * (*(const Lanes *)n - *(const Lanes *)o);
            odd += *(const Lanes *)(m + moment_step) *
                   (*(const Lanes *)(n + step) - *(const Lanes *)(o + step));
        }
        if (l < terms) even += *(const Lanes *)m * (*(const Lanes *)n - *(const Lanes *)o);
        *(Lanes *)(sum + i) += even + odd;
    }
}

#define LINES_KERNEL(path)                                                                         \
    static double dot(const double *a, const double *b, size_t stride) {                           \
        return line_dot(a, b, stride);                                                             \
    }                                                                                              \
    static void dots(const double *const j[3], const double *phi, const double *x,                 \
                     const double *y, size_t stride, double sums[4]) {                             \
        line_dots(j, phi, x, y, stride, sums);                                                     \
    }                                                                                              \
    static void add(double *sum, double p, const double *a, double r, const double *b,             \
                    size_t stride) {                                                               \
        line_add(sum, p, a, r, b, stride);                                                         \
    }                                                                                              \
    static void history(double *sum, size_t stride, size_t terms, const double *moment,            \
                        ptrdiff_t moment_step, const double *newer, const double *older,           \
                        ptrdiff_t step) {                                                          \
        line_history(sum, stride, terms, moment, moment_step, newer, older, step);                 \
    }                                                                                              \
    const Lines lines_##path = {dot, dots, add, history};
