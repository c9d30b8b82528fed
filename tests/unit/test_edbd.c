// SPDX-License-Identifier: GPL-3.0-or-later
// The event-driven engine: exact collisions, conservation, the same bits however it is run, and
// what it refuses. Its collisions in sequence are held against a slow twin in physics/test_twins.c,
// its pressure and diffusion against theory in physics/.
#include "reference_engine.h"

#include "edbd/edbd.h"
#include "base/cpu.h"
#include "packing/packing.h"

#include "observe.h"
#include "suite.h"

#include <stdlib.h>

static const RngKey KEY = {.seed = 7, .replica = 2};

static Propagator *propagator_of(const PropagatorKind *kind, const Settings *settings,
                                 State *state) {
    Propagator *propagator = NULL;
    ck_assert_msg(kind->create(&propagator, settings, state, KEY) == OK, "%s", status_sentence());
    return propagator;
}

static void run(const PropagatorKind *kind, const Settings *settings, State *state, int64_t ticks,
                Tally *tally) {
    Propagator *propagator = propagator_of(kind, settings, state);
    ck_assert_msg(kind->advance(propagator, ticks, tally) == OK, "%s", status_sentence());
    kind->free(propagator);
}

static State *packed(int dimension, int64_t particles, double packing_fraction, size_t species) {
    System system = system_of(dimension, particles, packing_fraction, species);
    if (species > 1) system.species[1].mass = 2;
    State *state = NULL;
    ck_assert_msg(packing_create(&state, &system, KEY, NULL, NULL) == OK, "%s", status_sentence());
    return state;
}

static State *copy_of(const State *state) {
    State *copy = new_state(&state->system);
    memcpy(copy->diameter, state->diameter, state->count * sizeof(double));
    for (int a = 0; a < 3; a++) {
        memcpy(copy->position[a], state->position[a], state->count * sizeof(double));
        memcpy(copy->velocity[a], state->velocity[a], state->count * sizeof(double));
        memcpy(copy->image[a], state->image[a], state->count * sizeof(int32_t));
    }
    copy->step = state->step;
    return copy;
}

static void check_same_bits(const State *one, const State *other) {
    for (int a = 0; a < one->box.dimension; a++) {
        ck_assert_mem_eq(one->position[a], other->position[a], one->count * sizeof(double));
        ck_assert_mem_eq(one->velocity[a], other->velocity[a], one->count * sizeof(double));
        ck_assert_mem_eq(one->image[a], other->image[a], one->count * sizeof(int32_t));
    }
}

// Discs of diameter 1 in a square box of edge 20.
static State *few_discs(int64_t particles) {
    System system = system_of(2, particles, 0, 1);
    system.number_density = (double)particles / 400;
    State *state = new_state(&system);
    for (size_t i = 0; i < state->count; i++) {
        state->position[0][i] = 1.5 * (double)(i + 1);
        state->position[1][i] = 15;
    }
    return state;
}

static void set(State *state, size_t i, double x, double y, double vx, double vy) {
    state->position[0][i] = x;
    state->position[1][i] = y;
    state->velocity[0][i] = vx;
    state->velocity[1][i] = vy;
}

// Discs at (0,0) and (3,0.5) with velocities (1,0) and (-1,0) meet after (6 - sqrt 3)/4; the
// corrected eq. 2.5 of Weysser's thesis gives what follows.
START_TEST(two_discs_meet_when_and_as_they_must) {
    for (int place = 0; place < 2; place++) { // in the middle, and across a corner of the box
        State *state = few_discs(2);
        const double x = place ? 18.7 : 5, y = place ? 19.8 : 7;
        set(state, 0, x, y, 1, 0);
        set(state, 1, fmod(x + 3, 20), fmod(y + 0.5, 20), -1, 0);
        const Settings settings = settings_of(&propagator_newtonian.options);
        Propagator *propagator = propagator_of(&propagator_newtonian, &settings, state);
        CollisionRecord record;
        CollisionLog log = {.records = &record, .capacity = 1};
        engine_record(propagator_engine(propagator), &log);
        Tally tally = {0};
        ck_assert_int_eq(propagator_newtonian.advance(propagator, 150, &tally), OK);
        ck_assert_uint_eq(log.count, 1);
        ck_assert_uint_eq(record.low, 0);
        ck_assert_uint_eq(record.high, 1);
        ck_assert_double_eq_tol(0.01 * (double)record.step + record.time, (6 - sqrt(3)) / 4, 1e-12);
        ck_assert_double_eq_tol(state->velocity[0][0], -0.5, 1e-12);
        ck_assert_double_eq_tol(state->velocity[1][0], -sqrt(3) / 2, 1e-12);
        ck_assert_double_eq_tol(state->velocity[0][1], 0.5, 1e-12);
        ck_assert_double_eq_tol(state->velocity[1][1], sqrt(3) / 2, 1e-12);
        propagator_newtonian.free(propagator);
        state_free(state);
    }
}
END_TEST

static double kinetic_energy(const State *state) {
    double energy = 0;
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            energy += state->mass[i] * state->velocity[a][i] * state->velocity[a][i] / 2;
        }
    }
    return energy;
}

static double momentum(const State *state, int axis) {
    double sum = 0;
    for (size_t i = 0; i < state->count; i++) sum += state->mass[i] * state->velocity[axis][i];
    return sum;
}

START_TEST(newtonian_motion_conserves_energy_and_momentum) {
    State *state = packed(2 + _i, 500, _i ? 0.45 : 0.75, 2);
    const Settings settings = settings_of(&propagator_newtonian.options);
    Tally tally = {0};
    run(&propagator_newtonian, &settings, state, 1, &tally);
    const double energy = kinetic_energy(state);
    ck_assert_double_eq_tol(energy, (2 + _i) * 500 / 2.0, 1e-9);
    run(&propagator_newtonian, &settings, state, 240000, &tally);
    ck_assert_uint_ge(tally.collisions, 10000000);
    // One rounding of the energy of the pair in each collision, were all of one sign.
    const double rounding = (double)tally.collisions * DBL_EPSILON * 2 / 500;
    ck_assert_double_eq_tol(kinetic_energy(state) / energy, 1, rounding);
    for (int a = 0; a < 2 + _i; a++) ck_assert_double_eq_tol(momentum(state, a), 0, 1e-10);
    ck_assert_uint_eq(tally.corrected, 0);
    state_free(state);
}
END_TEST

// Every instruction set that this machine has gives the bits of the portable code.
START_TEST(every_instruction_set_gives_the_same_bits) {
    const PropagatorKind *kind = _i / 2 ? &propagator_newtonian : &propagator_event_driven;
    const int dimension = 2 + _i % 2;
    const Settings settings = settings_of(&kind->options);
    State *start = packed(dimension, 343, dimension == 2 ? 0.78 : 0.5, 2);
    State *end[CPU_PATHS];
    Tally tally[CPU_PATHS] = {{0}};
    for (int path = 0; path < CPU_PATHS; path++) {
        end[path] = copy_of(start);
        setenv("PERRIN_CPU", cpu_path_name((CpuPath)path), 1);
        run(kind, &settings, end[path], 1500, &tally[path]);
        check_same_bits(end[0], end[path]);
        ck_assert_mem_eq(tally[0].exchange, tally[path].exchange, sizeof tally[0].exchange);
        ck_assert_uint_eq(tally[0].collisions, tally[path].collisions);
    }
    unsetenv("PERRIN_CPU");
    for (int path = 0; path < CPU_PATHS; path++) state_free(end[path]);
    state_free(start);
}
END_TEST

// In one go; in pieces; and with a new propagator, which knows nothing but the State, at the end of
// every piece that ends a step.
START_TEST(no_split_and_no_new_start_changes_a_bit) {
    const PropagatorKind *kind = _i / 2 ? &propagator_newtonian : &propagator_event_driven;
    const int dimension = 2 + _i % 2;
    Settings settings = settings_of(&kind->options);
    if (kind == &propagator_event_driven) set_number(&settings, &kind->options, "substeps", 3);
    const int64_t per_step = kind->ticks_per_step(&settings);
    State *whole = packed(dimension, 256, dimension == 2 ? 0.77 : 0.5, 2);
    State *pieces = copy_of(whole);
    Tally one = {0}, many = {0};
    run(kind, &settings, whole, 600 * per_step, &one);
    Propagator *propagator = propagator_of(kind, &settings, pieces);
    for (int64_t done = 0, piece = 1; done < 600 * per_step; piece = piece * 3 % 101) {
        if (done + piece > 600 * per_step) piece = 600 * per_step - done;
        ck_assert_int_eq(kind->advance(propagator, piece, &many), OK);
        done += piece;
        if (done % per_step != 0) continue;
        kind->free(propagator);
        propagator = propagator_of(kind, &settings, pieces);
    }
    kind->free(propagator);
    check_same_bits(whole, pieces);
    ck_assert_int_eq(whole->step, pieces->step);
    ck_assert_uint_eq(one.collisions, many.collisions);
    ck_assert_mem_eq(one.exchange, many.exchange, sizeof one.exchange);
    state_free(whole);
    state_free(pieces);
}
END_TEST

// Time is a count of steps: there is no absolute time to lose digits. (With the thermostat other
// steps draw other random numbers, so this can be seen in the Newtonian mode only.)
START_TEST(the_origin_of_time_changes_no_bit) {
    static const int64_t origins[] = {1000000, 1000000000000, INT64_MAX / 2};
    State *early = packed(2, 256, 0.7, 2);
    const Settings settings = settings_of(&propagator_newtonian.options);
    Tally first = {0};
    run(&propagator_newtonian, &settings, early, 1, &first); // draws the velocities
    State *late = copy_of(early);
    const int64_t start = early->step;
    late->step = origins[_i];
    Tally one = {0}, other = {0};
    run(&propagator_newtonian, &settings, early, 1000, &one);
    run(&propagator_newtonian, &settings, late, 1000, &other);
    check_same_bits(early, late);
    ck_assert_int_eq(late->step - origins[_i], early->step - start);
    state_free(early);
    state_free(late);
}
END_TEST

// Four discs on a square meet at one moment: the order is that of their ids, so renaming them
// changes the outcome by rounding only where it is the same by symmetry.
START_TEST(four_discs_that_meet_at_once_keep_energy_and_momentum) {
    static const int renamed[4] = {2, 0, 3, 1};
    State *one = few_discs(4), *other = few_discs(4);
    for (size_t k = 0; k < 4; k++) {
        const double x = k % 2 ? 1 : -1, y = k / 2 ? 1 : -1;
        set(one, k, 10 + x, 10 + y, -x, -y);
        set(other, (size_t)renamed[k], 10 + x, 10 + y, -x, -y);
    }
    const Settings settings = settings_of(&propagator_newtonian.options);
    Tally tally = {0};
    run(&propagator_newtonian, &settings, one, 100, &tally);
    run(&propagator_newtonian, &settings, other, 100, &tally);
    ck_assert_double_eq_tol(kinetic_energy(one), 4, 1e-14);
    for (int a = 0; a < 2; a++) ck_assert_double_eq_tol(momentum(one, a), 0, 1e-14);
    for (size_t k = 0; k < 4; k++) {
        for (int a = 0; a < 2; a++) {
            const size_t name = (size_t)renamed[k];
            ck_assert_double_eq_tol(one->position[a][k], other->position[a][name], 1e-12);
            ck_assert_double_eq_tol(one->velocity[a][k], other->velocity[a][name], 1e-12);
        }
    }
    state_free(one);
    state_free(other);
}
END_TEST

static double overlap_of(const State *state) {
    double deepest = 0;
    ck_assert_int_eq(state_deepest_overlap(state, 0, &deepest, NULL), OK);
    return deepest;
}

// Overlaps such as rounding leaves: approaching partners collide at once, so none gets deeper, and
// all are gone soon.
START_TEST(tiny_overlaps_never_deepen_and_vanish) {
    static const double depths[] = {1e-15, 1e-12, 1e-9, 1e-6};
    const double limit = fmax(2 * depths[_i], 1e-13);
    State *state = packed(2, 100, 0.6, 1);
    for (size_t i = 0; i + 1 < 100; i += 2) { // pairs that touch, and a little more
        state->position[0][i] = 1 + (double)(i / 2 % 5) * 2.2;
        state->position[1][i] = 0.5 + (double)(i / 10) * 1.15;
        state->position[0][i + 1] = state->position[0][i] + 1 - depths[_i];
        state->position[1][i + 1] = state->position[1][i];
    }
    const Settings settings = settings_of(&propagator_event_driven.options);
    Propagator *propagator = propagator_of(&propagator_event_driven, &settings, state);
    Tally tally = {0};
    for (int interval = 0; interval < 20; interval++) {
        ck_assert_int_eq(propagator_event_driven.advance(propagator, 1, &tally), OK);
        ck_assert_double_le(overlap_of(state), limit);
    }
    ck_assert_double_le(overlap_of(state), 1e-12);
    if (depths[_i] > 1e-11) ck_assert_uint_gt(tally.corrected, 0);
    propagator_event_driven.free(propagator);
    state_free(state);
}
END_TEST

START_TEST(dense_states_never_overlap) {
    State *state = packed(2 + _i, 400, _i ? 0.55 : 0.8, 2);
    const Settings settings = settings_of(&propagator_event_driven.options);
    Propagator *propagator = propagator_of(&propagator_event_driven, &settings, state);
    Tally tally = {0};
    for (int look = 0; look < 50; look++) {
        ck_assert_int_eq(propagator_event_driven.advance(propagator, 20, &tally), OK);
        ck_assert_double_le(overlap_of(state), 1e-12);
        ck_assert_int_eq(state_validate(state), OK);
    }
    ck_assert_uint_eq(tally.corrected, 0);
    propagator_event_driven.free(propagator);
    state_free(state);
}
END_TEST

// Per interval and direction a free particle moves by Delta times a normal number of variance kT/m.
// A few particles so fast that they outrun the neighbour list: what was run with it is run again.
// Every window must have the collisions of the slow twin that began it from the same state.
START_TEST(what_outruns_the_list_is_run_again_without_a_trace) {
    State *state = packed(2 + _i, 125, _i ? 0.4 : 0.7, 2);
    const Settings settings = settings_of(&propagator_newtonian.options);
    Tally fast = {0}, slow = {0};
    run(&propagator_newtonian, &settings, state, 1, &fast); // draws the velocities
    for (size_t i = 0; i < 125; i += 50) state->velocity[0][i] = 22;
    State *twin = copy_of(state), *whole = copy_of(state);
    const double energy = kinetic_energy(state);
    Propagator *propagator = propagator_of(&propagator_newtonian, &settings, state);
    Reference *reference = NULL;
    ck_assert_int_eq(reference_create(&reference, twin, KEY, 0.01, false, false), OK);
    fast = (Tally){0};
    for (int window = 0; window < 400; window++) {
        ck_assert_msg(propagator_newtonian.advance(propagator, 1, &fast) == OK, "%s",
                      status_sentence());
        reference_advance(reference, 1, &slow);
        ck_assert_uint_eq(fast.collisions, slow.collisions);
        for (size_t i = 0; i < 125; i++) {
            for (int a = 0; a < 2 + _i; a++) {
                ck_assert_double_eq_tol(state_unfolded(state, a, i), state_unfolded(twin, a, i),
                                        1e-9);
                twin->position[a][i] = state->position[a][i];
                twin->velocity[a][i] = state->velocity[a][i];
                twin->image[a][i] = state->image[a][i];
            }
        }
    }
    ck_assert_uint_gt(fast.replays, 0);
    Tally once = {0};
    run(&propagator_newtonian, &settings, whole, 400, &once); // several windows are run again
    ck_assert_uint_gt(once.replays, 0);
    check_same_bits(whole, state);
    ck_assert_mem_eq(once.exchange, fast.exchange, sizeof once.exchange);
    state_free(whole);
    ck_assert_double_eq_tol(kinetic_energy(state) / energy, 1, 1e-12);
    reference_free(reference);
    propagator_newtonian.free(propagator);
    state_free(twin);
    state_free(state);
}
END_TEST

START_TEST(free_particles_diffuse_with_half_the_interval_over_the_mass) {
    System system = system_of(2, 2000, 0, 2);
    system.number_density = 0.5;
    system.species[1].mass = 4;
    State *state = new_state(&system);
    for (size_t i = 0; i < 2000; i++) state->diameter[i] = 1e-9;
    scatter(state, KEY, 0);
    State *start = copy_of(state);
    const Settings settings = settings_of(&propagator_event_driven.options);
    Tally tally = {0};
    run(&propagator_event_driven, &settings, state, 100, &tally);
    double moved[2] = {0};
    for (size_t i = 0; i < 2000; i++) {
        for (int a = 0; a < 2; a++) {
            const double dx = state_unfolded(state, a, i) - state_unfolded(start, a, i);
            moved[state->species_of[i]] += dx * dx / (2 * 1000 * 100 * 1e-4);
        }
    }
    // Of 2000 squares of normal numbers the mean is 1 with standard error 0.032: five of them.
    ck_assert_double_eq_tol(moved[0], 1, 0.16);
    ck_assert_double_eq_tol(4 * moved[1], 1, 0.16);
    ck_assert_double_eq_tol(propagator_event_driven.tick(&settings, &system), 0.01 * 0.005, 1e-15);
    state_free(start);
    state_free(state);
}
END_TEST

START_TEST(a_hopeless_overlap_is_told_not_run_for_ever) {
    State *state = packed(2, 100, 0.6, 1);
    for (size_t i = 0; i < 100; i++) state->diameter[i] = 1.25; // packing fraction 0.94
    const Settings settings = settings_of(&propagator_newtonian.options);
    Propagator *propagator = propagator_of(&propagator_newtonian, &settings, state);
    Tally tally = {0};
    const Status status = propagator_newtonian.advance(propagator, 200, &tally);
    ck_assert(status == UNHEALTHY || (status == OK && tally.corrected > 0));
    propagator_newtonian.free(propagator);
    state_free(state);
}
END_TEST

static void check_refused(const PropagatorKind *kind, const Settings *settings,
                          const System *system, const char *word) {
    ck_assert_int_eq(kind->check(settings, system), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), word) != NULL, "%s", status_sentence());
}

START_TEST(what_cannot_be_done_is_refused_with_a_reason) {
    const PropagatorKind *kind = &propagator_event_driven;
    Settings settings = settings_of(&kind->options);
    System system = system_of(2, 1000, 0.7, 1);
    ck_assert_int_eq(kind->check(&settings, &system), OK);
    system.particles = 3;
    check_refused(kind, &settings, &system, "take more particles");
    system = system_of(2, 1000, 0.7, 1);
    system.species[0].mass = 0.001;
    check_refused(kind, &settings, &system, "window");
    system = system_of(2, 1000, 0.7, 1);
    system.species[0].shape = SHAPE_SPHERE;
    check_refused(kind, &settings, &system, "dimensions");
    system = system_of(2, 1000, 0.7, 1);
    set_number(&settings, &kind->options, "thermostat_interval", 0);
    check_refused(kind, &settings, &system, "thermostat_interval");
    set_number(&settings, &kind->options, "thermostat_interval", 1);
    set_number(&settings, &kind->options, "substeps", 2);
    check_refused(kind, &settings, &system, "window");
}
END_TEST

START_TEST(long_intervals_are_cut_into_short_windows) {
    const PropagatorKind *kind = &propagator_event_driven;
    Settings settings = settings_of(&kind->options);
    static const double intervals[] = {0.001, 0.01, 0.03, 0.031, 1};
    static const int64_t ticks[] = {1, 1, 3, 4, 100};
    for (int k = 0; k < 5; k++) {
        set_number(&settings, &kind->options, "thermostat_interval", intervals[k]);
        ck_assert_int_eq(kind->ticks_per_step(&settings), ticks[k]);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("edbd");
    TCase *exact = tcase_create("exact"), *bits = tcase_create("bits");
    tcase_set_timeout(exact, 120);
    tcase_set_timeout(bits, 120);
    tcase_add_test(exact, two_discs_meet_when_and_as_they_must);
    tcase_add_loop_test(exact, newtonian_motion_conserves_energy_and_momentum, 0, 2);
    tcase_add_test(exact, four_discs_that_meet_at_once_keep_energy_and_momentum);
    tcase_add_loop_test(exact, what_outruns_the_list_is_run_again_without_a_trace, 0, 2);
    tcase_add_loop_test(exact, tiny_overlaps_never_deepen_and_vanish, 0, 4);
    tcase_add_loop_test(exact, dense_states_never_overlap, 0, 2);
    tcase_add_test(exact, free_particles_diffuse_with_half_the_interval_over_the_mass);
    tcase_add_test(exact, a_hopeless_overlap_is_told_not_run_for_ever);
    tcase_add_test(exact, what_cannot_be_done_is_refused_with_a_reason);
    tcase_add_test(exact, long_intervals_are_cut_into_short_windows);
    tcase_add_loop_test(bits, every_instruction_set_gives_the_same_bits, 0, 4);
    tcase_add_loop_test(bits, no_split_and_no_new_start_changes_a_bit, 0, 4);
    tcase_add_loop_test(bits, the_origin_of_time_changes_no_bit, 0, 3);
    suite_add_tcase(suite, exact);
    suite_add_tcase(suite, bits);
    return run_suite(suite);
}
