// SPDX-License-Identifier: GPL-3.0-or-later
// Space and drives of a sheared stage: images, cells and unfolded coordinates of a leaning box, and
// rates whose means over steps add up to the strain.
#include "observables/near_pairs.h"
#include "propagator/drive.h"

#include "observe.h"
#include "suite.h"
#include "rng/rng.h"

#include <stdlib.h>

static const RngKey KEY = {.seed = 20261125};

static Box leaning(int dimension, double lean) {
    Box box = box_of_volume(dimension, 500, (double[3]){1.3, 1, 0.9});
    for (int k = 0; k < 10; k++) box_shear(&box, lean * box.edge[0] / 10);
    return box;
}

static double length2(const double r[3]) {
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

// Of all images within two boxes.
static double nearest2(const Box *box, const double r[3]) {
    double least = INFINITY;
    const int deep = box->dimension == 3 ? 1 : 0;
    for (int x = -2; x <= 2; x++) {
        for (int y = -1; y <= 1; y++) {
            for (int z = -deep; z <= deep; z++) {
                const double image[3] = {r[0] + x * box->edge[0] + y * box->offset,
                                         r[1] + y * box->edge[1], r[2] + z * box->edge[2]};
                least = fmin(least, length2(image));
            }
        }
    }
    return least;
}

static void draw_place(Rng *rng, const Box *box, double place[3]) {
    for (int a = 0; a < 3; a++) place[a] = a < box->dimension ? rng_uniform(rng) * box->edge[a] : 0;
}

// Images closer than half the shortest edge, which contacts must be, are found.
START_TEST(the_nearest_image_is_found_however_the_box_leans) {
    Rng rng = rng_open(KEY, STREAM_PACKING, 0, 0);
    for (int k = 0; k < 20000; k++) {
        const Box box = leaning(2 + k % 2, 3 * rng_uniform(&rng) - 1.5);
        double one[3], other[3], r[3];
        draw_place(&rng, &box, one);
        draw_place(&rng, &box, other);
        for (int a = 0; a < 3; a++) r[a] = one[a] - other[a];
        const double least = nearest2(&box, r);
        box_nearest_image(&box, r);
        const double shortest = fmin(box.edge[1], box.dimension == 3 ? box.edge[2] : box.edge[1]);
        if (sqrt(least) < shortest / 2) ck_assert_double_eq_tol(length2(r), least, 1e-12);
        ck_assert_double_ge(length2(r), least - 1e-12);
    }
}
END_TEST

// With steps and an edge that are sums of few powers of two nothing is rounded.
START_TEST(strain_is_folded_exactly) {
    Box box = {.dimension = 2, .edge = {8, 4, 1}};
    int64_t steps = 0;
    for (int k = 0; k < 100000; k++) {
        const int64_t more = k % 1000 < 700 ? 5 : -9;
        steps += more;
        box_shear(&box, (double)more / 16);
        ck_assert(fabs(box.offset) <= 4);
        ck_assert(box_displacement(&box) == (double)steps / 16);
        ck_assert(box_strain(&box) == (double)steps / 64);
    }
    Box again = {.dimension = 2, .edge = {8, 4, 1}};
    box_lean(&again, box.offset, box_strain(&box));
    ck_assert(again.turns == box.turns && again.turns != 0);
}
END_TEST

// Random places, many of which overlap.
static State *crowd(int dimension, double lean) {
    System system = system_of(dimension, 300, 0.25, 2);
    State *state = new_state(&system);
    box_shear(&state->box, lean * state->box.edge[0]);
    Rng rng = rng_open(KEY, STREAM_PACKING, 1, 0);
    for (size_t i = 0; i < state->count; i++) {
        double place[3];
        draw_place(&rng, &state->box, place);
        for (int a = 0; a < 3; a++) state->position[a][i] = place[a];
        state->diameter[i] = system.species[state->species_of[i]].diameter;
    }
    return state;
}

static double distance(const State *state, size_t i, size_t j) {
    double r[3];
    for (int a = 0; a < 3; a++) r[a] = state->position[a][i] - state->position[a][j];
    return sqrt(nearest2(&state->box, r));
}

START_TEST(cells_of_a_leaning_box_find_all_overlaps_and_all_near_pairs) {
    static const double leans[] = {0, 0.1, -0.3, 0.49, -0.5};
    const double range = 1.7;
    for (size_t k = 0; k < 2 * sizeof leans / sizeof *leans; k++) {
        State *state = crowd(2 + (int)k % 2, leans[k / 2]);
        uint64_t overlaps = 0, expected = 0, near = 0, found = 0;
        for (size_t i = 0; i < state->count; i++) {
            for (size_t j = 0; j < i; j++) {
                const double r = distance(state, i, j);
                expected += r < (state->diameter[i] + state->diameter[j]) / 2;
                near += r < range;
            }
        }
        double deepest = 0;
        ck_assert_int_eq(state_deepest_overlap(state, 0, &deepest, &overlaps), OK);
        ck_assert_uint_eq(overlaps, expected);
        NearPairs *pairs = NULL;
        const Box at_rest = system_box(&state->system);
        ck_assert_int_eq(near_pairs_create(&pairs, &at_rest, state->count, range), OK);
        near_pairs_sort(pairs, state);
        for (size_t slot = 0; slot < state->count; slot++) found += near_pairs_row(pairs, slot);
        ck_assert_uint_eq(found, near);
        ck_assert_uint_ge(expected, 50);
        near_pairs_free(pairs);
        state_free(state);
    }
}
END_TEST

// Steps of a thousandth, so that strains of steps are small beside that of the whole.
static void check_strains(const Flow *flow, double time, double strain, double tolerance) {
    const int steps = 1000;
    double sum = 0;
    for (int k = 0; k < steps; k++) {
        const double from = time * k / steps, to = time * (k + 1) / steps;
        const double rate = flow_rate(flow, from, to);
        ck_assert_double_le(fabs(rate), flow_fastest(flow) * (1 + 1e-12));
        sum += rate * (to - from);
    }
    ck_assert_double_eq_tol(sum, strain, tolerance);
    ck_assert_double_eq_tol(flow_strain(flow, time), strain, tolerance);
}

START_TEST(mean_rates_add_up_to_the_strain) {
    const Flow steady = {.rate = -0.7};
    const Flow wave = {.oscillation = {.amplitude = 0.3, .frequency = 17}};
    const Flow table = {.table = {.times = {3, {1, 2, 4}}, .rates = {3, {-1, 3, 0.5}}}};
    check_strains(&steady, 3, -2.1, 1e-12);
    for (double time = 0.01; time < 40; time *= 1.7)
        check_strains(&wave, time, 0.3 * sin(17 * time), 1e-13);
    // Constant for 1, a line of mean 1 for 1, one of mean 1.75 for 2, then constant.
    check_strains(&table, 0.5, -0.5, 1e-13);
    check_strains(&table, 2, 0, 1e-13);
    check_strains(&table, 3, 3 - 1.25 / 2, 1e-13);
    check_strains(&table, 6, 4.5, 1e-13);
}
END_TEST

START_TEST(a_drive_that_is_not_whole_is_refused) {
    Drive drive = {.flow = {.rate = 1}};
    ck_assert_int_eq(drive_check(&drive), OK);
    ck_assert_uint_eq(drive_kinds(&drive), DRIVE_FLOW);
    drive.flow.oscillation.amplitude = 1;
    ck_assert_int_eq(drive_check(&drive), BAD_DATA);
    drive.flow.rate = 0;
    ck_assert_int_eq(drive_check(&drive), BAD_DATA);
    drive.flow.oscillation.frequency = 1;
    ck_assert_int_eq(drive_check(&drive), OK);
    drive.flow.oscillation.amplitude = drive.flow.oscillation.frequency = 0;
    ck_assert_uint_eq(drive_kinds(&drive), 0);
    drive.flow.table.times = (OptionReals){2, {0, 0}};
    drive.flow.table.rates = (OptionReals){2, {1, 2}};
    ck_assert_int_eq(drive_check(&drive), BAD_DATA);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("shear geometry");
    TCase *all = tcase_create("all");
    tcase_add_test(all, the_nearest_image_is_found_however_the_box_leans);
    tcase_add_test(all, strain_is_folded_exactly);
    tcase_add_test(all, cells_of_a_leaning_box_find_all_overlaps_and_all_near_pairs);
    tcase_add_test(all, mean_rates_add_up_to_the_strain);
    tcase_add_test(all, a_drive_that_is_not_whole_is_refused);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
