// SPDX-License-Identifier: GPL-3.0-or-later
// Amplitudes from diffusion tensors, and what free trials of these amplitudes do. In the path of
// the trajectory: no function of the C library but sqrt.
#include "dmc/amplitude.h"

#include <math.h>

static const double ROTATION_LIMIT = 0.5; // a at which (1 - a) u no longer outweighs a w

// 1 - exp(-x), for x of order 1 at most, whose series needs no cancellation.
static double lost(double x) {
    double sum = 0, term = x;
    for (int k = 2; fabs(term) > 1e-18 * x; k++) {
        sum += term;
        term *= -x / k;
    }
    return sum;
}

static bool is_mixed(const ChainSettings *settings) {
    return settings->rotation == ROTATION_MIXED && !settings->gaussian;
}

// [JT 6, 9]: F(a) = <u'.u> = 1 - r^2/3 with r = a/(1 - a) must be exp(-x), x = parallel^2
// D_rot/(3 D_par): the decay in the time parallel^2/(6 D_par) of a trial.
static double mixed_rotation(double parallel, const Diffusion *diffusion) {
    const double x = parallel * parallel * diffusion->rotational / (3 * diffusion->parallel);
    const double r = sqrt(3 * lost(x));
    return r / (1 + r);
}

Amplitude amplitude_matched(double parallel, const Diffusion *diffusion,
                            const ChainSettings *settings) {
    Amplitude amplitude = {.parallel = parallel};
    amplitude.perpendicular = parallel * sqrt(diffusion->perpendicular / diffusion->parallel);
    if (is_mixed(settings))
        amplitude.rotation = mixed_rotation(parallel, diffusion);
    else
        amplitude.rotation = parallel * sqrt(diffusion->rotational / diffusion->parallel);
    return amplitude;
}

double amplitude_limit(const Diffusion *diffusion, const ChainSettings *settings) {
    const double ratio = sqrt(diffusion->parallel / diffusion->rotational);
    // a = 1/2 is r = 1, where exp(-x) = 2/3.
    return is_mixed(settings) ? sqrt(3 * log(1.5)) * ratio : ROTATION_LIMIT * ratio;
}

// artanh(r)/r, r < 1.
static double artanh_ratio(double r) {
    double sum = 0, power = 1;
    for (int k = 1; power > 1e-17 && k < 2000; k += 2) {
        sum += power / k;
        power *= r * r;
    }
    return sum;
}

// u' ~ u + r w with w uniform on the sphere: <u'.u> is [JT 6], <(u'.u)^2> the integral over the
// angle between u and w.
static void mixed_move(double a, FreeMove *move) {
    const double r = a / (1 - a), s = r * r;
    const double square = (3 - s + (1 - s) * (1 - s) * artanh_ratio(r)) / 4;
    move->squares.rotational = s / 3;
    move->second = 1.5 * (1 - square);
}

// u' ~ u + Y1 w1 + Y2 w2, averaged by Gauss' quadrature over uniform or normal Y of variance
// a^2/3.
static void tangent_move(double a, bool gaussian, FreeMove *move) {
    static const double node[2][3] = {{0, 0.5384693101056831, 0.9061798459386640},
                                      {0, 0.7826711399286465, 1.6494724065761532}};
    static const double weight[2][3] = {
        {0.2844444444444444, 2 * 0.23931433524968324, 2 * 0.11846344252809454},
        {0.5333333333333333, 2 * 0.22207592200561274, 2 * 0.011257411327720701}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double y1 = a * node[gaussian][i], y2 = a * node[gaussian][j];
            const double share = weight[gaussian][i] * weight[gaussian][j];
            const double s = y1 * y1 + y2 * y2, length = sqrt(1 + s);
            move->squares.rotational += share * s / (length * (1 + length)); // 1 - 1/length
            move->second += share * 1.5 * s / (1 + s);
        }
    }
}

FreeMove amplitude_free_move(const Amplitude *amplitude, int dimension,
                             const ChainSettings *settings) {
    const double along = amplitude->parallel, across = amplitude->perpendicular;
    FreeMove move = {.squares = {.parallel = along * along / 3,
                                 .perpendicular = (dimension - 1) * across * across / 3}};
    if (is_mixed(settings))
        mixed_move(amplitude->rotation, &move);
    else
        tangent_move(amplitude->rotation, settings->gaussian, &move);
    return move;
}
