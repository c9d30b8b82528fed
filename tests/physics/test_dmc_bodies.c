// SPDX-License-Identifier: GPL-3.0-or-later
// Monte Carlo of bodies with an axis as physics, on the engine that runs: proposals and free
// diffusion against closed forms, places that a body refuses to another against excluded volumes,
// acceptances and clocks of platelets against independent values, rods without length against
// spheres. Jabbari-Farouji and Trizac, J. Chem. Phys. 137, 054107 (2012): [JT]. Fixed seeds.
#include "dmc/chain.h"
#include "dmc/clock.h"
#include "packing/packing.h"
#include "simulate.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const RngKey KEY = {.seed = 20261125};
static const ChainSettings MIXED = {.stream = STREAM_TRIALS, .rotation = ROTATION_MIXED};

static System bodies(ShapeKind shape, int64_t particles, double number_density) {
    System system = {.dimension = 3,
                     .particles = particles,
                     .number_density = number_density,
                     .species_count = 1};
    system.species[0] = (Species){.name = "body",
                                  .shape = shape,
                                  .diameter = 1,
                                  .length = shape == SHAPE_SPHEROCYLINDER ? 5 : 0,
                                  .mass = 1,
                                  .fraction = 1};
    return system;
}

static State *packed(const System *system) {
    State *state = NULL;
    PackingReport report;
    ck_assert_msg(packing_create(&state, system, KEY, NULL, &report) == OK, "%s",
                  status_sentence());
    return state;
}

// On a cubic lattice, axes at random.
static State *spaced(const System *system) {
    State *state = new_state(system);
    scatter(state, KEY, 0);
    const size_t edge = (size_t)ceil(cbrt((double)state->count) - 1e-9);
    for (size_t i = 0; i < state->count; i++) {
        const size_t at[3] = {i % edge, i / edge % edge, i / edge / edge};
        for (int a = 0; a < 3; a++) {
            state->position[a][i] = ((double)at[a] + 0.5) * state->box.edge[a] / (double)edge;
        }
    }
    return state;
}

static Chain *chain_on(State *state, const ChainSettings *settings, const Amplitude *amplitude) {
    Chain *chain = NULL;
    ck_assert_msg(chain_create(&chain, settings, state, KEY) == OK, "%s", status_sentence());
    for (size_t s = 0; s < state->system.species_count; s++)
        chain_set_amplitude(chain, s, amplitude);
    return chain;
}

static MoveTally run(Chain *chain, double trials) {
    Tally tally = {0};
    ck_assert_int_eq(chain_run(chain, (int64_t)trials, &tally), OK);
    MoveTally sum = {0};
    for (size_t s = 0; s < SPECIES_MOST; s++) tally_add_moves(&sum, &tally.moves[s]);
    return sum;
}

static double acceptance(const MoveTally *moves) {
    return (double)moves->accepted / (double)moves->trials;
}

// A mean that is being taken.
typedef struct Mean {
    double count, sum, squares;
} Mean;

static void see(Mean *mean, double value) {
    mean->count++;
    mean->sum += value;
    mean->squares += value * value;
}

static Estimate estimate(const Mean *mean) {
    const double value = mean->sum / mean->count;
    const double variance = fmax(mean->squares / mean->count - value * value, 0);
    return (Estimate){.value = value, .error = sqrt(variance / (mean->count - 1))};
}

// One rotation of a free body by [JT] eq. 5: F(a) = <u'.u> (eq. 6) and <P2(u'.u)> (by quadrature).
START_TEST(rotations_are_as_long_as_the_paper_says) {
    static const struct {
        double amplitude, first, second;
    } known[] = {{0.109, 0.995011427, NAN}, {0.196, NAN, 0.9412832635}, {0.4, 0.8518518519, NAN}};
    const System system = bodies(SHAPE_PLATELET, 1, 1e-6);
    State *state = spaced(&system);
    Chain *chain = chain_on(state, &MIXED, &(Amplitude){.rotation = known[_i].amplitude});
    Mean first = {0}, second = {0};
    for (int trial = 0; trial < 200000; trial++) {
        double then[3], cosine = 0;
        for (int a = 0; a < 3; a++) then[a] = state->orientation[a][0];
        run(chain, 1);
        chain_publish(chain);
        for (int a = 0; a < 3; a++) cosine += then[a] * state->orientation[a][0];
        see(&first, 1 - cosine);
        see(&second, 1.5 * (1 - cosine * cosine));
    }
    if (!isnan(known[_i].first))
        expect_within("1 - F", estimate(&first), 1 - known[_i].first, 0, 4, 0.005);
    if (!isnan(known[_i].second))
        expect_within("1 - <P2>", estimate(&second), 1 - known[_i].second, 0, 4, 0.005);
    chain_free(chain);
    state_free(state);
}
END_TEST

// Free platelets. Times in d^2/(6 D0) = eta d^3/kT, as the paper has them: a cycle of steps l along
// the axis is worth l^2/(6 D_par) = (4/3) l^2.
typedef struct Walkers {
    State *state;
    ChainClock *clock;
    double *mark[6];
} Walkers;

static Walkers walkers(double cycle) {
    const System system = bodies(SHAPE_PLATELET, 1000, 1e-6);
    const ClockSettings settings = {.chain = MIXED, .kind = CLOCK_ACCEPTANCE};
    Walkers walkers = {.state = spaced(&system)};
    ck_assert_int_eq(clock_create(&walkers.clock, &settings, walkers.state, KEY), OK);
    clock_set_step(walkers.clock, 0, sqrt(0.75 * cycle));
    for (int a = 0; a < 6; a++) ck_assert_int_eq(NEW_ARRAY(walkers.mark[a], 1000), OK);
    return walkers;
}

static void rest(Walkers *walkers) {
    for (int a = 0; a < 6; a++) memory_free(walkers->mark[a]);
    clock_free(walkers->clock);
    state_free(walkers->state);
}

typedef struct Walked {
    Mean first, second, along, square, fourth; // u.u(0), P2, (r.u(0))^2, r^2, r^4
} Walked;

static void see_walkers(const Walkers *walkers, Walked *walked) {
    const State *state = walkers->state;
    for (size_t i = 0; i < state->count; i++) {
        double cosine = 0, along = 0, square = 0;
        for (int a = 0; a < 3; a++) {
            const double r = state_unfolded(state, a, i) - walkers->mark[a][i];
            const double u = walkers->mark[3 + a][i];
            cosine += u * state->orientation[a][i];
            along += u * r;
            square += r * r;
        }
        see(&walked->first, cosine);
        see(&walked->second, (3 * cosine * cosine - 1) / 2);
        see(&walked->along, along * along);
        see(&walked->square, square);
        see(&walked->fourth, square * square);
    }
}

// From `origins` origins one after the other; walks of different bodies and origins are
// independent.
static Walked walk(double time, double cycle, int origins) {
    Walkers all = walkers(cycle);
    const State *state = all.state;
    Walked walked = {0};
    Tally tally = {0};
    for (int origin = 0; origin < origins; origin++) {
        clock_publish(all.clock);
        for (int a = 0; a < 3; a++) {
            for (size_t i = 0; i < state->count; i++) all.mark[a][i] = state_unfolded(state, a, i);
            memcpy(all.mark[3 + a], state->orientation[a], state->count * sizeof(double));
        }
        ck_assert_int_eq(clock_advance(all.clock, time / 6, &tally), OK); // in d^2/D0
        clock_publish(all.clock);
        see_walkers(&all, &walked);
    }
    ck_assert_uint_eq(tally.moves[0].accepted, tally.moves[0].trials); // they never met
    rest(&all);
    return walked;
}

// <P1> = exp(-2 D_rot t), <P2> = exp(-6 D_rot t), D_rot = 3/4, and <(r.u(0))^2> = 2 D0 t + (4/3)
// (D_par - D_perp)(1 - exp(-6 D_rot t))/(6 D_rot). A step of finite length is off by D_rot times a
// cycle: 4e-4.
START_TEST(free_platelets_forget_their_axes_in_time) {
    const Walked walked = walk(0.5, 1 / 1800.0, 40);
    const double second = exp(-2.25);
    expect_within("<P1> at t = 0.5", estimate(&walked.first), 0.4723665527, 2e-4, 4, 0.01);
    expect_within("<P2> at t = 0.5", estimate(&walked.second), second, 2e-4, 4, 0.04);
}
END_TEST

START_TEST(free_platelets_move_less_along_their_axes) {
    static const struct {
        double time, along;
        int origins;
    } known[] = {{0.01, 0.0025184719, 200}, {1, 0.315020537, 30}};
    const double time = known[_i].time;
    const Walked walked = walk(time, 1 / 1800.0, known[_i].origins);
    printf("t = %g\n", time);
    expect_within("<(r.u(0))^2>", estimate(&walked.along), known[_i].along, 0, 4, 0.015);
    expect_within("<r^2>", estimate(&walked.square), time, 0, 4, 0.01);
}
END_TEST

// alpha_2 = 3 <r^4>/(5 <r^2>^2) - 1 = (8/45) (dD/D)^2 (x - 1 + exp(-x))/x^2, x = 6 D_rot t, dD/D =
// 3/8; in `cycles` cycles of uniform steps, which come as often as chance has it, 0.765/cycles
// more: (3/5) <s^4>/<s^2>^2 of one of them. Near a normal distribution alpha_2 of M walks has the
// standard error sqrt(8/(15 M)).
START_TEST(anisotropic_diffusion_is_not_gaussian) {
    static const struct { double x, alpha; } known[] = {{0.01, 0.0125}, {5, 0.0040067379}};
    enum { CYCLES = 200, ORIGINS = 250 };
    const double time = known[_i].x / 4.5;
    const Walked walked = walk(time, time / CYCLES, ORIGINS);
    const double square = walked.square.sum / walked.square.count;
    const Estimate alpha = {.value =
                                0.6 * walked.fourth.sum / walked.fourth.count / (square * square) -
                                1 - 0.765 / CYCLES,
                            .error = sqrt(8 / (15 * walked.square.count))};
    expect_within("alpha_2", alpha, known[_i].alpha, 5e-5, 4, 0.4);
}
END_TEST

// Two bodies in a box much larger than they are. Normal steps of a box edge end anywhere in the box
// with equal chances (to 1e-8), so that the share of them refused is the excluded volume, 2 B2 in
// isotropic directions, over that of the box.
START_TEST(refused_places_are_the_excluded_volume) {
    static const struct {
        const char *what;
        ShapeKind first, second;
        double edge, excluded;
    } known[] = {
        {"platelets", SHAPE_PLATELET, SHAPE_PLATELET, 6, 2 * 0.6168502751},
        {"spherocylinders L = 5", SHAPE_SPHEROCYLINDER, SHAPE_SPHEROCYLINDER, 20, 2 * 37.4373125},
        {"spherocylinder L = 5 and sphere", SHAPE_SPHEROCYLINDER, SHAPE_SPHERE, 16, 19.8967535}};
    const double edge = known[_i].edge, volume = edge * edge * edge, trials = 6e6;
    System system = bodies(known[_i].first, 2, 2 / volume);
    system.species[1] = bodies(known[_i].second, 1, 1).species[0];
    system.species_count = 2;
    system.species[0].fraction = system.species[1].fraction = 0.5;
    State *state = spaced(&system);
    const ChainSettings normal = {.stream = STREAM_TRIALS, .gaussian = 1};
    const double step = sqrt(3) * edge; // deviation: an edge
    Chain *chain = chain_on(state, &normal,
                            &(Amplitude){.parallel = step, .perpendicular = step, .rotation = 10});
    const MoveTally moves = run(chain, trials);
    const double refused = 1 - acceptance(&moves);
    const Estimate found = {.value = volume * refused, .error = volume * sqrt(refused / trials)};
    expect_within(known[_i].what, found, known[_i].excluded, 0, 4, 0.01);
    chain_free(chain);
    state_free(state);
}
END_TEST

// What is left of the mean square of a motion beyond the acceptance: the two clocks' ratio.
static double ratio(double found, double free, const MoveTally *moves) {
    return found / free / acceptance(moves);
}

// 500 platelets, from an independent Monte Carlo program; the first two acceptances are also [JT]'s
// 0.9988 and 0.93. Uncertainties are its statistics; ours are those of parts of the run.
START_TEST(platelets_accept_and_diffuse_as_they_should) {
    static const struct {
        double density, step, acceptance, uncertainty, ratio[3], ratio_uncertainty;
    } known[] = {{0.1, 0.005, 0.998743, 0.0004, {NAN}, 0},
                 {2, 0.01, 0.928387, 0.0008, {NAN}, 0},
                 {2, 0.05, 0.68775, 0.0004, {0.94997, 0.97502, 0.9847}, 0.001},
                 {2, 0.2, NAN, 0, {0.8437, 0.90791, 0.93588}, 0.001},
                 {3, 0.1, 0.29403, 0.0004, {NAN}, 0}};
    enum { PARTS = 20 };
    const System system = bodies(SHAPE_PLATELET, 500, known[_i].density);
    State *state = packed(&system);
    const Diffusion diffusion = species_diffusion(&system.species[0]);
    const Amplitude wide = amplitude_matched(0.15, &diffusion, &MIXED);
    const Amplitude wanted = amplitude_matched(known[_i].step, &diffusion, &MIXED);
    const MoveSquares free = amplitude_free_move(&wanted, 3, &MIXED).squares;
    Chain *chain = chain_on(state, &MIXED, &wide);
    run(chain, 1e6);
    Mean accepted = {0}, along = {0}, across = {0}, turned = {0};
    for (int part = 0; part < PARTS; part++) {
        chain_set_amplitude(chain, 0, &wanted);
        const MoveTally moves = run(chain, 2e5);
        const double trials = (double)moves.trials;
        see(&accepted, acceptance(&moves));
        see(&along, ratio(moves.parallel, free.parallel * trials, &moves));
        see(&across, ratio(moves.perpendicular, free.perpendicular * trials, &moves));
        see(&turned, ratio(moves.rotational, free.rotational * trials, &moves));
        chain_set_amplitude(chain, 0, &wide);
        run(chain, 1e5);
    }
    printf("density %g, step %g\n", known[_i].density, known[_i].step);
    if (!isnan(known[_i].acceptance))
        expect_within("acceptance", estimate(&accepted), known[_i].acceptance,
                      known[_i].uncertainty, 4, 0.005);
    const Mean *means[3] = {&along, &across, &turned};
    static const char *const motions[3] = {"along", "across", "rotation"};
    for (int k = 0; k < 3 && !isnan(known[_i].ratio[0]); k++) {
        expect_within(motions[k], estimate(means[k]), known[_i].ratio[k],
                      known[_i].ratio_uncertainty, 4, 0.005);
    }
    chain_free(chain);
    state_free(state);
}
END_TEST

// Rods without length, turning all the while, against spheres, which the other kind of chain moves:
// acceptance, what is accepted of the displacements, and the displacement after whole cycles.
typedef struct Motion {
    Mean accepted, squares, displacement;
} Motion;

static Motion motion_of(ShapeKind shape) {
    enum { PARTS = 200 };
    const double step = 0.1;
    System system = bodies(shape, 500, 0.8);
    system.species[0].length = 0;
    State *state = packed(&system);
    Chain *chain = chain_on(state, &MIXED,
                            &(Amplitude){.parallel = step, .perpendicular = step, .rotation = 0.3});
    Motion motion = {0};
    run(chain, 1e6);
    chain_publish(chain);
    for (int part = 0; part < PARTS; part++) {
        double *then[3], square = 0;
        for (int a = 0; a < 3; a++) {
            ck_assert_int_eq(NEW_ARRAY(then[a], state->count), OK);
            for (size_t i = 0; i < state->count; i++) then[a][i] = state_unfolded(state, a, i);
        }
        const MoveTally moves = run(chain, 100 * (double)state->count);
        chain_publish(chain);
        for (int a = 0; a < 3; a++) {
            for (size_t i = 0; i < state->count; i++) {
                const double x = state_unfolded(state, a, i) - then[a][i];
                square += x * x / (double)state->count;
            }
            memory_free(then[a]);
        }
        const double trials = (double)moves.trials;
        see(&motion.accepted, acceptance(&moves));
        see(&motion.squares, (moves.parallel + moves.perpendicular) / trials);
        see(&motion.displacement, square);
    }
    chain_free(chain);
    state_free(state);
    return motion;
}

START_TEST(rods_without_length_are_spheres) {
    const Motion rods = motion_of(SHAPE_SPHEROCYLINDER), spheres = motion_of(SHAPE_SPHERE);
    const Mean *means[3][2] = {{&rods.accepted, &spheres.accepted},
                               {&rods.squares, &spheres.squares},
                               {&rods.displacement, &spheres.displacement}};
    static const struct {
        const char *name;
        double precision;
    } what[3] = {
        {"acceptance", 0.002}, {"accepted squares", 0.004}, {"<r^2> after 100 cycles", 0.02}};
    for (int k = 0; k < 3; k++) {
        const Estimate known = estimate(means[k][1]);
        expect_within(what[k].name, estimate(means[k][0]), known.value, known.error, 4,
                      what[k].precision);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("dmc_bodies");
    ADD_CASE(suite, rotations_are_as_long_as_the_paper_says, 3);
    ADD_CASE(suite, free_platelets_forget_their_axes_in_time, 1);
    ADD_CASE(suite, free_platelets_move_less_along_their_axes, 2);
    ADD_CASE(suite, anisotropic_diffusion_is_not_gaussian, 2);
    ADD_CASE(suite, refused_places_are_the_excluded_volume, 3);
    ADD_CASE(suite, platelets_accept_and_diffuse_as_they_should, 5);
    ADD_CASE(suite, rods_without_length_are_spheres, 1);
    return run_suite(suite);
}
