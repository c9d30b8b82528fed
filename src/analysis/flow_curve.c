// SPDX-License-Identifier: GPL-3.0-or-later
// The yield stress that a flow curve extrapolates to, by the law of Herschel and Bulkley (1926),
//   sigma = sigma_y + A rate^n,
// with n free or given: sigma_y and A are those of a straight line in rate^n through the stresses,
// weighted by their errors, and n is where their misfit is least. A liquid's yield stress comes out
// as 0 within its error, with n near 1, where rates are slow enough to show its viscosity.
#include "analysis/sweep.h"

#include <math.h>
#include <string.h>

enum { EXPONENTS = 10, FREE_LEAST = 4, FIXED_LEAST = 3, GRID = 60, GOLDEN_STEPS = 60 };
static const double EXPONENT_STEP = 0.1;         // the given ones: 0.1 to 1
static const double SMALLEST = 0.05, MOST = 1.5; // the free one

typedef struct HerschelBulkley {
    double yield, amplitude, exponent;
    double misfit; // sum of squares over those of the errors
} HerschelBulkley;

static const HerschelBulkley NO_LAW = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};

// Of a single replica errors are not known: all states weigh the same.
static double weight_of(const States *states, size_t i) {
    if (!(states->at[i] > 0) || isnan(states->mean[i])) return 0;
    return states->error[i] > 0 ? 1 / (states->error[i] * states->error[i]) : 1;
}

static size_t states_there(const States *states) {
    size_t count = 0;
    for (size_t i = 0; i < states->count; i++) count += weight_of(states, i) > 0;
    return count;
}

static HerschelBulkley law_at(const States *states, double exponent) {
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < states->count; i++) {
        const double weight = weight_of(states, i);
        if (!(weight > 0)) continue;
        const double u = pow(states->at[i], exponent), v = states->mean[i];
        w += weight;
        x += weight * u;
        y += weight * v;
        xx += weight * u * u;
        xy += weight * u * v;
        yy += weight * v * v;
    }
    const double determinant = w * xx - x * x;
    const double yield = (xx * y - x * xy) / determinant;
    const double amplitude = (w * xy - x * y) / determinant;
    return (HerschelBulkley){yield, amplitude, exponent, yy - yield * y - amplitude * xy};
}

// Golden section between two exponents around the least misfit.
static HerschelBulkley refine(const States *states, double from, double to) {
    static const double GOLDEN = 0.6180339887498949;
    for (int k = 0; k < GOLDEN_STEPS; k++) {
        const double a = to - GOLDEN * (to - from), b = from + GOLDEN * (to - from);
        if (law_at(states, a).misfit < law_at(states, b).misfit)
            to = b;
        else
            from = a;
    }
    return law_at(states, (from + to) / 2);
}

// None if the misfit falls up to an end of what the exponent may be.
static HerschelBulkley free_law(const States *states) {
    if (states_there(states) < FREE_LEAST) return NO_LAW;
    const double step = (MOST - SMALLEST) / (GRID - 1);
    int best = 0;
    double least = INFINITY;
    for (int k = 0; k < GRID; k++) {
        const double misfit = law_at(states, SMALLEST + k * step).misfit;
        if (!(misfit < least)) continue;
        least = misfit;
        best = k;
    }
    if (best == 0 || best == GRID - 1) return NO_LAW;
    return refine(states, SMALLEST + (best - 1) * step, SMALLEST + (best + 1) * step);
}

enum { YIELD, AMPLITUDE, EXPONENT, GIVEN, NUMBERS = GIVEN + EXPONENTS };

static double exponent_of(size_t index) {
    return EXPONENT_STEP * (double)(index + 1);
}

static void herschel_bulkley(const States *states, double *out) {
    const HerschelBulkley free = free_law(states);
    out[YIELD] = free.yield;
    out[AMPLITUDE] = free.amplitude;
    out[EXPONENT] = free.exponent;
    const bool enough = states_there(states) >= FIXED_LEAST;
    for (size_t e = 0; e < EXPONENTS; e++)
        out[GIVEN + e] = enough ? law_at(states, exponent_of(e)).yield : (double)NAN;
}

Status derive_flow_curve(Results *results, Sweep *sweep) {
    double exponents[EXPONENTS];
    for (size_t e = 0; e < EXPONENTS; e++) exponents[e] = exponent_of(e);
    char unit[RESULT_NAME];
    strcpy(unit, sweep->series.unit);
    const Part parts[] = {
        {.name = "yield_stress",
         .about = "sigma_y of sigma = sigma_y + A rate^n, n free",
         .first = YIELD,
         .unit = unit},
        {.name = "flow_curve_amplitude",
         .about =
             "A of sigma = sigma_y + A rate^n, in the unit of the stress at a rate of 1 D0/d^2",
         .first = AMPLITUDE,
         .unit = unit},
        {.name = "flow_curve_exponent",
         .about = "n of sigma = sigma_y + A rate^n",
         .first = EXPONENT},
        {.name = "yield_stress_at",
         .about = "sigma_y of sigma = sigma_y + A rate^n, n given",
         .first = GIVEN,
         .axes = 1,
         .axis = {{.name = "exponent", .unit = "", .count = EXPONENTS, .values = exponents}},
         .unit = unit},
    };
    sweep->numbers = NUMBERS;
    return sweep_put(results, sweep, herschel_bulkley, "shear_stress", parts,
                     sizeof parts / sizeof *parts);
}
