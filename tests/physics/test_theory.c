// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the theory as a whole: what is asked for is in the results, under the names and axes of a
// simulation, and the parts agree with each other.
#include "suite.h"

#include "theory/theory.h"

#include "oz/oz.h"

#include <check.h>
#include <math.h>
#include <string.h>

static TheoryPlan plan_of(uint64_t calculate) {
    TheoryPlan plan = {.dimension = 3,
                       .structure = CLOSURE_PERCUS_YEVICK,
                       .wave_numbers = 60,
                       .last_wave_number = 25,
                       .calculate = calculate,
                       .first_time = 1e-4,
                       .last_time = 1e4,
                       .times_per_decade = 5,
                       .block = 64,
                       .species_count = 2};
    plan.species[0] = (TheorySpecies){"small", 1, 0.4, 1};
    plan.species[1] = (TheorySpecies){"big", 1.2, 0.6, 0.8};
    return plan;
}

static Results *run(const TheoryPlan *plan) {
    Theory *theory = NULL;
    Results *results = NULL;
    ck_assert_msg(theory_check(plan) == OK, "%s", status_sentence());
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_msg(theory_create(&theory, plan, NULL) == OK, "%s", status_sentence());
    double before = -1;
    while (!theory_finished(theory)) {
        ck_assert_msg(theory_advance(theory, results) == OK, "%s", status_sentence());
        ck_assert(theory_progress(theory) >= before);
        before = theory_progress(theory);
    }
    ck_assert_double_eq(before, 1);
    theory_free(theory);
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

START_TEST(a_glass_has_all_that_is_asked_for) {
    TheoryPlan plan = plan_of(((1u << THEORY_PARTS) - 1) & ~(1u << THEORY_FLOW_CURVE));
    plan.separation = 0.01;
    plan.correlator_wave_numbers = (OptionReals){2, {6, 7}};
    Results *results = run(&plan);
    const double critical = number(results, "critical_packing_fraction");
    ck_assert_double_eq_tol(number(results, "packing_fraction"), critical * 1.01, 1e-12);
    ck_assert_double_eq_tol(number(results, "separation_parameter"),
                            0.01 * number(results, "separation_slope"), 1e-10);
    ck_assert_ptr_null(results_find_scalar(results, "theory", "long_time_diffusion_small"));
    ck_assert(number(results, "shear_coefficient") > 0);
    ck_assert_double_eq(number(results, "is_glass"), 1);
    const double a = number(results, "exponent_a"), b = number(results, "exponent_b");
    ck_assert_double_eq_tol(number(results, "exponent_gamma"), 1 / (2 * a) + 1 / (2 * b), 1e-12);
    const ResultSeries *normalised = series(results, "collective_scattering_normalised");
    ck_assert_uint_eq(normalised->axes, 3);
    ck_assert_str_eq(normalised->axis[0].labels[1], "small-big");
    ck_assert_str_eq(normalised->axis[0].labels[3], "total");
    // A glass decays from nearly 1 to its form factor, and the displacement to 6 r_l^2.
    const size_t times = normalised->axis[2].count;
    ck_assert(normalised->values[0] > 0.9 && normalised->values[0] < 1);
    const ResultSeries *displacement = series(results, "mean_squared_displacement");
    const double end = displacement->values[displacement->axis[2].count - 1];
    const double length = number(results, "localisation_length_small");
    ck_assert_double_eq_tol(end / (6 * length * length), 1, 0.02);
    ck_assert(displacement->axis[2].values[times - 1] >= 1e4);
    const ResultSeries *master = series(results, "alpha_master");
    ck_assert_str_eq(master->axis[2].unit, "t'"); // not that of the correlators
    series(results, "beta_scaling_fluid");
    ck_assert_ptr_null(results_broken_limit(results));
    results_free(results);
}
END_TEST

START_TEST(the_total_is_the_sum_over_ordered_pairs) {
    TheoryPlan plan = plan_of(1u << THEORY_STRUCTURE);
    plan.packing_fraction = 0.4;
    Results *results = run(&plan);
    const ResultSeries *s = series(results, "structure_factor");
    const size_t count = s->axis[1].count;
    for (size_t m = 0; m < count; m++) {
        const double *v = s->values + m;
        ck_assert_double_eq_tol(v[3 * count], v[0] + 2 * v[count] + v[2 * count], 1e-14);
    }
    ck_assert_double_eq_tol(s->values[count - 1], 0.4, 0.05); // x_a at large q
    ck_assert_ptr_null(results_find_scalar(results, "theory", "critical_packing_fraction"));
    results_free(results);
}
END_TEST

// Percus-Yevick: spheres by the virial route have Z = (1 + 2 f + 3 f^2)/(1 - f)^2; discs against
// another program, whose equal discs are good to 3e-4 and whose mixture is to 3e-3.
START_TEST(contact_values_and_their_pressure) {
    TheoryPlan plan = plan_of(1u << THEORY_STRUCTURE);
    plan.packing_fraction = 0.3;
    plan.species_count = 1;
    plan.species[0] = (TheorySpecies){"all", 2, 1, 1};
    Results *results = run(&plan);
    ck_assert_double_eq_tol(number(results, "contact_value_all_all"), 1.15 / 0.49, 1e-9);
    ck_assert_double_eq_tol(number(results, "compressibility_factor_contact"), 1.87 / 0.49, 1e-9);
    results_free(results);

    plan.dimension = 2;
    results = run(&plan);
    ck_assert_double_eq_tol(number(results, "contact_value_all_all"), 1.7454, 3e-4 * 1.7454);
    ck_assert_double_eq_tol(number(results, "compressibility_factor_contact"),
                            1 + 2 * 0.3 * number(results, "contact_value_all_all"), 1e-12);
    results_free(results);

    plan.packing_fraction = 0.5;
    plan.species_count = 2;
    plan.species[0] = (TheorySpecies){"small", 1, 0.5, 1};
    plan.species[1] = (TheorySpecies){"big", 1.4, 0.5, 1};
    results = run(&plan);
    ck_assert_double_eq_tol(number(results, "contact_value_small_small"), 2.8047, 3e-3 * 2.8);
    ck_assert_double_eq_tol(number(results, "contact_value_small_big"), 2.9102, 3e-3 * 2.9);
    ck_assert_double_eq_tol(number(results, "contact_value_big_big"), 3.0384, 3e-3 * 3.0);
    results_free(results);
}
END_TEST

START_TEST(a_fluid_keeps_nothing) {
    TheoryPlan plan = plan_of(1u << THEORY_FORMS);
    plan.packing_fraction = 0.4;
    Results *results = run(&plan);
    ck_assert_double_eq(number(results, "is_glass"), 0);
    ck_assert_ptr_null(results_find_series(results, "theory", "glass_form_factors"));
    ck_assert_ptr_null(results_find_scalar(results, "theory", "localisation_length_small"));
    results_free(results);
}
END_TEST

// D_L = 1/(1/D + int m dt) in a fluid: slower than free, and the larger particles slower.
START_TEST(a_fluid_diffuses_in_the_end) {
    TheoryPlan plan = plan_of(1u << THEORY_CORRELATORS);
    plan.packing_fraction = 0.4;
    Results *results = run(&plan);
    const double small = number(results, "long_time_diffusion_small");
    const double big = number(results, "long_time_diffusion_big");
    ck_assert(small > 0 && small < 1 && big > 0 && big < small);
    ck_assert_ptr_null(results_find_scalar(results, "theory", "separation_parameter"));
    results_free(results);
}
END_TEST

START_TEST(a_glass_has_a_flow_curve_and_a_maximum_before_it) {
    TheoryPlan plan = plan_of(1u << THEORY_FLOW_CURVE | 1u << THEORY_EXPONENTS);
    plan.species_count = 1;
    plan.species[0].fraction = 1;
    plan.packing_fraction = 0.53;
    plan.first_rate = 1e-4;
    plan.last_rate = 1;
    plan.rates_per_decade = 1;
    Results *results = run(&plan);
    ck_assert(number(results, "shear_coefficient") > 0);
    const ResultSeries *flow = series(results, "flow_curve");
    const ResultSeries *peak = series(results, "flow_curve_peak");
    ck_assert_uint_eq(flow->size, 5);
    ck_assert_double_eq_tol(flow->axis[0].values[4], 1, 1e-12);
    ck_assert_double_eq_tol(flow->values[0] / flow->values[1], 1, 1e-3); // it yields
    ck_assert(flow->values[4] > 1.01 * flow->values[0]);
    for (size_t i = 0; i < flow->size; i++) ck_assert(peak->values[i] > 1.05 * flow->values[i]);
    results_free(results);
    plan.species_count = 2;
    plan.species[0].fraction = 0.4;
    ck_assert_int_eq(theory_check(&plan), BAD_DATA);
}
END_TEST

// Of what freezes at this packing fraction, whatever fraction the plan has.
START_TEST(the_transition_is_searched_along_a_fraction) {
    TheoryPlan plan = plan_of(1u << THEORY_CRITICAL | 1u << THEORY_EXPONENTS);
    plan.dimension = 2;
    plan.species[0] = (TheorySpecies){"small", 1.0 / 3, 0.5, 1};
    plan.species[1] = (TheorySpecies){"big", 1, 0.5, 1};
    Results *along_packing = run(&plan);
    strcpy(plan.search_key, "theory.species.small.fraction");
    plan.packing_fraction = number(along_packing, "critical_packing_fraction");
    plan.search_low = 0.2;
    plan.search_high = 0.7;
    plan.species[0].fraction = 0.3;
    plan.species[1].fraction = 0.7;
    Results *along_fraction = run(&plan);
    ck_assert_double_eq_tol(number(along_fraction, "critical_fraction_small"), 0.5, 1e-4);
    ck_assert_double_eq_tol(number(along_fraction, "exponent_parameter"),
                            number(along_packing, "exponent_parameter"), 5e-4);
    // sigma = C (x - x_c)/x_c; a smaller fraction of small ones is the glass.
    ck_assert_double_lt(number(along_fraction, "separation_slope"), 0);
    ck_assert_double_eq_tol(number(along_fraction, "separation_parameter"),
                            -0.4 * number(along_fraction, "separation_slope"), 1e-4);
    const ResultSeries *one = series(along_packing, "critical_form_factors");
    const ResultSeries *other = series(along_fraction, "critical_form_factors");
    ck_assert_uint_eq(one->size, other->size);
    for (size_t i = 0; i < one->size; i++)
        ck_assert_double_eq_tol(other->values[i], one->values[i], 2e-3);
    results_free(along_packing);
    results_free(along_fraction);
}
END_TEST

// Long-time diffusion of Percus-Yevick spheres at 0.4 with wave numbers up to `last`, as many of
// them as make R = 8.
static double diffusion_up_to(double last) {
    TheoryPlan plan = plan_of(1u << THEORY_CORRELATORS);
    plan.packing_fraction = 0.4;
    plan.species_count = 1;
    plan.species[0] = (TheorySpecies){"all", 1, 1, 1};
    plan.last_wave_number = last;
    plan.wave_numbers = (int64_t)(2.5 * last);
    Results *results = run(&plan);
    const double diffusion = number(results, "long_time_diffusion");
    results_free(results);
    return diffusion;
}

// Contact makes the kernel diverge as t^-1/2 at short times, which a cutoff K ends: the friction
// that is missing goes as 1/K in the end, K^-1.3 here.
START_TEST(diffusion_converges_with_the_cutoff) {
    const double near = diffusion_up_to(30), mid = diffusion_up_to(60), far = diffusion_up_to(120);
    ck_assert_double_lt(fabs(near / 0.18224 - 1), 2e-3); // of the table in docs/theory.md
    const double ratio = (near - mid) / (mid - far);
    ck_assert_msg(ratio > 2 && ratio < 2.8, "differences in the ratio %g", ratio);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("theory");
    TCase *tests = tcase_create("runs");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, a_glass_has_all_that_is_asked_for);
    tcase_add_test(tests, a_glass_has_a_flow_curve_and_a_maximum_before_it);
    tcase_add_test(tests, the_total_is_the_sum_over_ordered_pairs);
    tcase_add_test(tests, contact_values_and_their_pressure);
    tcase_add_test(tests, the_transition_is_searched_along_a_fraction);
    tcase_add_test(tests, diffusion_converges_with_the_cutoff);
    tcase_add_test(tests, a_fluid_keeps_nothing);
    tcase_add_test(tests, a_fluid_diffuses_in_the_end);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
