// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity at rest from the fluctuations of the shear stress.
#include "simulate.h"

#include "base/constants.h"
#include "numerics/fit.h"
#include "state/equation_of_state.h"

static const double SIGMAS = 4;
enum { REPLICAS = 8 };

static const OptionTable *options(void) {
    return &observable_viscosity.options;
}

// g(d) from the equation of state: Z - 1 = 2^(dim - 1) phi g.
static double contact_value(const System *system) {
    const double z = equation_of_state(system).compressibility_factor;
    return (z - 1) / ((system->dimension == 2 ? 2 : 4) * system->packing_fraction);
}

// Long after an interval and long before a particle diffuses over a gap, hard cores relax like a
// plane that Brownian particles start from: eta(t) = K phi^2 g(d) sqrt(D0 t)/d in kT/(d^(dim-2)
// D0), K = 2 sqrt(2)/pi^1.5 for discs (from Weysser, thesis, eqs. 4.35 and 4.36; 4.38 has the
// angular integral pi/4 twice), for spheres K = 1.21908. What happens within an interval adds a
// constant, so the slope of eta against sqrt(t) is compared; corrections are of the order sqrt(t),
// here 0.01.
static void expect_short_time_law(const System *system, double prefactor, double time) {
    enum { LAGS = 200 };
    const double interval = 0.002, step = interval * interval / 2;
    Plan *plan = new_plan(*system, interval, 20, time, REPLICAS);
    Settings *settings = observe(plan, &observable_viscosity);
    set_number(settings, options(), "times.first", 20 * step);
    set_number(settings, options(), "times.last", 200 * step);
    Results *results = simulate(plan);
    const ResultSeries *eta = series_of(results, "measured", "viscosity");
    const double law =
        prefactor * system->packing_fraction * system->packing_fraction * contact_value(system);
    double grown[LAGS], weights[LAGS];
    ck_assert_uint_le(eta->size, LAGS);
    for (size_t k = 0; k < eta->size; k++) {
        const double t = eta->axis[0].values[k];
        grown[k] = sqrt(t) - ((double)system->dimension - 1) / 2 * sqrt(PI / 2) * t;
        weights[k] = 1 / t; // errors grow as eta
    }
    for (size_t r = 0; r < REPLICAS; r++) {
        const double slope = fit_line(grown, eta->values + r * eta->size, weights, eta->size).slope;
        results_put_scalar(results, "measured", "ratio", "", "", r, slope / law);
    }
    char line[128];
    snprintf(line, sizeof line, "d eta/d sqrt(t) over its law, %d dimensions",
             (int)system->dimension);
    expect_within(line, measured(results, "ratio"), 1, 0.01, SIGMAS, 0.04);
    results_free(results);
}

// _i + 2: dimension. Few particles: the stress of one configuration is one sample, however large.
START_TEST(viscosity_begins_as_the_root_of_time) {
    const System discs = system_of(2, 100, 0.3, 1), spheres = system_of(3, 100, 0.15, 1);
    if (_i == 0) expect_short_time_law(&discs, 2 * sqrt(2) / pow(PI, 1.5), 1.5);
    if (_i == 1) expect_short_time_law(&spheres, 1.21908, 1);
}
END_TEST

// Within an interval nothing is drawn anew, and a collision's stress is over at once: eta is
// sqrt(pi)/4 rho^2 d^3 g sqrt(m kT) in the units of flight, where a time is Delta/2 of d^2/D0.
START_TEST(within_an_interval_the_viscosity_is_that_of_single_collisions) {
    const double interval = 0.01, diffusion = interval / 2;
    const System system = system_of(2, 400, 0.4, 1);
    Plan *plan = new_plan(system, interval, 20, 20 * diffusion, REPLICAS);
    set_number(&plan->stages[1].dynamics.settings, &propagator_event_driven.options, "substeps",
               10);
    Settings *settings = observe(plan, &observable_viscosity);
    set_number(settings, options(), "times.last", interval * diffusion);
    Results *results = simulate(plan);
    const double density = system_number_density(&system);
    const double flight = sqrt(PI) / 4 * density * density * contact_value(&system);
    const Estimate wandering = measured_at(results, "stress_wandering", 0);
    const double lag = series_of(results, "measured", "stress_wandering")->axis[0].values[0];
    const Estimate viscosity = {.value = wandering.value / lag, .error = wandering.error / lag};
    expect_within("eta within a tenth of an interval, kT/D0", viscosity, flight * diffusion, 0,
                  SIGMAS, 0.03);
    results_free(results);
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("viscosity");
    ADD_CASE(s, viscosity_begins_as_the_root_of_time, 2);
    ADD_CASE(s, within_an_interval_the_viscosity_is_that_of_single_collisions, 1);
    return s;
}

int main(void) {
    return run_suite(suite());
}
