// SPDX-License-Identifier: GPL-3.0-or-later
// Laws over the states of a sweep, with the jackknife's errors.
#include "analysis/sweep.h"

#include "analysis/analysis.h"
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double mean_without(const Results *results, const ResultSeries *series, size_t element,
                           int64_t without) {
    double sum = 0, n = 0;
    for (size_t r = 0; r < results->replicas; r++) {
        const double value = series->values[r * series->size + element];
        if ((int64_t)r == without || isnan(value)) continue;
        sum += value;
        n++;
    }
    return n > 0 ? sum / n : (double)NAN;
}

enum { NOBODY = -1 };

static void see_states(const Sweep *sweep, size_t row, int64_t without, States *states) {
    const size_t first = row / sweep->inner * sweep->inner * states->count + row % sweep->inner;
    for (size_t i = 0; i < states->count; i++) {
        const size_t element = first + i * sweep->inner;
        states->mean[i] = mean_without(sweep->results, &sweep->series, element, without);
        states->error[i] = results_series_estimate(sweep->results, &sweep->series, element).error;
        states->beside[i] = NAN;
        if (!sweep->beside) continue;
        states->beside[i] = mean_without(sweep->results, sweep->beside,
                                         element - element % sweep->beside_waves, without);
    }
}

static void apply_to_row(const Sweep *sweep, Law *law, size_t row, double *all) {
    const size_t replicas = sweep->results->replicas, stride = sweep->rows * sweep->numbers;
    double *values = sweep->values + row * sweep->numbers;
    const ResultAxis *axis = &sweep->series.axis[sweep->axis];
    States states = {.count = axis->count, .at = axis->values};
    see_states(sweep, row, NOBODY, &states);
    law(&states, all);
    for (size_t r = 0; r < replicas; r++) {
        see_states(sweep, row, (int64_t)r, &states);
        law(&states, values + r * stride);
    }
    for (size_t k = 0; k < sweep->numbers; k++) pseudo_values(replicas, all[k], values + k, stride);
}

static Status apply(Sweep *sweep, Law *law) {
    double *numbers = NULL;
    TRY(NEW_ARRAY(sweep->values, sweep->results->replicas * sweep->rows * sweep->numbers));
    TRY(NEW_ARRAY(numbers, sweep->numbers));
    for (size_t row = 0; row < sweep->rows; row++) apply_to_row(sweep, law, row, numbers);
    memory_free(numbers);
    return OK;
}

static size_t part_size(const Part *part) {
    size_t size = 1;
    for (size_t a = 0; a < part->axes; a++) size *= part->axis[a].count;
    return size;
}

void sweep_name(char name[RESULT_NAME], const char *observable, const char *ending,
                const char *part) {
    const size_t length = strlen(observable) - strlen(ending);
    snprintf(name, RESULT_NAME, "%.*s%s%s", (int)length, observable, length > 0 ? "_" : "", part);
}

static void shape_part(ResultSeries *shape, const Sweep *sweep, const char *ending,
                       const Part *part) {
    char name[RESULT_NAME];
    sweep_name(name, sweep->series.observable, ending, part->name);
    *shape = derive_shape(&sweep->series, name);
    snprintf(shape->unit, sizeof shape->unit, "%s", part->unit ? part->unit : "");
    shape->axes = 0;
    for (size_t a = 0; a < sweep->series.axes; a++) {
        if (a != sweep->axis) shape->axis[shape->axes++] = sweep->series.axis[a];
    }
    for (size_t a = 0; a < part->axes; a++) shape->axis[shape->axes++] = part->axis[a];
}

// Of the other keys of the sweep none may have the name of an axis of the part, such as an
// exponent.
static bool fits(const Sweep *sweep, const Part *part) {
    if (sweep->series.axes - 1 + part->axes > RESULT_AXES) return false;
    for (size_t a = 0; a < sweep->series.axes; a++) {
        for (size_t b = 0; b < part->axes && a != sweep->axis; b++) {
            if (strcmp(sweep->series.axis[a].name, part->axis[b].name) == 0) return false;
        }
    }
    return true;
}

static Status put_part(Results *results, const Sweep *sweep, const char *ending, const Part *part) {
    ResultSeries shape;
    double *some = NULL;
    const size_t size = part_size(part);
    if (!fits(sweep, part)) return OK;
    shape_part(&shape, sweep, ending, part);
    TRY(NEW_ARRAY(some, sweep->rows * size));
    Status status = OK;
    for (size_t r = 0; r < results->replicas && status == OK; r++) {
        for (size_t row = 0; row < sweep->rows; row++) {
            const double *numbers = sweep->values + (r * sweep->rows + row) * sweep->numbers;
            memcpy(some + row * size, numbers + part->first, size * sizeof *some);
        }
        if (shape.axes > 0)
            status = results_put_series(results, &shape, r, some);
        else
            status = results_put_scalar(results, shape.stage, shape.observable, shape.unit, NULL, r,
                                        *some);
    }
    memory_free(some);
    return status;
}

bool sweep_make(Sweep *sweep, const Results *results, const ResultSeries *series,
                const char *name) {
    *sweep = (Sweep){
        .results = results, .series = *series, .axis = series->axes, .inner = 1, .beside_waves = 1};
    for (size_t a = 0; a < series->axes; a++) {
        const ResultAxis *axis = &series->axis[a];
        if (strcmp(axis->name, name) == 0 && axis->values) sweep->axis = a;
    }
    if (sweep->axis == series->axes) return false;
    for (size_t a = sweep->axis + 1; a < series->axes; a++) sweep->inner *= series->axis[a].count;
    const size_t count = series->axis[sweep->axis].count;
    sweep->rows = series->size / count;
    return count >= 2 && count <= STATES_MOST;
}

Status sweep_put(Results *results, Sweep *sweep, Law *law, const char *ending, const Part *parts,
                 size_t count) {
    Status status = apply(sweep, law);
    for (size_t p = 0; p < count && status == OK; p++)
        status = put_part(results, sweep, ending, &parts[p]);
    memory_free(sweep->values);
    return status;
}

// Whether the name is this ending, or ends in it where that begins with '_'.
static bool ends_in(const char *name, const char *ending) {
    const size_t length = strlen(name), tail = strlen(ending);
    if (ending[0] != '_') return strcmp(name, ending) == 0;
    return length > tail && strcmp(name + length - tail, ending) == 0;
}

// Whether a stage flows, as its correlators tell: a flow makes it relax at any packing fraction.
static bool flows(const Results *results, const char *stage) {
    static const char *const rates[] = {"shear_rate", "largest_shear_rate"};
    for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
        if (results_find_series(results, stage, rates[i])) return true;
    }
    return false;
}

static Status derive_from(Results *results, const ResultSeries *series) {
    static const struct {
        const char *ending, *axis;
        Status (*derive)(Results *results, Sweep *sweep);
    } laws[] = {{"_relaxation_time", "packing_fraction", derive_power_law},
                {"_scaled", "packing_fraction", derive_master_curve},
                {"_plateau", "packing_fraction", derive_square_root_law},
                {"shear_stress", "shear_rate", derive_flow_curve}};
    Sweep sweep;
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        if (!ends_in(series->observable, laws[i].ending)) continue;
        const bool of_a_transition = strcmp(laws[i].axis, "packing_fraction") == 0;
        if (of_a_transition && flows(results, series->stage)) return OK;
        return sweep_make(&sweep, results, series, laws[i].axis) ? laws[i].derive(results, &sweep)
                                                                 : OK;
    }
    return OK;
}

Status analysis_derive_sweep(Results *results) {
    const size_t count = results->series_count; // what is added is not looked at
    for (size_t i = 0; i < count; i++) TRY(derive_from(results, &results->series[i]));
    return OK;
}
