// SPDX-License-Identifier: GPL-3.0-or-later
// Stress of sheared suspensions: two routes to it, its limit at small rates, its symmetry, and
// stages that end when it is known.
#include "simulate.h"

static const double SIGMAS = 4;
enum { REPLICAS = 8 };

static Plan *sheared_plan(System system, double interval, double rate, double strain) {
    Plan *plan = new_plan(system, interval, 30, 0, REPLICAS);
    plan->stage_count = 3;
    plan->stages[2] = plan->stages[1];
    for (size_t s = 1; s < 3; s++) plan->stages[s].drive.flow.rate = rate;
    strcpy(plan->stages[1].name, "start");
    plan->stages[1].strain = fmax(2, 2 * fabs(rate)); // and a time of 2
    plan->stages[2].strain = strain;
    return plan;
}

static const double *values_of(const Results *results, const char *quantity) {
    const ResultScalar *scalar = results_find_scalar(results, "measured", quantity);
    ck_assert_msg(scalar != NULL, "no scalar 'measured/%s'", quantity);
    return scalar->values;
}

static void expect_ratio(const char *what, Results *results, const char *above, const char *below,
                         double known, double precision) {
    for (size_t r = 0; r < REPLICAS; r++) {
        results_put_scalar(results, "measured", "ratio", "", "", r,
                           values_of(results, above)[r] / values_of(results, below)[r]);
    }
    expect_within(what, measured(results, "ratio"), 1, known, SIGMAS, precision);
}

static const struct {
    const char *what;
    int dimension;
    size_t species;
    double packing_fraction, rate, strain;
} flows[] = {{"binary discs 0.60, rate 4", 2, 2, 0.60, 4, 40},
             {"binary discs 0.70, rate 10", 2, 2, 0.70, 10, 60},
             {"spheres 0.40, rate 4", 3, 1, 0.40, 4, 20}};

// Momentum that collisions exchange against the directions in which pairs touch. Partners that the
// flow drives together collide harder than those at rest, which contacts do not know: that is the
// share of the Newtonian viscosity within an interval, sqrt(pi)/4 rho^2 d^3 g sqrt(m kT), one or
// two per cent here and proportional to the interval.
START_TEST(collisions_and_contacts_carry_the_same_stress) {
    const System system =
        system_of(flows[_i].dimension, 100, flows[_i].packing_fraction, flows[_i].species);
    Plan *plan = sheared_plan(system, 0.005, flows[_i].rate, flows[_i].strain);
    observe(plan, &observable_stress);
    Settings *settings = observe(plan, &observable_contact_stress);
    set_number(settings, &observable_contact_stress.options, "looks", 4000);
    Results *results = simulate(plan);
    char line[128];
    snprintf(line, sizeof line, "shear stress by contact over by collision, %s", flows[_i].what);
    expect_ratio(line, results, "shear_stress_contact", "shear_stress", 0.015, 0.05);
    snprintf(line, sizeof line, "pressure by contact over by collision, %s", flows[_i].what);
    expect_ratio(line, results, "pressure_contact", "mean_pressure", 0.002, 0.02);
    results_free(results);
}
END_TEST

// eta from the fluctuations at rest is stress over rate as the rate goes to 0. _i: 0.5, 0.7.
START_TEST(fluctuations_at_rest_tell_the_response_to_slow_shear) {
    static const struct {
        double packing_fraction, time, rate, strain;
    } cases[] = {{0.5, 60, 0.5, 40}, {0.7, 120, 0.125, 30}};
    const System system = system_of(2, 100, cases[_i].packing_fraction, 2);
    Plan *plan = new_plan(system, 0.06, 50, cases[_i].time, REPLICAS);
    Settings *settings = observe(plan, &observable_viscosity);
    set_number(settings, &observable_viscosity.options, "times.last", 3);
    Results *rest = simulate(plan);
    const Estimate at_rest = measured(rest, "zero_shear_viscosity");
    plan = sheared_plan(system, 0.06, cases[_i].rate, cases[_i].strain);
    observe(plan, &observable_stress);
    Results *sheared = simulate(plan);
    char line[128];
    snprintf(line, sizeof line, "stress over rate against fluctuations, %g",
             cases[_i].packing_fraction);
    // At these rates the suspension is thinned by a few per cent.
    expect_within(line, measured(sheared, "shear_viscosity"), at_rest.value,
                  hypot(at_rest.error, 0.03 * at_rest.value), SIGMAS, 0.1);
    results_free(rest);
    results_free(sheared);
}
END_TEST

// Backwards: the shear stress turns its sign, normal stresses do not.
START_TEST(backward_flow_is_the_mirror_image) {
    const System system = system_of(2, 100, 0.7, 2);
    Results *flow[2];
    for (int k = 0; k < 2; k++) {
        Plan *plan = sheared_plan(system, 0.02, k == 0 ? 5 : -5, 40);
        observe(plan, &observable_stress);
        flow[k] = simulate(plan);
    }
    const Estimate forth = measured(flow[0], "shear_stress"),
                   back = measured(flow[1], "shear_stress");
    expect_within("shear stress at rate -5, turned, against that at 5",
                  (Estimate){.value = -back.value, .error = back.error, .n = back.n}, forth.value,
                  forth.error, SIGMAS, 0.02);
    const Estimate one = measured(flow[0], "mean_pressure"),
                   other = measured(flow[1], "mean_pressure");
    expect_within("pressure at rate -5 against that at 5", other, one.value, one.error, SIGMAS,
                  0.005);
    const Estimate viscosity = measured(flow[1], "shear_viscosity");
    ck_assert_double_gt(viscosity.value, 0);
    for (int k = 0; k < 2; k++) results_free(flow[k]);
}
END_TEST

static void save(Replica *replica, Archive *archive) {
    *archive = archive_writer();
    replica_save(replica, archive);
    ck_assert_int_eq(archive->status, OK);
}

// Ends before its limit, where the error over all replicas is what was wished for; and a replica
// saved and loaded again and again ends at the same tick with the same bits.
START_TEST(a_stage_ends_when_its_stress_is_known) {
    Plan *plan = sheared_plan(system_of(2, 100, 0.6, 2), 0.02, 4, 400);
    Settings *settings = observe(plan, &observable_stress);
    set_number(settings, &observable_stress.options, "windows", 400);
    plan->stages[2].stress_error = 0.05;
    ck_assert_msg(plan_check(plan) == OK, "%s", status_sentence());
    Replica *straight = NULL, *broken = NULL;
    ck_assert_int_eq(replica_create(&straight, plan, 0, NULL), OK);
    ck_assert_int_eq(replica_create(&broken, plan, 0, NULL), OK);
    while (!replica_finished(straight)) ck_assert_int_eq(replica_advance(straight), OK);
    for (int k = 0; !replica_finished(broken); k++) {
        ck_assert_int_eq(replica_advance(broken), OK);
        if (k % 7 != 0 || !replica_can_save(broken)) continue;
        Archive saved;
        save(broken, &saved);
        replica_free(broken);
        Archive loaded = archive_reader(saved.bytes, saved.size);
        ck_assert_int_eq(replica_load(&broken, plan, 0, &loaded), OK);
        archive_free(&saved);
    }
    ck_assert_uint_eq(replica_tally(straight).collisions, replica_tally(broken).collisions);
    ck_assert_int_eq(replica_state(straight)->step, replica_state(broken)->step);
    for (int a = 0; a < 2; a++) {
        ck_assert_mem_eq(replica_state(straight)->position[a], replica_state(broken)->position[a],
                         100 * sizeof(double));
    }
    replica_free(straight);
    replica_free(broken);
    Results *results = simulate(plan);
    const Estimate strain = measured(results, "stress_strain"),
                   stress = measured(results, "shear_stress");
    printf("ended at a strain of %.1f, of 400, with an error of %.3f\n", strain.value,
           stress.error / stress.value);
    ck_assert_double_lt(strain.value, 300);
    ck_assert_double_lt(stress.error / stress.value, 2 * 0.05); // of 8 replicas, known to a quarter
    results_free(results);
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("shear stress");
    ADD_CASE(s, collisions_and_contacts_carry_the_same_stress, sizeof flows / sizeof *flows);
    ADD_CASE(s, fluctuations_at_rest_tell_the_response_to_slow_shear, 2);
    ADD_CASE(s, backward_flow_is_the_mirror_image, 1);
    ADD_CASE(s, a_stage_ends_when_its_stress_is_known, 1);
    return s;
}

int main(void) {
    return run_suite(suite());
}
