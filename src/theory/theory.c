// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the theory: structure, glass transition, correlators, one after the other.
#include "theory/theory.h"

#include "base/memory.h"
#include "mct/beta.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "mct/forms.h"
#include "mct/grid.h"
#include "mct/sheared.h"
#include "oz/oz.h"
#include "theory/input.h"
#include "theory/put.h"
#include "theory/series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double SLICE_STEPS = 32; // times of the correlators between two looks from outside
static const double BETA_LAST = 1e6, BETA_LEAST = -10;      // of t/t_sigma and of G
static const double MASTER_FIRST = 1e-5, MASTER_LAST = 1e3; // of t in units of its own scale

// Of the slope of ln dr^2 against ln t from 1, where diffusion is not reached.
static const double NOT_DIFFUSIVE = 0.01;

// Limits of two ways to one curvature. What composition and sizes do to sigma nearly cancels, and
// errors of the slope are those of the parts.
static const double MISMATCH = 0.02, MISMATCH_ALONG = 0.05;

struct Theory {
    const TheoryPlan *plan;
    Mixture mixture;
    const Measured *measured; // structure in place of the closure's; NULL: none
    Grid *grid;
    Oz *oz;
    const Structure *structure; // at the packing fraction of the plan; NULL before
    CriticalPoint *critical;    // NULL: not wanted
    Correlators *correlators;   // while they are being calculated
    Kept kept;
    Sheared *sheared;           // while it is calculated
    double *rate, *flow, *peak; // the flow curve so far, and the largest stress on the way
    size_t rates, rates_most;
    double next_time; // to be kept
    size_t step;      // of the table below
    double share;     // of the step that is done
};

static bool wants(const Theory *theory, TheoryPart part) {
    return theory->plan->calculate >> part & 1;
}

// A state is asked for, not only the transition.
static bool wants_state(const Theory *theory) {
    return theory->plan->packing_fraction > 0 || theory->plan->separation != 0;
}

// ---- The steps ---------------------------------------------------------------------------------

static bool wants_critical(const Theory *theory) {
    return wants(theory, THEORY_CRITICAL) || wants(theory, THEORY_EXPONENTS) ||
           wants(theory, THEORY_BETA) || wants(theory, THEORY_MASTER) ||
           theory->plan->separation != 0;
}

static const struct {
    const char *name, *about;
    bool exponent;
} number_rows[] = {
    {"critical_packing_fraction", "Packing fraction of the glass transition.", false},
    {"exponent_parameter", "Exponent parameter lambda.", true},
    {"exponent_a", "Critical exponent a: G -> (t/t0)^-a.", true},
    {"exponent_b", "Von Schweidler exponent b: G -> -B (t/t_sigma)^b.", true},
    {"exponent_gamma", "Exponent gamma = 1/(2 a) + 1/(2 b) of the time of the final decay.", true},
    {"von_schweidler_amplitude", "Amplitude B of G -> -B (t/t_sigma)^b.", true},
    {"separation_slope",
     "C in sigma = C (phi - phi_c)/phi_c, the separation parameter, or so of what is searched "
     "along.",
     true},
    {"shear_coefficient",
     "c of the beta-scaling equation sigma - c (rate t)^2 + lambda G^2 = d/dt int GG; of the "
     "theories, in the isotropically sheared model.",
     true},
};

static Status put_numbers(const Theory *theory, Results *results) {
    enum { NUMBERS = sizeof number_rows / sizeof *number_rows };
    const CriticalPoint *point = theory->critical;
    const Exponents *e = &point->exponents;
    double amplitude;
    TRY(beta_von_schweidler(e->lambda, &amplitude));
    const double value[NUMBERS] = {point->packing_fraction,
                                   e->lambda,
                                   e->a,
                                   e->b,
                                   e->gamma,
                                   amplitude,
                                   point->slope,
                                   point->shear};
    for (size_t i = 0; i < NUMBERS; i++) {
        if (number_rows[i].exponent && !wants(theory, THEORY_EXPONENTS)) continue;
        TRY(theory_put_number(results, number_rows[i].name, "", number_rows[i].about, value[i]));
    }
    return OK;
}

// Where the search begins and ends if the plan does not say: where the structure was measured, or
// where closures have their transition.
static double search_end(const Theory *theory, double given, bool low) {
    const bool discs = theory->plan->dimension == 2;
    if (given > 0) return given;
    if (theory->measured)
        return low ? measured_lowest(theory->measured) : measured_highest(theory->measured);
    return low ? (discs ? 0.6 : 0.45) : discs ? 0.74 : 0.57;
}

static Status search_critical(const Theory *theory, CriticalPoint **point) {
    const TheoryPlan *plan = theory->plan;
    size_t species;
    const MixtureAxis axis = theory_search_axis(plan, &species);
    const CriticalSearch search = {
        .axis = axis,
        .species = species,
        .packing_fraction = plan->packing_fraction,
        .name = axis == MIXTURE_PACKING_FRACTION ? NULL : plan->search_key,
        .mixture = theory->mixture,
        .closure = (Closure)plan->structure,
        .measured = theory->measured,
        .count = (size_t)plan->wave_numbers,
        .last = plan->last_wave_number,
        .low = search_end(theory, plan->search_low, true),
        .high = search_end(theory, plan->search_high, false),
    };
    return critical_find(point, &search);
}

// Of what else than the packing fraction is searched along.
static Status put_value(const Theory *theory, Results *results) {
    const TheoryPlan *plan = theory->plan;
    size_t species;
    char name[RESULT_NAME];
    const MixtureAxis axis = theory_search_axis(plan, &species);
    if (axis == MIXTURE_PACKING_FRACTION) return OK;
    const bool fraction = axis == MIXTURE_FRACTION;
    snprintf(name, sizeof name, "critical_%s_%s", fraction ? "fraction" : "diameter",
             plan->species[species].name);
    return theory_put_number(results, name, fraction ? "" : "d",
                             fraction ? "Fraction of the species at the glass transition."
                                      : "Diameter of the species at the glass transition.",
                             theory->critical->value);
}

// Where a state of this packing fraction is on the line that is searched.
static double value_of(const Theory *theory, double packing_fraction) {
    size_t species;
    const MixtureAxis axis = theory_search_axis(theory->plan, &species);
    return axis == MIXTURE_FRACTION   ? theory->mixture.fraction[species]
           : axis == MIXTURE_DIAMETER ? theory->mixture.diameter[species]
                                      : packing_fraction;
}

static Status find_critical(Theory *theory, Results *results) {
    const TheoryPlan *plan = theory->plan;
    TRY(search_critical(theory, &theory->critical));
    const CriticalPoint *point = theory->critical;
    TRY(put_numbers(theory, results));
    TRY(put_value(theory, results));
    TRY(results_put_health(results, "transition_mismatch",
                           "relative difference of two ways to the curvature of what is searched "
                           "along in 1 - E",
                           plan->search_key[0] ? MISMATCH_ALONG : MISMATCH,
                           fabs(point->curvature / point->expected_curvature - 1)));
    TRY(put_pairs(results, plan, "critical_form_factors", point->wave_number, point->count,
                  point->form));
    return put_pairs(results, plan, "critical_amplitude", point->wave_number, point->count,
                     point->amplitude);
}

// ---- A state -----------------------------------------------------------------------------------

static Status solve_structure(Theory *theory, Results *results) {
    const TheoryPlan *plan = theory->plan;
    const double packing_fraction =
        plan->packing_fraction > 0 ? plan->packing_fraction
                                   : theory->critical->packing_fraction * (1 + plan->separation);
    TRY(oz_solve(theory->oz, packing_fraction, &theory->structure));
    const Structure *s = theory->structure;
    if (theory->measured)
        TRY(results_put_health(results, "structure_misfit",
                               "mean square of (c - fit)/error of the measured structure", NAN,
                               measured_misfit(theory->measured)));
    TRY(theory_put_number(results, "packing_fraction", "", "Packing fraction of the state.",
                          packing_fraction));
    TRY(results_put_health(results, "structure_residual",
                           "largest residual of the closure, where it is solved numerically", 1e-8,
                           oz_effort(theory->oz).residual));
    if (theory->critical)
        TRY(theory_put_number(
            results, "separation_parameter", "",
            "sigma = C (phi - phi_c)/phi_c of the state, or so of what is "
            "searched along.",
            theory->critical->slope *
                (value_of(theory, packing_fraction) / theory->critical->value - 1)));
    if (!wants(theory, THEORY_STRUCTURE)) return OK;
    TRY(put_contacts(results, plan, s));
    TRY(put_pairs(results, plan, "structure_factor", s->wave_number, s->count, s->factor));
    return put_pairs(results, plan, "direct_correlation", s->wave_number, s->count, s->direct);
}

static bool wants_forms(const Theory *theory) {
    return wants_state(theory) && wants(theory, THEORY_FORMS);
}

static Status put_forms(const Theory *theory, Results *results, const Forms *forms) {
    const Structure *s = theory->structure;
    TRY(theory_put_number(results, "is_glass", "", "1 in a glass, 0 in a fluid.",
                          forms->glass ? 1 : 0));
    if (!forms->glass) return OK;
    TRY(put_pairs(results, theory->plan, "glass_form_factors", s->wave_number, s->count,
                  forms->collective));
    TRY(put_species(results, theory->plan, "self_form_factors", s->wave_number, s->count,
                    forms->self));
    return theory_put_each(
        results, theory->plan->species, theory->plan->species_count, "localisation_length", "d",
        "r_l of a tagged particle: its displacement ends at 2 dim r_l^2.", forms->localisation);
}

static Status find_forms(Theory *theory, Results *results) {
    Forms *forms = NULL;
    TRY(forms_create(&forms, theory->grid, theory->structure));
    const Status status = put_forms(theory, results, forms);
    forms_free(forms);
    return status;
}

static bool wants_beta(const Theory *theory) {
    return wants(theory, THEORY_BETA);
}

static Status put_beta(const Theory *theory, Results *results, double sigma, const char *name) {
    BetaFunction *beta = NULL;
    const BetaSettings settings = {.lambda = theory->critical->exponents.lambda,
                                   .sigma = sigma,
                                   .shear = theory->plan->beta_shear,
                                   .last = BETA_LAST};
    TRY(beta_create(&beta, &settings));
    size_t count = 0;
    double next = 1e-6;
    for (size_t i = 0; i < beta->count && beta->value[i] > BETA_LEAST; i++) {
        if (beta->time[i] < next) continue; // twenty times a decade
        beta->time[count] = beta->time[i];
        beta->value[count++] = beta->value[i];
        next *= pow(10, 0.05);
    }
    const Status status = put_curve(results, name, "t_sigma", beta->time, count, beta->value);
    beta_free(beta);
    return status;
}

static Status solve_beta(Theory *theory, Results *results) {
    TRY(put_beta(theory, results, -1, "beta_scaling_fluid"));
    return put_beta(theory, results, 1, "beta_scaling_glass");
}

// ---- Correlators -------------------------------------------------------------------------------

static size_t nearest(const Grid *grid, double wave_number) {
    size_t best = 0;
    for (size_t m = 1; m < grid->count; m++) {
        if (fabs(grid->wave_number[m] - wave_number) < fabs(grid->wave_number[best] - wave_number))
            best = m;
    }
    return best;
}

static size_t peak(const Structure *s) {
    const size_t species = s->mixture.species;
    double most = 0;
    size_t best = 0;
    for (size_t m = 0; m < s->count; m++) {
        double total = 0;
        for (size_t a = 0; a < species; a++) {
            for (size_t b = 0; b < species; b++)
                total += s->factor[mixture_pair(species, a, b) * s->count + m];
        }
        if (total > most) best = m;
        most = fmax(most, total);
    }
    return best;
}

// Which wave numbers are kept, and room for them at all times.
static Status kept_create(Theory *theory, double first, double last, double per_decade,
                          bool tagged) {
    const OptionReals *wanted = &theory->plan->correlator_wave_numbers;
    Kept *kept = &theory->kept;
    const size_t species = theory->plan->species_count;
    memset(kept, 0, sizeof *kept);
    kept->unit_of_time = "d^2/D0";
    kept->waves = wanted->count > 0 ? (size_t)wanted->count : 1;
    for (size_t i = 0; i < kept->waves; i++) {
        kept->index[i] =
            wanted->count > 0 ? nearest(theory->grid, wanted->values[i]) : peak(theory->structure);
        kept->wave_number[i] = theory->grid->wave_number[kept->index[i]];
        for (size_t pair = 0; pair < mixture_pairs(&theory->mixture); pair++)
            kept->start[pair][i] =
                theory->structure->factor[pair * theory->grid->count + kept->index[i]];
    }
    kept->times_most = (size_t)(per_decade * log10(last / first)) + 2;
    theory->next_time = first;
    TRY(NEW_ARRAY(kept->time, kept->times_most));
    TRY(NEW_ARRAY(kept->collective, kept->times_most * species * (species + 1) / 2 * kept->waves));
    if (!tagged) return OK;
    TRY(NEW_ARRAY(kept->self, kept->times_most * species * kept->waves));
    return NEW_ARRAY(kept->displacement, kept->times_most * species);
}

static void kept_free(Kept *kept) {
    memory_free(kept->time);
    memory_free(kept->collective);
    memory_free(kept->self);
    memory_free(kept->displacement);
    memset(kept, 0, sizeof *kept);
}

static void keep(Theory *theory) {
    const Correlators *c = theory->correlators;
    Kept *kept = &theory->kept;
    const size_t species = theory->plan->species_count, pairs = species * (species + 1) / 2;
    const size_t stride = theory->grid->stride, t = kept->times++;
    kept->time[t] = correlators_time(c);
    for (size_t i = 0; i < pairs * kept->waves; i++)
        kept->collective[t * pairs * kept->waves + i] =
            correlators_collective(c)[i / kept->waves * stride + kept->index[i % kept->waves]];
    for (size_t i = 0; kept->self && i < species * kept->waves; i++)
        kept->self[t * species * kept->waves + i] =
            correlators_self(c)[i / kept->waves * stride + kept->index[i % kept->waves]];
    for (size_t a = 0; kept->self && a < species; a++)
        kept->displacement[t * species + a] = correlators_displacement(c)[a];
}

// Some more times; `done` when the last is passed or there is no more room.
static Status follow(Theory *theory, double last, double per_decade, bool *done) {
    for (int i = 0; i < SLICE_STEPS; i++) {
        TRY(correlators_advance(theory->correlators));
        const double time = correlators_time(theory->correlators);
        if (time < theory->next_time) continue;
        keep(theory);
        while (theory->next_time <= time) theory->next_time *= pow(10, 1 / per_decade);
        *done = time >= last || theory->kept.times == theory->kept.times_most;
        if (*done) return OK;
    }
    const double first = 1e-9, time = correlators_time(theory->correlators);
    theory->share = fmin(0.999, fmax(0, log(time / first) / log(last / first)));
    return OK;
}

static void end_correlators(Theory *theory) {
    correlators_free(theory->correlators);
    theory->correlators = NULL;
    kept_free(&theory->kept);
}

static bool wants_correlators(const Theory *theory) {
    return wants_state(theory) && wants(theory, THEORY_CORRELATORS);
}

static Status begin_correlators(Theory *theory) {
    const TheoryPlan *plan = theory->plan;
    CorrelatorSettings settings = {.block = (size_t)plan->block, .tagged = true};
    for (size_t a = 0; a < plan->species_count; a++)
        settings.diffusion[a] = plan->species[a].diffusion;
    TRY(kept_create(theory, plan->first_time, plan->last_time, (double)plan->times_per_decade,
                    true));
    return correlators_create(&theory->correlators, theory->grid, theory->structure, &settings);
}

// Where the displacement grows like the time between the last two that are kept.
static Status put_diffusion(const Theory *theory, Results *results) {
    const Kept *kept = &theory->kept;
    const size_t species = theory->plan->species_count, last = kept->times - 1;
    double diffusion[MIXTURE_SPECIES_MOST];
    if (kept->times < 2) return OK;
    const double way = kept->time[last] - kept->time[last - 1];
    for (size_t a = 0; a < species; a++) {
        const double end = kept->displacement[last * species + a];
        const double rise = end - kept->displacement[(last - 1) * species + a];
        if (fabs(rise / way * kept->time[last] / end - 1) > NOT_DIFFUSIVE) return OK;
        diffusion[a] = rise / way / (2 * (double)theory->plan->dimension);
    }
    return theory_put_each(
        results, theory->plan->species, theory->plan->species_count, "long_time_diffusion", "D0",
        "Long-time diffusion coefficient, from the end of the displacement.", diffusion);
}

static Status solve_correlators(Theory *theory, Results *results) {
    const TheoryPlan *plan = theory->plan;
    bool done = false;
    if (!theory->correlators) TRY(begin_correlators(theory));
    TRY(follow(theory, plan->last_time, (double)plan->times_per_decade, &done));
    if (!done) return OK;
    Status status = put_kept(results, plan, &theory->kept, "collective_scattering");
    if (status == OK) status = put_normalised(results, plan, &theory->kept);
    if (status == OK) status = put_diffusion(theory, results);
    end_correlators(theory);
    theory->share = 1;
    return status;
}

static bool wants_master(const Theory *theory) {
    return wants(theory, THEORY_MASTER);
}

static Status begin_master(Theory *theory) {
    const CriticalPoint *point = theory->critical;
    TRY(oz_solve(theory->oz, point->packing_fraction, &theory->structure));
    TRY(kept_create(theory, MASTER_FIRST, MASTER_LAST, (double)theory->plan->times_per_decade,
                    false));
    theory->kept.unit_of_time = "t'";
    return correlators_create_master(&theory->correlators, theory->grid, theory->structure,
                                     point->form, point->amplitude, point->exponents.b);
}

static Status solve_master(Theory *theory, Results *results) {
    bool done = false;
    if (!theory->correlators) TRY(begin_master(theory));
    TRY(follow(theory, MASTER_LAST, (double)theory->plan->times_per_decade, &done));
    if (!done) return OK;
    const Status status = put_kept(results, theory->plan, &theory->kept, "alpha_master");
    end_correlators(theory);
    theory->share = 1;
    return status;
}

// ---- Flow curve of the isotropically sheared model
// ------------------------------------------------

static bool wants_flow(const Theory *theory) {
    return wants_state(theory) && wants(theory, THEORY_FLOW_CURVE);
}

static Status begin_flow(Theory *theory) {
    const TheoryPlan *plan = theory->plan;
    const double decades = log10(plan->last_rate / plan->first_rate);
    const double count = fmax(2, round(decades * (double)plan->rates_per_decade) + 1);
    theory->rates_most = (size_t)count;
    TRY(NEW_ARRAY(theory->rate, theory->rates_most));
    TRY(NEW_ARRAY(theory->flow, theory->rates_most));
    TRY(NEW_ARRAY(theory->peak, theory->rates_most));
    for (size_t i = 0; i < theory->rates_most; i++)
        theory->rate[i] = plan->first_rate * pow(10, decades * (double)i / (count - 1));
    return OK;
}

static void end_flow(Theory *theory) {
    sheared_free(theory->sheared);
    memory_free(theory->rate);
    memory_free(theory->flow);
    memory_free(theory->peak);
    theory->sheared = NULL;
    theory->rate = theory->flow = theory->peak = NULL;
}

static Status put_flow(const Theory *theory, Results *results) {
    TRY(put_rates(results, "flow_curve", theory->plan, theory->rate, theory->rates, theory->flow));
    return put_rates(results, "flow_curve_peak", theory->plan, theory->rate, theory->rates,
                     theory->peak);
}

// One rate after the other.
static Status solve_flow(Theory *theory, Results *results) {
    if (!theory->rate) TRY(begin_flow(theory));
    const size_t i = theory->rates;
    if (!theory->sheared)
        TRY(sheared_create(&theory->sheared, theory->grid, theory->structure, theory->rate[i],
                           (size_t)theory->plan->block));
    for (int k = 0; k < SLICE_STEPS && !sheared_has_decayed(theory->sheared); k++) {
        TRY(sheared_advance(theory->sheared));
        theory->peak[i] = fmax(theory->peak[i], sheared_stress(theory->sheared));
    }
    if (!sheared_has_decayed(theory->sheared)) return OK;
    theory->flow[i] = sheared_stress(theory->sheared);
    sheared_free(theory->sheared);
    theory->sheared = NULL;
    theory->share = (double)++theory->rates / (double)theory->rates_most;
    return theory->rates < theory->rates_most ? OK : put_flow(theory, results);
}

// ---- The whole ---------------------------------------------------------------------------------

// In this order; a step that takes several slices says its share in theory->share.
static const struct {
    const char *name;
    bool (*wanted)(const Theory *theory);
    Status (*work)(Theory *theory, Results *results);
    bool slices;
} steps[] = {
    {"critical point", wants_critical, find_critical, false},
    {"structure", wants_state, solve_structure, false},
    {"form factors", wants_forms, find_forms, false},
    {"beta scaling", wants_beta, solve_beta, false},
    {"correlators", wants_correlators, solve_correlators, true},
    {"flow curve", wants_flow, solve_flow, true},
    {"alpha master curve", wants_master, solve_master, true},
};
enum { STEPS = sizeof steps / sizeof *steps };

static void skip_unwanted(Theory *theory) {
    while (theory->step < STEPS && !steps[theory->step].wanted(theory)) theory->step++;
}

static Status prepare(Theory *theory) {
    const TheoryPlan *plan = theory->plan;
    TRY(grid_create(&theory->grid, (int)plan->dimension, (size_t)plan->wave_numbers,
                    plan->last_wave_number));
    const double *q = theory->grid->wave_number;
    const size_t count = theory->grid->count;
    TRY(theory->measured
            ? oz_create_measured(&theory->oz, theory->measured, q, count)
            : oz_create(&theory->oz, (Closure)plan->structure, &theory->mixture, q, count));
    skip_unwanted(theory);
    return OK;
}

Status theory_create(Theory **out, const TheoryPlan *plan, const Measured *measured) {
    Theory *theory = NULL;
    *out = NULL;
    TRY(NEW(theory));
    theory->plan = plan;
    theory->measured = measured;
    // That of the files has the fractions of so many particles.
    theory->mixture = measured ? *measured_mixture(measured) : theory_mixture(plan);
    const Status status = prepare(theory);
    if (status == OK)
        *out = theory;
    else
        theory_free(theory);
    return status;
}

void theory_free(Theory *theory) {
    if (!theory) return;
    end_correlators(theory);
    end_flow(theory);
    critical_free(theory->critical);
    oz_free(theory->oz);
    grid_free(theory->grid);
    memory_free(theory);
}

Status theory_advance(Theory *theory, Results *results) {
    TRY(steps[theory->step].work(theory, results));
    if (steps[theory->step].slices && theory->share < 1) return OK;
    theory->share = 0;
    theory->step++;
    skip_unwanted(theory);
    return OK;
}

bool theory_finished(const Theory *theory) {
    return theory->step == STEPS;
}

double theory_progress(const Theory *theory) {
    return ((double)theory->step + fmin(theory->share, 1)) / STEPS;
}

const char *theory_doing(const Theory *theory) {
    return theory_finished(theory) ? "" : steps[theory->step].name;
}

double theory_time(const Theory *theory) {
    return theory->correlators ? correlators_time(theory->correlators) : 0;
}
