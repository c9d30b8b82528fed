// SPDX-License-Identifier: GPL-3.0-or-later
// The direct correlation function c(q) of equal discs at any wave number, from a table at
// (i + 1/2) spacing: what the theory under shear starts from. Beyond the table c = 0.
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct Direct {
    double density, spacing;
    size_t count;
    double *value, *slope; // [count + 2]: of c, one more entry at q = -spacing/2 and at the end
} Direct;

// The wave numbers at which a table is to be given.
double direct_wave_number(double spacing, size_t i);
Status direct_create(Direct **out, double density, double spacing, const double *c, size_t count);
void direct_free(Direct *direct);

double direct_value(const Direct *direct, double q);
double direct_slope(const Direct *direct, double q);  // dc/dq
double direct_factor(const Direct *direct, double q); // S = 1/(1 - rho c)
