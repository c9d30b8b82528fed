// SPDX-License-Identifier: GPL-3.0-or-later
// Exponents by bisection: both sides of the relation fall with the exponent.
#include "mct/exponents.h"

#include <math.h>

// Gamma(1 + x)^2/Gamma(1 + 2 x), with x = -a or b.
static double relation(double x) {
    return exp(2 * lgamma(1 + x) - lgamma(1 + 2 * x));
}

static double solve(double lambda, double end) {
    double low = 0, high = 1; // in units of `end`
    for (int step = 0; step < 60; step++) {
        const double middle = (low + high) / 2;
        if (relation(middle * end) > lambda)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2 * end;
}

Status exponents_of(double lambda, Exponents *exponents) {
    if (!(lambda >= 0.5) || !(lambda < 1))
        return status_fail(BAD_DATA, "an exponent parameter of %g is not between 1/2 and 1",
                           lambda);
    const double a = -solve(lambda, -0.499999), b = solve(lambda, 1);
    *exponents = (Exponents){.lambda = lambda, .a = a, .b = b, .gamma = 1 / (2 * a) + 1 / (2 * b)};
    return OK;
}
