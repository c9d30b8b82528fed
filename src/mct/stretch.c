// SPDX-License-Identifier: GPL-3.0-or-later
// c(q) between the wave numbers of the grid is a cubic spline, good to 1e-5 where the grid resolves
// the diameter D; beyond the cutoff K it is what the jump of c(r) at contact leaves, (A cos D(q -
// K)
// + B sin D(q - K))/q^((d + 1)/2), with the value and the slope that it has at K.
#include "mct/stretch.h"

#include "base/memory.h"

#include <gsl/gsl_spline.h>

#include <math.h>

struct Stretch {
    const Grid *grid;
    double density;
    gsl_spline *spline;
    double diameter, cutoff;
    double end, end_slope; // A and B in units of cutoff^((d + 1)/2)
    double *direct;        // [stride]: what was asked for last
};

static double power(const Stretch *stretch) {
    return (stretch->grid->dimension + 1) / 2.0;
}

static void set_end(Stretch *stretch) {
    const double cutoff = stretch->grid->wave_number[stretch->grid->count - 1];
    stretch->cutoff = cutoff;
    stretch->end = gsl_spline_eval(stretch->spline, cutoff, NULL);
    stretch->end_slope = (gsl_spline_eval_deriv(stretch->spline, cutoff, NULL) +
                          power(stretch) / cutoff * stretch->end) /
                         stretch->diameter;
}

static double direct_at(const Stretch *stretch, double k) {
    if (k <= stretch->cutoff) return gsl_spline_eval(stretch->spline, k, NULL);
    const double x = stretch->diameter * (k - stretch->cutoff);
    return pow(stretch->cutoff / k, power(stretch)) *
           (stretch->end * cos(x) + stretch->end_slope * sin(x));
}

static double slope_at(const Stretch *stretch, double k) {
    if (k <= stretch->cutoff) return gsl_spline_eval_deriv(stretch->spline, k, NULL);
    const double x = stretch->diameter * (k - stretch->cutoff);
    return stretch->diameter * pow(stretch->cutoff / k, power(stretch)) *
               (stretch->end_slope * cos(x) - stretch->end * sin(x)) -
           power(stretch) / k * direct_at(stretch, k);
}

Status stretch_create(Stretch **out, const Grid *grid, const Structure *structure, size_t a,
                      size_t b) {
    const size_t pair = mixture_pair(structure->mixture.species, a, b);
    Stretch *stretch = NULL;
    *out = NULL;
    ASSERT(structure->count == grid->count);
    TRY(NEW(stretch));
    stretch->grid = grid;
    stretch->density = structure->density;
    stretch->diameter = mixture_contact(&structure->mixture, a, b);
    Status status = NEW_ARRAY(stretch->direct, grid->stride);
    stretch->spline = gsl_spline_alloc(gsl_interp_cspline, grid->count);
    if (status == OK && !stretch->spline)
        status = status_fail(NO_MEMORY, "no memory for a spline of %zu points", grid->count);
    if (status != OK) {
        stretch_free(stretch);
        return status;
    }
    gsl_spline_init(stretch->spline, grid->wave_number, structure->direct + pair * grid->count,
                    grid->count);
    set_end(stretch);
    *out = stretch;
    return OK;
}

void stretch_free(Stretch *stretch) {
    if (!stretch) return;
    if (stretch->spline) gsl_spline_free(stretch->spline);
    memory_free(stretch->direct);
    memory_free(stretch);
}

double stretch_factor(int dimension, double strain) {
    return sqrt(1 + strain * strain / dimension);
}

const double *stretch_direct(Stretch *stretch, double strain) {
    const Grid *grid = stretch->grid;
    const double factor = stretch_factor(grid->dimension, strain);
    for (size_t m = 0; m < grid->count; m++)
        stretch->direct[m] = direct_at(stretch, factor * grid->wave_number[m]);
    return stretch->direct;
}

double stretch_modulus(const Stretch *stretch, const double *correlator, double strain) {
    const Grid *grid = stretch->grid;
    const double factor = stretch_factor(grid->dimension, strain);
    const double dimension = grid->dimension, density = stretch->density;
    double sum = 0;
    for (size_t m = 0; m < grid->count; m++) {
        const double k = grid->wave_number[m], f = correlator[m];
        sum += grid->k_weight[m] * k * k / factor * slope_at(stretch, k) *
               slope_at(stretch, factor * k) * f * f;
    }
    return density * density / (2 * dimension * (dimension + 2)) * sum;
}
