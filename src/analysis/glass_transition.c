// SPDX-License-Identifier: GPL-3.0-or-later
// What a sweep over packing fractions says of the glass transition:
//   relaxation times, tau ~ (phi_c - phi)^-gamma, both free or gamma given, and what phi_c becomes
//   if the lowest packing fractions are left out; only where the plateau is above 1/e, since below
//   it the function has fallen to 1/e before its final decay begins;
//   scaled functions: how far they are from one master curve;
//   plateaus of the states that did not relax, f = f_c + A sqrt(phi/phi_c - 1), phi_c from the
//   relaxation times at the smallest wave number, where they are longest.
// (Weysser, thesis, ch. 3.) The laws are fitted to ln tau with equal weights: what is left is how
// far they hold, not noise.
#include "analysis/sweep.h"
#include "numerics/fit.h"

#include <gsl/gsl_statistics_double.h>

#include <math.h>
#include <string.h>

enum { EXPONENTS = 21, FREE_LEAST = 4, FIXED_LEAST = 3 };
static const double FIRST_EXPONENT = 2, EXPONENT_STEP = 0.1;
static const double HIGH = 1.2;                     // of 1/e, for a plateau
static const double NEAREST = 1e-5, FARTHEST = 0.5; // phi_c less the largest phi
enum { PLACES = 100 };

// The logarithms of relaxation times that are there.
typedef struct Times {
    size_t count;
    double phi[STATES_MOST], log_tau[STATES_MOST];
} Times;

static Times times_of(const States *states, const double *tau, size_t first) {
    Times times = {.count = 0};
    for (size_t i = first; i < states->count; i++) {
        if (!(tau[i] > 0)) continue;
        times.phi[times.count] = states->at[i];
        times.log_tau[times.count++] = log(tau[i]);
    }
    return times;
}

typedef struct PowerLaw {
    double packing_fraction, exponent;
    double misfit; // root of the mean square of ln tau about the law
} PowerLaw;

static const PowerLaw NO_LAW = {(double)NAN, (double)NAN, (double)NAN};

// The best amplitude for this phi_c, and exponent unless that is given (not NaN).
static PowerLaw law_at(const Times *times, double packing_fraction, double exponent) {
    const size_t n = times->count;
    double nearness[STATES_MOST], left[STATES_MOST];
    for (size_t i = 0; i < n; i++) nearness[i] = -log(packing_fraction - times->phi[i]);
    if (isnan(exponent)) {
        const Line line = fit_line(nearness, times->log_tau, NULL, n);
        return (PowerLaw){packing_fraction, line.slope, sqrt(line.misfit / (double)n)};
    }
    for (size_t i = 0; i < n; i++) left[i] = times->log_tau[i] - exponent * nearness[i];
    return (PowerLaw){packing_fraction, exponent, sqrt(gsl_stats_tss(left, 1, n) / (double)n)};
}

typedef struct Approach {
    const Times *times;
    double exponent; // NaN: free
    double top;      // the largest packing fraction
} Approach;

static double misfit(double log_distance, const void *of) {
    const Approach *a = of;
    return law_at(a->times, a->top + exp(log_distance), a->exponent).misfit;
}

// None if the misfit falls up to an end of what phi_c may be: there is no sign of a transition.
static PowerLaw fit(const Times *times, double exponent) {
    double log_distance;
    if (times->count < (isnan(exponent) ? FREE_LEAST : FIXED_LEAST)) return NO_LAW;
    const Approach approach = {times, exponent, gsl_stats_max(times->phi, 1, times->count)};
    if (!fit_least(misfit, &approach, log(NEAREST), log(FARTHEST), PLACES, &log_distance))
        return NO_LAW;
    return law_at(times, approach.top + exp(log_distance), exponent);
}

static double exponent_of(size_t index) {
    return FIRST_EXPONENT + EXPONENT_STEP * (double)index;
}

// Then phi_c from each state on with gamma free, [state], and given, [state][exponent].
enum { EXPONENT, MISFIT, SCAN };

// Of the states that relax, by what stands beside: where none is known, nothing speaks against it.
static bool plateau_is_high(const States *states) {
    double most = -INFINITY;
    for (size_t i = 0; i < states->count; i++) {
        if (states->mean[i] > 0) most = fmax(most, states->beside[i]);
    }
    return isinf(most) || most > HIGH / exp(1);
}

static void power_law(const States *states, double *out) {
    const bool high = plateau_is_high(states);
    double *scan = out + SCAN, *given = scan + states->count;
    for (size_t i = 0; i < states->count; i++) {
        const Times times = times_of(states, states->mean, high ? i : states->count);
        const PowerLaw free = fit(&times, NAN);
        if (i == 0) out[EXPONENT] = free.exponent;
        if (i == 0) out[MISFIT] = free.misfit;
        scan[i] = free.packing_fraction;
        for (size_t e = 0; e < EXPONENTS; e++)
            given[i * EXPONENTS + e] = fit(&times, exponent_of(e)).packing_fraction;
    }
}

// Spread of the means about their own mean.
static void spread(const States *states, double *out) {
    double sum = 0, squares = 0, n = 0;
    for (size_t i = 0; i < states->count; i++) {
        if (isnan(states->mean[i])) continue;
        sum += states->mean[i];
        n++;
    }
    for (size_t i = 0; i < states->count; i++) {
        const double off = states->mean[i] - sum / n;
        if (!isnan(off)) squares += off * off;
    }
    *out = n < 2 ? (double)NAN : sqrt(squares / n);
}

enum { CRITICAL_PLATEAU, PLATEAU_AMPLITUDE, PLATEAU_NUMBERS };

// By least squares of the plateaus (mean) of states without relaxation times (beside) above phi_c.
static void square_root_law(const States *states, double *out) {
    const Times times = times_of(states, states->beside, 0);
    const double critical = fit(&times, NAN).packing_fraction;
    double root[STATES_MOST], plateau[STATES_MOST];
    size_t count = 0;
    for (size_t i = 0; i < states->count; i++) {
        const double above = states->at[i] / critical - 1, f = states->mean[i];
        if (!(above > 0) || isnan(f) || states->beside[i] > 0) continue;
        root[count] = sqrt(above);
        plateau[count++] = f;
    }
    const Line none = {(double)NAN, (double)NAN, (double)NAN};
    const Line line = count < FIXED_LEAST ? none : fit_line(root, plateau, NULL, count);
    out[CRITICAL_PLATEAU] = line.intercept;
    out[PLATEAU_AMPLITUDE] = line.slope;
}

static const char RELAXATION_TIME[] = "_relaxation_time", SCALED[] = "_scaled",
                  PLATEAU[] = "_plateau";

// Another quantity of the same observable, if it is there for the same states.
static const ResultSeries *beside(const Results *results, const Sweep *sweep, const char *ending,
                                  const char *other) {
    char name[RESULT_NAME];
    sweep_name(name, sweep->series.observable, ending, other + 1);
    const ResultSeries *found = results_find_series(results, sweep->series.stage, name);
    return found && found->size == sweep->series.size ? found : NULL;
}

Status derive_power_law(Results *results, Sweep *sweep) {
    double exponents[EXPONENTS];
    for (size_t e = 0; e < EXPONENTS; e++) exponents[e] = exponent_of(e);
    const ResultAxis exponent = {
        .name = "exponent", .unit = "", .count = EXPONENTS, .values = exponents};
    const ResultAxis from = sweep->series.axis[sweep->axis];
    const size_t given = SCAN + from.count;
    const Part parts[] = {
        {.name = "critical_packing_fraction", .first = SCAN},
        {.name = "critical_exponent", .first = EXPONENT},
        {.name = "critical_misfit", .first = MISFIT},
        {.name = "critical_packing_fraction_at", .first = given, .axes = 1, .axis = {exponent}},
        {.name = "critical_scan", .first = SCAN, .axes = 1, .axis = {from}},
        {.name = "critical_scan_at", .first = given, .axes = 2, .axis = {from, exponent}},
    };
    sweep->beside = beside(results, sweep, RELAXATION_TIME, PLATEAU);
    sweep->numbers = given + from.count * EXPONENTS;
    return sweep_put(results, sweep, power_law, RELAXATION_TIME, parts,
                     sizeof parts / sizeof *parts);
}

Status derive_master_curve(Results *results, Sweep *sweep) {
    static const Part part = {.name = "scaled_spread"};
    sweep->numbers = 1;
    return sweep_put(results, sweep, spread, SCALED, &part, 1);
}

Status derive_square_root_law(Results *results, Sweep *sweep) {
    static const Part parts[] = {
        {.name = "plateau_critical", .first = CRITICAL_PLATEAU},
        {.name = "plateau_amplitude", .first = PLATEAU_AMPLITUDE},
    };
    sweep->beside = beside(results, sweep, PLATEAU, RELAXATION_TIME);
    if (!sweep->beside) return OK;
    const ResultAxis *last = &sweep->series.axis[sweep->series.axes - 1];
    if (strcmp(last->name, "wave_number") == 0) sweep->beside_waves = last->count;
    sweep->numbers = PLATEAU_NUMBERS;
    return sweep_put(results, sweep, square_root_law, PLATEAU, parts, PLATEAU_NUMBERS);
}
