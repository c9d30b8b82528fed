// SPDX-License-Identifier: GPL-3.0-or-later
// Pade approximant: the denominator 1 + q_1 x + ... + q_n x^n makes the terms m+1 ... m+n of its
// product with the series vanish; the numerator is what is left of that product.
#include "numerics/pade.h"

#include "base/status.h"

#include <gsl/gsl_linalg.h>

static void solve_denominator(const double *series, int m, int n, double *denominator) {
    double matrix[PADE_MOST * PADE_MOST], right[PADE_MOST];
    size_t pivots[PADE_MOST];
    int sign;
    for (int i = 0; i < n; i++) {
        right[i] = -series[m + 1 + i];
        for (int j = 1; j <= n; j++)
            matrix[i * n + j - 1] = m + 1 + i < j ? 0 : series[m + 1 + i - j];
    }
    gsl_matrix_view a = gsl_matrix_view_array(matrix, (size_t)n, (size_t)n);
    gsl_vector_view b = gsl_vector_view_array(right, (size_t)n);
    gsl_vector_view x = gsl_vector_view_array(denominator + 1, (size_t)n);
    gsl_permutation permutation = {.size = (size_t)n, .data = pivots};
    denominator[0] = 1;
    gsl_linalg_LU_decomp(&a.matrix, &permutation, &sign);
    gsl_linalg_LU_solve(&a.matrix, &permutation, &b.vector, &x.vector);
}

double pade(const double *series, int m, int n, double x) {
    ASSERT(m >= 0 && n >= 1 && m + n < PADE_MOST);
    double denominator[PADE_MOST];
    solve_denominator(series, m, n, denominator);
    double above = 0, below = 0;
    for (int k = m; k >= 0; k--) {
        double coefficient = 0;
        for (int j = 0; j <= k && j <= n; j++) coefficient += denominator[j] * series[k - j];
        above = above * x + coefficient;
    }
    for (int k = n; k >= 0; k--) below = below * x + denominator[k];
    return above / below;
}
