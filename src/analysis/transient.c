// SPDX-License-Identifier: GPL-3.0-or-later
// The relation of integration through transients between correlators that begin when shear does and
// those that begin a waiting strain later (Krueger, Weysser & Fuchs 2011; Weysser, thesis, eqs. 6.1
// to 6.4). With the quiescent function Phi_eq and a time s that depends on the waiting time alone,
//   Phi_w = Phi_tr + s Phi_eq d/dt (Phi_tr/Phi_eq),
// or solved for the transient, as it is used here for it takes no derivative of data,
//   Phi_tr = Phi_eq (e^(-t/s) + 1/s integral_0^t e^(-(t-t')/s) Phi_w/Phi_eq dt');
// for displacements, the long waves of the above, likewise with differences for ratios,
//   D_tr = D_eq + 1/s integral_0^t e^(-(t-t')/s) (D_w - D_eq) dt'.
// For short waiting times s is the waiting time itself, and the relation has no parameter; for
// others s is that which serves best, given in strain. Errors are the jackknife's over replicas.
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

// One correlator of the three, from the means over replicas or over all but one: [lags].
typedef struct Curves {
    size_t lags;
    const double *times;
    double *quiescent, *transient, *waited, *predicted;
    bool differences; // of displacements; else ratios
} Curves;

// What is to be said of every row of a series, in the order [row][waiting strain].
typedef struct Relation {
    const Results *results;
    const ResultSeries *rest, *sheared;
    double rate;
    size_t waits, rows;
    Curves curves;
    double *predicted[2]; // [replica][row][wait][lag]: with s the waiting time, and the best
    double *strain;       // [replica][row][wait]: the best s, in strain
} Relation;

enum { AS_WAITED, BEST };
static const int64_t NOBODY = -1;

static double mean_without(const Results *results, const ResultSeries *series, size_t element,
                           int64_t without) {
    double sum = 0, count = 0;
    for (size_t r = 0; r < results->replicas; r++) {
        if ((int64_t)r == without) continue;
        sum += series->values[r * series->size + element];
        count++;
    }
    return sum / count;
}

// At a time between the lags of the stage at rest, on a straight line in log t.
static double at_rest(const Relation *relation, size_t sheared_row, double time, int64_t without) {
    const ResultSeries *rest = relation->rest;
    const ResultAxis *axis = &rest->axis[rest->axes - 1];
    const size_t row = derive_same_row(relation->sheared, sheared_row, rest, rest->axes - 1);
    size_t k = 0;
    while (k < axis->count && axis->values[k] < time * (1 - 1e-9)) k++;
    if (k == axis->count) return NAN;
    const double after = mean_without(relation->results, rest, row * axis->count + k, without);
    if (axis->values[k] <= time * (1 + 1e-9)) return after;
    if (k == 0 || !(axis->values[k - 1] > 0)) return NAN;
    const double before = mean_without(relation->results, rest, row * axis->count + k - 1, without);
    const double share =
        log(time / axis->values[k - 1]) / log(axis->values[k] / axis->values[k - 1]);
    return before + share * (after - before);
}

// What the quiescent function is divided out of, or taken from.
static double reduced(const Curves *curves, size_t lag) {
    const double waited = curves->waited[lag], quiescent = curves->quiescent[lag];
    return curves->differences ? waited - quiescent : waited / quiescent;
}

// The convolution with an exponential, by exact weights for straight lines between the lags. Before
// the first lag nothing has happened: the ratio is 1, the difference 0.
static void predict(Curves *curves, double s) {
    double memory = curves->differences ? 0 : 1, before = memory, time = 0;
    for (size_t k = 0; k < curves->lags; k++) {
        const double now = reduced(curves, k), step = (curves->times[k] - time) / s;
        const double kept = exp(-step);
        const double mean = step > 0 ? -expm1(-step) / step : 1; // of the exponential over the step
        memory = kept * memory + (1 - mean) * now + (mean - kept) * before;
        before = now;
        time = curves->times[k];
        curves->predicted[k] =
            curves->differences ? curves->quiescent[k] + memory : curves->quiescent[k] * memory;
    }
}

// Mean square of what is wrong, each lag as much: of logarithms for displacements, that grow.
static double misfit(Curves *curves, double s) {
    predict(curves, s);
    double sum = 0, count = 0;
    for (size_t k = 0; k < curves->lags; k++) {
        const double error = curves->differences ? log(curves->predicted[k] / curves->transient[k])
                                                 : curves->predicted[k] - curves->transient[k];
        if (!isfinite(error)) continue;
        sum += error * error;
        count++;
    }
    return sum / count;
}

// The best s by golden sections of its logarithm.
static double best(Curves *curves, double least, double most) {
    const double golden = 0.6180339887498949;
    double low = log(least), high = log(most);
    double one = high - golden * (high - low), other = low + golden * (high - low);
    double at_one = misfit(curves, exp(one)), at_other = misfit(curves, exp(other));
    while (high - low > 1e-4) {
        if (at_one < at_other) {
            high = other;
            other = one;
            at_other = at_one;
            one = high - golden * (high - low);
            at_one = misfit(curves, exp(one));
        } else {
            low = one;
            one = other;
            at_one = at_other;
            other = low + golden * (high - low);
            at_other = misfit(curves, exp(other));
        }
    }
    return exp((low + high) / 2);
}

static void take_means(Relation *relation, size_t row, size_t wait, int64_t without) {
    Curves *curves = &relation->curves;
    for (size_t k = 0; k < curves->lags; k++) {
        const size_t first = row * relation->waits * curves->lags + k;
        curves->quiescent[k] = at_rest(relation, row, curves->times[k], without);
        curves->transient[k] = mean_without(relation->results, relation->sheared, first, without);
        curves->waited[k] = mean_without(relation->results, relation->sheared,
                                         first + wait * curves->lags, without);
    }
}

// Of one waiting strain: both predictions, and the best s in strain.
static double relate(Relation *relation, size_t row, size_t wait, int64_t without,
                     double *predicted[2]) {
    static const double LEAST = 1e-4, MOST = 10; // in strain, where s is looked for
    Curves *curves = &relation->curves;
    const ResultSeries *sheared = relation->sheared;
    const double waited = sheared->axis[sheared->axes - 2].values[wait] / relation->rate;
    const size_t bytes = curves->lags * sizeof(double);
    take_means(relation, row, wait, without);
    if (waited > 0)
        predict(curves, waited);
    else
        memcpy(curves->predicted, curves->transient, bytes);
    memcpy(predicted[AS_WAITED], curves->predicted, bytes);
    if (!(waited > 0)) {
        memcpy(predicted[BEST], curves->predicted, bytes);
        return 0;
    }
    const double s = best(curves, LEAST / relation->rate, MOST / relation->rate);
    predict(curves, s);
    memcpy(predicted[BEST], curves->predicted, bytes);
    return s * relation->rate;
}

// Pseudo-values of all replicas; `all` has room for two predictions.
static void derive_row(Relation *relation, size_t row, size_t wait, double *all[2]) {
    const size_t replicas = relation->results->replicas, lags = relation->curves.lags;
    const size_t index = row * relation->waits + wait, count = relation->rows * relation->waits;
    const double strain = relate(relation, row, wait, NOBODY, all);
    for (size_t r = 0; r < replicas; r++) {
        const size_t at = r * count + index;
        double *to[] = {relation->predicted[AS_WAITED] + at * lags,
                        relation->predicted[BEST] + at * lags};
        relation->strain[at] = relate(relation, row, wait, (int64_t)r, to);
    }
    pseudo_values(replicas, strain, relation->strain + index, count);
    for (size_t i = 0; i < 2 * lags; i++)
        pseudo_values(replicas, all[i / lags][i % lags],
                      relation->predicted[i / lags] + index * lags + i % lags, count * lags);
}

static Status put_series(Results *results, const ResultSeries *like, const char *name, size_t axes,
                         const double *values, size_t size) {
    ResultSeries shape = derive_shape(like, name);
    shape.axes = axes;
    if (axes < like->axes) shape.unit[0] = '\0';
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_series(results, &shape, r, values + r * size));
    }
    return OK;
}

static Status put(Results *results, const Relation *relation) {
    const ResultSeries like = *relation->sheared; // adding a series moves those that are there
    const size_t size = relation->rows * relation->waits;
    TRY(put_series(results, &like, "_relation", like.axes, relation->predicted[AS_WAITED],
                   size * relation->curves.lags));
    TRY(put_series(results, &like, "_relation_fitted", like.axes, relation->predicted[BEST],
                   size * relation->curves.lags));
    return put_series(results, &like, "_relation_strain", like.axes - 1, relation->strain, size);
}

static Status allocate(Relation *relation, double *room[2]) {
    const size_t lags = relation->curves.lags;
    const size_t size = relation->results->replicas * relation->rows * relation->waits;
    double **curves[] = {&relation->curves.quiescent,
                         &relation->curves.transient,
                         &relation->curves.waited,
                         &relation->curves.predicted,
                         &room[0],
                         &room[1]};
    for (size_t k = 0; k < sizeof curves / sizeof *curves; k++) TRY(NEW_ARRAY(*curves[k], lags));
    TRY(NEW_ARRAY(relation->predicted[AS_WAITED], size * lags));
    TRY(NEW_ARRAY(relation->predicted[BEST], size * lags));
    return NEW_ARRAY(relation->strain, size);
}

static void clear(Relation *relation, double *room[2]) {
    double *all[] = {relation->curves.quiescent,
                     relation->curves.transient,
                     relation->curves.waited,
                     relation->curves.predicted,
                     room[0],
                     room[1],
                     relation->predicted[AS_WAITED],
                     relation->predicted[BEST],
                     relation->strain};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) memory_free(all[k]);
}

// A stage with the same functions, among others perhaps, and no shear.
static const ResultSeries *quiescent_of(const Results *results, const ResultSeries *sheared) {
    for (size_t i = 0; i < results->series_count; i++) {
        const ResultSeries *rest = &results->series[i];
        if (strcmp(rest->observable, sheared->observable) != 0) continue;
        if (rest->axes + 1 != sheared->axes) continue;
        if (results_find_scalar(results, rest->stage, "shear_rate")) continue;
        if (derive_unsteady(results, rest->stage)) continue;
        if (derive_has_rows(sheared, rest, rest->axes - 1)) return rest;
    }
    return NULL;
}

static bool begins_with_the_transient(const ResultSeries *series) {
    if (series->axes < 2) return false;
    const ResultAxis *wait = &series->axis[series->axes - 2];
    return strcmp(wait->name, "waiting_strain") == 0 && wait->count > 1 && wait->values[0] == 0;
}

Status derive_transient(Results *results, const ResultSeries *sheared) {
    if (!begins_with_the_transient(sheared)) return OK;
    const ResultSeries *rest = quiescent_of(results, sheared);
    const ResultScalar *rate = results_find_scalar(results, sheared->stage, "shear_rate");
    if (!rest || !rate || results_find_scalar(results, sheared->stage, "shear_rate_before"))
        return OK;
    const ResultAxis *time = &sheared->axis[sheared->axes - 1];
    const size_t waits = sheared->axis[sheared->axes - 2].count;
    Relation relation = {
        .results = results,
        .rest = rest,
        .sheared = sheared,
        .rate = fabs(results_scalar_estimate(results, rate).value),
        .waits = waits,
        .rows = sheared->size / (waits * time->count),
        .curves = {.lags = time->count,
                   .times = time->values,
                   .differences = strstr(sheared->observable, "displacement") != NULL}};
    double *room[2] = {NULL, NULL};
    Status status = allocate(&relation, room);
    for (size_t i = 0; status == OK && i < relation.rows * waits; i++) {
        derive_row(&relation, i / waits, i % waits, room);
    }
    if (status == OK) status = put(results, &relation);
    clear(&relation, room);
    return status;
}
