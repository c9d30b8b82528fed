// SPDX-License-Identifier: GPL-3.0-or-later
// The exponents of mode-coupling theory from its exponent parameter (Weysser, thesis, eq. 3.19).
#pragma once

#include "base/status.h"

typedef struct Exponents {
    double lambda, a, b, gamma;
} Exponents;

// lambda = Gamma(1 - a)^2/Gamma(1 - 2 a) = Gamma(1 + b)^2/Gamma(1 + 2 b), gamma = 1/(2 a) + 1/(2
// b). BAD_DATA unless 1/2 <= lambda < 1.
Status exponents_of(double lambda, Exponents *exponents);
