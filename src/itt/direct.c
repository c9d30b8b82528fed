// SPDX-License-Identifier: GPL-3.0-or-later
// c(q) between the entries of its table: a cubic with the values and slopes of both ends.
#include "itt/direct.h"

#include "base/memory.h"

#include <math.h>

double direct_wave_number(double spacing, size_t i) {
    return ((double)i + 0.5) * spacing;
}

// c at entry i, of any sign: c is even in q.
static double entry(const double *c, size_t count, ptrdiff_t i) {
    const size_t at = (size_t)(i < 0 ? -i - 1 : i);
    return at < count ? c[at] : 0;
}

// Slopes of sixth order in the spacing; at the end of the table c goes on as zero.
static Status fill(Direct *direct, const double *c) {
    TRY(NEW_ARRAY(direct->value, direct->count + 2));
    TRY(NEW_ARRAY(direct->slope, direct->count + 2));
    for (size_t k = 0; k < direct->count + 1; k++) {
        const ptrdiff_t i = (ptrdiff_t)k - 1;
        const size_t n = direct->count;
        direct->value[k] = entry(c, n, i);
        direct->slope[k] = (45 * (entry(c, n, i + 1) - entry(c, n, i - 1)) -
                            9 * (entry(c, n, i + 2) - entry(c, n, i - 2)) +
                            (entry(c, n, i + 3) - entry(c, n, i - 3))) /
                           (60 * direct->spacing);
    }
    return OK;
}

Status direct_create(Direct **out, double density, double spacing, const double *c, size_t count) {
    Direct *direct = NULL;
    *out = NULL;
    TRY(NEW(direct));
    direct->density = density;
    direct->spacing = spacing;
    direct->count = count;
    const Status status = fill(direct, c);
    if (status == OK)
        *out = direct;
    else
        direct_free(direct);
    return status;
}

void direct_free(Direct *direct) {
    if (!direct) return;
    memory_free(direct->value);
    memory_free(direct->slope);
    memory_free(direct);
}

// The interval of q, and how far q is in it, 0 <= u < 1; `count` where the table has ended.
static size_t interval(const Direct *direct, double q, double *u) {
    const double place = q / direct->spacing + 0.5;
    if (!(place < (double)direct->count)) return direct->count;
    const size_t at = (size_t)place;
    *u = place - (double)at;
    return at;
}

double direct_value(const Direct *direct, double q) {
    double u = 0;
    const size_t k = interval(direct, q, &u);
    if (k == direct->count) return 0;
    const double rise = direct->value[k + 1] - direct->value[k];
    const double a = direct->spacing * direct->slope[k], b = direct->spacing * direct->slope[k + 1];
    return direct->value[k] + u * (a + u * (3 * rise - 2 * a - b + u * (a + b - 2 * rise)));
}

double direct_slope(const Direct *direct, double q) {
    double u = 0;
    const size_t k = interval(direct, q, &u);
    if (k == direct->count) return 0;
    const double rise = direct->value[k + 1] - direct->value[k];
    const double a = direct->spacing * direct->slope[k], b = direct->spacing * direct->slope[k + 1];
    return (a + u * (2 * (3 * rise - 2 * a - b) + 3 * u * (a + b - 2 * rise))) / direct->spacing;
}

double direct_factor(const Direct *direct, double q) {
    return 1 / (1 - direct->density * direct_value(direct, q));
}
