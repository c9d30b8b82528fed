// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares.
#include "numerics/fit.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multifit.h>

#include <float.h>
#include <math.h>

Line fit_line(const double *x, const double *y, const double *weights, size_t count) {
    Line line;
    double cov00, cov01, cov11;
    if (weights)
        gsl_fit_wlinear(x, 1, weights, 1, y, 1, count, &line.intercept, &line.slope, &cov00, &cov01,
                        &cov11, &line.misfit);
    else
        gsl_fit_linear(x, 1, y, 1, count, &line.intercept, &line.slope, &cov00, &cov01, &cov11,
                       &line.misfit);
    return line;
}

typedef struct Search {
    FitMisfit *misfit;
    const void *of;
} Search;

// What is not a number must not end the search: GSL would end the program.
static double misfit_at(double at, void *search) {
    const Search *s = search;
    const double misfit = s->misfit(at, s->of);
    return isfinite(misfit) ? misfit : DBL_MAX;
}

static double refine(gsl_function *f, double from, double middle, double to) {
    static const double NEAR = 1e-10;
    enum { STEPS_MOST = 100 };
    gsl_min_fminimizer *brent = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    gsl_min_fminimizer_set(brent, f, middle, from, to);
    for (int k = 0; k < STEPS_MOST; k++) {
        if (gsl_min_fminimizer_iterate(brent) != GSL_SUCCESS) break;
        from = gsl_min_fminimizer_x_lower(brent);
        to = gsl_min_fminimizer_x_upper(brent);
        if (gsl_min_test_interval(from, to, NEAR, NEAR) == GSL_SUCCESS) break;
    }
    middle = gsl_min_fminimizer_x_minimum(brent);
    gsl_min_fminimizer_free(brent);
    return middle;
}

bool fit_least(FitMisfit *misfit, const void *of, double from, double to, size_t places,
               double *at) {
    Search search = {misfit, of};
    gsl_function f = {misfit_at, &search};
    const double step = (to - from) / (double)(places - 1);
    double least = DBL_MAX;
    size_t best = 0;
    for (size_t k = 0; k < places; k++) {
        const double here = misfit_at(from + (double)k * step, &search);
        if (!(here < least)) continue;
        least = here;
        best = k;
    }
    if (best == 0 || best == places - 1) return false;
    *at = from + (double)best * step;
    // Brent's method wants the middle below both ends: a neighbour may be as low.
    if (least < misfit_at(*at - step, &search) && least < misfit_at(*at + step, &search))
        *at = refine(&f, *at - step, *at, *at + step);
    return true;
}

typedef struct Fit {
    gsl_matrix *basis;
    gsl_vector *data, *coefficients;
    gsl_matrix *covariance;
    gsl_multifit_linear_workspace *work;
} Fit;

static Fit fit_new(size_t bins, size_t coefficients) {
    return (Fit){.basis = gsl_matrix_alloc(bins, coefficients),
                 .data = gsl_vector_alloc(bins),
                 .coefficients = gsl_vector_alloc(coefficients),
                 .covariance = gsl_matrix_alloc(coefficients, coefficients),
                 .work = gsl_multifit_linear_alloc(bins, coefficients)};
}

static void fit_free(Fit *fit) {
    gsl_matrix_free(fit->basis);
    gsl_vector_free(fit->data);
    gsl_vector_free(fit->coefficients);
    gsl_matrix_free(fit->covariance);
    gsl_multifit_linear_free(fit->work);
}

// Average of u^power over bin k of unit intervals cut into `bins`; u = 0 at the edge.
static double power_average(size_t k, size_t bins, int power) {
    const double low = (double)k / (double)bins, high = (double)(k + 1) / (double)bins;
    return (pow(high, power + 1) - pow(low, power + 1)) / ((power + 1) * (high - low));
}

Status fit_value_at_edge(const double *y, size_t bins, int degree, double *value) {
    const size_t coefficients = (size_t)degree + 1;
    if (bins < coefficients) {
        return status_fail(BAD_DATA, "%zu bins cannot fix the %zu coefficients of a polynomial",
                           bins, coefficients);
    }
    Fit fit = fit_new(bins, coefficients);
    for (size_t k = 0; k < bins; k++) {
        gsl_vector_set(fit.data, k, y[k]);
        for (int p = 0; p <= degree; p++) {
            gsl_matrix_set(fit.basis, k, (size_t)p, power_average(k, bins, p));
        }
    }
    double chi2;
    gsl_multifit_linear(fit.basis, fit.data, fit.coefficients, fit.covariance, &chi2, fit.work);
    *value = gsl_vector_get(fit.coefficients, 0);
    fit_free(&fit);
    return OK;
}

double fit_parabola_top(const double *x, const double *y, size_t count, double *place,
                        double *height) {
    enum { COEFFICIENTS = 3 };
    const double middle = (x[0] + x[count - 1]) / 2;
    Fit fit = fit_new(count, COEFFICIENTS);
    for (size_t k = 0; k < count; k++) {
        gsl_vector_set(fit.data, k, y[k]);
        for (int p = 0; p < COEFFICIENTS; p++) {
            gsl_matrix_set(fit.basis, k, (size_t)p, pow(x[k] - middle, p));
        }
    }
    double chi2;
    gsl_multifit_linear(fit.basis, fit.data, fit.coefficients, fit.covariance, &chi2, fit.work);
    const double level = gsl_vector_get(fit.coefficients, 0);
    const double slope = gsl_vector_get(fit.coefficients, 1);
    const double bend = gsl_vector_get(fit.coefficients, 2);
    const double from_middle = -slope / (2 * bend);
    *place = middle + from_middle;
    *height = level + slope * from_middle / 2;
    fit_free(&fit);
    return bend;
}
