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

#include <math.h>
#include <string.h>

enum { EXPONENTS = 21, FREE_LEAST = 4, FIXED_LEAST = 3 };
static const double FIRST_EXPONENT = 2, EXPONENT_STEP = 0.1;
static const double HIGH = 1.2;                     // of 1/e, for a plateau
static const double NEAREST = 1e-5, FARTHEST = 0.5; // phi_c less the largest phi
enum { GRID = 100, GOLDEN_STEPS = 60 };

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
    const double n = (double)times->count;
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < times->count; i++) {
        const double u = -log(packing_fraction - times->phi[i]), v = times->log_tau[i];
        x += u / n;
        y += v / n;
        xx += u * u / n;
        xy += u * v / n;
        yy += v * v / n;
    }
    const double gamma = isnan(exponent) ? (xy - x * y) / (xx - x * x) : exponent;
    const double square = (yy - y * y) - 2 * gamma * (xy - x * y) + gamma * gamma * (xx - x * x);
    return (PowerLaw){packing_fraction, gamma, sqrt(fmax(0, square))};
}

static double largest(const double *values, size_t count) {
    double most = -INFINITY;
    for (size_t i = 0; i < count; i++) most = fmax(most, values[i]);
    return most;
}

// Golden section in ln(phi_c - phi_max) between two places around the least misfit.
static PowerLaw refine(const Times *times, double exponent, double top, double from, double to) {
    static const double GOLDEN = 0.6180339887498949;
    double a = to - GOLDEN * (to - from), b = from + GOLDEN * (to - from);
    for (int k = 0; k < GOLDEN_STEPS; k++) {
        const double at_a = law_at(times, top + exp(a), exponent).misfit,
                     at_b = law_at(times, top + exp(b), exponent).misfit;
        if (at_a < at_b) {
            to = b;
            b = a;
            a = to - GOLDEN * (to - from);
        } else {
            from = a;
            a = b;
            b = from + GOLDEN * (to - from);
        }
    }
    return law_at(times, top + exp((from + to) / 2), exponent);
}

// None if the misfit falls up to an end of what phi_c may be: there is no sign of a transition.
static PowerLaw fit(const Times *times, double exponent) {
    if (times->count < (isnan(exponent) ? FREE_LEAST : FIXED_LEAST)) return NO_LAW;
    const double top = largest(times->phi, times->count);
    const double step = log(FARTHEST / NEAREST) / (GRID - 1);
    double least = INFINITY;
    size_t best = 0;
    for (size_t k = 0; k < GRID; k++) {
        const double place = top + NEAREST * exp((double)k * step);
        const double misfit = law_at(times, place, exponent).misfit;
        if (!(misfit < least)) continue;
        least = misfit;
        best = k;
    }
    if (best == 0 || best == GRID - 1) return NO_LAW;
    const double at = log(NEAREST) + (double)best * step;
    return refine(times, exponent, top, at - step, at + step);
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
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < states->count; i++) {
        const double above = states->at[i] / critical - 1, f = states->mean[i];
        if (!(above > 0) || isnan(f) || states->beside[i] > 0) continue;
        n++;
        x += sqrt(above);
        y += f;
        xx += above;
        xy += sqrt(above) * f;
    }
    const double determinant = n * xx - x * x;
    const bool there = n >= FIXED_LEAST && determinant > 0;
    out[CRITICAL_PLATEAU] = there ? (xx * y - x * xy) / determinant : (double)NAN;
    out[PLATEAU_AMPLITUDE] = there ? (n * xy - x * y) / determinant : (double)NAN;
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
        {.name = "critical_packing_fraction",
         .about = "phi_c of tau ~ (phi_c - phi)^-gamma, gamma free",
         .first = SCAN},
        {.name = "critical_exponent",
         .about = "gamma of tau ~ (phi_c - phi)^-gamma",
         .first = EXPONENT},
        {.name = "critical_misfit",
         .about = "Root of the mean square of ln tau about its power law",
         .first = MISFIT},
        {.name = "critical_packing_fraction_at",
         .about = "phi_c of tau ~ (phi_c - phi)^-gamma, gamma given",
         .first = given,
         .axes = 1,
         .axis = {exponent}},
        {.name = "critical_scan",
         .about = "phi_c of tau ~ (phi_c - phi)^-gamma from each packing fraction on, gamma free",
         .first = SCAN,
         .axes = 1,
         .axis = {from}},
        {.name = "critical_scan_at",
         .about = "phi_c of tau ~ (phi_c - phi)^-gamma from each packing fraction on, gamma given",
         .first = given,
         .axes = 2,
         .axis = {from, exponent}},
    };
    sweep->beside = beside(results, sweep, RELAXATION_TIME, PLATEAU);
    sweep->numbers = given + from.count * EXPONENTS;
    return sweep_put(results, sweep, power_law, RELAXATION_TIME, parts,
                     sizeof parts / sizeof *parts);
}

Status derive_master_curve(Results *results, Sweep *sweep) {
    static const Part part = {
        .name = "scaled_spread",
        .about = "How far the functions against t/tau differ from packing fraction to packing "
                 "fraction: root of the mean square about their mean"};
    sweep->numbers = 1;
    return sweep_put(results, sweep, spread, SCALED, &part, 1);
}

Status derive_square_root_law(Results *results, Sweep *sweep) {
    static const Part parts[] = {
        {.name = "plateau_critical",
         .about = "f_c of the plateaus f_c + A sqrt(phi/phi_c - 1) of states that did not relax",
         .first = CRITICAL_PLATEAU},
        {.name = "plateau_amplitude",
         .about = "A of the plateaus f_c + A sqrt(phi/phi_c - 1) of states that did not relax",
         .first = PLATEAU_AMPLITUDE},
    };
    sweep->beside = beside(results, sweep, PLATEAU, RELAXATION_TIME);
    if (!sweep->beside) return OK;
    const ResultAxis *last = &sweep->series.axis[sweep->series.axes - 1];
    if (strcmp(last->name, "wave_number") == 0) sweep->beside_waves = last->count;
    sweep->numbers = PLATEAU_NUMBERS;
    return sweep_put(results, sweep, square_root_law, PLATEAU, parts, PLATEAU_NUMBERS);
}
