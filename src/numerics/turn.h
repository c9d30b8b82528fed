// SPDX-License-Identifier: GPL-3.0-or-later
// Cosine and sine of a fraction of a turn, 2 pi f, to 2e-16, by polynomials of our own: the C
// library's differ between processors in the last bit.
#pragma once

void turn_cosine_sine(double fraction, double *cosine, double *sine);
