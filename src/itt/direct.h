// SPDX-License-Identifier: GPL-3.0-or-later
// The direct correlation functions c_ab(q) of a mixture of discs at any wave number, from tables at
// (i + 1/2) spacing: what the theory under shear starts from. Beyond the tables c = 0.
#pragma once

#include "base/status.h"
#include "numerics/small.h"
#include "oz/mixture.h"

#include <stddef.h>

typedef struct Direct {
    Mixture mixture;
    double density, spacing;
    size_t count;
    double *value,
        *slope; // [pair][count + 2]: of c, one more entry at q = -spacing/2 and at the end
} Direct;

// The wave numbers at which a table is to be given.
double direct_wave_number(double spacing, size_t i);
// c is [pair][count].
Status direct_create(Direct **out, const Mixture *mixture, double density, double spacing,
                     const double *c, size_t count);
void direct_free(Direct *direct);

double direct_value(const Direct *direct, size_t pair, double q);
double direct_slope(const Direct *direct, size_t pair, double q); // dc/dq
// S, the inverse of delta_ab/x_a - rho c_ab.
void direct_factor(const Direct *direct, double q, SmallMatrix factor);
double direct_total(const Direct *direct, double q); // the sum over all of S_ab
