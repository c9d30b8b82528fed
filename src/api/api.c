// SPDX-License-Identifier: GPL-3.0-or-later
// The public C functions: thin wrappers, so that nothing of the inside shows.
#include "perrin/perrin.h"

#include "base/memory.h"
#include "base/plain_locale.h"
#include "base/version.h"
#include "config/config.h"
#include "session/session.h"
#include "store/store.h"

#include <string.h>

_Static_assert((int)PERRIN_AXES_MOST == (int)RESULT_AXES,
               "a caller's perrin_series has room for all axes");

struct perrin_plan {
    Plan *plan;
};

struct perrin_run {
    Session *session;
};

struct perrin_results {
    Results *results;
};

const char *perrin_version(void) {
    return version_number();
}
const char *perrin_error(void) {
    return status_sentence();
}

static Status wrap_plan(perrin_plan **out, Plan *plan) {
    perrin_plan *wrapped = NULL;
    const Status status = NEW(wrapped);
    if (status != OK) {
        memory_free(plan);
        return status;
    }
    wrapped->plan = plan;
    *out = wrapped;
    return OK;
}

int perrin_plan_read(perrin_plan **out, const char *path, const char *const *settings) {
    IN_PLAIN_LOCALE;
    ConfigOverrides overrides = {.settings = settings};
    while (settings && settings[overrides.count]) overrides.count++;
    Plan *plan = NULL;
    TRY(config_read(&plan, path, &overrides));
    return wrap_plan(out, plan);
}

int perrin_plan_parse(perrin_plan **out, const char *name, const char *text) {
    IN_PLAIN_LOCALE;
    Plan *plan = NULL;
    TRY(config_read_text(&plan, name, text, strlen(text), NULL));
    return wrap_plan(out, plan);
}

void perrin_plan_free(perrin_plan *plan) {
    if (!plan) return;
    memory_free(plan->plan);
    memory_free(plan);
}

int perrin_run_start(perrin_run **out, const perrin_plan *plan, const char *directory,
                     int threads) {
    IN_PLAIN_LOCALE;
    perrin_run *run = NULL;
    TRY(NEW(run));
    const SessionWishes wishes = {.directory = directory, .threads = threads};
    const Status status = session_open(&run->session, plan->plan, &wishes);
    if (status != OK) {
        memory_free(run);
        return status;
    }
    *out = run;
    return OK;
}

double perrin_run_progress(const perrin_run *run) {
    return session_progress(run->session).fraction;
}

void perrin_run_stop(perrin_run *run) {
    session_stop(run->session);
}

static Status wrap_results(perrin_results **out, Results *results) {
    perrin_results *wrapped = NULL;
    const Status status = NEW(wrapped);
    if (status != OK) {
        results_free(results);
        return status;
    }
    wrapped->results = results;
    *out = wrapped;
    return OK;
}

int perrin_run_finish(perrin_run *run, perrin_results **out) {
    IN_PLAIN_LOCALE;
    Results *results = NULL;
    const char *note = NULL;
    const Status status = session_finish(run->session, &results, &note);
    session_close(run->session);
    memory_free(run);
    if (!results) return status;
    if (!out) {
        results_free(results);
        return status;
    }
    const Status wrapped = wrap_results(out, results);
    return wrapped != OK ? wrapped : status;
}

int perrin_results_read(perrin_results **out, const char *path) {
    IN_PLAIN_LOCALE;
    Results *results = NULL;
    TRY(store_read_results(&results, path));
    return wrap_results(out, results);
}

void perrin_results_free(perrin_results *results) {
    if (!results) return;
    results_free(results->results);
    memory_free(results);
}

size_t perrin_results_count(const perrin_results *results) {
    return results->results->scalar_count;
}

static perrin_quantity quantity_of(const Results *results, const ResultScalar *scalar) {
    const Estimate estimate = results_scalar_estimate(results, scalar);
    return (perrin_quantity){.stage = scalar->stage,
                             .name = scalar->quantity,
                             .unit = scalar->unit,
                             .about = scalar->about,
                             .value = estimate.value,
                             .error = estimate.error,
                             .n = estimate.n};
}

int perrin_results_at(const perrin_results *results, size_t index, perrin_quantity *out) {
    if (index >= results->results->scalar_count) {
        return status_fail(BAD_USAGE, "there is no quantity %zu of %zu", index,
                           results->results->scalar_count);
    }
    *out = quantity_of(results->results, &results->results->scalars[index]);
    return OK;
}

// Splits "stage/name"; a stage's name has no slash.
static Status split_name(const char *name, char stage[RESULT_NAME], const char **rest) {
    const char *slash = strchr(name, '/');
    const size_t length = slash ? (size_t)(slash - name) : RESULT_NAME;
    if (length >= RESULT_NAME) {
        return status_fail(BAD_USAGE, "'%.60s' is not a name like stage/quantity", name);
    }
    memcpy(stage, name, length);
    stage[length] = '\0';
    *rest = slash + 1;
    return OK;
}

int perrin_results_find(const perrin_results *results, const char *name, perrin_quantity *out) {
    char stage[RESULT_NAME];
    const char *quantity = NULL;
    TRY(split_name(name, stage, &quantity));
    const ResultScalar *scalar = results_find_scalar(results->results, stage, quantity);
    if (!scalar) return status_fail(BAD_USAGE, "there is no quantity '%.100s'", name);
    *out = quantity_of(results->results, scalar);
    return OK;
}

static Status find_series(const perrin_results *results, const char *name,
                          const ResultSeries **out) {
    char stage[RESULT_NAME];
    const char *observable = NULL;
    TRY(split_name(name, stage, &observable));
    *out = results_find_series(results->results, stage, observable);
    return *out ? OK : status_fail(BAD_USAGE, "there is no series '%.100s'", name);
}

int perrin_results_series(const perrin_results *results, const char *name, perrin_series *out) {
    const ResultSeries *series = NULL;
    TRY(find_series(results, name, &series));
    *out = (perrin_series){
        .unit = series->unit, .about = series->about, .axes = series->axes, .size = series->size};
    for (size_t a = 0; a < series->axes; a++) {
        out->count[a] = series->axis[a].count;
        out->axis_name[a] = series->axis[a].name;
        out->axis_unit[a] = series->axis[a].unit;
        out->axis_values[a] = series->axis[a].values;
        out->axis_labels[a] = series->axis[a].labels;
    }
    return OK;
}

int perrin_results_values(const perrin_results *results, const char *name, double *mean,
                          double *error) {
    const ResultSeries *series = NULL;
    TRY(find_series(results, name, &series));
    for (size_t i = 0; i < series->size; i++) {
        const Estimate estimate = results_series_estimate(results->results, series, i);
        if (mean) mean[i] = estimate.value;
        if (error) error[i] = estimate.error;
    }
    return OK;
}
