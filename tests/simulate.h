// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the physics tests: a plan of two stages, `settle` and `measured`, run replica by
// replica in this thread, and comparisons in standard errors that say what was found.
#pragma once

#include "analysis/analysis.h"
#include "base/memory.h"
#include "observe.h"
#include "protocol/replica.h"
#include "suite.h"

// Event-driven Brownian dynamics of `system`: settled for `settle` d sqrt(m/kT) of Newtonian
// flight, then measured for `time` d^2/D0.
static inline Plan *new_plan(System system, double interval, double settle, double time,
                             int64_t replicas) {
    Plan *plan = NULL;
    ck_assert_int_eq(NEW(plan), OK);
    plan->system = system;
    plan->ensemble = (EnsemblePlan){.replicas = replicas, .seed = 20261125};
    plan->stage_count = 2;
    Stage *settling = &plan->stages[0], *measured = &plan->stages[1];
    strcpy(settling->name, "settle");
    settling->time = settle;
    settling->dynamics.kind = &propagator_newtonian;
    settling->dynamics.settings = settings_of(&propagator_newtonian.options);
    strcpy(measured->name, "measured");
    measured->time = time;
    measured->dynamics.kind = &propagator_event_driven;
    measured->dynamics.settings = settings_of(&propagator_event_driven.options);
    set_number(&measured->dynamics.settings, &propagator_event_driven.options,
               "thermostat_interval", interval);
    return plan;
}

// Adds an observable to the last stage; its settings can then be changed.
static inline Settings *observe(Plan *plan, const ObservableKind *kind) {
    Stage *stage = &plan->stages[plan->stage_count - 1];
    Observation *observation = &stage->observations[stage->observation_count++];
    *observation = (Observation){.kind = kind, .settings = settings_of(&kind->options)};
    return &observation->settings;
}

static inline void run_replica(const Plan *plan, size_t index, Results *results) {
    Replica *replica = NULL;
    ck_assert_msg(replica_create(&replica, plan, index, NULL) == OK, "%s", status_sentence());
    while (!replica_finished(replica)) {
        ck_assert_msg(replica_advance(replica) == OK, "%s", status_sentence());
    }
    ck_assert_uint_eq(replica_overlaps(replica), 0);
    ck_assert_int_eq(replica_write(replica, results), OK);
    replica_free(replica);
}

// Runs and frees the plan.
static inline Results *simulate(Plan *plan) {
    ck_assert_msg(plan_check(plan) == OK, "%s", status_sentence());
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, (size_t)plan->ensemble.replicas), OK);
    for (size_t r = 0; r < (size_t)plan->ensemble.replicas; r++) run_replica(plan, r, results);
    ck_assert_int_eq(analysis_derive(results, &plan->system), OK);
    memory_free(plan);
    return results;
}

static inline Estimate measured(const Results *results, const char *quantity) {
    const ResultScalar *scalar = results_find_scalar(results, "measured", quantity);
    ck_assert_msg(scalar != NULL, "no scalar 'measured/%s'", quantity);
    return results_scalar_estimate(results, scalar);
}

// An element of a series of the stage `measured`.
static inline Estimate measured_at(const Results *results, const char *observable, size_t element) {
    const ResultSeries *series = series_of(results, "measured", observable);
    ck_assert_uint_lt(element, series->size);
    return results_series_estimate(results, series, element);
}

// Fails unless `found` is within `sigmas` combined standard errors of what is expected, `known`
// being the uncertainty of that; and unless the test is sharp: an error below `precision` times the
// value.
static inline void expect_within(const char *what, Estimate found, double expected, double known,
                                 double sigmas, double precision) {
    const double error = sqrt(found.error * found.error + known * known);
    const double deviation = (found.value - expected) / error;
    printf("%-58s %10.5f +- %.5f  expected %10.5f +- %.5f  %+.2f\n", what, found.value, found.error,
           expected, known, deviation);
    ck_assert_msg(fabs(deviation) <= sigmas,
                  "%s: %g +- %g, expected %g +- %g: %.1f standard errors", what, found.value,
                  found.error, expected, known, deviation);
    ck_assert_msg(error <= precision * fabs(expected), "%s: an error of %g tests nothing", what,
                  error);
}

// A case of its own for each test, so that CK_RUN_CASE=NAME runs it alone; `count` loops.
#define ADD_CASE(suite, test, count)                                                               \
    do {                                                                                           \
        TCase *added = tcase_create(#test);                                                        \
        tcase_set_timeout(added, 300);                                                             \
        tcase_add_loop_test(added, test, 0, (int)(count));                                         \
        suite_add_tcase(suite, added);                                                             \
    } while (0)
