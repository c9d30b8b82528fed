// SPDX-License-Identifier: GPL-3.0-or-later
// Cosines and sines of fractions of a turn, eight at a time, the same bits on every instruction
// set: + - * and bits only, no C library. By Taylor polynomials whose first term left out is below
// 1e-17.
#pragma once

#include <stdint.h>

enum { LANES = 8 };
typedef double Lanes __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t LaneBits __attribute__((vector_size(LANES * sizeof(int64_t))));

#define KERNEL static inline __attribute__((always_inline))

// Adding and taking away this number rounds one below 2^51 to a whole number, half to even.
static const double TURN_ROUND = 0x1.8p52;
static const double TURN_PI = 3.14159265358979323846;

// Eight numbers in a fixed order.
KERNEL double lanes_sum(const Lanes *v) {
    typedef double Half __attribute__((vector_size(LANES / 2 * sizeof(double))));
    const union {
        Lanes all;
        Half half[2];
    } x = {.all = *v};
    const Half y = x.half[0] + x.half[1];
    return (y[0] + y[2]) + (y[1] + y[3]);
}

// sin(x)/x and cos(x) in powers of x^2.
static const double TURN_SINE[] = {1.0,
                                   -1.0 / 6,
                                   1.0 / 120,
                                   -1.0 / 5040,
                                   1.0 / 362880,
                                   -1.0 / 39916800,
                                   1.0 / 6227020800,
                                   -1.0 / 1307674368000,
                                   1.0 / 355687428096000,
                                   -1.0 / 121645100408832000,
                                   1.0 / 51090942171709440000.0};
static const double TURN_COSINE[] = {1.0,
                                     -1.0 / 2,
                                     1.0 / 24,
                                     -1.0 / 720,
                                     1.0 / 40320,
                                     -1.0 / 3628800,
                                     1.0 / 479001600,
                                     -1.0 / 87178291200,
                                     1.0 / 20922789888000};

KERNEL void turn_polynomial(const double *coefficients, const int terms, const Lanes *y,
                            Lanes *sum) {
    *sum = coefficients[terms - 2] + coefficients[terms - 1] * *y;
    for (int k = terms - 3; k >= 0; k--) *sum = coefficients[k] + *y * *sum;
}

KERNEL void turn_choose(const LaneBits *where, const Lanes *yes, const Lanes *no, Lanes *chosen) {
    *chosen = (Lanes)(((LaneBits)*yes & *where) | ((LaneBits)*no & ~*where));
}

// Within an eighth of a turn of the nearest quarter; the quarters then exchange the two and change
// their signs. |fraction| < 2^48.
KERNEL void turn_cosine_sine(const Lanes *fraction, Lanes *cosine, Lanes *sine) {
    const Lanes shifted = 4 * *fraction + TURN_ROUND;
    const Lanes x = 2 * TURN_PI * (*fraction - (shifted - TURN_ROUND) / 4), y = x * x;
    Lanes c, s;
    turn_polynomial(TURN_COSINE, 9, &y, &c);
    turn_polynomial(TURN_SINE, 8, &y, &s);
    s = s * x;
    const LaneBits quarter = (LaneBits)shifted; // its last two bits
    const LaneBits exchanged = -(quarter & 1);
    turn_choose(&exchanged, &s, &c, cosine);
    turn_choose(&exchanged, &c, &s, sine);
    *cosine = (Lanes)((LaneBits)*cosine ^ ((quarter + 1) & 2) << 62);
    *sine = (Lanes)((LaneBits)*sine ^ (quarter & 2) << 62);
}

// 1 - cos = 2 sin^2 of the half angle, to full precision where the angle is small.
KERNEL void turn_versine(const Lanes *fraction, Lanes *versine) {
    const Lanes x = TURN_PI * (*fraction - ((*fraction + TURN_ROUND) - TURN_ROUND)), y = x * x;
    Lanes s;
    turn_polynomial(TURN_SINE, 11, &y, &s);
    s = s * x;
    *versine = 2 * s * s;
}
