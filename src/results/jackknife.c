// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of whatever was calculated from samples, by leaving out some of them (Efron & Tibshirani,
// An Introduction to the Bootstrap, ch. 11): pseudo-values have as mean and standard error those of
// the jackknife.
#include "results/results.h"

#include "base/memory.h"
#include "numerics/jackknife.h"

#include <math.h>
#include <string.h>

// A number or a curve in each of the results: that of all samples, then those without a group.
typedef struct Passes {
    size_t groups, size;
    const double **values; // [1 + groups]; NULL: not there, or over other axes
    bool certain;          // a flag, or what is set and not calculated
} Passes;

static bool is_certain(const Passes *passes) {
    const double *whole = passes->values[0];
    bool same = true, integers = true;
    for (size_t g = 0; g <= passes->groups; g++) {
        const double *values = passes->values[g];
        if (!values) return false;
        same = same && memcmp(values, whole, passes->size * sizeof *values) == 0;
        for (size_t i = 0; i < passes->size; i++)
            integers = integers && values[i] == rint(values[i]);
    }
    return same || integers;
}

static bool has_errors(const Passes *passes, size_t element) {
    for (size_t g = 0; g <= passes->groups; g++) {
        if (!passes->values[g] || !isfinite(passes->values[g][element])) return false;
    }
    return true;
}

// Of one group. What has no error stands in the first place alone, as of all samples.
static void values_of_group(const Passes *passes, size_t group, double *out) {
    const double *whole = passes->values[0], *without = passes->values[group + 1];
    for (size_t i = 0; i < passes->size; i++) {
        if (!passes->certain && has_errors(passes, i))
            out[i] = pseudo_value(passes->groups, whole[i], without[i]);
        else
            out[i] = group == 0 ? whole[i] : (double)NAN;
    }
}

static bool same_axis(const ResultAxis *a, const ResultAxis *b) {
    if (a->count != b->count || strcmp(a->name, b->name) != 0) return false;
    if (a->labels) return b->labels != NULL;
    return b->values && memcmp(a->values, b->values, a->count * sizeof *a->values) == 0;
}

static bool same_axes(const ResultSeries *a, const ResultSeries *b) {
    if (a->axes != b->axes) return false;
    for (size_t i = 0; i < a->axes; i++) {
        if (!same_axis(&a->axis[i], &b->axis[i])) return false;
    }
    return true;
}

static Status put_series(Results *results, const ResultSeries *shape, const Passes *passes) {
    double *values = NULL;
    TRY(NEW_ARRAY(values, passes->size));
    Status status = OK;
    for (size_t g = 0; g < passes->groups && status == OK; g++) {
        values_of_group(passes, g, values);
        status = results_put_series(results, shape, g, values);
    }
    memory_free(values);
    return status;
}

static Status combine_series(Results *results, Results *const *from, Passes *passes) {
    for (size_t i = 0; i < from[0]->series_count; i++) {
        const ResultSeries *whole = &from[0]->series[i];
        passes->size = whole->size;
        for (size_t g = 0; g <= passes->groups; g++) {
            const ResultSeries *one = results_find_series(from[g], whole->stage, whole->observable);
            passes->values[g] = one && same_axes(one, whole) ? one->values : NULL;
        }
        passes->certain = is_certain(passes);
        TRY(put_series(results, whole, passes));
    }
    return OK;
}

static Status combine_scalars(Results *results, Results *const *from, Passes *passes) {
    passes->size = 1;
    for (size_t i = 0; i < from[0]->scalar_count; i++) {
        const ResultScalar *whole = &from[0]->scalars[i];
        for (size_t g = 0; g <= passes->groups; g++) {
            const ResultScalar *one = results_find_scalar(from[g], whole->stage, whole->quantity);
            passes->values[g] = one ? one->values : NULL;
        }
        passes->certain = is_certain(passes);
        for (size_t g = 0; g < passes->groups; g++) {
            double value;
            values_of_group(passes, g, &value);
            TRY(results_put_scalar(results, whole->stage, whole->quantity, whole->unit,
                                   whole->about, g, value));
        }
    }
    return OK;
}

Status results_jackknife(Results *results, Results *const *from, size_t groups) {
    Passes passes = {.groups = groups};
    ASSERT(groups >= 2 && groups <= results->replicas);
    TRY(NEW_ARRAY(passes.values, groups + 1));
    Status status = combine_series(results, from, &passes);
    if (status == OK) status = combine_scalars(results, from, &passes);
    memory_free(passes.values);
    for (size_t i = 0; i < from[0]->health_count && status == OK; i++) {
        const ResultCounter *counter = &from[0]->health[i];
        status = results_put_health(results, counter->name, counter->about, counter->limit,
                                    counter->value);
    }
    return status;
}
