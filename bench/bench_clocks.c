// SPDX-License-Identifier: GPL-3.0-or-later
// What Brownian motion costs by each way to it: the long-time diffusion D_L of hard spheres at
// packing fraction 0.50 by event-driven dynamics and by Monte Carlo with its clocks. No way is
// right at the steps that are worth their time, so that each is measured at two and extrapolated to
// none by a straight line: in the interval squared, in the step, or where the clock is that of
// attempts in its square. Equal accuracy means a statistical error of 1 % of what is extrapolated,
// the time being shared between the two as is cheapest. Displacements know nothing of the way they
// came about, so one variance serves all.
#include "bench.h"

#include "dmc/clock.h"
#include "dmc/dmc.h"
#include "edbd/edbd.h"
#include "packing/packing.h"

#include <math.h>

enum { PARTICLES = 500, BLOCKS = 20, LAGS = 3, CALIBRATION = 1000, SETTLE_CYCLES = 10000 };
static const RngKey KEY = {.seed = 1};
static const double LAG = 1, ACCURACY = 0.01; // in d^2/D0
static const double SETTLE_STEP = 0.055, WINDOW = 0.01;

// VA, VD after a whole cycle, VD per attempt.
typedef enum Way { EVENT_DRIVEN, RESCALED, MATCHED, MATCHED_ATTEMPTS, WAYS } Way;
static const char *const WAY[WAYS] = {"edbd interval", "dmc VA step", "dmc VD step",
                                      "dmc per attempt step"};
static const double STEP[WAYS][2] = {{0.02, 0.05}, {0.03, 0.06}, {0.03, 0.06}, {0.03, 0.06}};
static const double POWER[WAYS] = {2, 1, 1, 2}; // of the step, that the line is straight in
static const ClockSettings CLOCK[WAYS] = {
    [RESCALED] = {.chain = {.stream = STREAM_TRIALS}, .kind = CLOCK_ACCEPTANCE},
    [MATCHED] = {.chain = {.stream = STREAM_TRIALS}, .kind = CLOCK_MATCHING},
    [MATCHED_ATTEMPTS] = {
        .chain = {.stream = STREAM_TRIALS}, .kind = CLOCK_MATCHING, .span = MATCH_PER_ATTEMPT}};

typedef struct Walk {
    double diffusion, error; // D_L/D0
    double seconds;          // per d^2/D0
} Walk;

static void stop_if(Status status) {
    if (status == OK) return;
    fprintf(stderr, "bench_clocks: %s\n", status_sentence());
    exit(status);
}

static ChainClock *clock_of(State *state, Way way, double step) {
    ChainClock *clock = NULL;
    stop_if(clock_create(&clock, &CLOCK[way], state, KEY));
    clock_set_step(clock, 0, step);
    return clock;
}

static State *settled(void) {
    System system = {
        .dimension = 3, .particles = PARTICLES, .packing_fraction = 0.50, .species_count = 1};
    system.species[0] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 1};
    State *state = NULL;
    PackingReport packing;
    stop_if(packing_create(&state, &system, KEY, NULL, &packing));
    ChainClock *clock = clock_of(state, RESCALED, SETTLE_STEP);
    stop_if(clock_run(clock, (int64_t)SETTLE_CYCLES * PARTICLES, NULL));
    clock_publish(clock);
    clock_free(clock);
    return state;
}

typedef double Frame[3][PARTICLES];

static void look(Frame frame, const State *state) {
    for (int axis = 0; axis < 3; axis++) {
        for (size_t i = 0; i < PARTICLES; i++) frame[axis][i] = state_unfolded(state, axis, i);
    }
}

static double squared_displacement(Frame from, Frame to) {
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        for (size_t i = 0; i < PARTICLES; i++) {
            const double moved = to[axis][i] - from[axis][i];
            sum += moved * moved;
        }
    }
    return sum / PARTICLES;
}

// Slope between a lag and three of them, of frames one lag apart.
static double diffusion_of(Frame frames[LAGS + 1]) {
    double one = 0;
    for (int k = 0; k < LAGS; k++) one += squared_displacement(frames[k], frames[k + 1]) / LAGS;
    return (squared_displacement(frames[0], frames[LAGS]) - one) / (6 * LAG * (LAGS - 1));
}

typedef struct Mover {
    State *state;
    Engine *engine;    // one of these
    ChainClock *clock; //
    double interval;   // of the engine, in d sqrt(m/kT); it lasts interval^2/2 in d^2/D0
} Mover;

static Mover mover_of(State *state, Way way, double step) {
    Mover mover = {.state = state, .interval = step};
    if (way == EVENT_DRIVEN) {
        const EngineSettings settings = {.window = WINDOW,
                                         .windows_per_step = llrint(step / WINDOW),
                                         .redraw = 1,
                                         .stream = STREAM_VELOCITY};
        stop_if(engine_create(&mover.engine, &settings, state, KEY));
        return mover;
    }
    mover.clock = clock_of(state, way, step);
    stop_if(clock_run(mover.clock, (int64_t)CALIBRATION * PARTICLES, NULL));
    return mover;
}

static void move(Mover *mover, Tally *tally) {
    if (mover->engine) {
        const double intervals = LAG / (mover->interval * mover->interval / 2);
        stop_if(engine_advance(mover->engine, llrint(intervals * mover->interval / WINDOW), tally));
        return;
    }
    stop_if(clock_advance(mover->clock, LAG, tally));
    clock_publish(mover->clock);
}

static Walk walk_of(State *state, Way way, double step) {
    static Frame frames[LAGS + 1];
    Mover mover = mover_of(state, way, step);
    Tally tally = {0};
    double sum = 0, squares = 0;
    look(frames[0], state);
    const double begin = bench_user_seconds();
    for (int block = 0; block < BLOCKS; block++) {
        for (int k = 1; k <= LAGS; k++) {
            move(&mover, &tally);
            look(frames[k], state);
        }
        const double diffusion = diffusion_of(frames);
        sum += diffusion;
        squares += diffusion * diffusion;
        look(frames[0], state);
    }
    const double seconds = bench_user_seconds() - begin, mean = sum / BLOCKS;
    engine_free(mover.engine);
    clock_free(mover.clock);
    return (Walk){.diffusion = mean,
                  .error = sqrt((squares / BLOCKS - mean * mean) / (BLOCKS - 1)),
                  .seconds = seconds / (BLOCKS * LAGS * LAG)};
}

// d^2/D0 until the error of D_L of these particles is as wanted, whatever the way.
static double time_needed(Walk walks[WAYS][2]) {
    double sum = 0;
    for (int way = 0; way < WAYS; way++) {
        for (int k = 0; k < 2; k++) {
            const double relative = walks[way][k].error / walks[way][k].diffusion;
            sum += relative * relative / (2 * WAYS);
        }
    }
    return BLOCKS * LAGS * LAG * sum / (ACCURACY * ACCURACY);
}

// A straight line through the two, at zero. The time t_k spent on each minimises sum c_k t_k where
// sum w_k^2 v/t_k is given: the cost is v (sum |w_k| sqrt(c_k))^2 for that.
static void report_extrapolated(Way way, const Walk walks[2], double time) {
    double x[2];
    for (int k = 0; k < 2; k++) x[k] = pow(STEP[way][k], POWER[way]);
    const double weight[2] = {x[1] / (x[1] - x[0]), -x[0] / (x[1] - x[0])};
    const double diffusion = weight[0] * walks[0].diffusion + weight[1] * walks[1].diffusion;
    double roots = 0; // relative errors are those of the walks
    for (int k = 0; k < 2; k++) {
        roots += fabs(weight[k]) * walks[k].diffusion / diffusion * sqrt(walks[k].seconds);
    }
    char name[64];
    snprintf(name, sizeof name, "clocks %s 0: D_L", WAY[way]);
    bench_result(name, diffusion, "D0");
    snprintf(name, sizeof name, "clocks %s 0: its error here", WAY[way]);
    bench_result(name, hypot(weight[0] * walks[0].error, weight[1] * walks[1].error), "D0");
    snprintf(name, sizeof name, "clocks %s 0: D_L to 1 %%", WAY[way]);
    bench_result(name, time * roots * roots, "s");
}

static void report(Way way, int k, const Walk *walk, double time) {
    char name[64];
    snprintf(name, sizeof name, "clocks %s %g: 1 d^2/D0 of 1000 spheres", WAY[way], STEP[way][k]);
    bench_result(name, walk->seconds * 1000 / PARTICLES, "s");
    snprintf(name, sizeof name, "clocks %s %g: D_L", WAY[way], STEP[way][k]);
    bench_result(name, walk->diffusion, "D0");
    snprintf(name, sizeof name, "clocks %s %g: D_L to 1 %% as it is", WAY[way], STEP[way][k]);
    bench_result(name, walk->seconds * time, "s");
}

int main(void) {
    Walk walks[WAYS][2];
    State *state = settled();
    for (int way = 0; way < WAYS; way++) {
        for (int k = 0; k < 2; k++) walks[way][k] = walk_of(state, (Way)way, STEP[way][k]);
    }
    state_free(state);
    const double time = time_needed(walks);
    for (int way = 0; way < WAYS; way++) {
        for (int k = 0; k < 2; k++) report((Way)way, k, &walks[way][k], time);
        report_extrapolated((Way)way, walks[way], time);
    }
    return 0;
}
