// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the theory under shear as a whole: what is asked for is in the results, under the names
// and axes of a simulation, and the parts agree with each other.
#include "suite.h"

#include "itt/itt.h"
#include "itt/transient.h"

#include "oz/oz.h"

#include <check.h>
#include <math.h>

static IttPlan plan_of(double packing_fraction, double rate) {
    return (IttPlan){.given = true,
                     .structure = CLOSURE_FUNDAMENTAL,
                     .packing_fraction = packing_fraction,
                     .spacing = 0.8,
                     .last_wave_number = 16,
                     .shear_rate = rate,
                     .last_strain = 6,
                     .block = 32,
                     .tagged = 1,
                     .wave_numbers = {1, {6.4}},
                     .first_time = 1e-3,
                     .times_per_decade = 20};
}

static Results *run(const IttPlan *plan) {
    Itt *itt = NULL;
    Results *results = NULL;
    double before = 0;
    ck_assert_msg(itt_check(plan) == OK, "%s", status_sentence());
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(itt_create(&itt, plan, NULL), OK);
    while (!itt_finished(itt)) {
        ck_assert_msg(itt_advance(itt, results) == OK, "%s", status_sentence());
        ck_assert(itt_progress(itt) >= before);
        before = itt_progress(itt);
    }
    ck_assert_double_eq(before, 1);
    itt_free(itt);
    ck_assert_ptr_null(results_broken_limit(results));
    return results;
}

static double number(const Results *results, const char *name) {
    const ResultScalar *scalar = results_find_scalar(results, "theory", name);
    ck_assert_msg(scalar != NULL, "no %s", name);
    return scalar->values[0];
}

static const ResultSeries *series(const Results *results, const char *name) {
    const ResultSeries *found = results_find_series(results, "theory", name);
    ck_assert_msg(found != NULL, "no %s", name);
    return found;
}

START_TEST(a_glass_has_a_maximum_of_the_stress) {
    const IttPlan plan = plan_of(0.7, 0.1);
    Results *results = run(&plan);
    const ResultSeries *stress = series(results, "stress");
    const size_t strains = stress->axis[1].count;
    double most = 0, slope = 0;
    for (size_t i = 0; i < strains; i++) most = fmax(most, stress->values[i]);
    ck_assert_double_ge(number(results, "largest_stress"), most);
    ck_assert_double_eq_tol(number(results, "largest_stress") / most, 1, 2e-3);
    ck_assert_double_eq(number(results, "shear_stress"), stress->values[strains - 1]);
    ck_assert_double_gt(most, 1.2 * stress->values[strains - 1]);
    ck_assert_double_eq(number(results, "shear_viscosity"), stress->values[strains - 1] / 0.1);
    // The stress begins as modulus times strain.
    slope = stress->values[0] / stress->axis[1].values[0];
    const ResultSeries *modulus = series(results, "transient_modulus");
    ck_assert(slope > modulus->values[modulus->axis[0].count / 2] && slope < modulus->values[0]);
    results_free(results);
}
END_TEST

// The picture, its cuts, and what they are less at rest: on the axis q_x = 0 nothing changes.
START_TEST(pictures_and_cuts_of_the_structure_agree) {
    const IttPlan plan = plan_of(0.6, 1);
    Results *results = run(&plan);
    const ResultSeries *picture = series(results, "planar_structure_factor");
    const ResultSeries *change = series(results, "planar_structure_factor_change");
    const ResultSeries *cuts = series(results, "structure_factor_cuts");
    const size_t side = picture->axis[1].count, half = side / 2, count = cuts->axis[2].count;
    for (size_t k = 0; k < half && k < count; k++) {
        ck_assert_double_eq_tol(cuts->values[k], picture->values[(half + k + 1) * side + half],
                                1e-12);
        ck_assert_double_eq_tol(cuts->values[count + k],
                                picture->values[half * side + half + k + 1], 1e-12);
    }
    for (size_t j = 0; j < side; j++) ck_assert_double_eq(change->values[half * side + j], 0);
    for (size_t k = 0; k < side * side; k++)
        ck_assert_double_eq_tol(change->values[k], change->values[side * side - 1 - k], 1e-12);
    results_free(results);
}
END_TEST

static IttPlan plan_of_binary(void) {
    IttPlan plan = plan_of(0.68, 1);
    plan.structure = CLOSURE_PERCUS_YEVICK;
    plan.last_strain = 12; // composition at small wave numbers decays late
    plan.species_count = 2;
    plan.species[0] = (TheorySpecies){"small", 1, 0.6, 1};
    plan.species[1] = (TheorySpecies){"big", 1.4, 0.4, 0.7};
    return plan;
}

// Rows of pairs, and their total: of what begins at 1 and of what adds up.
START_TEST(a_mixture_has_rows_of_pairs_and_species) {
    const IttPlan plan = plan_of_binary();
    Results *results = run(&plan);
    const ResultSeries *phi = series(results, "advected_scattering_normalised");
    const ResultSeries *change = series(results, "structure_factor_cuts_change");
    ck_assert_uint_eq(phi->axis[0].count, 4);
    ck_assert_str_eq(phi->axis[0].labels[1], "small-big");
    ck_assert_str_eq(phi->axis[0].labels[3], "total");
    const size_t lines = TRANSIENT_DIRECTIONS * phi->axis[2].count, times = phi->axis[3].count;
    for (size_t i = 0; i < 4 * lines; i++) // at the first time, 1e-3
        ck_assert_double_eq_tol(phi->values[i * times], 1, 0.1);
    const size_t row = change->axis[1].count * change->axis[2].count;
    for (size_t i = 0; i < row; i++) {
        const double *c = change->values + i;
        ck_assert_double_eq_tol(c[0] + 2 * c[row] + c[2 * row], c[3 * row], 1e-12);
    }
    ck_assert_uint_eq(series(results, "self_scattering")->axis[0].count, 2);
    ck_assert_double_gt(number(results, "diffusion_across_flow_small"),
                        number(results, "diffusion_across_flow_big"));
    results_free(results);
}
END_TEST

static void finish(Itt *itt, Results *results) {
    while (!itt_finished(itt))
        ck_assert_msg(itt_advance(itt, results) == OK, "%s", status_sentence());
}

// What was saved in the middle goes on to the same bits.
START_TEST(a_mixture_goes_on_from_where_it_was_saved) {
    const IttPlan plan = plan_of_binary();
    Itt *itt = NULL, *later = NULL;
    Results *results = NULL, *again = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(results_create(&again, 1), OK);
    ck_assert_int_eq(itt_create(&itt, &plan, NULL), OK);
    ck_assert_int_eq(itt_create(&later, &plan, NULL), OK);
    while (itt_time(itt) < 0.01) ck_assert_int_eq(itt_advance(itt, results), OK);
    Archive saved = archive_writer();
    itt_save(itt, &saved);
    Archive loaded = archive_reader(saved.bytes, saved.size);
    ck_assert_msg(itt_load(later, again, &loaded) == OK, "%s", status_sentence());
    finish(itt, results);
    finish(later, again);
    const ResultSeries *one = series(results, "self_scattering");
    const ResultSeries *other = series(again, "self_scattering");
    for (size_t i = 0; i < one->size; i++) ck_assert_double_eq(one->values[i], other->values[i]);
    ck_assert_double_eq(number(results, "shear_stress"), number(again, "shear_stress"));
    archive_free(&saved);
    itt_free(itt);
    itt_free(later);
    results_free(results);
    results_free(again);
}
END_TEST

START_TEST(what_is_not_asked_for_is_not_there) {
    IttPlan plan = plan_of(0.4, 5);
    plan.tagged = 0;
    plan.wave_numbers.count = 0;
    Results *results = run(&plan);
    const ResultSeries *phi = series(results, "advected_scattering_normalised");
    ck_assert_double_eq_tol(phi->axis[2].values[0], 6, 1.5); // the peak of S(q)
    ck_assert_ptr_null(results_find_series(results, "theory", "self_scattering"));
    ck_assert_ptr_null(results_find_scalar(results, "theory", "diffusion_across_flow"));
    results_free(results);
}
END_TEST

START_TEST(a_separation_is_counted_from_the_transition) {
    IttPlan plan = plan_of(0, 10);
    plan.separation = -0.05;
    plan.last_wave_number = 30;
    Itt *itt = NULL;
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(itt_create(&itt, &plan, NULL), OK);
    while (!results_find_scalar(results, "theory", "packing_fraction"))
        ck_assert_int_eq(itt_advance(itt, results), OK);
    ck_assert_double_eq_tol(number(results, "critical_packing_fraction"), 0.69064, 1e-4);
    ck_assert_double_eq(number(results, "packing_fraction"),
                        0.95 * number(results, "critical_packing_fraction"));
    itt_free(itt);
    results_free(results);
}
END_TEST

// The hypernetted chain's transition depends on the cutoff as no other: the theory at rest finds
// 0.6933 at 24/d, 0.6816 at 40/d.
START_TEST(the_transition_is_that_of_the_plane_s_cutoff) {
    const double known[][2] = {{24, 0.6933}, {40, 0.6816}};
    IttPlan plan = plan_of(0, 10);
    plan.structure = CLOSURE_HYPERNETTED_CHAIN;
    plan.separation = -0.05;
    plan.last_wave_number = known[_i][0];
    Itt *itt = NULL;
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(itt_create(&itt, &plan, NULL), OK);
    ck_assert_msg(itt_advance(itt, results) == OK, "%s", status_sentence());
    ck_assert_double_eq_tol(number(results, "critical_packing_fraction"), known[_i][1], 2e-4);
    itt_free(itt);
    results_free(results);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("runs of itt");
    TCase *tests = tcase_create("runs");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, a_glass_has_a_maximum_of_the_stress);
    tcase_add_test(tests, pictures_and_cuts_of_the_structure_agree);
    tcase_add_test(tests, a_mixture_has_rows_of_pairs_and_species);
    tcase_add_test(tests, a_mixture_goes_on_from_where_it_was_saved);
    tcase_add_test(tests, what_is_not_asked_for_is_not_there);
    tcase_add_test(tests, a_separation_is_counted_from_the_transition);
    tcase_add_loop_test(tests, the_transition_is_that_of_the_plane_s_cutoff, 0, 2);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
