// SPDX-License-Identifier: GPL-3.0-or-later
// Results of the theory: stage `theory`, one replica.
#include "theory/put.h"

#include "base/memory.h"
#include "theory/series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define STAGE "theory"

static void add_pairs(ResultSeries *series, TheoryLabels *labels, const TheoryPlan *plan) {
    theory_label_pairs(labels, plan->species, plan->species_count);
    theory_add_labels(series, "pair", labels->count, labels->names);
}

static void add_species(ResultSeries *series, TheoryLabels *labels, const TheoryPlan *plan) {
    theory_label_species(labels, plan->species, plan->species_count);
    theory_add_labels(series, "species", labels->count, labels->names);
}

static void add_waves(ResultSeries *series, const double *wave_number, size_t count) {
    theory_add_numbers(series, "wave_number", "1/d", count, wave_number);
}

static void add_times(ResultSeries *series, const Kept *kept) {
    theory_add_numbers(series, "time", kept->unit_of_time, kept->times, kept->time);
}

// Into all[pair][at], and their sum over ordered pairs into the last line.
static void fill_total(const TheoryPlan *plan, double *all, size_t count) {
    const size_t species = plan->species_count, pairs = species * (species + 1) / 2;
    double *total = all + pairs * count;
    memset(total, 0, count * sizeof *total);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            const double *values = all + mixture_pair(species, a, b) * count;
            for (size_t i = 0; i < count; i++) total[i] += (a == b ? 1 : 2) * values[i];
        }
    }
}

Status put_pairs(Results *results, const TheoryPlan *plan, const char *name,
                 const double *wave_number, size_t count, const double *values) {
    TheoryLabels labels;
    double *all = NULL;
    ResultSeries shape = theory_series(name, "", "");
    add_pairs(&shape, &labels, plan);
    TRY(NEW_ARRAY(all, labels.count * count));
    memcpy(all, values, (labels.count - 1) * count * sizeof *all);
    fill_total(plan, all, count);
    add_waves(&shape, wave_number, count);
    const Status status = results_put_series(results, &shape, 0, all);
    memory_free(all);
    return status;
}

Status put_species(Results *results, const TheoryPlan *plan, const char *name,
                   const double *wave_number, size_t count, const double *values) {
    TheoryLabels labels;
    ResultSeries shape = theory_series(name, "", "");
    add_species(&shape, &labels, plan);
    add_waves(&shape, wave_number, count);
    return results_put_series(results, &shape, 0, values);
}

Status put_contacts(Results *results, const TheoryPlan *plan, const Structure *structure) {
    if (isnan(structure->contact[0])) return OK;
    for (size_t a = 0; a < plan->species_count; a++) {
        for (size_t b = a; b < plan->species_count; b++) {
            char name[RESULT_NAME];
            snprintf(name, sizeof name, "contact_value_%s_%s", plan->species[a].name,
                     plan->species[b].name);
            TRY(theory_put_number(results, name, "", "Pair distribution at contact.",
                                  structure->contact[mixture_pair(plan->species_count, a, b)]));
        }
    }
    return theory_put_number(results, "compressibility_factor_contact", "",
                             "P V/(N kT) from the pair distributions at contact.",
                             oz_compressibility_factor(structure));
}

Status put_curve(Results *results, const char *name, const char *unit_of_time, const double *time,
                 size_t count, const double *values) {
    ResultSeries shape = theory_series(name, "", "");
    theory_add_numbers(&shape, "time", unit_of_time, count, time);
    return results_put_series(results, &shape, 0, values);
}

Status put_rates(Results *results, const char *name, const TheoryPlan *plan, const double *rate,
                 size_t count, const double *stress) {
    ResultSeries shape = theory_series(name, plan->dimension == 2 ? "kT/d^2" : "kT/d^3", "");
    theory_add_numbers(&shape, "shear_rate", "D0/d^2", count, rate);
    return results_put_series(results, &shape, 0, stress);
}

static Status put_collective(Results *results, const TheoryPlan *plan, const Kept *kept,
                             const char *name, double *values) {
    TheoryLabels labels;
    ResultSeries shape = theory_series(name, "", "");
    add_pairs(&shape, &labels, plan);
    theory_turn(kept->collective, kept->times, (labels.count - 1) * kept->waves, values);
    fill_total(plan, values, kept->waves * kept->times);
    add_waves(&shape, kept->wave_number, kept->waves);
    add_times(&shape, kept);
    return results_put_series(results, &shape, 0, values);
}

static const char *const MEAN[] = {"mean"}, *const TOTAL[] = {"total"};

static Status put_self(Results *results, const TheoryPlan *plan, const Kept *kept, double *values) {
    TheoryLabels labels;
    ResultSeries shape = theory_series(
        "self_scattering", "", "Self-intermediate scattering function of a tagged particle.");
    add_species(&shape, &labels, plan);
    theory_turn(kept->self, kept->times, labels.count * kept->waves, values);
    theory_add_labels(&shape, "direction", 1, MEAN);
    add_waves(&shape, kept->wave_number, kept->waves);
    add_times(&shape, kept);
    return results_put_series(results, &shape, 0, values);
}

static Status put_displacement(Results *results, const TheoryPlan *plan, const Kept *kept,
                               double *values) {
    TheoryLabels labels;
    ResultSeries shape = theory_series("mean_squared_displacement", "d^2",
                                       "Mean squared displacement of a tagged particle.");
    add_species(&shape, &labels, plan);
    theory_turn(kept->displacement, kept->times, labels.count, values);
    theory_add_labels(&shape, "direction", 1, TOTAL);
    add_times(&shape, kept);
    return results_put_series(results, &shape, 0, values);
}

Status put_kept(Results *results, const TheoryPlan *plan, const Kept *kept,
                const char *collective) {
    double *values = NULL;
    TRY(NEW_ARRAY(values, (MIXTURE_PAIRS_MOST + 1) * kept->waves * kept->times));
    Status status = put_collective(results, plan, kept, collective, values);
    if (status == OK && kept->self) status = put_self(results, plan, kept, values);
    if (status == OK && kept->self) status = put_displacement(results, plan, kept, values);
    memory_free(values);
    return status;
}

// Lines of [pair][wave][time], the last of the pairs the total, over their start.
static void normalise(const TheoryPlan *plan, const Kept *kept, double *values) {
    const size_t species = plan->species_count, pairs = species * (species + 1) / 2;
    for (size_t w = 0; w < kept->waves; w++) {
        double total = 0;
        for (size_t pair = 0; pair <= pairs; pair++) {
            double *line = values + (pair * kept->waves + w) * kept->times;
            for (size_t t = 0; t < kept->times; t++)
                line[t] /= pair < pairs ? kept->start[pair][w] : total;
            for (size_t a = 0; pair + 1 == pairs && a < species; a++) {
                for (size_t b = 0; b < species; b++)
                    total += kept->start[mixture_pair(species, a, b)][w];
            }
        }
    }
}

Status put_normalised(Results *results, const TheoryPlan *plan, const Kept *kept) {
    TheoryLabels labels;
    double *values = NULL;
    ResultSeries shape = theory_series(
        "collective_scattering_normalised", "",
        "Collective intermediate scattering functions, each over its value at t = 0.");
    add_pairs(&shape, &labels, plan);
    TRY(NEW_ARRAY(values, labels.count * kept->waves * kept->times));
    theory_turn(kept->collective, kept->times, (labels.count - 1) * kept->waves, values);
    fill_total(plan, values, kept->waves * kept->times);
    normalise(plan, kept, values);
    add_waves(&shape, kept->wave_number, kept->waves);
    add_times(&shape, kept);
    const Status status = results_put_series(results, &shape, 0, values);
    memory_free(values);
    return status;
}
