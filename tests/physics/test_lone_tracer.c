// SPDX-License-Identifier: GPL-3.0-or-later
// A tracer alone under a constant force: by each clock of Monte Carlo drift and diffusion against
// the exact moments of a trial, from f = F d/kT = 0.01 to 5, through balls and bodies alike; by
// event-driven dynamics against D F and D. Fixed seeds; statistical tolerances are of five standard
// errors.
#include "dmc/clock.h"
#include "observe.h"
#include "suite.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 20261125};
static const double STEP = 0.1, WORK[] = {0.01, 0.1, 0.3, 1, 2, 5};
enum { WORKS = sizeof WORK / sizeof *WORK, PULLED = 300, AXIS = 1 };

// Two particles out of each other's reach, the second pulled; among bodies the first is a rod.
static State *two(bool bodies) {
    System system = {.dimension = 3, .particles = 2, .number_density = 1e-9, .species_count = 2};
    system.species[0] = (Species){.shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 0.5};
    if (bodies) {
        system.species[0].shape = SHAPE_SPHEROCYLINDER;
        system.species[0].length = 5;
    }
    system.species[1] = (Species){
        .shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 0.5, .name = "tracer"};
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < 2; i++) {
        state->diameter[i] = 1;
        for (int a = 0; a < 3; a++)
            state->position[a][i] = state->box.edge[a] / 4 * (double)(i + 1);
    }
    return state;
}

// Of a trial with uniform components of half-width 1, accepted as Metropolis has it: closed forms,
// with the C library.
typedef struct Exact {
    double mean, square, acceptance;
} Exact;

static Exact exact(double f) {
    const double e = exp(-f);
    return (Exact){.mean = 0.25 + ((1 + f) * e - 1) / (2 * f * f),
                   .square = 1.0 / 6 + (2 - (f * f + 2 * f + 2) * e) / (2 * f * f * f),
                   .acceptance = 0.5 + (1 - e) / (2 * f)};
}

START_TEST(free_moments_are_exact) {
    for (double f = 0.01; f < 300; f *= 1.3) {
        const Exact known = exact(f);
        ck_assert_double_eq_tol(pull_drift(f) / known.mean, 1, 1e-15 * (20 + 20 / (f * f * f)));
        ck_assert_double_eq_tol(pull_acceptance(f), known.acceptance, 1e-13);
    }
    ck_assert_double_eq_tol(pull_drift(1e-3), 1e-3 / 6 * (1 - 3e-3 / 8 + 1e-6 / 10), 1e-13);
}
END_TEST

// What the tracer did, over D F t and 2 D t.
typedef struct Found {
    double drift, along, across;                   // of its own
    double drift_error, along_error, across_error; // relative standard errors
    double acceptance, cycle;                      // cycle over that of a free trial
} Found;

static Found pulled(PullClock kind, double f, bool bodies) {
    enum { PARTS = 2000 };
    State *state = two(bodies);
    ChainClock *clock = NULL;
    const ClockSettings settings = {.chain = {.stream = STREAM_TRIALS}, .kind = CLOCK_ACCEPTANCE};
    ck_assert_int_eq(clock_create(&clock, &settings, state, KEY), OK);
    clock_set_step(clock, 0, STEP);
    clock_set_step(clock, 1, STEP);
    const ClockPull pull = {.species = 1, .axis = AXIS, .force = f / STEP, .kind = kind};
    clock_pull(clock, &pull);
    double sum = 0, along = 0, across = 0, last[3];
    clock_publish(clock);
    for (int a = 0; a < 3; a++) last[a] = state_unfolded(state, a, 1);
    for (int p = 0; p < PARTS; p++) {
        ck_assert_int_eq(clock_run(clock, 2 * PULLED, NULL), OK);
        clock_publish(clock);
        for (int a = 0; a < 3; a++) {
            const double now = state_unfolded(state, a, 1), r = now - last[a];
            if (a == AXIS)
                sum += r, along += r * r;
            else
                across += r * r;
            last[a] = now;
        }
    }
    const double trials = (double)clock_trials(clock, 1);
    const double free_cycle = STEP * STEP / 6 /
                              species_diffusion(&state->system.species[1]).parallel *
                              system_reference_diffusion(&state->system);
    const double time = trials * STEP * STEP / 6 * clock_cycle_of(clock, 1) / free_cycle; // D t
    const double mean = sum / PARTS, variance = along / PARTS - mean * mean;
    Found found = {.drift = sum / (pull.force * time),
                   .along = PARTS * variance / (2 * time),
                   .across = across / (4 * time),
                   .drift_error = sqrt(PARTS * variance) / sum,
                   .along_error = sqrt(2.0 / PARTS),
                   .across_error = sqrt(2.0 / PARTS),
                   .acceptance = clock_acceptance(clock, 1),
                   .cycle = clock_cycle_of(clock, 1) / free_cycle};
    clock_free(clock);
    state_free(state);
    return found;
}

static void check_found(const char *what, double found, double error, double known) {
    printf(" %s %.4f(%.4f) of %.4f", what, found, error, known);
    ck_assert_double_eq_tol(found, known, 5 * error);
}

// The whole of the theory of a lone particle: a trial in each cycle, of known moments.
START_TEST(a_lone_tracer_moves_as_its_trials_say) {
    const PullClock kind = (PullClock)(_i / WORKS % PULL_CLOCKS);
    const bool bodies = _i >= WORKS * PULL_CLOCKS;
    const double f = WORK[_i % WORKS];
    const Exact free = exact(f);
    const Found found = pulled(kind, f, bodies);
    // Time of a trial over that of one without force; what one gains along and across.
    const double pace = kind == PULL_DRIFTED       ? 1
                        : kind == PULL_EXACT_FORCE ? 6 * free.mean / f
                                                   : (3 * found.acceptance - 1) / 2;
    const double drift = kind == PULL_DRIFTED ? 1 : 6 * free.mean / f / pace;
    const double along =
        kind == PULL_DRIFTED ? 1 : 3 * (free.square - free.mean * free.mean) / pace;
    const double across = kind == PULL_FIRST_ORDER ? free.acceptance / pace : 1;
    printf("%s f %g %s:", drive_pull_clocks[kind], f, bodies ? "rods" : "balls");
    check_found("drift", found.drift, found.drift_error * drift, drift);
    check_found("along", found.along, found.along_error * along, along);
    check_found("across", found.across, found.across_error * across, across);
    printf("\n");
    if (kind == PULL_DRIFTED)
        ck_assert_double_eq(found.acceptance, 1);
    else
        ck_assert_double_eq_tol(found.acceptance, free.acceptance, 5 * 0.5 / sqrt(2000 * PULLED));
    ck_assert_double_eq_tol(found.cycle, pace, 0.006);
    if (kind != PULL_FIRST_ORDER) ck_assert_double_eq_tol(drift, 1, 1e-9);
}
END_TEST

typedef struct Flight {
    double interval, peclet;
    int64_t substeps, rest; // windows of an interval; intervals without the force, of ten
} Flight;

enum { PARTS = 4000, INTERVALS = 10 };

// Of a tracer of twice the first species' mass, event-driven: displacements in each of the parts,
// and the time of a part. An interval of rest comes after it, at whose end the tracer begins
// somewhere else.
static double fly(const Flight *flight, double peclet, double displacement[PARTS][3]) {
    State *state = two(false);
    state->system.species[1].mass = state->mass[1] = 2;
    const PropagatorKind *kind = &propagator_event_driven;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "thermostat_interval", flight->interval);
    set_number(&settings, &kind->options, "substeps", (double)flight->substeps);
    const int64_t per_step = kind->ticks_per_step(&settings);
    const double step = kind->tick(&settings, &state->system) * (double)per_step;
    const Drive drive = {.pull = {.species = "tracer",
                                  .peclet = peclet,
                                  .axis = AXIS,
                                  .period = (INTERVALS + 1) * step,
                                  .rest = (double)(flight->rest + 1) * step}};
    Propagator *propagator = NULL;
    Tally tally = {0};
    ck_assert_int_eq(kind->create(&propagator, &settings, state, KEY), OK);
    ck_assert_int_eq(kind->drive(propagator, &drive, 0), OK);
    for (int p = 0; p < PARTS; p++) {
        for (int a = 0; a < 3; a++) displacement[p][a] = -state_unfolded(state, a, 1);
        ck_assert_int_eq(kind->advance(propagator, INTERVALS * per_step, &tally), OK);
        for (int a = 0; a < 3; a++) displacement[p][a] += state_unfolded(state, a, 1);
        ck_assert_int_eq(kind->advance(propagator, per_step, &tally), OK);
    }
    kind->free(propagator);
    state_free(state);
    return INTERVALS * step;
}

// Event-driven, the same random numbers with and without the force: it adds D F t to the digit, and
// the rest diffuses with D = D0/2, whatever the interval and the force.
START_TEST(event_driven_drift_is_exact) {
    static const Flight flights[] = {{0.01, 0.01, 0, 0},  {0.01, 50, 0, 0}, {0.001, 500, 0, 2},
                                     {0.1, 2, 0, 5},      {1, 0.02, 0, 0},  {0.03, 20, 5, 3},
                                     {0.0003, 5000, 1, 0}};
    static double pulled[PARTS][3], free[PARTS][3];
    const Flight *flight = &flights[_i];
    const double time = fly(flight, flight->peclet, pulled), diffusion = 0.5;
    fly(flight, 0, free);
    const double drift =
        diffusion * 2 * flight->peclet * time * (1 - (double)flight->rest / INTERVALS);
    double squares[3] = {0};
    for (int p = 0; p < PARTS; p++) {
        for (int a = 0; a < 3; a++) {
            ck_assert_double_eq_tol(pulled[p][a] - free[p][a], a == AXIS ? drift : 0, 1e-9);
            squares[a] += free[p][a] * free[p][a];
        }
    }
    printf("event-driven interval %g Pe %g:", flight->interval, flight->peclet);
    for (int a = 0; a < 3; a++)
        check_found("diffusion", squares[a] / (PARTS * 2 * diffusion * time), sqrt(2.0 / PARTS), 1);
    printf("\n");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("a lone tracer");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 120);
    tcase_add_test(all, free_moments_are_exact);
    tcase_add_loop_test(all, a_lone_tracer_moves_as_its_trials_say, 0, 2 * WORKS * PULL_CLOCKS);
    tcase_add_loop_test(all, event_driven_drift_is_exact, 0, 7);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
