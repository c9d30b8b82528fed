// SPDX-License-Identifier: GPL-3.0-or-later
// Pade approximant of a power series.
#pragma once

enum { PADE_MOST = 16 };

// [m/n] of sum series[k] x^k, k = 0..m+n, at x; m + n below PADE_MOST.
double pade(const double *series, int m, int n, double x);
