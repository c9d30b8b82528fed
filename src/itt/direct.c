// SPDX-License-Identifier: GPL-3.0-or-later
// c_ab(q) between the entries of their tables: a cubic with the values and slopes of both ends.
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
static void fill(const Direct *direct, const double *c, double *value, double *slope) {
    const size_t n = direct->count;
    for (size_t k = 0; k < n + 1; k++) {
        const ptrdiff_t i = (ptrdiff_t)k - 1;
        value[k] = entry(c, n, i);
        slope[k] = (45 * (entry(c, n, i + 1) - entry(c, n, i - 1)) -
                    9 * (entry(c, n, i + 2) - entry(c, n, i - 2)) +
                    (entry(c, n, i + 3) - entry(c, n, i - 3))) /
                   (60 * direct->spacing);
    }
}

Status direct_create(Direct **out, const Mixture *mixture, double density, double spacing,
                     const double *c, size_t count) {
    const size_t pairs = mixture_pairs(mixture), room = count + 2;
    Direct *direct = NULL;
    *out = NULL;
    TRY(NEW(direct));
    *direct = (Direct){.mixture = *mixture, .density = density, .spacing = spacing, .count = count};
    Status status = NEW_ARRAY(direct->value, pairs * room);
    if (status == OK) status = NEW_ARRAY(direct->slope, pairs * room);
    if (status != OK) {
        direct_free(direct);
        return status;
    }
    for (size_t pair = 0; pair < pairs; pair++)
        fill(direct, c + pair * count, direct->value + pair * room, direct->slope + pair * room);
    *out = direct;
    return OK;
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

double direct_value(const Direct *direct, size_t pair, double q) {
    double u = 0;
    const size_t k = interval(direct, q, &u);
    if (k == direct->count) return 0;
    const double *value = direct->value + pair * (direct->count + 2) + k;
    const double *slope = direct->slope + pair * (direct->count + 2) + k;
    const double rise = value[1] - value[0];
    const double a = direct->spacing * slope[0], b = direct->spacing * slope[1];
    return value[0] + u * (a + u * (3 * rise - 2 * a - b + u * (a + b - 2 * rise)));
}

double direct_slope(const Direct *direct, size_t pair, double q) {
    double u = 0;
    const size_t k = interval(direct, q, &u);
    if (k == direct->count) return 0;
    const double *value = direct->value + pair * (direct->count + 2) + k;
    const double *slope = direct->slope + pair * (direct->count + 2) + k;
    const double rise = value[1] - value[0];
    const double a = direct->spacing * slope[0], b = direct->spacing * slope[1];
    return (a + u * (2 * (3 * rise - 2 * a - b) + 3 * u * (a + b - 2 * rise))) / direct->spacing;
}

void direct_factor(const Direct *direct, double q, SmallMatrix factor) {
    const Mixture *mixture = &direct->mixture;
    SmallMatrix inverse;
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = 0; b < mixture->species; b++)
            inverse[a][b] =
                (a == b ? 1 / mixture->fraction[a] : 0) -
                direct->density * direct_value(direct, mixture_pair(mixture->species, a, b), q);
    }
    small_invert(mixture->species, inverse, factor);
}

double direct_total(const Direct *direct, double q) {
    SmallMatrix factor;
    double sum = 0;
    direct_factor(direct, q, factor);
    for (size_t a = 0; a < direct->mixture.species; a++) {
        for (size_t b = 0; b < direct->mixture.species; b++) sum += factor[a][b];
    }
    return sum;
}
