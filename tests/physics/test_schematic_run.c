// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the schematic model as a whole: what is asked for is in the results, under the names of a
// simulation, and the parts agree with each other.
#include "suite.h"

#include "schematic/schematic.h"

#include "config/options.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

static SchematicPlan plan_of(uint64_t calculate) {
    SchematicPlan plan;
    ck_assert_int_eq(options_default(&schematic_options, &plan), OK);
    plan.given = true;
    plan.calculate = calculate;
    return plan;
}

static Results *run(const SchematicPlan *plan) {
    Schematic *schematic = NULL;
    Results *results = NULL;
    ck_assert_msg(schematic_check(plan) == OK, "%s", status_sentence());
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(schematic_create(&schematic, plan), OK);
    double before = -1;
    while (!schematic_finished(schematic)) {
        ck_assert_msg(schematic_advance(schematic, results) == OK, "%s", status_sentence());
        ck_assert(schematic_progress(schematic) >= before);
        before = schematic_progress(schematic);
    }
    ck_assert_double_eq(before, 1);
    schematic_free(schematic);
    return results;
}

static double number(const Results *results, const char *name) {
    const ResultScalar *scalar = results_find_scalar(results, "schematic", name);
    ck_assert_msg(scalar != NULL, "no %s", name);
    return scalar->values[0];
}

static const ResultSeries *series(const Results *results, const char *name) {
    const ResultSeries *found = results_find_series(results, "schematic", name);
    ck_assert_msg(found != NULL, "no %s", name);
    return found;
}

START_TEST(a_glass_at_rest_ends_at_its_plateau) {
    SchematicPlan plan = plan_of((1u << SCHEMATIC_PARTS) - 1);
    plan.separation = 1e-2;
    plan.last_time = 1e10;
    Results *results = run(&plan);
    const ResultSeries *correlator = series(results, "correlator");
    ck_assert_double_eq_tol(correlator->values[correlator->size - 1], number(results, "plateau"),
                            1e-6);
    ck_assert_double_eq(number(results, "is_glass"), 1);
    ck_assert_double_eq_tol(number(results, "exponent_parameter"), 1 / sqrt(2), 1e-12);
    const ResultSeries *flow = series(results, "flow_curve");
    ck_assert_double_eq_tol(flow->axis[0].values[0], 1e-8, 1e-20);
    ck_assert_double_eq_tol(flow->axis[0].values[flow->size - 1], 1, 1e-12);
    ck_assert(number(results, "yield_stress") < flow->values[0]);
    ck_assert_double_eq_tol(number(results, "yield_stress") / flow->values[0], 1, 0.01);
    results_free(results);
}
END_TEST

START_TEST(a_fluid_has_no_yield_stress) {
    SchematicPlan plan = plan_of(1u << SCHEMATIC_TRANSITION | 1u << SCHEMATIC_YIELD_STRESS);
    plan.separation = -1e-2;
    Results *results = run(&plan);
    ck_assert_ptr_null(results_find_scalar(results, "schematic", "yield_stress"));
    ck_assert_double_eq(number(results, "is_glass"), 0);
    results_free(results);
}
END_TEST

START_TEST(flow_that_begins_ends_on_the_flow_curve) {
    SchematicPlan plan = plan_of(1u << SCHEMATIC_CORRELATOR | 1u << SCHEMATIC_FLOW_CURVE);
    plan.separation = 1e-3;
    plan.shear_rate = plan.first_rate = 1e-4;
    plan.last_rate = 1e-3;
    plan.softening_strain = 0.025;
    plan.last_strain = 2;
    Results *results = run(&plan);
    ck_assert_double_eq_tol(
        number(results, "shear_stress") / series(results, "flow_curve")->values[0], 1, 1e-12);
    const ResultSeries *stress = series(results, "stress");
    ck_assert_str_eq(stress->axis[0].labels[0], "shear_stress");
    ck_assert_str_eq(stress->axis[1].name, "strain");
    ck_assert_double_eq_tol(stress->values[stress->size - 1] / number(results, "shear_stress"), 1,
                            1e-3);
    ck_assert(number(results, "overshoot_height") > 1.05);
    results_free(results);
}
END_TEST

// The integrand of the stress is positive where nothing softens.
START_TEST(a_stress_that_only_rises_has_no_overshoot) {
    SchematicPlan plan = plan_of(1u << SCHEMATIC_CORRELATOR);
    plan.shear_rate = 1e-3;
    for (plan.last_strain = 2; plan.last_strain < 300; plan.last_strain *= 5) {
        Results *results = run(&plan);
        ck_assert_ptr_null(results_find_scalar(results, "schematic", "overshoot_height"));
        results_free(results);
    }
}
END_TEST

START_TEST(a_cycle_has_its_moduli) {
    SchematicPlan plan = plan_of(1u << SCHEMATIC_CORRELATOR);
    plan.separation = 1e-3;
    plan.amplitude = 0.2;
    plan.frequency = 0.01;
    plan.moments = 64;
    plan.block = 64;
    plan.periods = 4;
    Results *results = run(&plan);
    const ResultSeries *moduli = series(results, "stress_harmonics");
    ck_assert_double_eq(moduli->values[0], number(results, "storage_modulus"));
    // Odd under reversal of the strain: no even harmonics.
    ck_assert(fabs(moduli->values[1]) < 1e-2 * fabs(moduli->values[2]));
    ck_assert(number(results, "third_harmonic") > 0.01);
    ck_assert(number(results, "cycle_mismatch") < 0.05);
    // The area of the Lissajous figure is what a cycle dissipates: pi G'' amplitude^2.
    const ResultSeries *curve = series(results, "lissajous");
    double area = 0;
    for (size_t i = 0; i < curve->size; i++) {
        const size_t next = (i + 1) % curve->size;
        area += (curve->values[i] + curve->values[next]) / 2 *
                (curve->axis[0].values[next] - curve->axis[0].values[i]);
    }
    ck_assert_double_eq_tol(area / (M_PI * number(results, "loss_modulus") * 0.04), 1, 5e-3);
    results_free(results);
}
END_TEST

START_TEST(what_cannot_be_is_said) {
    static const struct {
        const char *sentence;
        double v1, separation, rate, amplitude, time;
    } wrong[] = {
        {"v1 = -2 must not be below 0; -1 means: as separation says", -2, 0, 0, 0, 0},
        {"separation = 0.1 stands beside v1 = 0.5; give one of the two", 0.5, 0.1, 0, 0, 0},
        {"separation = -5 makes v1 = -11.2426; it must not be below 0", -1, -5, 0, 0, 0},
        {"shear_rate = 1 stands beside oscillate; give one of the two", -1, 0, 1, 1, 0},
        {"oscillate = {amplitude: 1, frequency: 0}: both must be above 0", -1, 0, 0, 1, 0},
        {"time = 3 is that of a shear_table, and there is none", -1, 0, 0, 0, 3},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        SchematicPlan plan = plan_of(1);
        plan.v1 = wrong[i].v1;
        plan.separation = wrong[i].separation;
        plan.shear_rate = wrong[i].rate;
        plan.amplitude = wrong[i].amplitude;
        plan.duration = wrong[i].time;
        ck_assert_int_eq(schematic_check(&plan), BAD_DATA);
        ck_assert_str_eq(status_sentence(), wrong[i].sentence);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("schematic run");
    TCase *test = tcase_create("run");
    tcase_set_timeout(test, 60);
    tcase_add_test(test, a_glass_at_rest_ends_at_its_plateau);
    tcase_add_test(test, a_fluid_has_no_yield_stress);
    tcase_add_test(test, flow_that_begins_ends_on_the_flow_curve);
    tcase_add_test(test, a_stress_that_only_rises_has_no_overshoot);
    tcase_add_test(test, a_cycle_has_its_moduli);
    tcase_add_test(test, what_cannot_be_is_said);
    suite_add_tcase(suite, test);
    return run_suite(suite);
}
