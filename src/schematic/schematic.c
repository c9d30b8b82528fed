// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the schematic model, step by step: the transition, the correlator with the stress of the
// shear that is given, the flow curve, the yield stress.
#include "schematic/schematic.h"

#include "base/memory.h"
#include "schematic/driven.h"
#include "schematic/put.h"
#include "schematic/steady.h"

#include <math.h>
#include <string.h>

enum {
    SLICE_STEPS = 2000, // points of a doubling grid in a slice
    SLICE_AGES = 16,    // of correlators of all beginnings
    STRAINS = 200,      // at which the stress of steady shear is kept
    BEGINNINGS = 4,     // whose correlators are kept where the shear varies
    HARMONICS = 5
};
static const double OVERSHOOT_LEAST = 1e-4; // of the stress: less is what the grid of times may do
static const double YIELDED = 1e-6;         // relative change of the stress in a decade of the rate
static const double LEAST_RATE = 1e-40; // where the search for a yield stress gives up, in Gamma

struct Schematic {
    const SchematicPlan *plan;
    F12 model;
    size_t step;
    double share; // of a step in slices
    Steady *steady;
    Driven *driven;
    double *time, *phi; // kept, phi [beginning][times_most]
    size_t times, times_most;
    double next_time;
    double strain[STRAINS], stress[STRAINS];
    size_t strains;
    double before_strain, before_stress; // of the last point of the grid
    double *rate, *flow;                 // the flow curve so far
    size_t rates, rates_most;
};

static bool wants(const Schematic *s, SchematicPart part) {
    return s->plan->calculate >> part & 1;
}

// ---- The transition ----------------------------------------------------------------------------

static bool wants_transition(const Schematic *s) {
    return wants(s, SCHEMATIC_TRANSITION);
}

static Status put_exponents(const Schematic *s, Results *results) {
    Exponents exponents;
    if (!f12_is_discontinuous(s->model.v2)) return OK;
    TRY(f12_exponents(&s->model, &exponents));
    TRY(put_scalar(results, "exponent_parameter", "", "Exponent parameter lambda.",
                   exponents.lambda));
    TRY(put_scalar(results, "exponent_a", "", "Critical exponent a: G -> (t/t0)^-a.", exponents.a));
    TRY(put_scalar(results, "exponent_b", "", "Von Schweidler exponent b: G -> -B (t/t_sigma)^b.",
                   exponents.b));
    TRY(put_scalar(
        results, "shear_coefficient", "",
        "c of the beta-scaling equation sigma - c (rate t)^2 + lambda G^2 = d/dt int GG.",
        f12_shear_coefficient(&s->model)));
    return put_scalar(results, "exponent_gamma", "",
                      "Exponent gamma = 1/(2 a) + 1/(2 b) of the time of the final decay.",
                      exponents.gamma);
}

static Status find_transition(Schematic *s, Results *results) {
    const F12 critical = {.v1 = f12_critical_v1(s->model.v2), .v2 = s->model.v2};
    const double plateau = f12_plateau(&s->model);
    TRY(put_scalar(results, "coupling_v1", "", "v1 of the state.", s->model.v1));
    TRY(put_scalar(results, "critical_v1", "", "v1 of the glass transition at this v2.",
                   critical.v1));
    TRY(put_scalar(results, "critical_plateau", "", "f_c, the plateau at the transition.",
                   f12_plateau(&critical)));
    TRY(put_scalar(results, "plateau", "", "What is left of the correlator at rest.", plateau));
    TRY(put_scalar(results, "is_glass", "", "1 in a glass, 0 in a fluid.", plateau > 0 ? 1 : 0));
    return put_exponents(s, results);
}

// ---- At rest and under steady shear
// --------------------------------------------------------------

static bool varies(const Schematic *s) {
    return schematic_oscillates(s->plan) || schematic_has_table(s->plan);
}

static bool wants_steady(const Schematic *s) {
    return wants(s, SCHEMATIC_CORRELATOR) && !varies(s);
}

static Status times_create(Schematic *s, size_t lines) {
    const SchematicPlan *plan = s->plan;
    const double decades = log10(plan->last_time / plan->first_time);
    s->times = 0;
    s->times_most = (size_t)(decades * (double)plan->times_per_decade) + 2;
    s->next_time = plan->first_time;
    TRY(NEW_ARRAY(s->time, s->times_most));
    return NEW_ARRAY(s->phi, lines * s->times_most);
}

// Whether this time of the grid is one to keep.
static bool keeps(Schematic *s, double time) {
    if (time < s->next_time || s->times == s->times_most) return false;
    while (s->next_time <= time) s->next_time *= pow(10, 1 / (double)s->plan->times_per_decade);
    s->time[s->times++] = time;
    return true;
}

// Strains at equal distances, between those of the grid.
static void keep_stress(Schematic *s) {
    const double strain = s->plan->shear_rate * steady_time(s->steady);
    const double stress = steady_stress(s->steady);
    while (s->strains < STRAINS && strain >= s->strain[s->strains]) {
        const double part =
            (s->strain[s->strains] - s->before_strain) / (strain - s->before_strain);
        s->stress[s->strains++] = s->before_stress + part * (stress - s->before_stress);
    }
    s->before_strain = strain;
    s->before_stress = stress;
}

static Status begin_steady(Schematic *s) {
    const SchematicPlan *plan = s->plan;
    const SteadySettings settings = {s->model, plan->shear_rate, (size_t)plan->block};
    for (size_t i = 0; i < STRAINS; i++)
        s->strain[i] = plan->last_strain * (double)(i + 1) / STRAINS;
    TRY(times_create(s, 1));
    return steady_create(&s->steady, &settings);
}

static bool steady_is_over(const Schematic *s) {
    if (s->plan->shear_rate == 0) return steady_time(s->steady) >= s->plan->last_time;
    return steady_has_decayed(s->steady) && s->strains == STRAINS;
}

static Status put_start_up(const Schematic *s, Results *results) {
    size_t top = 0;
    for (size_t i = 1; i < STRAINS; i++) {
        if (s->stress[i] > s->stress[top]) top = i;
    }
    const double steady = steady_stress(s->steady);
    TRY(put_stress(results, "Shear stress against the strain since the shear began.", "strain", "",
                   s->strain, STRAINS, s->stress));
    TRY(put_scalar(results, "shear_rate", "D0/d^2", "Shear rate.", s->plan->shear_rate));
    TRY(put_scalar(results, "shear_stress", "", "Shear stress of steady flow.", steady));
    TRY(put_scalar(results, "shear_viscosity", "d^2/D0", "Shear stress over shear rate.",
                   steady / s->plan->shear_rate));
    if (top + 1 == STRAINS || s->stress[top] < (1 + OVERSHOOT_LEAST) * steady) return OK;
    TRY(put_scalar(results, "overshoot_strain", "", "Strain where the stress is largest.",
                   s->strain[top]));
    return put_scalar(results, "overshoot_height", "", "Largest stress over that of steady flow.",
                      s->stress[top] / steady);
}

static void end_correlator(Schematic *s) {
    steady_free(s->steady);
    driven_free(s->driven);
    memory_free(s->time);
    memory_free(s->phi);
    s->steady = NULL;
    s->driven = NULL;
    s->time = s->phi = NULL;
}

static Status solve_steady(Schematic *s, Results *results) {
    if (!s->steady) TRY(begin_steady(s));
    for (int i = 0; i < SLICE_STEPS && !steady_is_over(s); i++) {
        steady_advance(s->steady);
        if (keeps(s, steady_time(s->steady))) s->phi[s->times - 1] = steady_correlator(s->steady);
        if (s->plan->shear_rate > 0) keep_stress(s);
    }
    if (!steady_is_over(s)) return OK;
    Status status = put_line(results, "correlator", "", "The correlator.", "time", "d^2/D0",
                             s->time, s->times, s->phi);
    if (status == OK && s->plan->shear_rate > 0) status = put_start_up(s, results);
    end_correlator(s);
    s->share = 1;
    return status;
}

// ---- Under shear that varies
// ---------------------------------------------------------------------

static bool wants_driven(const Schematic *s) {
    return wants(s, SCHEMATIC_CORRELATOR) && varies(s);
}

static Strain strain_of(const SchematicPlan *plan) {
    Strain strain = {.amplitude = plan->amplitude,
                     .frequency = plan->frequency,
                     .count = (size_t)plan->table_times.count,
                     .duration = plan->duration};
    memcpy(strain.time, plan->table_times.values, strain.count * sizeof *strain.time);
    memcpy(strain.rate, plan->table_rates.values, strain.count * sizeof *strain.rate);
    return strain;
}

// The second half of a cycle is the mirror image of the first.
static size_t beginning(const Schematic *s, size_t k) {
    const size_t parts = (schematic_oscillates(s->plan) ? 2 : 1) * BEGINNINGS;
    return k * (size_t)s->plan->moments / parts;
}

static Status begin_driven(Schematic *s) {
    const SchematicPlan *plan = s->plan;
    const DrivenSettings settings = {s->model, strain_of(plan), (size_t)plan->moments,
                                     schematic_oscillates(plan) ? (size_t)plan->periods : 1,
                                     (size_t)plan->block};
    TRY(times_create(s, BEGINNINGS));
    return driven_create(&s->driven, &settings);
}

static Status put_correlators(const Schematic *s, Results *results) {
    double from[BEGINNINGS], *values = NULL;
    TRY(NEW_ARRAY(values, BEGINNINGS * s->times));
    for (size_t k = 0; k < BEGINNINGS; k++) {
        const size_t moment = beginning(s, k);
        from[k] = moment > 0 ? driven_time(s->driven, moment - 1) : 0;
        memcpy(values + k * s->times, s->phi + k * s->times_most, s->times * sizeof *values);
    }
    const Status status =
        put_rows(results, "correlator", "Correlators that begin when the shear is at these times.",
                 "waiting_time", from, BEGINNINGS, s->time, s->times, values);
    memory_free(values);
    return status;
}

static Status put_history(const Driven *driven, Results *results, double *time, double *strain,
                          double *stress) {
    const size_t count = driven_count(driven);
    for (size_t i = 0; i < count; i++) {
        time[i] = driven_time(driven, i);
        strain[i] = driven_strain(driven, i);
        stress[i] = driven_stress(driven, i);
    }
    TRY(put_stress(results, "Shear stress since the shear began.", "time", "d^2/D0", time, count,
                   stress));
    return put_line(results, "strain", "", "Strain since the shear began.", "time", "d^2/D0", time,
                    count, strain);
}

// The largest change of the stress from the last cycle but one to the last, over its largest.
static double cycle_mismatch(const double *stress, size_t count, size_t moments) {
    double change = 0, most = 0;
    for (size_t i = count - moments; i < count; i++) {
        change = fmax(change, fabs(stress[i] - stress[i - moments]));
        most = fmax(most, fabs(stress[i]));
    }
    return change / most;
}

static Status put_moduli(const Schematic *s, Results *results) {
    double moduli[2][HARMONICS], size[HARMONICS];
    for (int n = 0; n < HARMONICS; n++) {
        const Harmonic harmonic = driven_harmonic(s->driven, n + 1);
        moduli[0][n] = harmonic.storage / s->plan->amplitude;
        moduli[1][n] = harmonic.loss / s->plan->amplitude;
        size[n] = hypot(moduli[0][n], moduli[1][n]);
    }
    TRY(put_harmonics(results, HARMONICS, moduli[0]));
    TRY(put_scalar(results, "storage_modulus", "",
                   "G' of the first harmonic: stress in phase with the strain, over its amplitude.",
                   moduli[0][0]));
    TRY(put_scalar(results, "loss_modulus", "",
                   "G'' of the first harmonic: stress in phase with the rate, over the strain's "
                   "amplitude.",
                   moduli[1][0]));
    TRY(put_scalar(results, "third_harmonic", "",
                   "Amplitude of the third harmonic of the stress over the first.",
                   size[2] / size[0]));
    return put_scalar(results, "fifth_harmonic", "",
                      "Amplitude of the fifth harmonic of the stress over the first.",
                      size[4] / size[0]);
}

// From phase 0 to 1, so that the curve closes; `phase` has room for it.
static Status put_cycle(const Schematic *s, Results *results, double *phase, const double *strain,
                        const double *stress) {
    const size_t moments = (size_t)s->plan->moments;
    const size_t first = driven_count(s->driven) - moments - 1;
    for (size_t k = 0; k <= moments; k++) phase[k] = (double)k / (double)moments;
    TRY(put_line(results, "stress_cycle", "", "Shear stress over the last cycle.", "phase", "",
                 phase, moments + 1, stress + first));
    TRY(put_line(results, "lissajous", "", "Shear stress over the last cycle, against the strain.",
                 "cycle_strain", "", strain + first, moments + 1, stress + first));
    TRY(put_scalar(results, "cycle_mismatch", "",
                   "Largest change of the stress from the last cycle but one to the last, over the "
                   "largest stress: what more cycles would still change.",
                   cycle_mismatch(stress, driven_count(s->driven), moments)));
    return put_moduli(s, results);
}

static Status put_driven(const Schematic *s, Results *results) {
    const size_t count = driven_count(s->driven);
    double *room = NULL;
    TRY(NEW_ARRAY(room, 3 * count));
    double *time = room, *strain = room + count, *stress = room + 2 * count;
    Status status = put_correlators(s, results);
    if (status == OK) status = put_history(s->driven, results, time, strain, stress);
    if (status == OK && schematic_oscillates(s->plan))
        status = put_cycle(s, results, time, strain, stress);
    memory_free(room);
    return status;
}

static Status solve_driven(Schematic *s, Results *results) {
    if (!s->driven) TRY(begin_driven(s));
    for (int i = 0; i < SLICE_AGES && !driven_finished(s->driven); i++) {
        driven_advance(s->driven);
        if (!keeps(s, driven_age(s->driven))) continue;
        for (size_t k = 0; k < BEGINNINGS; k++)
            s->phi[k * s->times_most + s->times - 1] =
                driven_correlator(s->driven, beginning(s, k));
    }
    s->share = fmin(driven_share(s->driven), 0.999);
    if (!driven_finished(s->driven)) return OK;
    const Status status = put_driven(s, results);
    end_correlator(s);
    s->share = 1;
    return status;
}

// ---- Flow curve and yield stress
// -----------------------------------------------------------------

static Status stress_at(const Schematic *s, double rate, double *stress) {
    Steady *steady = NULL;
    const SteadySettings settings = {s->model, rate, (size_t)s->plan->block};
    TRY(steady_create(&steady, &settings));
    while (!steady_has_decayed(steady)) steady_advance(steady);
    *stress = steady_stress(steady);
    steady_free(steady);
    return OK;
}

static bool wants_flow(const Schematic *s) {
    return wants(s, SCHEMATIC_FLOW_CURVE);
}

static Status begin_flow(Schematic *s) {
    const double decades = log10(s->plan->last_rate / s->plan->first_rate);
    s->rates_most = (size_t)round(decades * (double)s->plan->rates_per_decade) + 1;
    s->rates_most = s->rates_most < 2 ? 2 : s->rates_most;
    TRY(NEW_ARRAY(s->rate, s->rates_most));
    TRY(NEW_ARRAY(s->flow, s->rates_most));
    for (size_t i = 0; i < s->rates_most; i++)
        s->rate[i] =
            s->plan->first_rate * pow(10, decades * (double)i / (double)(s->rates_most - 1));
    return OK;
}

// A rate in a slice.
static Status solve_flow(Schematic *s, Results *results) {
    if (!s->rate) TRY(begin_flow(s));
    TRY(stress_at(s, s->rate[s->rates], &s->flow[s->rates]));
    s->rates++;
    s->share = (double)s->rates / (double)s->rates_most;
    if (s->rates < s->rates_most) return OK;
    return put_line(results, "flow_curve", "", "Shear stress of steady flow.", "shear_rate",
                    "D0/d^2", s->rate, s->rates, s->flow);
}

// A fluid has none.
static bool wants_yield(const Schematic *s) {
    return wants(s, SCHEMATIC_YIELD_STRESS) && f12_plateau(&s->model) > 0;
}

// At ever smaller rates, until a decade changes nothing.
static Status find_yield(Schematic *s, Results *results) {
    double rate = 1e-10 * s->model.rate, before = 0, stress = 0;
    TRY(stress_at(s, rate, &stress));
    while (!(fabs(stress - before) < YIELDED * stress)) {
        rate /= 10;
        if (rate < LEAST_RATE * s->model.rate)
            return status_fail(UNHEALTHY, "yield stress: at a rate of %g the stress still falls",
                               rate);
        before = stress;
        TRY(stress_at(s, rate, &stress));
    }
    return put_scalar(results, "yield_stress", "",
                      "Shear stress of steady flow as the rate goes to 0.", stress);
}

// ---- The whole ---------------------------------------------------------------------------------

// In this order; a step that takes several slices says its share in schematic->share.
static const struct {
    const char *name;
    bool (*wanted)(const Schematic *schematic);
    Status (*work)(Schematic *schematic, Results *results);
    bool slices;
} steps[] = {
    {"transition", wants_transition, find_transition, false},
    {"correlator", wants_steady, solve_steady, true},
    {"correlators", wants_driven, solve_driven, true},
    {"flow curve", wants_flow, solve_flow, true},
    {"yield stress", wants_yield, find_yield, false},
};
enum { STEPS = sizeof steps / sizeof *steps };

static void skip_unwanted(Schematic *s) {
    while (s->step < STEPS && !steps[s->step].wanted(s)) s->step++;
}

Status schematic_create(Schematic **out, const SchematicPlan *plan) {
    Schematic *s = NULL;
    *out = NULL;
    TRY(NEW(s));
    s->plan = plan;
    s->model = schematic_model(plan);
    skip_unwanted(s);
    *out = s;
    return OK;
}

void schematic_free(Schematic *s) {
    if (!s) return;
    end_correlator(s);
    memory_free(s->rate);
    memory_free(s->flow);
    memory_free(s);
}

Status schematic_advance(Schematic *s, Results *results) {
    TRY(steps[s->step].work(s, results));
    if (steps[s->step].slices && s->share < 1) return OK;
    s->share = 0;
    s->step++;
    skip_unwanted(s);
    return OK;
}

bool schematic_finished(const Schematic *s) {
    return s->step == STEPS;
}

double schematic_progress(const Schematic *s) {
    return ((double)s->step + fmin(s->share, 1)) / STEPS;
}

const char *schematic_doing(const Schematic *s) {
    return schematic_finished(s) ? "" : steps[s->step].name;
}

double schematic_time(const Schematic *s) {
    if (s->steady) return steady_time(s->steady);
    return s->driven ? driven_age(s->driven) : 0;
}
