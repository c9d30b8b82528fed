// SPDX-License-Identifier: GPL-3.0-or-later
// Velocity of a pulled tracer and effective friction gamma_eff/gamma_0 = D F/<v> (Garcia Daza,
// Puertas, Cuetos and Patti), from distances and times summed over all trajectories; without force
// D over its long-time diffusion coefficient. Errors are of the jackknife over replicas.
#include "analysis/derive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const size_t MAIN_BEGIN = 3; // a fifth of the shortest trajectory is left out

enum { NOBODY = -1 };

// Over all replicas but one.
static double velocity(const Results *results, const ResultSeries *passage, size_t begin,
                       int64_t without) {
    const size_t begins = passage->axis[1].count;
    double distance = 0, time = 0;
    for (size_t replica = 0; replica < results->replicas; replica++) {
        if ((int64_t)replica == without) continue;
        distance += passage->values[replica * passage->size + begin];
        time += passage->values[replica * passage->size + begins + begin];
    }
    return distance / time;
}

// Of the tracer without force: the slope of its mean square displacement after `part` of it.
static double diffusion(const Results *results, const ResultSeries *squares, double part,
                        int64_t without) {
    const size_t looks = squares->axis[1].count, first = (size_t)(part * (double)looks);
    double sum = 0, replicas = 0;
    for (size_t replica = 0; replica < results->replicas; replica++) {
        if ((int64_t)replica == without) continue;
        const double *along = squares->values + replica * squares->size, *across = along + looks;
        sum += along[looks - 1] - along[first] + 2 * (across[looks - 1] - across[first]);
        replicas++;
    }
    const double *times = squares->axis[1].values;
    return sum / replicas / (6 * (times[looks - 1] - times[first]));
}

typedef struct Source {
    const Results *results;
    const ResultSeries *passage, *squares;
    double free_velocity, free_diffusion;
} Source;

static double friction(const Source *source, size_t begin, int64_t without) {
    const double part = source->passage->axis[1].values[begin];
    if (source->free_velocity > 0)
        return source->free_velocity / velocity(source->results, source->passage, begin, without);
    return source->free_diffusion / diffusion(source->results, source->squares, part, without);
}

static void fill(const Source *source, int64_t replica, double *values) {
    const size_t begins = source->passage->axis[1].count, replicas = source->results->replicas;
    for (size_t b = 0; b < begins; b++) {
        values[b] = pseudo_value(replicas, velocity(source->results, source->passage, b, NOBODY),
                                 velocity(source->results, source->passage, b, replica));
        values[begins + b] =
            pseudo_value(replicas, friction(source, b, NOBODY), friction(source, b, replica));
    }
}

Status derive_friction(Results *results, const ResultSeries *given) {
    enum { BEGINS_MOST = 16 };
    char stage[RESULT_NAME];
    snprintf(stage, sizeof stage, "%s", given->stage);
    const size_t begins = given->axis[1].count;
    const ResultScalar *free_velocity = results_find_scalar(results, stage, "tracer_free_velocity");
    const ResultScalar *free = results_find_scalar(results, stage, "tracer_free_diffusion");
    if (!free || !free_velocity || begins <= MAIN_BEGIN || begins > BEGINS_MOST) return OK;
    const Source source = {.results = results,
                           .passage = given,
                           .squares =
                               results_find_series(results, stage, "tracer_square_displacement"),
                           .free_velocity = free_velocity->values[0],
                           .free_diffusion = free->values[0]};
    if (!source.squares) return OK;
    for (size_t replica = 0; replica < results->replicas; replica++) {
        double values[2 * BEGINS_MOST];
        fill(&source, (int64_t)replica, values);
        TRY(results_put_scalar(results, stage, "tracer_velocity", "D0/d", NULL, replica,
                               values[MAIN_BEGIN]));
        TRY(results_put_scalar(results, stage, "effective_friction", "", NULL, replica,
                               values[begins + MAIN_BEGIN]));
        TRY(results_put_scalar(results, stage, "effective_friction_earlier", "", NULL, replica,
                               values[begins + MAIN_BEGIN - 1]));
        TRY(results_put_scalar(results, stage, "effective_friction_later", "", NULL, replica,
                               values[begins + MAIN_BEGIN + 1]));
    }
    return OK;
}
