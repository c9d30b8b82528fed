// SPDX-License-Identifier: GPL-3.0-or-later
// The memory integral on a doubling grid.
#include "mct/history.h"

#include "base/memory.h"
#include "mct/lines.h"

#include <string.h>

Status history_create(History *history, size_t block, size_t f_size, size_t m_size, size_t stride) {
    *history = (History){.block = block, .f_size = f_size, .m_size = m_size, .stride = stride};
    TRY(NEW_ARRAY(history->f, (block + 1) * f_size));
    TRY(NEW_ARRAY(history->m, (block + 1) * m_size));
    TRY(NEW_ARRAY(history->f_mean, (block + 1) * f_size));
    return NEW_ARRAY(history->m_mean, (block + 1) * m_size);
}

void history_free(History *history) {
    memory_free(history->f);
    memory_free(history->m);
    memory_free(history->f_mean);
    memory_free(history->m_mean);
    *history = (History){0};
}

double *history_f(const History *history, size_t i) {
    return history->f + i * history->f_size;
}

double *history_m(const History *history, size_t i) {
    return history->m + i * history->m_size;
}

static void average(double *mean, const double *values, size_t size, size_t i) {
    const double *before = values + (i - 1) * size, *now = values + i * size;
    for (size_t k = 0; k < size; k++) mean[i * size + k] = (before[k] + now[k]) / 2;
}

void history_average(History *history, size_t i) {
    average(history->f_mean, history->f, history->f_size, i);
    average(history->m_mean, history->m, history->m_size, i);
}

void history_known(const History *history, size_t i, size_t m_line, size_t f_line, double *sum) {
    const size_t half = i / 2, stride = history->stride;
    const ptrdiff_t f_step = (ptrdiff_t)history->f_size, m_step = (ptrdiff_t)history->m_size;
    const double *f = history->f + f_line * stride, *f_mean = history->f_mean + f_line * stride;
    const double *m = history->m + m_line * stride, *m_mean = history->m_mean + m_line * stride;
    const double *f_half = f + half * history->f_size;
    const double *m_half = m + (i - half) * history->m_size;
    const double *f_last = f + (i - 1) * history->f_size;
    const double *m_last = m + (i - 1) * history->m_size;
    for (size_t k = 0; k < stride; k++)
        sum[k] += m_half[k] * f_half[k] - m_mean[history->m_size + k] * f_last[k] -
                  m_last[k] * f_mean[history->f_size + k];
    // sum over l = 2.. of m_mean[l] (f[i - l + 1] - f[i - l])
    lines()->history(sum, stride, i - half - 1, m_mean + 2 * history->m_size, m_step, f_last,
                     f_last - f_step, -f_step);
    // sum over j = 2.. of f_mean[j] (m[i - j + 1] - m[i - j])
    lines()->history(sum, stride, half - 1, f_mean + 2 * history->f_size, f_step, m_last,
                     m_last - m_step, -m_step);
}

static void halve(double *values, double *mean, size_t size, size_t block) {
    for (size_t i = 1; i <= block / 2; i++) {
        memcpy(values + i * size, values + 2 * i * size, size * sizeof *values);
        for (size_t k = 0; k < size; k++)
            mean[i * size + k] = (mean[(2 * i - 1) * size + k] + mean[2 * i * size + k]) / 2;
    }
}

void history_decimate(History *history) {
    halve(history->f, history->f_mean, history->f_size, history->block);
    halve(history->m, history->m_mean, history->m_size, history->block);
}
