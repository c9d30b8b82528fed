// SPDX-License-Identifier: GPL-3.0-or-later
// The slope of a straight line that a curve over lags tends to, and where it begins.
//
// The fit is weighted by 1/t^2 (errors grow with t) and ends at the last lag. To see where the
// slope stops changing, stretches of lags that end there are cut into halves (in log t): the
// earliest stretch is taken whose halves have slopes that agree within AGREEMENT standard errors of
// their difference over replicas. Its later half is the window; its earlier half is the proof that
// the window is long after the change. Where no stretch is like that, or with one replica, the
// window is the last LAST_STRETCH in time.
#pragma once

#include "results/results.h"

enum { CURVE_LAGS_LEAST = 3 }; // in each half of a window

// One curve of a series whose last axis is time, up to the last lag that all replicas saw: a stage
// may end before its limit, in each replica elsewhere.
typedef struct Curve {
    const Results *results;
    const ResultSeries *series;
    const double *times;
    size_t stride, row; // values[replica][row * stride + lag]
    size_t lags;
    double *weights; // [lags], 1/t^2
} Curve;

// `weights` are made by the first and freed by the owner of the curve.
Status curve_weights(double **weights, const ResultAxis *time);
Curve curve_in(const Results *results, const ResultSeries *series, size_t row, double *weights);

const double *curve_of(const Curve *curve, size_t replica); // [lags]
double curve_mean(const Curve *curve, size_t lag);          // over replicas
double curve_slope(const Curve *curve, size_t replica, size_t begin, size_t end);

// Where the window begins; `settled` if the slope is seen to have stopped changing before.
size_t curve_window(const Curve *curve, bool *settled);
