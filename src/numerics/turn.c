// SPDX-License-Identifier: GPL-3.0-or-later
// Cosine and sine of a fraction of a turn.
#include "numerics/turn.h"

#include "base/constants.h"

#include <math.h>

// Taylor polynomials in x^2 for |x| <= pi/4, where the first term left out is below 1e-17.
static double small_sine(double x) {
    const double y = x * x;
    double sum = 1;
    for (int k = 16; k >= 2; k -= 2) sum = 1 - y / (k * (k + 1)) * sum;
    return x * sum;
}

static double small_cosine(double x) {
    const double y = x * x;
    double sum = 1;
    for (int k = 18; k >= 2; k -= 2) sum = 1 - y / (k * (k - 1)) * sum;
    return sum;
}

void turn_cosine_sine(double fraction, double *cosine, double *sine) {
    const double turn = fraction - rint(fraction);
    const double quarter = rint(4 * turn);
    const double angle = 2 * PI * (turn - quarter / 4);
    const double c = small_cosine(angle), s = small_sine(angle);
    const int quadrant = (int)quarter & 3;
    *cosine = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
    *sine = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
}
