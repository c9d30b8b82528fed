// SPDX-License-Identifier: GPL-3.0-or-later
// What the mean squared displacement would be without collisions: 2 dim D_a t, beyond a thermostat
// interval. Event-driven, D_a/D0 is the mass of the first species over that of species a, since D_a
// = thermostat_interval kT/(2 m_a); Monte Carlo says its own D_a, in the series free_diffusion. All
// particles together have the mean over particles.
#include "analysis/derive.h"
#include "base/memory.h"

#include <string.h>

static double free_diffusion(const System *system, size_t species) { // in D0
    return system->species[0].mass / system->species[species].mass;
}

static double mean_free_diffusion(const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    double sum = 0, particles = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        sum += (double)counts[s] * free_diffusion(system, s);
        particles += (double)counts[s];
    }
    return sum / particles;
}

// [species], then all of them if there are several.
static void free_diffusions(double *diffusion, const Results *results, const ResultSeries *shape,
                            const System *system) {
    const ResultSeries *given = results_find_series(results, shape->stage, "free_diffusion");
    for (size_t s = 0; s < shape->axis[0].count; s++) {
        const bool one = s < system->species_count;
        diffusion[s] = given ? results_series_estimate(results, given, s).value
                       : one ? free_diffusion(system, s)
                             : mean_free_diffusion(system);
    }
}

// values[species][direction][lag] as in the series; the last direction is the sum over the others.
static void fill(const ResultSeries *series, const double *diffusion, double *values) {
    const size_t directions = series->axis[1].count;
    const ResultAxis *time = &series->axis[2];
    for (size_t s = 0; s < series->axis[0].count; s++) {
        for (size_t d = 0; d < directions; d++) {
            const double dimensions = d + 1 < directions ? 1 : (double)(directions - 1);
            for (size_t k = 0; k < time->count; k++) {
                *values++ = 2 * dimensions * diffusion[s] * time->values[k];
            }
        }
    }
}

Status derive_free_displacement(Results *results, const ResultSeries *displacement,
                                const System *system) {
    if (strcmp(displacement->axis[2].unit, "d^2/D0") != 0) return OK; // no thermostat, no diffusion
    if (derive_forced(results, displacement->stage, NULL)) return OK; // a tracer alone would drift
    const ResultSeries shape = derive_shape(displacement, "free_displacement");
    double *values = NULL;
    TRY(NEW_ARRAY(values, shape.size));
    double diffusion[SPECIES_MOST + 1] = {0};
    free_diffusions(diffusion, results, &shape, system);
    fill(&shape, diffusion, values);
    Status status = OK;
    for (size_t replica = 0; status == OK && replica < results->replicas; replica++) {
        status = results_put_series(results, &shape, replica, values);
    }
    memory_free(values);
    return status;
}
