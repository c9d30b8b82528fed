// SPDX-License-Identifier: GPL-3.0-or-later
// Base, box, shapes, system and state: what everything else stands on.
#include "suite.h"

#include "base/archive.h"
#include "base/memory.h"
#include "base/status.h"
#include "box/box.h"
#include "shapes/shape.h"
#include "state/state.h"
#include "state/tally.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static System binary_discs(int64_t particles, double packing_fraction) {
    return (System){
        .dimension = 2,
        .particles = particles,
        .packing_fraction = packing_fraction,
        .species_count = 2,
        .species = {
            {.name = "small", .shape = SHAPE_DISC, .diameter = 1, .mass = 1, .fraction = 0.5},
            {.name = "big", .shape = SHAPE_DISC, .diameter = 1.4, .mass = 2, .fraction = 0.5}}};
}

START_TEST(a_failure_is_a_sentence_that_may_quote_itself) {
    ck_assert_int_eq(status_fail(BAD_DATA, "x = %d is wrong", 7), BAD_DATA);
    ck_assert_str_eq(status_sentence(), "x = 7 is wrong");
    status_fail(IO_FAILED, "file.yaml: %s", status_sentence());
    ck_assert_str_eq(status_sentence(), "file.yaml: x = 7 is wrong");
}
END_TEST

START_TEST(memory_is_aligned_zeroed_and_refuses_overflow) {
    double *numbers = memory_new(1000, sizeof *numbers);
    ck_assert_uint_eq((uintptr_t)numbers % MEMORY_ALIGNMENT, 0);
    for (int i = 0; i < 1000; i++) ck_assert_double_eq(numbers[i], 0);
    memory_free(numbers);
    ck_assert_ptr_null(memory_new(SIZE_MAX / 2, 3));
    ck_assert_ptr_nonnull(strstr(status_sentence(), "out of memory"));
    void *nothing = memory_new(0, 8);
    ck_assert_ptr_nonnull(nothing);
    memory_free(nothing);
}
END_TEST

typedef struct Numbers {
    double real[3];
    int64_t integer;
    uint64_t natural;
    int32_t small[2];
} Numbers;

static void numbers_archive(Numbers *numbers, Archive *archive) {
    archive_f64(archive, numbers->real, 3);
    archive_tag(archive, 42);
    archive_i64(archive, &numbers->integer, 1);
    archive_u64(archive, &numbers->natural, 1);
    archive_i32(archive, numbers->small, 2);
}

START_TEST(what_was_saved_is_loaded_and_nothing_else) {
    Numbers saved = {{1.5, -0.0, 1e-300}, INT64_MIN, UINT64_MAX, {-7, 8}},
            loaded = {{0}, 0, 0, {0}};
    Archive writer = archive_writer();
    numbers_archive(&saved, &writer);
    ck_assert_int_eq(archive_status(&writer, true), OK);
    Archive reader = archive_reader(writer.bytes, writer.size);
    numbers_archive(&loaded, &reader);
    ck_assert_int_eq(archive_status(&reader, true), OK);
    ck_assert_mem_eq(&saved, &loaded, sizeof saved);

    for (size_t cut = 0; cut < writer.size; cut++) {
        Archive torn = archive_reader(writer.bytes, cut);
        numbers_archive(&loaded, &torn);
        ck_assert_int_eq(archive_status(&torn, true), BAD_DATA);
    }
    Archive longer = archive_reader(writer.bytes, writer.size);
    archive_f64(&longer, loaded.real, 3);
    ck_assert_int_eq(archive_status(&longer, true), BAD_DATA);
    writer.bytes[24] ^= 1; // the tag
    Archive spoiled = archive_reader(writer.bytes, writer.size);
    numbers_archive(&loaded, &spoiled);
    ck_assert_int_eq(archive_status(&spoiled, true), BAD_DATA);
    archive_free(&writer);
}
END_TEST

START_TEST(the_nearest_image_is_never_further_than_half_an_edge) {
    const Box box = {.dimension = 2, .edge = {10, 4, 1}};
    double r[3] = {9, -3, 0.7};
    box_nearest_image(&box, r);
    ck_assert_double_eq(r[0], -1);
    ck_assert_double_eq(r[1], 1);
    ck_assert_double_eq(r[2], 0.7); // not an axis of this box
    double back[3] = {-1, 0, 0};    // floor instead of round would give 9
    box_nearest_image(&box, back);
    ck_assert_double_eq(back[0], -1);
}
END_TEST

START_TEST(a_box_has_the_wanted_volume_and_aspect) {
    const double aspect[3] = {4, 1, 2};
    const Box box = box_of_volume(3, 64, aspect);
    ck_assert_double_eq_tol(box_volume(&box), 64, 1e-12);
    ck_assert_double_eq_tol(box.edge[0] / box.edge[1], 4, 1e-14);
    ck_assert_double_eq_tol(box.edge[2] / box.edge[1], 2, 1e-14);
}
END_TEST

static double second_virial(ShapeKind shape, double a, double b) {
    const Body one = {.shape = shape, .diameter = a}, other = {.shape = shape, .diameter = b};
    return shape_second_virial(&one, &other);
}

START_TEST(second_virial_coefficients_are_half_the_excluded_volume) {
    ck_assert_double_eq_tol(second_virial(SHAPE_DISC, 1, 1), M_PI / 2, 1e-15);
    ck_assert_double_eq_tol(second_virial(SHAPE_SPHERE, 1, 1), 2 * M_PI / 3, 1e-15);
    // [analytic] binary discs 1.4, equal numbers: 2.2933627
    const double mixed = (second_virial(SHAPE_DISC, 1, 1) + 2 * second_virial(SHAPE_DISC, 1, 1.4) +
                          second_virial(SHAPE_DISC, 1.4, 1.4)) /
                         4;
    ck_assert_double_eq_tol(mixed, 2.2933627, 1e-7);
}
END_TEST

START_TEST(number_density_and_packing_fraction_say_the_same) {
    System system = binary_discs(1000, 0.79);
    ck_assert_double_eq_tol(system_number_density(&system), 0.6796347, 1e-7); // [analytic]
    System other = system;
    other.packing_fraction = 0;
    other.number_density = system_number_density(&system);
    ck_assert_double_eq_tol(system_packing_fraction(&other), 0.79, 1e-14);
    const Box box = system_box(&system);
    ck_assert_double_eq_tol(1000 / box_volume(&box), 0.6796347, 1e-7);
}
END_TEST

START_TEST(species_counts_are_the_nearest_that_add_up) {
    System system = binary_discs(10, 0.5);
    system.species_count = 3;
    system.species[2] = system.species[1];
    system.species[0].fraction = 1.0 / 3;
    system.species[1].fraction = 1.0 / 3;
    system.species[2].fraction = 1.0 / 3;
    size_t counts[SPECIES_MOST];
    system_counts(&system, counts);
    ck_assert_uint_eq(counts[0] + counts[1] + counts[2], 10);
    for (int s = 0; s < 3; s++) ck_assert_uint_ge(counts[s], 3);
}
END_TEST

START_TEST(counts_come_before_fractions) {
    System system = binary_discs(11, 0.5);
    system.species_count = 3;
    system.species[2] = system.species[1];
    system.species[2].count = 1;
    system.species[2].fraction = 0;
    size_t counts[SPECIES_MOST];
    ck_assert_int_eq(system_check_counts(&system), OK);
    system_counts(&system, counts);
    ck_assert_uint_eq(counts[0], 5);
    ck_assert_uint_eq(counts[1], 5);
    ck_assert_uint_eq(counts[2], 1);
    system.species[0].count = system.species[1].count = 5;
    ck_assert_int_eq(system_check_counts(&system), BAD_DATA); // beside a fraction
    system.species[0].fraction = system.species[1].fraction = 0;
    ck_assert_int_eq(system_check_counts(&system), OK);
    system.particles = 12;
    ck_assert_int_eq(system_check_counts(&system), BAD_DATA); // one is nobody's
    system.species[0].count = 0;
    system.species[0].fraction = 1;
    system.particles = 6;
    ck_assert_int_eq(system_check_counts(&system), BAD_DATA); // nothing is left to share
}
END_TEST

START_TEST(a_spread_of_sizes_raises_the_moments_as_it_must) {
    System system = binary_discs(1000, 0.5);
    system.species_count = 1;
    system.species[0].fraction = 1;
    system.species[0].spread = SPREAD_GAUSSIAN;
    system.species[0].spread_width = 0.1;
    ck_assert_double_eq_tol(system_diameter_moment(&system, 1), 1, 1e-15);
    ck_assert_double_eq_tol(system_diameter_moment(&system, 2), 1.01, 1e-14);
    ck_assert_double_eq_tol(system_diameter_moment(&system, 3), 1.03, 1e-14);
}
END_TEST

static State *scattered(const System *system) {
    State *state = NULL;
    ck_assert_int_eq(state_create(&state, system), OK);
    srand(3);
    for (size_t i = 0; i < state->count; i++) {
        state->diameter[i] = system->species[state->species_of[i]].diameter;
        for (int a = 0; a < state->box.dimension; a++) {
            state->position[a][i] = state->box.edge[a] * (rand() / (RAND_MAX + 1.0));
            state->velocity[a][i] = rand() / (double)RAND_MAX - 0.5;
            state->image[a][i] = rand() % 7 - 3;
        }
    }
    return state;
}

// The slow twin: every pair.
static double deepest_by_all_pairs(const State *state, uint64_t *pairs) {
    double deepest = 0;
    *pairs = 0;
    for (size_t i = 0; i < state->count; i++) {
        for (size_t j = i + 1; j < state->count; j++) {
            double r[3] = {0};
            for (int a = 0; a < state->box.dimension; a++) {
                r[a] = state->position[a][i] - state->position[a][j];
                r[a] -= state->box.edge[a] * round(r[a] / state->box.edge[a]);
            }
            const double contact = (state->diameter[i] + state->diameter[j]) / 2;
            const double depth = 1 - sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / contact;
            *pairs += depth > 0.1;
            if (depth > deepest) deepest = depth;
        }
    }
    return deepest;
}

START_TEST(cells_find_the_overlaps_that_all_pairs_find) {
    static const int64_t sizes[] = {2, 5, 20, 400};
    for (int k = 0; k < 4; k++) {
        const System system = binary_discs(sizes[k], 0.3);
        State *state = scattered(&system);
        double deepest = -1;
        uint64_t pairs = 99, expected = 0;
        ck_assert_int_eq(state_deepest_overlap(state, 0.1, &deepest, &pairs), OK);
        ck_assert_double_eq_tol(deepest, deepest_by_all_pairs(state, &expected), 1e-14);
        ck_assert_uint_eq(pairs, expected);
        state_free(state);
    }
}
END_TEST

START_TEST(a_state_is_loaded_to_the_bit_and_a_spoiled_one_is_refused) {
    const System system = binary_discs(50, 0.3);
    State *saved = scattered(&system), *loaded = NULL;
    saved->step = INT64_C(1) << 40;
    Archive writer = archive_writer();
    state_archive(saved, &writer);
    ck_assert_int_eq(state_create(&loaded, &system), OK);
    Archive reader = archive_reader(writer.bytes, writer.size);
    state_archive(loaded, &reader);
    ck_assert_int_eq(archive_status(&reader, true), OK);
    for (int a = 0; a < 2; a++) {
        ck_assert_mem_eq(saved->position[a], loaded->position[a], 50 * sizeof(double));
        ck_assert_mem_eq(saved->velocity[a], loaded->velocity[a], 50 * sizeof(double));
        ck_assert_mem_eq(saved->image[a], loaded->image[a], 50 * sizeof(int32_t));
    }
    ck_assert_int_eq(loaded->step, saved->step);
    ck_assert_int_eq(saved->species_of[49], 1);

    saved->position[1][7] = NAN;
    Archive poison = archive_writer();
    state_archive(saved, &poison);
    Archive bad = archive_reader(poison.bytes, poison.size);
    state_archive(loaded, &bad);
    ck_assert_int_eq(archive_status(&bad, true), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "particle 7"));
    archive_free(&writer);
    archive_free(&poison);
    state_free(saved);
    state_free(loaded);
}
END_TEST

START_TEST(tallies_add) {
    Tally sum = {.collisions = 2, .exchange = {{1, 2}, {3, 4}}, .deepest_contact = 1e-15};
    const Tally more = {.collisions = UINT64_C(1) << 33, .exchange = {{1, 1}, {1, 1}}};
    tally_add(&sum, &more);
    ck_assert_uint_eq(sum.collisions, (UINT64_C(1) << 33) + 2);
    ck_assert_double_eq(sum.exchange[1][1], 5);
    ck_assert_double_eq(sum.deepest_contact, 1e-15);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("base");
    TCase *all = tcase_create("all");
    tcase_add_test(all, a_failure_is_a_sentence_that_may_quote_itself);
    tcase_add_test(all, memory_is_aligned_zeroed_and_refuses_overflow);
    tcase_add_test(all, what_was_saved_is_loaded_and_nothing_else);
    tcase_add_test(all, the_nearest_image_is_never_further_than_half_an_edge);
    tcase_add_test(all, a_box_has_the_wanted_volume_and_aspect);
    tcase_add_test(all, second_virial_coefficients_are_half_the_excluded_volume);
    tcase_add_test(all, number_density_and_packing_fraction_say_the_same);
    tcase_add_test(all, species_counts_are_the_nearest_that_add_up);
    tcase_add_test(all, counts_come_before_fractions);
    tcase_add_test(all, a_spread_of_sizes_raises_the_moments_as_it_must);
    tcase_add_test(all, cells_find_the_overlaps_that_all_pairs_find);
    tcase_add_test(all, a_state_is_loaded_to_the_bit_and_a_spoiled_one_is_refused);
    tcase_add_test(all, tallies_add);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
