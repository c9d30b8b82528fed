// SPDX-License-Identifier: GPL-3.0-or-later
// What the event-driven engine costs in its reference states: nanoseconds per particle and
// thermostat interval, collisions per second in the Newtonian mode, for each instruction set this
// processor has, and as ratios to the plain reference engine (linked cells and a heap), which is
// measured in turns with it. The states are packed and settled here, and the packing timed; user
// CPU seconds, medians of five.
#include "bench.h"
#include "reference_engine.h"

#include "base/cpu.h"
#include "base/memory.h"
#include "edbd/edbd.h"
#include "packing/packing.h"

#include <stdbool.h>
#include <string.h>

enum { REPEATS = 5 };
static const RngKey KEY = {.seed = 1};
static const double SETTLE_WINDOWS = 1e7; // particle windows, Newtonian, after packing
static const double WORK = 3e6;           // particle windows in one measurement
static const double REFERENCE_WORK = 2e5;

typedef struct Figure {
    double nanoseconds; // per particle and window
    double collisions;  // per second
    double rate;        // collisions per particle and window, each counted once
} Figure;

static void stop_if(Status status) {
    if (status == OK) return;
    fprintf(stderr, "bench_edbd: %s\n", status_sentence());
    exit(status);
}

static System system_of(int dimension, int64_t particles, double packing_fraction) {
    System system = {.dimension = dimension,
                     .particles = particles,
                     .packing_fraction = packing_fraction,
                     .species_count = dimension == 2 ? 2 : 1};
    for (size_t s = 0; s < system.species_count; s++) {
        system.species[s] = (Species){.shape = dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE,
                                      .diameter = s == 0 ? 1 : 1.4,
                                      .mass = 1,
                                      .fraction = 1.0 / (double)system.species_count};
    }
    return system;
}

static State *packed(const char *what, const System *system) {
    State *state = NULL;
    PackingReport packing;
    const double begin = bench_user_seconds();
    stop_if(packing_create(&state, system, KEY, NULL, &packing));
    char name[64];
    snprintf(name, sizeof name, "packing %dD %s %lld particles", (int)system->dimension, what,
             (long long)system->particles);
    bench_result(name, bench_user_seconds() - begin, "s");
    return state;
}

// The densest that issues from packing: binary discs at 0.81, polydisperse spheres at 0.58.
static void pack_densely(void) {
    const System discs = system_of(2, 1000, 0.81);
    System spheres = system_of(3, 1000, 0.58);
    spheres.species[0].spread = SPREAD_GAUSSIAN;
    spheres.species[0].spread_width = 0.1;
    state_free(packed("0.81", &discs));
    state_free(packed("0.58 polydisperse", &spheres));
}

static State *settled(int dimension, int64_t particles) {
    const System system = system_of(dimension, particles, dimension == 2 ? 0.79 : 0.50);
    Engine *engine = NULL;
    Tally tally = {0};
    const EngineSettings redrawn = {
        .window = 0.01, .windows_per_step = 50, .redraw = 1, .stream = STREAM_VELOCITY};
    State *state = packed(dimension == 2 ? "0.79" : "0.50", &system);
    stop_if(engine_create(&engine, &redrawn, state, KEY));
    stop_if(engine_advance(engine, (int64_t)(SETTLE_WINDOWS / (double)particles), &tally));
    engine_free(engine);
    return state;
}

static State *copy_of(const State *state) {
    State *copy = NULL;
    stop_if(state_create(&copy, &state->system));
    memcpy(copy->diameter, state->diameter, state->count * sizeof(double));
    for (int a = 0; a < state->box.dimension; a++) {
        memcpy(copy->position[a], state->position[a], state->count * sizeof(double));
        memcpy(copy->velocity[a], state->velocity[a], state->count * sizeof(double));
    }
    return copy;
}

static Figure figure_of(double seconds, double windows, double particles, const Tally *tally) {
    return (Figure){.nanoseconds = 1e9 * seconds / (windows * particles),
                    .collisions = (double)tally->collisions / seconds,
                    .rate = (double)tally->collisions / (windows * particles)};
}

// `strain`: of the flow in each step; 0: at rest.
static Figure engine_figure(const State *start, const EngineSettings *settings, CpuPath path,
                            double strain) {
    State *state = copy_of(start);
    Engine *engine = NULL;
    Tally tally = {0};
    const int64_t windows = (int64_t)(WORK / (double)state->count);
    setenv("PERRIN_CPU", cpu_path_name(path), 1);
    stop_if(engine_create(&engine, settings, state, KEY));
    const Flow flow = {.rate = strain};
    const EngineFlow steady = {.flow = &flow, .step_time = 1};
    if (strain > 0) stop_if(engine_shear(engine, &steady));
    stop_if(engine_advance(engine, windows / 10, &tally));
    tally = (Tally){0};
    const double begin = bench_user_seconds();
    stop_if(engine_advance(engine, windows, &tally));
    const double seconds = bench_user_seconds() - begin;
    engine_free(engine);
    const Figure figure = figure_of(seconds, (double)windows, (double)state->count, &tally);
    state_free(state);
    unsetenv("PERRIN_CPU");
    return figure;
}

static Figure reference_figure(const State *start, const EngineSettings *settings) {
    State *state = copy_of(start);
    Reference *reference = NULL;
    Tally tally = {0};
    const int64_t windows = (int64_t)(REFERENCE_WORK / (double)state->count);
    stop_if(reference_create(&reference, state, KEY, settings->window, settings->redraw, false));
    reference_advance(reference, 1, &tally);
    tally = (Tally){0};
    const double begin = bench_user_seconds();
    reference_advance(reference, windows, &tally);
    const double seconds = bench_user_seconds() - begin;
    reference_free(reference);
    const Figure figure = figure_of(seconds, (double)windows, (double)state->count, &tally);
    state_free(state);
    return figure;
}

static void report(const char *what, const EngineSettings *settings, Figure figure) {
    if (settings->redraw)
        bench_result(what, figure.nanoseconds, "ns per particle and interval");
    else
        bench_result(what, figure.collisions, "collisions per second");
}

static Figure median_of(Figure figures[REPEATS]) {
    double nanoseconds[REPEATS], collisions[REPEATS];
    for (int k = 0; k < REPEATS; k++) {
        nanoseconds[k] = figures[k].nanoseconds;
        collisions[k] = figures[k].collisions;
    }
    return (Figure){.nanoseconds = bench_median(nanoseconds, REPEATS),
                    .collisions = bench_median(collisions, REPEATS),
                    .rate = figures[0].rate};
}

// All instruction sets and the reference engine in turns, so that a busy moment meets all of them.
static void compare(const char *scene, const State *state, const EngineSettings *settings) {
    const int paths = (int)cpu_path() + 1;
    Figure figures[CPU_PATHS + 1][REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (int path = 0; path < paths; path++) {
            figures[path][repeat] = engine_figure(state, settings, (CpuPath)path, 0);
        }
        figures[CPU_PATHS][repeat] = reference_figure(state, settings);
    }
    char name[64];
    const Figure reference = median_of(figures[CPU_PATHS]);
    for (int path = paths - 1; path >= 0; path--) {
        const Figure figure = median_of(figures[path]);
        snprintf(name, sizeof name, "edbd %s %s", scene, cpu_path_name((CpuPath)path));
        report(name, settings, figure);
        snprintf(name, sizeof name, "edbd %s %s over reference", scene,
                 cpu_path_name((CpuPath)path));
        bench_result(name, reference.nanoseconds / figure.nanoseconds, "times faster");
    }
    snprintf(name, sizeof name, "edbd %s reference engine", scene);
    report(name, settings, reference);
    snprintf(name, sizeof name, "edbd %s collisions", scene);
    bench_result(name, figures[paths - 1][0].rate, "per particle and window (pairs once)");
}

// A flow of bare Peclet number 0.1, beside rest.
static void compare_sheared(const char *scene, const State *state, const EngineSettings *settings) {
    static const double PECLET = 0.1;
    const double interval = settings->window * (double)settings->windows_per_step;
    const double strain = PECLET * interval * interval / 2;
    Figure rest[REPEATS], sheared[REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        rest[repeat] = engine_figure(state, settings, cpu_path(), 0);
        sheared[repeat] = engine_figure(state, settings, cpu_path(), strain);
    }
    char name[80];
    snprintf(name, sizeof name, "edbd %s sheared", scene);
    report(name, settings, median_of(sheared));
    snprintf(name, sizeof name, "edbd %s sheared over rest", scene);
    bench_result(name, median_of(rest).nanoseconds / median_of(sheared).nanoseconds,
                 "of the speed at rest");
}

static void scenes_of(int dimension, const char *density) {
    State *state = settled(dimension, 1000);
    static const double intervals[] = {0.01, 0.001};
    char scene[48];
    for (int k = 0; k < 2; k++) {
        const EngineSettings brownian = {
            .window = intervals[k], .windows_per_step = 1, .redraw = 1, .stream = STREAM_VELOCITY};
        snprintf(scene, sizeof scene, "%dD %s Delta %g", dimension, density, intervals[k]);
        compare(scene, state, &brownian);
        compare_sheared(scene, state, &brownian);
    }
    const EngineSettings newtonian = {.window = 0.01, .windows_per_step = 1};
    snprintf(scene, sizeof scene, "%dD %s Newtonian", dimension, density);
    compare(scene, state, &newtonian);
    state_free(state);
}

// Larger systems on the best instruction set, against the same scene with 1000 particles.
static void size_of(int64_t particles) {
    State *state = settled(2, particles);
    const EngineSettings brownian = {
        .window = 0.01, .windows_per_step = 1, .redraw = 1, .stream = STREAM_VELOCITY};
    Figure figures[REPEATS];
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        figures[repeat] = engine_figure(state, &brownian, cpu_path(), 0);
    }
    char name[64];
    snprintf(name, sizeof name, "edbd 2D 0.79 Delta 0.01 %lld particles", (long long)particles);
    report(name, &brownian, median_of(figures));
    state_free(state);
}

int main(void) {
    pack_densely();
    scenes_of(2, "0.79");
    scenes_of(3, "0.50");
    size_of(10000);
    size_of(100000);
    return 0;
}
