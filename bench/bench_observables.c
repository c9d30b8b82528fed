// SPDX-License-Identifier: GPL-3.0-or-later
// What the correlators cost: user CPU seconds of a stage that observes them over those of the same
// stage that observes nothing, less 1, in per cent, at the settings of examples/01: each alone, and
// all of them together. Medians of three, in turns. The most of it is the engine's, which is
// stopped at every look; those of several correlators are shared.
#include "bench.h"

#include "base/memory.h"
#include "protocol/replica.h"

#include <string.h>

enum { REPEATS = 3 };

static const ObservableKind *const correlators[] = {&observable_mean_squared_displacement,
                                                    &observable_self_scattering,
                                                    &observable_collective_scattering,
                                                    &observable_non_gaussian_parameter,
                                                    &observable_van_hove,
                                                    &observable_overlap};
enum { CORRELATORS = sizeof correlators / sizeof *correlators };

static void stop_if(Status status) {
    if (status == OK) return;
    fprintf(stderr, "bench_observables: %s\n", status_sentence());
    exit(status);
}

static Settings defaults_of(const OptionTable *options) {
    Settings settings = {{0}};
    for (size_t i = 0; i < options->count; i++) {
        const Option *row = &options->rows[i];
        const int64_t whole = (int64_t)row->fallback;
        const bool real = row->type == OPTION_REAL;
        memcpy(settings.bytes + row->offset, real ? (const void *)&row->fallback : &whole,
               sizeof whole);
    }
    return settings;
}

static void add_species(System *system, const char *name, double diameter) {
    Species *species = &system->species[system->species_count++];
    *species = (Species){.shape = SHAPE_DISC, .diameter = diameter, .mass = 1, .fraction = 0.5};
    strcpy(species->name, name);
}

// The stage `quiescent` of examples/01, which observes correlators [first, last).
static Plan *plan_with(size_t first, size_t last) {
    Plan *plan = NULL;
    stop_if(NEW(plan));
    plan->system = (System){.dimension = 2, .particles = 1000, .packing_fraction = 0.70};
    add_species(&plan->system, "small", 1);
    add_species(&plan->system, "big", 1.4);
    plan->ensemble = (EnsemblePlan){.replicas = 1, .seed = 1};
    plan->stage_count = 1;
    Stage *stage = &plan->stages[0];
    strcpy(stage->name, "quiescent");
    stage->time = 10;
    stage->dynamics.kind = &propagator_event_driven;
    stage->dynamics.settings = defaults_of(&propagator_event_driven.options);
    for (size_t k = first; k < last; k++) {
        Observation *observation = &stage->observations[stage->observation_count++];
        *observation = (Observation){.kind = correlators[k],
                                     .settings = defaults_of(&correlators[k]->options)};
    }
    return plan;
}

static double seconds_with(size_t first, size_t last) {
    Plan *plan = plan_with(first, last);
    Replica *replica = NULL;
    stop_if(replica_create(&replica, plan, 0, NULL));
    const double begin = bench_user_seconds();
    while (!replica_finished(replica)) stop_if(replica_advance(replica));
    const double seconds = bench_user_seconds() - begin;
    replica_free(replica);
    memory_free(plan);
    return seconds;
}

int main(void) {
    double shares[CORRELATORS + 1][REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double nothing = seconds_with(0, 0);
        for (size_t k = 0; k < CORRELATORS; k++)
            shares[k][repeat] = 100 * (seconds_with(k, k + 1) / nothing - 1);
        shares[CORRELATORS][repeat] = 100 * (seconds_with(0, CORRELATORS) / nothing - 1);
    }
    for (size_t k = 0; k <= CORRELATORS; k++) {
        char name[64];
        snprintf(name, sizeof name, "correlators %s",
                 k < CORRELATORS ? correlators[k]->name : "all together");
        bench_result(name, bench_median(shares[k], REPEATS), "per cent of propagation");
    }
    return 0;
}
