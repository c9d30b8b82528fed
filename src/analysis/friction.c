// SPDX-License-Identifier: GPL-3.0-or-later
// Velocity of a pulled tracer and effective friction gamma_eff/gamma_0 = D F/<v> (Garcia Daza,
// Puertas, Cuetos and Patti), from distances and times summed over all trajectories; without force
// D over its long-time diffusion coefficient. Errors are of the jackknife over replicas; of a
// single replica, whose trajectories follow each other in one bath, over these.
#include "analysis/derive.h"

#include <math.h>
#include <stdio.h>

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

// Of the velocity between a fifth and two fifths, and of that from there on.
static double velocity_drift(const Source *source, int64_t without) {
    const ResultSeries *passage = source->passage;
    const size_t begins = passage->axis[1].count;
    double sum[2][2] = {{0}}; // [earlier, later][distance, time]
    for (size_t replica = 0; replica < source->results->replicas; replica++) {
        if ((int64_t)replica == without) continue;
        for (size_t q = 0; q < 2; q++) {
            const double *from = passage->values + replica * passage->size + q * begins;
            sum[0][q] += from[MAIN_BEGIN] - from[MAIN_BEGIN + 1];
            sum[1][q] += from[MAIN_BEGIN + 1];
        }
    }
    return sum[1][0] / sum[1][1] / (sum[0][0] / sum[0][1]) - 1;
}

// Errors of a single replica over its trajectories.

enum { DISTANCE, TIME, DISTANCE_2, PRODUCT, TIME_2, TRAJECTORIES, SUMS }; // of tracer_passage

static double passage_sum(const Source *source, size_t sum, size_t begin) {
    return source->passage->values[sum * source->passage->axis[1].count + begin];
}

// Square of the standard error of a distance that goes with a time: what is left of it beside
// velocity times time (the error of a ratio of sums).
static double square_error_of_distance(const Source *source, size_t begin) {
    const double n = passage_sum(source, TRAJECTORIES, begin);
    const double v = passage_sum(source, DISTANCE, begin) / passage_sum(source, TIME, begin);
    const double left = passage_sum(source, DISTANCE_2, begin) -
                        2 * v * passage_sum(source, PRODUCT, begin) +
                        v * v * passage_sum(source, TIME_2, begin);
    return n > 1 ? fmax(left, 0) * n / (n - 1) : NAN;
}

static double relative_error_of_velocity(const Source *source, size_t begin) {
    return sqrt(square_error_of_distance(source, begin)) /
           fabs(passage_sum(source, DISTANCE, begin));
}

// Windows one after the other are independent, so that squares of errors add up.
static double error_of_drift(const Source *source) {
    const double later = square_error_of_distance(source, MAIN_BEGIN + 1),
                 earlier = fmax(square_error_of_distance(source, MAIN_BEGIN) - later, 0);
    const double way = passage_sum(source, DISTANCE, MAIN_BEGIN + 1),
                 way_earlier = passage_sum(source, DISTANCE, MAIN_BEGIN) - way;
    return sqrt(later / (way * way) + earlier / (way_earlier * way_earlier)) *
           fabs(1 + velocity_drift(source, NOBODY));
}

// Without force, of the slope: displacements in parts of time one after the other are independent,
// so that the square of an error grows by that of what is added.
static double relative_error_of_diffusion(const Source *source, size_t begin) {
    const ResultSeries *squares = source->squares;
    const ResultSeries *errors = results_own_errors(source->results, squares);
    const size_t looks = squares->axis[1].count;
    const size_t first = (size_t)(source->passage->axis[1].values[begin] * (double)looks);
    const double *times = squares->axis[1].values;
    double square = 0;
    if (!errors) return NAN;
    for (size_t d = 0; d < 2; d++) { // along, and twice across
        const double weight = d == 0 ? 1 : 2;
        const double early = errors->values[d * looks + first],
                     late = errors->values[d * looks + looks - 1];
        square += weight * weight * fmax(late * late - early * early, 0);
    }
    return sqrt(square) / (6 * (times[looks - 1] - times[first])) /
           fabs(
               diffusion(source->results, squares, source->passage->axis[1].values[begin], NOBODY));
}

static Status put_own_errors(Results *results, const Source *source, const char *stage) {
    static const struct {
        const char *name;
        size_t begin;
    } FRICTIONS[] = {{"effective_friction", 3},
                     {"effective_friction_earlier", 2},
                     {"effective_friction_later", 4}};
    const bool forced = source->free_velocity > 0;
    for (size_t k = 0; k < sizeof FRICTIONS / sizeof *FRICTIONS; k++) {
        const size_t begin = FRICTIONS[k].begin;
        const double part = forced ? relative_error_of_velocity(source, begin)
                                   : relative_error_of_diffusion(source, begin);
        char name[RESULT_NAME];
        snprintf(name, sizeof name, "%s_error", FRICTIONS[k].name);
        TRY(results_put_scalar(results, stage, name, "", NULL, 0,
                               part * friction(source, begin, NOBODY)));
    }
    const double way = fabs(velocity(results, source->passage, MAIN_BEGIN, NOBODY));
    TRY(results_put_scalar(results, stage, "tracer_velocity_error", "D0/d", NULL, 0,
                           way * relative_error_of_velocity(source, MAIN_BEGIN)));
    if (!forced) return OK;
    return results_put_scalar(results, stage, "tracer_velocity_drift_error", "", NULL, 0,
                              error_of_drift(source));
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
        if (source.free_velocity > 0)
            TRY(results_put_scalar(results, stage, "tracer_velocity_drift", "", NULL, replica,
                                   pseudo_value(results->replicas, velocity_drift(&source, NOBODY),
                                                velocity_drift(&source, (int64_t)replica))));
    }
    const bool told = given->axis[0].count >= SUMS && results_own_errors(results, source.squares);
    return told ? put_own_errors(results, &source, stage) : OK;
}
