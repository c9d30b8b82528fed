// SPDX-License-Identifier: GPL-3.0-or-later
// Results of the theory: stage `theory`, one replica.
#include "theory/put.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define STAGE "theory"

// "small-small", "small-big", "big-big", and "total", their sum over ordered pairs.
typedef struct Labels {
    size_t count;
    const char *names[MIXTURE_PAIRS_MOST + 1]; // point into `text`
    char text[MIXTURE_PAIRS_MOST + 1][2 * THEORY_NAME_SIZE];
} Labels;

static void append(Labels *labels, const char *first, const char *dash, const char *second) {
    char *text = labels->text[labels->count];
    snprintf(text, sizeof labels->text[0], "%s%s%s", first, dash, second);
    labels->names[labels->count++] = text;
}

static void label_pairs(Labels *labels, const TheoryPlan *plan) {
    labels->count = 0;
    for (size_t a = 0; a < plan->species_count; a++) {
        for (size_t b = a; b < plan->species_count; b++)
            append(labels, plan->species[a].name, "-", plan->species[b].name);
    }
    append(labels, "total", "", "");
}

static void label_species(Labels *labels, const TheoryPlan *plan) {
    labels->count = 0;
    for (size_t a = 0; a < plan->species_count; a++) append(labels, plan->species[a].name, "", "");
}

// `about` where the name stands for something else in a simulation; else empty.
static ResultSeries shape_of(const char *name, const char *unit, const char *about) {
    ResultSeries shape = {.stage = STAGE};
    snprintf(shape.observable, sizeof shape.observable, "%s", name);
    snprintf(shape.unit, sizeof shape.unit, "%s", unit);
    snprintf(shape.about, sizeof shape.about, "%s", about);
    return shape;
}

static void add_axis(ResultSeries *shape, ResultAxis axis) {
    shape->axis[shape->axes++] = axis;
}

static ResultAxis labels_axis(const char *name, const Labels *labels) {
    return (ResultAxis){.name = name, .unit = "", .count = labels->count, .labels = labels->names};
}

static ResultAxis wave_axis(const double *wave_number, size_t count) {
    return (ResultAxis){
        .name = "wave_number", .unit = "1/d", .count = count, .values = wave_number};
}

static ResultAxis time_axis(const char *unit, const double *time, size_t count) {
    return (ResultAxis){.name = "time", .unit = unit, .count = count, .values = time};
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
    Labels labels;
    double *all = NULL;
    ResultSeries shape = shape_of(name, "", "");
    label_pairs(&labels, plan);
    TRY(NEW_ARRAY(all, labels.count * count));
    memcpy(all, values, (labels.count - 1) * count * sizeof *all);
    fill_total(plan, all, count);
    add_axis(&shape, labels_axis("pair", &labels));
    add_axis(&shape, wave_axis(wave_number, count));
    const Status status = results_put_series(results, &shape, 0, all);
    memory_free(all);
    return status;
}

Status put_species(Results *results, const TheoryPlan *plan, const char *name,
                   const double *wave_number, size_t count, const double *values) {
    Labels labels;
    ResultSeries shape = shape_of(name, "", "");
    label_species(&labels, plan);
    add_axis(&shape, labels_axis("species", &labels));
    add_axis(&shape, wave_axis(wave_number, count));
    return results_put_series(results, &shape, 0, values);
}

Status put_each(Results *results, const TheoryPlan *plan, const char *name, const char *unit,
                const char *about, const double *values) {
    for (size_t a = 0; a < plan->species_count; a++) {
        char full[RESULT_NAME];
        snprintf(full, sizeof full, "%.28s_%s", name, plan->species[a].name);
        TRY(results_put_scalar(results, STAGE, plan->species_count > 1 ? full : name, unit, about,
                               0, values[a]));
    }
    return OK;
}

Status put_contacts(Results *results, const TheoryPlan *plan, const Structure *structure) {
    if (isnan(structure->contact[0])) return OK;
    for (size_t a = 0; a < plan->species_count; a++) {
        for (size_t b = a; b < plan->species_count; b++) {
            char name[RESULT_NAME];
            snprintf(name, sizeof name, "contact_value_%s_%s", plan->species[a].name,
                     plan->species[b].name);
            TRY(put_number(results, name, "", "Pair distribution at contact.",
                           structure->contact[mixture_pair(plan->species_count, a, b)]));
        }
    }
    return put_number(results, "compressibility_factor_contact", "",
                      "P V/(N kT) from the pair distributions at contact.",
                      oz_compressibility_factor(structure));
}

Status put_number(Results *results, const char *name, const char *unit, const char *about,
                  double value) {
    return results_put_scalar(results, STAGE, name, unit, about, 0, value);
}

Status put_slot(Results *results, const char *name, const char *about, size_t slot, double value) {
    return results_put_scalar(results, STAGE, name, "", about, slot, value);
}

Status put_curve(Results *results, const char *name, const char *unit_of_time, const double *time,
                 size_t count, const double *values) {
    ResultSeries shape = shape_of(name, "", "");
    add_axis(&shape, time_axis(unit_of_time, time, count));
    return results_put_series(results, &shape, 0, values);
}

Status put_rates(Results *results, const char *name, const TheoryPlan *plan, const double *rate,
                 size_t count, const double *stress) {
    ResultSeries shape = shape_of(name, plan->dimension == 2 ? "kT/d^2" : "kT/d^3", "");
    add_axis(&shape,
             (ResultAxis){.name = "shear_rate", .unit = "D0/d^2", .count = count, .values = rate});
    return results_put_series(results, &shape, 0, stress);
}

// [time][line][wave] as [line][wave][time].
static void turn(const double *kept, size_t times, size_t lines, double *out) {
    for (size_t t = 0; t < times; t++) {
        for (size_t i = 0; i < lines; i++) out[i * times + t] = kept[t * lines + i];
    }
}

static Status put_collective(Results *results, const TheoryPlan *plan, const Kept *kept,
                             const char *name, double *values) {
    Labels labels;
    ResultSeries shape = shape_of(name, "", "");
    label_pairs(&labels, plan);
    turn(kept->collective, kept->times, (labels.count - 1) * kept->waves, values);
    fill_total(plan, values, kept->waves * kept->times);
    add_axis(&shape, labels_axis("pair", &labels));
    add_axis(&shape, wave_axis(kept->wave_number, kept->waves));
    add_axis(&shape, time_axis("d^2/D0", kept->time, kept->times));
    return results_put_series(results, &shape, 0, values);
}

static const char *const MEAN[] = {"mean"}, *const TOTAL[] = {"total"};

static Status put_self(Results *results, const TheoryPlan *plan, const Kept *kept, double *values) {
    Labels labels;
    ResultSeries shape = shape_of("self_scattering", "",
                                  "Self-intermediate scattering function of a tagged particle.");
    label_species(&labels, plan);
    turn(kept->self, kept->times, labels.count * kept->waves, values);
    add_axis(&shape, labels_axis("species", &labels));
    add_axis(&shape, (ResultAxis){.name = "direction", .unit = "", .count = 1, .labels = MEAN});
    add_axis(&shape, wave_axis(kept->wave_number, kept->waves));
    add_axis(&shape, time_axis("d^2/D0", kept->time, kept->times));
    return results_put_series(results, &shape, 0, values);
}

static Status put_displacement(Results *results, const TheoryPlan *plan, const Kept *kept,
                               double *values) {
    Labels labels;
    ResultSeries shape = shape_of("mean_squared_displacement", "d^2",
                                  "Mean squared displacement of a tagged particle.");
    label_species(&labels, plan);
    turn(kept->displacement, kept->times, labels.count, values);
    add_axis(&shape, labels_axis("species", &labels));
    add_axis(&shape, (ResultAxis){.name = "direction", .unit = "", .count = 1, .labels = TOTAL});
    add_axis(&shape, time_axis("d^2/D0", kept->time, kept->times));
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
    Labels labels;
    double *values = NULL;
    ResultSeries shape =
        shape_of("collective_scattering_normalised", "",
                 "Collective intermediate scattering functions, each over its value at t = 0.");
    label_pairs(&labels, plan);
    TRY(NEW_ARRAY(values, labels.count * kept->waves * kept->times));
    turn(kept->collective, kept->times, (labels.count - 1) * kept->waves, values);
    fill_total(plan, values, kept->waves * kept->times);
    normalise(plan, kept, values);
    add_axis(&shape, labels_axis("pair", &labels));
    add_axis(&shape, wave_axis(kept->wave_number, kept->waves));
    add_axis(&shape, time_axis("d^2/D0", kept->time, kept->times));
    const Status status = results_put_series(results, &shape, 0, values);
    memory_free(values);
    return status;
}
