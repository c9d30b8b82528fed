// SPDX-License-Identifier: GPL-3.0-or-later
// What the effective friction of a pulled tracer costs at packing fraction 0.5 and Pe = 10: soft
// spheres by Monte Carlo at two steps, hard ones by event-driven dynamics; user seconds for a unit
// of time, and to 5 % of statistical error (what the step leaves is not in it: the two steps show
// it). Beside it what Langevin dynamics of the same soft spheres takes for a unit of time with its
// largest stable step.
#include "bench.h"

#include "analysis/analysis.h"
#include "base/memory.h"
#include "protocol/replica.h"

#include <math.h>
#include <string.h>

enum { PARTICLES = 1000, REPLICAS = 8 };
static const double PERIOD = 3, REST = 0.2, PERIODS = 2, ACCURACY = 0.05; // in d^2/D0

// CPU seconds for d^2/D0 of 1024 of these spheres by LAMMPS (2022), steps of 5e-5 d^2/D0; on
// another machine, an AVX-512 server near 3.7 GHz.
static const double LANGEVIN_SECONDS = 2.9, LANGEVIN_PARTICLES = 1024;

typedef struct Way {
    const char *name;
    ShapeKind shape;
    const PropagatorKind *kind;
    const char *key; // of its step
    double step;
} Way;

static void stop_if(Status status) {
    if (status == OK) return;
    fprintf(stderr, "bench_pull: %s\n", status_sentence());
    exit(status);
}

static void set(Settings *settings, const OptionTable *options, const char *name, double value) {
    for (size_t i = 0; i < options->count; i++) {
        const Option *row = &options->rows[i];
        if (strcmp(row->name, name) != 0) continue;
        const int64_t whole = (int64_t)value;
        memcpy(settings->bytes + row->offset,
               row->type == OPTION_REAL ? (const void *)&value : (const void *)&whole,
               sizeof value);
    }
}

static Settings defaults(const OptionTable *options) {
    Settings settings = {{0}};
    for (size_t i = 0; i < options->count; i++)
        set(&settings, options, options->rows[i].name, options->rows[i].fallback);
    return settings;
}

static System system_of(ShapeKind shape) {
    System system = {.dimension = 3,
                     .particles = PARTICLES,
                     .packing_fraction = 0.5,
                     .aspect = {3, {2, 1, 1}},
                     .species_count = 2};
    for (size_t s = 0; s < 2; s++)
        system.species[s] = (Species){.shape = shape, .diameter = 1, .mass = 1, .exponent = 36};
    strcpy(system.species[0].name, "bath");
    strcpy(system.species[1].name, "tracer");
    system.species[0].fraction = 1;
    system.species[1].count = 1;
    return system;
}

static void fill(Plan *plan, const Way *way) {
    Stage *settle = &plan->stages[0], *pulled = &plan->stages[1];
    plan->system = system_of(way->shape);
    plan->ensemble = (EnsemblePlan){.replicas = REPLICAS, .seed = 1};
    plan->stage_count = 2;
    strcpy(settle->name, "settle");
    settle->time = 1000;
    settle->dynamics.kind = &propagator_monte_carlo;
    settle->dynamics.settings = defaults(&propagator_monte_carlo.options);
    strcpy(pulled->name, "pulled");
    pulled->time = PERIOD * PERIODS;
    pulled->dynamics.kind = way->kind;
    pulled->dynamics.settings = defaults(&way->kind->options);
    set(&pulled->dynamics.settings, &way->kind->options, way->key, way->step);
    set(&pulled->dynamics.settings, &way->kind->options, "clock", 0); // acceptance-rescaling
    set(&pulled->dynamics.settings, &way->kind->options, "calibration", 4000);
    strcpy(pulled->drive.pull.species, "tracer");
    pulled->drive.pull.peclet = 10;
    pulled->drive.pull.period = PERIOD;
    pulled->drive.pull.rest = REST;
    pulled->observation_count = 1;
    pulled->observations[0] = (Observation){
        .kind = &observable_pulled_tracer, .settings = defaults(&observable_pulled_tracer.options)};
}

// All replicas; user seconds of the stages in which the tracer is pulled.
static double run(const Plan *plan, Results *results) {
    double seconds = 0;
    for (size_t r = 0; r < REPLICAS; r++) {
        Replica *replica = NULL;
        stop_if(replica_create(&replica, plan, r, NULL));
        while (replica_stage(replica) == 0) stop_if(replica_advance(replica));
        const double begin = bench_user_seconds();
        while (!replica_finished(replica)) stop_if(replica_advance(replica));
        seconds += bench_user_seconds() - begin;
        stop_if(replica_write(replica, results));
        replica_free(replica);
    }
    return seconds;
}

static void report(const Way *way) {
    Plan *plan = NULL;
    Results *results = NULL;
    stop_if(NEW(plan));
    fill(plan, way);
    stop_if(plan_check(plan));
    stop_if(results_create(&results, REPLICAS));
    const double seconds = run(plan, results);
    stop_if(analysis_derive(results, &plan->system));
    const Estimate friction = results_scalar_estimate(
        results, results_find_scalar(results, "pulled", "effective_friction"));
    const double off = friction.error / friction.value / ACCURACY;
    char name[96];
    snprintf(name, sizeof name, "pull %s %g: 1 d^2/D0 of 1000", way->name, way->step);
    bench_result(name, seconds / (REPLICAS * PERIODS * PERIOD), "s");
    snprintf(name, sizeof name, "pull %s %g: friction", way->name, way->step);
    bench_result(name, friction.value, "");
    snprintf(name, sizeof name, "pull %s %g: its error here", way->name, way->step);
    bench_result(name, friction.error, "");
    snprintf(name, sizeof name, "pull %s %g: friction to 5 %%", way->name, way->step);
    bench_result(name, seconds * off * off, "s");
    results_free(results);
    memory_free(plan);
}

int main(void) {
    static const Way ways[] = {
        {"soft dmc step", SHAPE_SOFT_SPHERE, &propagator_dynamic_monte_carlo, "step", 0.05},
        {"soft dmc step", SHAPE_SOFT_SPHERE, &propagator_dynamic_monte_carlo, "step", 0.03},
        {"hard edbd interval", SHAPE_SPHERE, &propagator_event_driven, "thermostat_interval", 0.02},
    };
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) report(&ways[w]);
    bench_result("pull soft Langevin 5e-5: 1 d^2/D0 of 1000",
                 LANGEVIN_SECONDS * PARTICLES / LANGEVIN_PARTICLES, "s, quoted");
    return 0;
}
