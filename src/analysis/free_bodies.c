// SPDX-License-Identifier: GPL-3.0-or-later
// How bodies with an axis would move alone, as series of the shape of what was measured: with the
// free diffusion tensor of a species, D0 its mean, times in d^2/D0 of the first species,
//   <P1> = exp(-2 D_rot t), <P2> = exp(-6 D_rot t),
//   <(dr.u(0))^2> = 2 D0 t + (4/3) (D_par - D_perp) (1 - exp(-6 D_rot t))/(6 D_rot),
// across it half of the rest of 6 D0 t; 2 D0 t along any direction that knows nothing of u.
// Jabbari-Farouji & Trizac, J. Chem. Phys. 137, 054107 (2012), sec. II.
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// A label of a series: one species, or all that have an axis. Weights are their particles.
typedef struct Bodies {
    size_t count;
    Diffusion diffusion[SPECIES_MOST]; // in D0
    double weight[SPECIES_MOST];
} Bodies;

static Bodies bodies_with_axes(const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    const double unit = system_reference_diffusion(system);
    Bodies bodies = {.count = 0};
    for (size_t s = 0; s < system->species_count; s++) {
        if (!shape_is_oriented((ShapeKind)system->species[s].shape)) continue;
        const Diffusion free = species_diffusion(&system->species[s]);
        bodies.weight[bodies.count] = (double)counts[s];
        bodies.diffusion[bodies.count++] = (Diffusion){.parallel = free.parallel / unit,
                                                       .perpendicular = free.perpendicular / unit,
                                                       .rotational = free.rotational / unit};
    }
    return bodies;
}

static Bodies bodies_of_label(const Bodies *bodies, size_t label) {
    if (label >= bodies->count) return *bodies;
    return (Bodies){
        .count = 1, .diffusion = {bodies->diffusion[label]}, .weight = {bodies->weight[label]}};
}

// In the order of the observables' axes.
enum { P1, P2 };
enum { PARALLEL, PERPENDICULAR };

static double correlation(const Diffusion *free, size_t polynomial, double time) {
    return exp((polynomial == P1 ? -2 : -6) * free->rotational * time);
}

static double displacement(const Diffusion *free, size_t direction, double time) {
    const double mean = diffusion_mean(free, 3), rate = 6 * free->rotational;
    const double along = 2 * mean * time - 4.0 / 3 * (free->parallel - free->perpendicular) *
                                               expm1(-rate * time) / rate;
    if (direction == PARALLEL) return along;
    if (direction == PERPENDICULAR) return (6 * mean * time - along) / 2;
    return 2 * mean * time; // the director
}

static double diffusion(const Diffusion *free, size_t direction, double time) {
    (void)time;
    return direction == PARALLEL ? free->parallel : free->perpendicular;
}

typedef double (*FreeFunction)(const Diffusion *free, size_t row, double time);

static double mean_over_bodies(const Bodies *bodies, FreeFunction function, size_t row,
                               double time) {
    double sum = 0, weights = 0;
    for (size_t b = 0; b < bodies->count; b++) {
        sum += bodies->weight[b] * function(&bodies->diffusion[b], row, time);
        weights += bodies->weight[b];
    }
    return sum / weights;
}

static void fill(const ResultSeries *shape, const System *system, FreeFunction function,
                 double *values) {
    const Bodies bodies = bodies_with_axes(system);
    const ResultAxis *time = &shape->axis[2];
    for (size_t l = 0; l < shape->axis[0].count; l++) {
        const Bodies some = bodies_of_label(&bodies, l);
        for (size_t row = 0; row < shape->axis[1].count; row++) {
            for (size_t k = 0; k < time->count; k++) {
                *values++ = mean_over_bodies(&some, function, row, time->values[k]);
            }
        }
    }
}

// Of a label, along or across the body axis, before it turns: NAME, or NAME_SPECIES where there is
// another label after it.
static Status put_tensor(Results *results, const ResultSeries *shape, const System *system) {
    static const char *const names[] = {"free_diffusion_parallel", "free_diffusion_perpendicular"};
    const Bodies bodies = bodies_with_axes(system);
    for (size_t l = 0; l < shape->axis[0].count; l++) {
        const Bodies some = bodies_of_label(&bodies, l);
        const bool named = l + 1 < shape->axis[0].count;
        for (size_t row = PARALLEL; row <= PERPENDICULAR; row++) {
            char name[2 * RESULT_NAME];
            snprintf(name, sizeof name, "%s%s%s", names[row], named ? "_" : "",
                     named ? shape->axis[0].labels[l] : "");
            const double value = mean_over_bodies(&some, diffusion, row, 0);
            for (size_t r = 0; r < results->replicas; r++) {
                TRY(results_put_scalar(results, shape->stage, name, "D0", NULL, r, value));
            }
        }
    }
    return OK;
}

Status derive_free_bodies(Results *results, const ResultSeries *series, const System *system) {
    if (strcmp(series->axis[2].unit, "d^2/D0") != 0) return OK; // no clock, no diffusion
    const bool turning = strcmp(series->observable, "orientation_correlation") == 0;
    const ResultSeries shape = derive_shape(series, turning ? "free_orientation_correlation"
                                                            : "free_directional_displacement");
    double *values = NULL;
    TRY(NEW_ARRAY(values, shape.size));
    fill(&shape, system, turning ? correlation : displacement, values);
    Status status = OK;
    for (size_t replica = 0; status == OK && replica < results->replicas; replica++) {
        status = results_put_series(results, &shape, replica, values);
    }
    memory_free(values);
    if (status == OK && !turning) status = put_tensor(results, &shape, system);
    return status;
}
