// SPDX-License-Identifier: GPL-3.0-or-later
// In the path of the trajectory: logarithms and exponentials are series of our own.
#include "dmc/pull.h"

#include <math.h>
#include <string.h>

// -ln u for u in (0, 1]: with u = m 2^e, sqrt(1/2) <= m < sqrt 2, by ln m = 2 artanh((m-1)/(m+1)).
static double minus_logarithm(double u) {
    static const double LN_2 = 0.69314718055994530942;
    static const int64_t ROOT_HALF = 0x3fe6a09e667f3bcc; // bits of sqrt(1/2)
    int64_t bits;
    memcpy(&bits, &u, sizeof bits);
    const int64_t e = (bits - ROOT_HALF) >> 52;
    bits -= e * (INT64_C(1) << 52);
    double m;
    memcpy(&m, &bits, sizeof m);
    const double s = (m - 1) / (m + 1), z = s * s;
    double series = 2.0 / 21;
    for (int k = 19; k >= 1; k -= 2) series = series * z + 2.0 / k;
    return -((double)e * LN_2 + s * series);
}

size_t pull_calm(const ChainPull *pull, int64_t k, size_t count, const uint32_t *who, uint32_t mask,
                 size_t most) {
    if (!pull) return most;
    const size_t left = count - (size_t)k % count, end = most < left ? most : left;
    size_t calm = 0;
    while (calm < end && (who[calm] & mask) != pull->particle) calm++;
    return calm;
}

PullTrial pull_trial(const ChainPull *pull, RngKey key, int64_t k, int dimension) {
    Rng rng = rng_open(key, STREAM_PULL, (uint64_t)k, 0);
    PullTrial trial = {.thermal = minus_logarithm(1 - rng_uniform(&rng))};
    trial.afforded = trial.thermal;
    for (int a = 0; a < dimension; a++) {
        const double width = a == pull->axis ? pull->along : pull->across;
        trial.shift[a] = pull->drifted ? width / sqrt(3) * rng_normal(&rng)
                                       : width * (2 * rng_uniform(&rng) - 1);
    }
    if (pull->drifted)
        trial.shift[pull->axis] += pull->force * pull->along * pull->along / 6; // D F t
    else
        trial.afforded += pull->force * trial.shift[pull->axis];
    return trial;
}

// exp(-f), by the 2^n-th power of exp(-f/2^n).
static double decay(double f) {
    int halvings = 0;
    for (; f > 0.25; f /= 2) halvings++;
    double sum = 1;
    for (int k = 14; k >= 1; k--) sum = 1 - sum * f / k;
    for (; halvings > 0; halvings--) sum *= sum;
    return sum;
}

// Integral over x from 0 to 1 of x^power exp(-f x), by its series; f <= 1.
static double series(double f, int power) {
    double sum = 0, term = 1;
    for (int n = 0; n <= 20; n++) {
        sum += term / (n + power + 1);
        term *= -f / (n + 1);
    }
    return sum;
}

double pull_drift(double f) {
    const double back = f <= 1 ? series(f, 1) : (1 - (1 + f) * decay(f)) / (f * f);
    return 0.25 - back / 2;
}

double pull_acceptance(double f) {
    return 0.5 + (f <= 1 ? series(f, 0) : (1 - decay(f)) / f) / 2;
}
