// SPDX-License-Identifier: GPL-3.0-or-later
// What the correlators cost: CPU seconds of stretches that are observed over those of stretches
// that are not, less 1, in per cent, at the settings of examples/01: each alone, and all of them
// together. Both are of one engine, by turns, since where its arrays happen to lie makes more
// difference than observing; medians over pairs of stretches. Much of it is the engine's, which is
// stopped at every look; those of several correlators are shared.
#include "bench.h"

#include "observables/observables.h"
#include "packing/packing.h"

#include <string.h>

enum { STRETCHES = 200, TICKS = 1000 };

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

// The stage `quiescent` of examples/01: 10 d^2/D0.
typedef struct Bench {
    State *state;
    Propagator *propagator;
    Tally tally;
    Observer *observers[CORRELATORS]; // NULL: not there
    int64_t tick;                     // of what is observed
} Bench;

static void bench_begin(Bench *bench) {
    const PropagatorKind *kind = &propagator_event_driven;
    const RngKey key = {.seed = 1};
    PackingReport report;
    System system = {.dimension = 2, .particles = 1000, .packing_fraction = 0.70};
    add_species(&system, "small", 1);
    add_species(&system, "big", 1.4);
    const Settings settings = defaults_of(&kind->options);
    stop_if(packing_create(&bench->state, &system, key, NULL, &report));
    stop_if(kind->create(&bench->propagator, &settings, bench->state, key));
}

static void bench_end(Bench *bench) {
    bench->propagator->kind->free(bench->propagator);
    state_free(bench->state);
}

static void begin_observing(Bench *bench, size_t first, size_t last) {
    const Settings settings = defaults_of(&propagator_event_driven.options);
    const Clock clock = {.tick = propagator_event_driven.tick(&settings, &bench->state->system),
                         .flight_time = propagator_event_driven.flight_time(&settings),
                         .ticks = (int64_t)STRETCHES * TICKS,
                         .ticks_per_step = 1,
                         .unit = propagator_event_driven.time_unit,
                         .stage = "quiescent",
                         .flies = true,
                         .thermostatted = true};
    bench->tick = 0;
    for (size_t k = first; k < last; k++) {
        const Settings chosen = defaults_of(&correlators[k]->options);
        stop_if(correlators[k]->create(&bench->observers[k], &chosen, bench->state, &clock));
    }
}

static void end_observing(Bench *bench) {
    for (size_t k = 0; k < CORRELATORS; k++) {
        if (bench->observers[k]) bench->observers[k]->kind->free(bench->observers[k]);
        bench->observers[k] = NULL;
    }
}

static void advance(Bench *bench, int64_t ticks) {
    stop_if(bench->propagator->kind->advance(bench->propagator, ticks, &bench->tally));
}

// To the next look, as protocol/replica.c does.
static void advance_observed(Bench *bench, int64_t end) {
    const int64_t before = bench->tick;
    int64_t after = end;
    for (size_t k = 0; k < CORRELATORS; k++) {
        const Observer *observer = bench->observers[k];
        if (!observer) continue;
        const int64_t wish = observer->kind->next(observer, before);
        if (wish < after) after = wish;
    }
    advance(bench, after - before);
    bench->tick = after;
    for (size_t k = 0; k < CORRELATORS; k++) {
        Observer *observer = bench->observers[k];
        if (!observer || observer->kind->next(observer, before) != after) continue;
        stop_if(observer->kind->see(observer, after, bench->state, &bench->tally));
    }
}

static double share(Bench *bench, size_t first, size_t last) {
    double shares[STRETCHES];
    begin_observing(bench, first, last);
    for (size_t k = 0; k < STRETCHES; k++) {
        const double begin = bench_cpu_seconds();
        advance(bench, TICKS);
        const double middle = bench_cpu_seconds();
        while (bench->tick < (int64_t)(k + 1) * TICKS)
            advance_observed(bench, (int64_t)(k + 1) * TICKS);
        shares[k] = 100 * ((bench_cpu_seconds() - middle) / (middle - begin) - 1);
    }
    end_observing(bench);
    return bench_median(shares, STRETCHES);
}

int main(void) {
    static Bench bench;
    bench_begin(&bench);
    for (size_t k = 0; k <= CORRELATORS; k++) {
        const bool one = k < CORRELATORS;
        char name[64];
        snprintf(name, sizeof name, "correlators %s", one ? correlators[k]->name : "all together");
        bench_result(name, share(&bench, one ? k : 0, one ? k + 1 : CORRELATORS),
                     "per cent of propagation");
    }
    bench_end(&bench);
    return 0;
}
