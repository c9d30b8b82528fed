// SPDX-License-Identifier: GPL-3.0-or-later
// Fields on the half plane of wave vectors to space and back: sums over wave vectors of products
// become products. The box in space is so large that no sum wraps around. Even and odd fields have
// transforms that are real but for a factor i, of which half a plane is enough again.
#pragma once

#include "itt/plane.h"

typedef struct Fourier Fourier;

Status fourier_create(Fourier **out, const Plane *plane);
void fourier_free(Fourier *fourier);
size_t fourier_size(const Fourier *fourier); // numbers in a field in space

// sum over all wave vectors of field cos(q.r) of an even field, and of field sin(q.r) of an odd
// one; both on the half plane.
void fourier_even(Fourier *fourier, const double *field, double *space);
void fourier_odd(Fourier *fourier, const double *field, double *space);

// The even field of which `space` is the transform; `space` is used up.
void fourier_back(Fourier *fourier, double *space, double *field);
