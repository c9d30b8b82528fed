// SPDX-License-Identifier: GPL-3.0-or-later
// The yield stress that a flow curve extrapolates to, by the law of Herschel and Bulkley (1926),
//   sigma = sigma_y + A rate^n,
// with n free or given: sigma_y and A are those of a straight line in rate^n through the stresses,
// weighted by their errors, and n is where their misfit is least. A liquid's yield stress comes out
// as 0 within its error, with n near 1, where rates are slow enough to show its viscosity.
#include "analysis/sweep.h"
#include "numerics/fit.h"

#include <math.h>
#include <string.h>

enum { EXPONENTS = 10, FREE_LEAST = 4, FIXED_LEAST = 3, PLACES = 60 };
static const double EXPONENT_STEP = 0.1;         // the given ones: 0.1 to 1
static const double SMALLEST = 0.05, MOST = 1.5; // the free one

typedef struct HerschelBulkley {
    double yield, amplitude, exponent;
} HerschelBulkley;

static const HerschelBulkley NO_LAW = {(double)NAN, (double)NAN, (double)NAN};

// The stresses that are there. Of a single replica errors are not known: all weigh the same.
typedef struct Stresses {
    size_t count;
    double rate[STATES_MOST], stress[STATES_MOST], weight[STATES_MOST];
} Stresses;

static Stresses stresses_of(const States *states) {
    Stresses s = {.count = 0};
    for (size_t i = 0; i < states->count; i++) {
        const double error = states->error[i];
        if (!(states->at[i] > 0) || isnan(states->mean[i])) continue;
        s.rate[s.count] = states->at[i];
        s.stress[s.count] = states->mean[i];
        s.weight[s.count++] = error > 0 ? 1 / (error * error) : 1;
    }
    return s;
}

static Line line_at(double exponent, const Stresses *stresses) {
    double power[STATES_MOST];
    for (size_t i = 0; i < stresses->count; i++) power[i] = pow(stresses->rate[i], exponent);
    return fit_line(power, stresses->stress, stresses->weight, stresses->count);
}

static double misfit(double exponent, const void *stresses) {
    return line_at(exponent, stresses).misfit;
}

// None if the misfit falls up to an end of what the exponent may be.
static HerschelBulkley free_law(const Stresses *stresses) {
    double exponent;
    if (stresses->count < FREE_LEAST ||
        !fit_least(misfit, stresses, SMALLEST, MOST, PLACES, &exponent))
        return NO_LAW;
    const Line line = line_at(exponent, stresses);
    return (HerschelBulkley){line.intercept, line.slope, exponent};
}

enum { YIELD, AMPLITUDE, EXPONENT, GIVEN, NUMBERS = GIVEN + EXPONENTS };

static double exponent_of(size_t index) {
    return EXPONENT_STEP * (double)(index + 1);
}

static void herschel_bulkley(const States *states, double *out) {
    const Stresses stresses = stresses_of(states);
    const HerschelBulkley free = free_law(&stresses);
    out[YIELD] = free.yield;
    out[AMPLITUDE] = free.amplitude;
    out[EXPONENT] = free.exponent;
    const bool enough = stresses.count >= FIXED_LEAST;
    for (size_t e = 0; e < EXPONENTS; e++)
        out[GIVEN + e] = enough ? line_at(exponent_of(e), &stresses).intercept : (double)NAN;
}

// Whether the rates along the axis are those of the stage, and not of another that is swept: its
// viscosity is the stress over its own.
static bool is_of_its_rates(const Sweep *sweep) {
    const ResultSeries *stress = &sweep->series;
    const ResultSeries *viscosity =
        results_find_series(sweep->results, stress->stage, "shear_viscosity");
    if (!viscosity || viscosity->size != stress->size) return false;
    const ResultAxis *axis = &stress->axis[sweep->axis];
    for (size_t e = 0; e < stress->size; e++) {
        const double rate = axis->values[e / sweep->inner % axis->count];
        const double off = viscosity->values[e] * rate - stress->values[e];
        if (fabs(off) > 1e-9 * fabs(stress->values[e])) return false;
    }
    return true;
}

Status derive_flow_curve(Results *results, Sweep *sweep) {
    if (!is_of_its_rates(sweep)) return OK;
    double exponents[EXPONENTS];
    for (size_t e = 0; e < EXPONENTS; e++) exponents[e] = exponent_of(e);
    char unit[RESULT_NAME];
    strcpy(unit, sweep->series.unit);
    const Part parts[] = {
        {.name = "yield_stress", .first = YIELD, .unit = unit},
        {.name = "flow_curve_amplitude", .first = AMPLITUDE, .unit = unit},
        {.name = "flow_curve_exponent", .first = EXPONENT},
        {.name = "yield_stress_at",
         .first = GIVEN,
         .axes = 1,
         .axis = {{.name = "exponent", .unit = "", .count = EXPONENTS, .values = exponents}},
         .unit = unit},
    };
    sweep->numbers = NUMBERS;
    return sweep_put(results, sweep, herschel_bulkley, "shear_stress", parts,
                     sizeof parts / sizeof *parts);
}
