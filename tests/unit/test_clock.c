// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of dynamic Monte Carlo: amplitudes against closed forms, time of free bodies, slices
// and resumes to the bit, also inside a cycle that is being measured.
#include "dmc/agreement.h"
#include "dmc/clock.h"
#include "dmc/dmc.h"
#include "dmc/predict.h"
#include "observe.h"
#include "suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const Diffusion platelet = {.parallel = 0.125, .perpendicular = 0.1875, .rotational = 0.75};
static const ChainSettings mixed = {.stream = STREAM_TRIALS, .rotation = ROTATION_MIXED};

START_TEST(amplitudes_of_platelets_match) {
    // Jabbari-Farouji and Trizac, eq. 9 with its ratio turned: computed apart, to ten digits.
    ck_assert_double_eq_tol(amplitude_matched(0.01, &platelet, &mixed).rotation, 0.0239080761,
                            1e-9);
    ck_assert_double_eq_tol(amplitude_matched(0.1, &platelet, &mixed).rotation, 0.1959665289, 1e-9);
    ck_assert_double_eq_tol(amplitude_matched(0.05, &platelet, &mixed).rotation, 0.109, 5e-4);
    ck_assert_double_eq_tol(amplitude_matched(0.2, &platelet, &mixed).rotation, 0.324, 5e-4);
    ck_assert_double_eq_tol(amplitude_matched(0.2, &platelet, &mixed).perpendicular,
                            0.2 * sqrt(1.5), 1e-15);
}
END_TEST

START_TEST(the_largest_step_is_where_rotation_is_one_half) {
    const double limit = amplitude_limit(&platelet, &mixed);
    ck_assert_double_eq_tol(amplitude_matched(limit, &platelet, &mixed).rotation, 0.5, 1e-12);
}
END_TEST

START_TEST(free_rotations_lose_what_closed_forms_say) {
    const Amplitude amplitude = {.parallel = 0.1, .perpendicular = 0.1, .rotation = 0.196};
    const FreeMove move = amplitude_free_move(&amplitude, 3, &mixed);
    const double r = 0.196 / 0.804;
    ck_assert_double_eq_tol(move.squares.rotational, r * r / 3, 1e-15);
    ck_assert_double_eq_tol(1 - move.second, 0.9412832635, 1e-9); // by quadrature, apart
}
END_TEST

// Bodies on a cubic lattice, `spacing` apart, axes in many directions.
static State *lattice(ShapeKind shape, int edge, double spacing) {
    System system = {.dimension = 3, .particles = edge * edge * edge, .species_count = 1};
    system.number_density = 1 / (spacing * spacing * spacing);
    system.species[0] = (Species){.name = "a",
                                  .shape = shape,
                                  .diameter = 1,
                                  .mass = 1,
                                  .fraction = 1,
                                  .exponent = 36,
                                  .length = shape == SHAPE_SPHEROCYLINDER ? 5 : 0};
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, &system), OK);
    for (size_t i = 0; i < state->count; i++) {
        const int at[3] = {(int)i % edge, (int)i / edge % edge, (int)i / edge / edge};
        for (int a = 0; a < 3; a++) state->position[a][i] = (at[a] + 0.5) * spacing;
        state->diameter[i] = 1;
        if (!state->oriented) continue;
        const double z = 2 * ((double)i + 0.5) / (double)state->count - 1, angle = 2.4 * (double)i;
        state->orientation[0][i] = sqrt(1 - z * z) * cos(angle);
        state->orientation[1][i] = sqrt(1 - z * z) * sin(angle);
        state->orientation[2][i] = z;
    }
    return state;
}

typedef struct Case {
    ShapeKind shape;
    double step;
    const char *clock, *matching, *matched;
    double spacing;
} Case;

static const Case cases[] = {
    {SHAPE_SPHERE, 0.2, "acceptance-rescaling", "per-cycle", "parallel", 20},
    {SHAPE_SPHERE, 0.2, "diffusion-matching", "per-cycle", "parallel", 20},
    {SHAPE_SPHERE, 0.2, "diffusion-matching", "per-attempt", "parallel", 20},
    {SHAPE_PLATELET, 0.2, "acceptance-rescaling", "per-cycle", "parallel", 20},
    {SHAPE_PLATELET, 0.2, "diffusion-matching", "per-cycle", "parallel", 20},
    {SHAPE_PLATELET, 0.2, "diffusion-matching", "per-cycle", "perpendicular", 20},
    {SHAPE_PLATELET, 0.2, "diffusion-matching", "per-cycle", "rotational", 20},
    {SHAPE_PLATELET, 0.2, "diffusion-matching", "per-attempt", "rotational", 20},
    {SHAPE_SPHEROCYLINDER, 0.3, "diffusion-matching", "per-cycle", "parallel", 40},
};

static void choose(Settings *settings, const char *name, const char *word) {
    const OptionTable *table = &propagator_dynamic_monte_carlo.options;
    for (size_t r = 0; r < table->count; r++) {
        if (strcmp(table->rows[r].name, name) != 0) continue;
        for (int64_t c = 0; table->rows[r].choices[c]; c++) {
            if (strcmp(table->rows[r].choices[c], word) != 0) continue;
            memcpy(settings->bytes + table->rows[r].offset, &c, sizeof c);
            return;
        }
    }
    ck_abort_msg("no %s: %s", name, word);
}

static Settings settings_for(const Case *now) {
    Settings settings = settings_of(&propagator_dynamic_monte_carlo.options);
    set_number(&settings, &propagator_dynamic_monte_carlo.options, "step", now->step);
    choose(&settings, "clock", now->clock);
    choose(&settings, "matching", now->matching);
    choose(&settings, "matched", now->matched);
    return settings;
}

static Propagator *create(const Settings *settings, State *state) {
    Propagator *propagator = NULL;
    ck_assert_msg(propagator_dynamic_monte_carlo.create(&propagator, settings, state,
                                                        (RngKey){.seed = 7}) == OK,
                  "%s", status_sentence());
    return propagator;
}

static Propagator *begin(const Settings *settings, State *state) {
    Propagator *propagator = create(settings, state);
    ck_assert_msg(propagator->kind->prepare(propagator) == OK, "%s", status_sentence());
    return propagator;
}

// So far apart that nothing meets: <r^2> = 6 D0 t by each clock, and only that much by chance off.
START_TEST(free_bodies_diffuse_in_time) {
    const Case *now = &cases[_i];
    State *state = lattice(now->shape, 10, now->spacing);
    const Settings settings = settings_for(now);
    Propagator *propagator = begin(&settings, state);
    double start[3][1000], square = 0;
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < 1000; i++) start[a][i] = state_unfolded(state, a, i);
    }
    Tally tally = {0};
    const int64_t ticks = 300;
    ck_assert_int_eq(propagator->kind->advance(propagator, ticks, &tally), OK);
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < 1000; i++) {
            const double r = state_unfolded(state, a, i) - start[a][i];
            square += r * r / 1000;
        }
    }
    const double time = (double)ticks * propagator->kind->tick(&settings, &state->system);
    // Of 1000 squares of three normal components the mean is known to sqrt(2/3000); the clock
    // itself to 1 %.
    const double error = sqrt(2 / 3000.0 + 0.01 * 0.01);
    ck_assert_double_eq_tol(square / (6 * time), 1, 4 * error);
    // The clock is at worst known by one component of each body in one of 32 cycles.
    const double cycles = (double)tally.moves[0].trials / 1000;
    const double clock_error = sqrt(2 / (1000 * cycles / 32));
    const Diffusion diffusion = species_diffusion(&state->system.species[0]);
    const double free_cycle = now->step * now->step / (6 * diffusion.parallel) *
                              system_reference_diffusion(&state->system);
    ck_assert_msg(fabs(time / cycles / free_cycle - 1) < 4 * clock_error,
                  "a cycle lasts %.4f of a free one", time / cycles / free_cycle);
    propagator->kind->free(propagator);
    state_free(state);
}
END_TEST

static void ck_assert_same(const State *a, const State *b) {
    ck_assert_int_eq(a->step, b->step);
    for (int k = 0; k < 3; k++) {
        const size_t bytes = a->count * sizeof(double);
        ck_assert_mem_eq(a->position[k], b->position[k], bytes);
        ck_assert_mem_eq(a->image[k], b->image[k], a->count * sizeof(int32_t));
        if (a->oriented) ck_assert_mem_eq(a->orientation[k], b->orientation[k], bytes);
    }
}

// Everything saved and taken up again by a new propagator after every `every` ticks: among 100
// ticks are all places in and out of measured cycles.
static void stop_and_go(const Settings *settings, State *state, int64_t every, Tally *tally) {
    Propagator *propagator = begin(settings, state);
    for (int64_t done = 0; done < 100; done += every) {
        ck_assert_int_eq(propagator->kind->advance(propagator, every, tally), OK);
        Archive saved = archive_writer();
        propagator->kind->archive(propagator, &saved);
        ck_assert_int_eq(archive_status(&saved, true), OK);
        propagator->kind->free(propagator);
        propagator = create(settings, state);
        Archive loading = archive_reader(saved.bytes, saved.size);
        propagator->kind->archive(propagator, &loading);
        ck_assert_msg(archive_status(&loading, true) == OK, "%s", status_sentence());
        archive_free(&saved);
    }
    propagator->kind->free(propagator);
}

START_TEST(slices_and_resumes_change_no_bit) {
    static const Case dense[] = {
        {SHAPE_SPHERE, 0.1, "diffusion-matching", "per-cycle", "parallel", 1.2},
        {SHAPE_SPHERE, 0.1, "acceptance-rescaling", "per-cycle", "parallel", 1.2},
        {SHAPE_PLATELET, 0.05, "diffusion-matching", "per-cycle", "rotational", 1.2},
    };
    const Settings settings = settings_for(&dense[_i]);
    State *whole = lattice(dense[_i].shape, 5, dense[_i].spacing);
    State *sliced = lattice(dense[_i].shape, 5, dense[_i].spacing);
    Tally one = {0}, other = {0};
    Propagator *propagator = begin(&settings, whole);
    ck_assert_int_eq(propagator->kind->advance(propagator, 100, &one), OK);
    propagator->kind->free(propagator);
    stop_and_go(&settings, sliced, 1, &other);
    ck_assert_same(whole, sliced);
    ck_assert_mem_eq(&one.moves, &other.moves, sizeof one.moves);
    state_free(whole);
    state_free(sliced);
}
END_TEST

START_TEST(predicted_acceptances_are_those_measured) {
    // Monte Carlo of 1024 hard spheres and of 500 platelets at number density 2, run apart.
    System spheres = {.dimension = 3, .particles = 1024, .species_count = 1};
    spheres.species[0] =
        (Species){.name = "a", .shape = SHAPE_SPHERE, .diameter = 1, .fraction = 1};
    static const double known[][4] = {{0.5, 0.01, 0.8446, 0.01}, {0.5, 0.07, 0.317, 0.01},
                                      {0.5, 0.1, 0.202, 0.01},   {0.3, 0.1, 0.6557, 0.01},
                                      {0.3, 0.2, 0.4376, 0.01},  {0.1, 0.1, 0.9278, 0.005}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        spheres.packing_fraction = known[k][0];
        ck_assert_double_eq_tol(predict_acceptance(&spheres, 0, known[k][1], &mixed), known[k][2],
                                known[k][3]);
        const double step = predict_step(&spheres, 0, known[k][2], &mixed);
        ck_assert_double_eq_tol(step / known[k][1], 1, 0.06);
    }
    System discs = {.dimension = 3, .particles = 500, .number_density = 2, .species_count = 1};
    discs.species[0] =
        (Species){.name = "a", .shape = SHAPE_PLATELET, .diameter = 1, .fraction = 1};
    ck_assert_double_eq_tol(predict_acceptance(&discs, 0, 0.01, &mixed), 0.9284, 0.02);
    ck_assert_double_eq_tol(predict_acceptance(&discs, 0, 0.05, &mixed), 0.6878, 0.05);
}
END_TEST

// What is predicted is the acceptance of bodies that point anywhere: 0.03 here, where 500 upright
// platelets that have melted to a nematic accept 0.41.
START_TEST(a_nematic_may_take_steps_that_isotropic_bodies_may_not) {
    static const Case step = {SHAPE_PLATELET, 0.01,       "acceptance-rescaling",
                              "per-cycle",    "parallel", 1};
    const Settings settings = settings_for(&step);
    System system = {.dimension = 3, .particles = 500, .number_density = 24, .species_count = 1};
    system.species[0] =
        (Species){.name = "a", .shape = SHAPE_PLATELET, .diameter = 1, .fraction = 1};
    const PropagatorKind *kind = &propagator_dynamic_monte_carlo;
    ck_assert_int_eq(kind->check(&settings, &system), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "where the clock has no meaning"));
    system.start = START_CRYSTAL;
    ck_assert_int_eq(kind->check(&settings, &system), OK);
    Text lines = {0};
    kind->describe(&settings, &system, &(Drive){0}, 1, &lines);
    ck_assert_ptr_nonnull(strstr(text_words(&lines), ", more in a nematic"));
    ck_assert_ptr_nonnull(strstr(text_words(&lines), ", a longer one in a nematic"));
    text_free(&lines);
}
END_TEST

// A particle that is crowded for 200 trials on average, and free for as many: its acceptances, in
// blocks of so many trials, beside a clock that is known. Its own is `fast` times that.
typedef struct Crowd {
    double crowded, free, fast;
    int64_t trials;
} Crowd;

static Agreement noted(const Crowd *crowd, uint64_t sample) {
    static const double SWITCHING = 1 / 200.0;
    Rng rng = rng_open((RngKey){.seed = 5, .replica = sample}, STREAM_TRIALS, 0, 0);
    Agreement agreement = {0};
    bool crowded = sample % 2;
    double accepted = 0, trials = 0;
    for (int b = 0; b < AGREEMENT_BLOCKS; b++) {
        for (int64_t k = 0; k < crowd->trials; k++, trials++) {
            if (rng_uniform(&rng) < SWITCHING) crowded = !crowded;
            accepted += rng_uniform(&rng) < (crowded ? crowd->crowded : crowd->free);
        }
        agreement.cycle[b][0] = 3 * (crowd->crowded + crowd->free) / 2;
        agreement.cycle[b][1] = 3 * crowd->fast * accepted / trials;
    }
    return agreement;
}

START_TEST(the_error_of_a_clock_is_that_of_trials_that_follow_each_other) {
    enum { SAMPLES = 500 };
    static const Crowd crowd = {.crowded = 0.5, .free = 0.9, .fast = 1, .trials = 2000};
    double square = 0, told = 0;
    for (uint64_t k = 0; k < SAMPLES; k++) {
        const Agreement agreement = noted(&crowd, k);
        const double apart = agreement_apart(&agreement, 1), error = agreement_error(&agreement, 1);
        square += apart * apart / SAMPLES;
        told += error * error / SAMPLES;
    }
    // The mean square is known to sqrt(2/500), 6 %; blocks of 20 correlation times miss 5 %.
    ck_assert_double_eq_tol(told / square, 0.95, 4 * sqrt(2.0 / SAMPLES));
    ck_assert_double_gt(sqrt(square), 3.5 * sqrt(0.21 / (AGREEMENT_BLOCKS * 2000.0)) / 0.7);
}
END_TEST

START_TEST(few_encounters_are_no_disagreement_and_another_clock_is_one) {
    enum { SAMPLES = 500 };
    static const Crowd alike = {.crowded = 0.1, .free = 0.9, .fast = 1, .trials = 500},
                       apart = {.crowded = 0.5, .free = 0.9, .fast = 1.4, .trials = 2000};
    int refused = 0, passed = 0, far = 0;
    for (uint64_t k = 0; k < SAMPLES; k++) {
        const Agreement one = noted(&alike, k), two = noted(&apart, k);
        refused += !agreement_holds(&one, 1);
        passed += agreement_holds(&two, 1);
        far += fabs(agreement_apart(&one, 1)) > 0.1 + 4 / sqrt(8000.0);
    }
    ck_assert_int_eq(refused, 0);
    ck_assert_int_eq(passed, 0);
    ck_assert_int_gt(far, SAMPLES / 10); // farther than so many independent trials would be
}
END_TEST

int main(void) {
    Suite *suite = suite_create("clock");
    TCase *unit = tcase_create("clock");
    tcase_set_timeout(unit, 300);
    tcase_add_test(unit, amplitudes_of_platelets_match);
    tcase_add_test(unit, the_largest_step_is_where_rotation_is_one_half);
    tcase_add_test(unit, free_rotations_lose_what_closed_forms_say);
    tcase_add_test(unit, the_error_of_a_clock_is_that_of_trials_that_follow_each_other);
    tcase_add_test(unit, few_encounters_are_no_disagreement_and_another_clock_is_one);
    tcase_add_test(unit, predicted_acceptances_are_those_measured);
    tcase_add_test(unit, a_nematic_may_take_steps_that_isotropic_bodies_may_not);
    tcase_add_loop_test(unit, free_bodies_diffuse_in_time, 0, sizeof cases / sizeof *cases);
    tcase_add_loop_test(unit, slices_and_resumes_change_no_bit, 0, 3);
    suite_add_tcase(suite, unit);
    return run_suite(suite);
}
