// SPDX-License-Identifier: GPL-3.0-or-later
// The memory integral over ages on a grid whose spacing doubles (Fuchs et al., J. Phys.: Condens.
// Matter 3, 5047, 1991), for one correlator: as mct/history.h, with f and m in arrays that may
// belong to different beginnings and ends. Inside schematic/ only.
#pragma once

#include "base/status.h"

#include <stddef.h>

enum { AGES_BLOCK = 256 }; // points of a block

// A function of age at i step, and its averages over (i - 1, i).
typedef struct Ages {
    double *at, *mean; // [count + 1]
} Ages;

Status ages_create(Ages *ages, size_t count);
void ages_free(Ages *ages);
void ages_average(Ages *ages, size_t i);   // over interval i, from its ends
void ages_halve(Ages *ages, size_t block); // every second point becomes the older half of a block

// What point i knows of int m(t - t') df(t'). What is missing is m_mean[1] f[i] - m[i] (f[0] -
// f_mean[1]).
double ages_known(const Ages *f, const Ages *m, size_t i);

// The free decay and the first of the memory, to second order in the age, which is short.
double ages_early(double rate, double coupling, double age);

// The root of linear x - square x^2 = rest that is the only one as square -> 0.
double ages_root(double linear, double square, double rest);
