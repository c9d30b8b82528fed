// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Legendre quadrature, thin over GSL.
#include "numerics/quadrature.h"

#include <gsl/gsl_integration.h>

void quadrature_legendre(size_t count, double from, double to, double *points, double *weights) {
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(count);
    for (size_t i = 0; i < count; i++)
        gsl_integration_glfixed_point(from, to, i, &points[i], &weights[i], table);
    gsl_integration_glfixed_table_free(table);
}
