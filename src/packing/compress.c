// SPDX-License-Identifier: GPL-3.0-or-later
// Slow compression of bodies by Monte Carlo. After every cycle of trials all sizes grow a little;
// bodies that then overlap are moved by trials of their own until they do not, so that no single
// pair holds the others up. How much is halved where that fails and doubled slowly where it
// succeeds, but never more than what moves of this length relax: where steps become short, growth
// becomes slow, and what wants to align has time to. In the box of the end that is compression at
// constant shape.
#include "packing/compress.h"

#include "base/memory.h"
#include "dmc/dmc.h"

#include <math.h>

static const int64_t MELT_CYCLES = 200;          // of the dilute start, at the first scale
static const int64_t CYCLES_MOST = 100000;       // then it is jammed
static const int64_t TUNE_CYCLES = 10;           // between adjustments of the steps
static const double ACCEPTANCE[2] = {0.3, 0.5};  // wanted between
static const double SHORTER = 0.8, LONGER = 1.2; // steps, where it is not
static const double STEP = 0.2, STEP_MOST = 2;   // half-width, in d of the species; first, largest
static const double TURN_MOST = 0.5;             // of a tangent rotation
static const double GROWTH = 1e-3, GROWTH_MOST = 4e-3; // of the scale in a cycle; first, largest
static const double FASTER = 1.4, SLOWER = 0.6;        // growth, after it succeeded or failed
static const double RELAXED = 0.012; // largest growth, of the square of the step in diameters

typedef struct Compression {
    State *state;
    Chain *chain;
    const atomic_int *stop;
    Tally tally; // since the steps were adjusted
    double step[SPECIES_MOST];
    double scale, growth;
    int64_t cycles;
} Compression;

// Uniform on the sphere, without a function of the C library: points of a cube that lie in its
// ball.
static void draw_axis(Rng *rng, double axis[3]) {
    static const double INNER2 = 1e-4; // nearer to the middle, digits of the direction are lost
    double square;
    do {
        square = 0;
        for (int a = 0; a < 3; a++) {
            axis[a] = 2 * rng_uniform(rng) - 1;
            square += axis[a] * axis[a];
        }
    } while (!(square > INNER2 && square < 1));
    const double length = sqrt(square);
    for (int a = 0; a < 3; a++) axis[a] /= length;
}

static void turn_axes(State *state, RngKey key) {
    for (size_t i = 0; i < state->count; i++) {
        const Species *species = &state->system.species[state->species_of[i]];
        if (!shape_is_oriented((ShapeKind)species->shape)) continue;
        double axis[3];
        Rng rng = rng_open(key, STREAM_ORIENTING, 0, i);
        draw_axis(&rng, axis);
        for (int a = 0; a < 3; a++) state->orientation[a][i] = axis[a];
    }
}

// The ends of a body move as far by its rotation as by its translation.
static void set_step(Compression *compression, size_t s) {
    const Body body = species_body(&compression->state->system.species[s]);
    const double step = compression->step[s];
    const double turn = fmin(TURN_MOST, 2 * step / shape_reach(&body));
    const Amplitude amplitude = {.parallel = step, .perpendicular = step, .rotation = turn};
    chain_set_amplitude(compression->chain, s, &amplitude);
}

static void tune(Compression *compression) {
    const System *system = &compression->state->system;
    for (size_t s = 0; s < system->species_count; s++) {
        const MoveTally *moves = &compression->tally.moves[s];
        if (!moves->trials) continue;
        const double accepted = (double)moves->accepted / (double)moves->trials;
        double *step = &compression->step[s];
        if (accepted < ACCEPTANCE[0]) *step *= SHORTER;
        if (accepted > ACCEPTANCE[1]) *step *= LONGER;
        *step = fmin(*step, STEP_MOST * system->species[s].diameter);
        set_step(compression, s);
    }
    compression->tally = (Tally){0};
}

static Status run_cycle(Compression *compression) {
    if (compression->stop && atomic_load(compression->stop)) {
        return status_fail(INTERRUPTED, "stopped while packing");
    }
    TRY(chain_run(compression->chain, (int64_t)compression->state->count, &compression->tally));
    if (++compression->cycles % TUNE_CYCLES == 0) tune(compression);
    return OK;
}

static double largest_growth(const Compression *compression) {
    double largest = GROWTH_MOST;
    for (size_t s = 0; s < compression->state->system.species_count; s++) {
        const double step = compression->step[s] / compression->state->system.species[s].diameter;
        largest = fmin(largest, RELAXED * step * step);
    }
    return largest;
}

static void grow(Compression *compression) {
    compression->growth = fmin(compression->growth, largest_growth(compression));
    const double wanted = fmin(1 + COMPRESS_MARGIN, compression->scale * (1 + compression->growth));
    const bool fits = chain_squeeze(compression->chain, wanted);
    compression->growth *= fits ? FASTER : SLOWER;
    if (fits) compression->scale = wanted;
}

static Status fail_jammed(const Compression *compression) {
    const double scale = compression->scale;
    const System *system = &compression->state->system;
    return status_fail(UNHEALTHY,
                       "compression jams: after %lld cycles the bodies have %.4g of their sizes, "
                       "which is number_density = %.4g instead of %.4g; try start: crystal",
                       (long long)compression->cycles, scale,
                       system_number_density(system) * scale * scale * scale,
                       system_number_density(system));
}

static Status squeeze(Compression *compression) {
    while (compression->cycles < MELT_CYCLES) TRY(run_cycle(compression));
    while (compression->scale < 1 + COMPRESS_MARGIN) {
        if (compression->cycles == CYCLES_MOST) return fail_jammed(compression);
        TRY(run_cycle(compression));
        grow(compression);
    }
    chain_publish(compression->chain);
    return OK;
}

Status compress_bodies(State *state, RngKey key, double scale, const atomic_int *stop,
                       PackingReport *report) {
    const ChainSettings settings = {
        .stream = STREAM_SQUEEZING, .rotation = ROTATION_TANGENT, .scale = scale};
    Compression compression = {.state = state, .stop = stop, .scale = scale, .growth = GROWTH};
    turn_axes(state, key);
    TRY(chain_create(&compression.chain, &settings, state, key));
    for (size_t s = 0; s < state->system.species_count; s++) {
        compression.step[s] = STEP * state->system.species[s].diameter;
        set_step(&compression, s);
    }
    const Status status = squeeze(&compression);
    report->windows += compression.cycles;
    chain_free(compression.chain);
    return status;
}
