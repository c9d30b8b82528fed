// SPDX-License-Identifier: GPL-3.0-or-later
// How long a body remembers where it pointed: <P1(u(t).u(0))> and <P2(u(t).u(0))> over particles
// and time origins (lags.h says which), P1(x) = x, P2(x) = (3 x^2 - 1)/2. A free body has
// exp(-2 D_rot t) and exp(-6 D_rot t); in a nematic P2 falls to S^2. Bodies whose two ends are
// alike have a marked one here, so that P1 tells how they turn over.
#include "observables/axis_lags.h"

#include <string.h>

static const Option rows[] = {LAG_OPTIONS(LagSettingsAlone, lags)};

// Body axes [3][axes].
static void copy(const State *state, const Oriented *oriented, size_t axes, double *frame) {
    (void)axes;
    for (int a = 0; a < 3; a++) {
        for (size_t s = 0; s < oriented->count; s++) {
            const size_t begin = oriented->begin[s], count = oriented->end[s] - begin;
            memcpy(frame, state->orientation[a] + begin, count * sizeof *frame);
            frame += count;
        }
    }
}

enum { COSINE, SQUARE, COSINES };

// Four partial sums in a fixed order: a vector unit can run them, and every compiler agrees.
static void add(const double *then, const double *now, size_t axes, size_t begin, size_t end,
                double sums[]) {
    enum { LANES = 4 };
    double cosines[LANES] = {0}, squares[LANES] = {0};
    for (size_t i = begin; i < end; i++) {
        const double cosine = now[i] * then[i] + now[axes + i] * then[axes + i] +
                              now[2 * axes + i] * then[2 * axes + i];
        cosines[i % LANES] += cosine;
        squares[i % LANES] += cosine * cosine;
    }
    sums[COSINE] += (cosines[0] + cosines[1]) + (cosines[2] + cosines[3]);
    sums[SQUARE] += (squares[0] + squares[1]) + (squares[2] + squares[3]);
}

static const char *const polynomials[] = {"P1", "P2"};

static void finish(const double means[], double values[]) {
    values[0] = means[COSINE];
    values[1] = (3 * means[SQUARE] - 1) / 2;
}

static const AxisCorrelation what = {
    .kind = &observable_orientation_correlation,
    .tag = 0x4f5249454e303031, // "ORIEN001"
    .per_axis = 3,
    .sums = COSINES,
    .copy = copy,
    .add = add,
    .finish = finish,
    .rows_name = "polynomial",
    .row_names = polynomials,
    .rows = sizeof polynomials / sizeof *polynomials,
    .unit = "",
};

AXIS_CORRELATION(orientation_correlation,
                 "Orientational correlation functions P1 and P2 of particles with a body axis, at "
                 "logarithmic lags.")
