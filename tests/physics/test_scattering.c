// SPDX-License-Identifier: GPL-3.0-or-later
// Correlation functions of event-driven Brownian dynamics against exact results: free particles,
// whose displacements are Gaussian and independent, and the slopes at t = 0 that any interaction
// leaves as they are.
#include "simulate.h"

#include "base/constants.h"
#include "numerics/fit.h"
#include "observables/frame.h"

static const double SIGMAS = 4;

static void set_wave_numbers(Settings *settings, OptionReals list) {
    memcpy(settings->bytes, &list, sizeof list); // the first member of both settings structs
}

// The element of a series at these indices of its first axes and at a time on its last.
static size_t element_at(const ResultSeries *series, const size_t *index, double time) {
    const ResultAxis *last = &series->axis[series->axes - 1];
    size_t element = 0, best = 0;
    for (size_t a = 0; a + 1 < series->axes; a++)
        element = element * series->axis[a].count + index[a];
    for (size_t k = 0; k < last->count; k++) {
        if (fabs(last->values[k] - time) < fabs(last->values[best] - time)) best = k;
    }
    ck_assert_double_eq_tol(last->values[best], time, 1e-6 * time);
    return element * last->count + best;
}

static Estimate value_at(const Results *results, const char *observable, const size_t *index,
                         double time) {
    const ResultSeries *series = series_of(results, "measured", observable);
    return results_series_estimate(results, series, element_at(series, index, time));
}

static void choose_times(Settings *settings, const ObservableKind *kind, double step) {
    set_number(settings, &kind->options, "times.first", step);
    set_number(settings, &kind->options, "times.last", 100 * step);
    set_number(settings, &kind->options, "times.per_decade", 1);
    set_number(settings, &kind->options, "origins", 10);
}

static const double FREE_INTERVAL = 0.1; // a step is 0.005 d^2/D0
static const double FREE_STEP = 0.005;
enum { FREE_TIMES = 3 };
static const double free_times[FREE_TIMES] = {0.005, 0.05, 0.5};
static const double free_diffusion[2] = {1, 0.5};

// Two species, of which the second is twice as heavy, so dilute that hardly anything collides.
static Plan *free_plan(int64_t particles, int64_t replicas) {
    System system = system_of(2, particles, 1e-4, 2);
    system.species[1].mass = 2;
    return new_plan(system, FREE_INTERVAL, 1, 2500 * FREE_STEP, replicas);
}

START_TEST(free_particles_scatter_exponentially) {
    Plan *plan = free_plan(200, 32);
    const OptionReals q = {.count = 2, .values = {1, 3}};
    Settings *self = observe(plan, &observable_self_scattering);
    choose_times(self, &observable_self_scattering, FREE_STEP);
    set_wave_numbers(self, q);
    Settings *collective = observe(plan, &observable_collective_scattering);
    choose_times(collective, &observable_collective_scattering, FREE_STEP);
    set_wave_numbers(collective, q);
    set_number(collective, &observable_collective_scattering.options, "shell.width", 0.01);
    Results *results = simulate(plan);
    for (size_t k = 0; k < 2 * FREE_TIMES; k++) {
        const double t = free_times[k / 2], wave = q.values[k % 2];
        for (size_t s = 0; s < 2; s++) {
            const double expected = exp(-wave * wave * free_diffusion[s] * t);
            if (expected < 0.02) continue;        // nothing left to measure
            const size_t index[] = {s, 4, k % 2}; // the mean of four directions
            expect_within("free: F^s(q,t) over exp(-q^2 D t)",
                          value_at(results, "self_scattering", index, t), expected, 0, SIGMAS,
                          0.05);
            const size_t pair[] = {2 * s, k % 2};
            expect_within("free: F_aa(q,t)/S_aa(q)",
                          value_at(results, "collective_scattering_normalised", pair, t), expected,
                          0, SIGMAS, 0.05);
        }
    }
    const size_t unlike[] = {1, 1};
    const Estimate cross = value_at(results, "collective_scattering", unlike, FREE_STEP);
    ck_assert_double_le(fabs(cross.value), SIGMAS * cross.error);
    results_free(results);
}
END_TEST

START_TEST(free_particles_have_gaussian_displacements) {
    Plan *plan = free_plan(200, 32);
    choose_times(observe(plan, &observable_non_gaussian_parameter),
                 &observable_non_gaussian_parameter, FREE_STEP);
    Settings *van_hove = observe(plan, &observable_van_hove);
    choose_times(van_hove, &observable_van_hove, FREE_STEP);
    set_number(van_hove, &observable_van_hove.options, "distances.spacing", 0.25);
    Results *results = simulate(plan);
    const ResultSeries *g = series_of(results, "measured", "van_hove");
    for (size_t k = 0; k < 2 * FREE_TIMES; k++) {
        const size_t s = k % 2;
        const double t = free_times[k / 2], variance = 4 * free_diffusion[s] * t;
        const Estimate alpha = value_at(results, "non_gaussian_parameter", &s, t);
        printf("free: alpha_2 at t = %g %44.5f +- %.5f  expected 0\n", t, alpha.value, alpha.error);
        ck_assert_double_le(fabs(alpha.value), SIGMAS * alpha.error);
        ck_assert_double_le(alpha.error, 0.03);
        for (size_t bin = 0; bin < 8; bin++) {
            const double low = 0.25 * (double)bin, high = low + 0.25;
            const double within = exp(-low * low / variance) - exp(-high * high / variance);
            if (within < 0.02) continue;
            const size_t lags = g->axis[1].count, bins = g->axis[2].count;
            size_t lag = 0;
            while (g->axis[1].values[lag] < t * (1 - 1e-6)) lag++;
            Estimate found = results_series_estimate(results, g, (s * lags + lag) * bins + bin);
            const double ring = PI * (high * high - low * low);
            expect_within("free: G^s(r,t) over a Gaussian", found, within / ring, 0, SIGMAS, 0.05);
        }
    }
    results_free(results);
}
END_TEST

// Independent particles: the fluctuation is that of a binomial distribution, p (1 - p).
START_TEST(free_particles_do_not_move_together) {
    Plan *plan = free_plan(100, 64);
    Settings *settings = observe(plan, &observable_overlap);
    choose_times(settings, &observable_overlap, FREE_STEP);
    set_number(settings, &observable_overlap.options, "distance", 0.3);
    Results *results = simulate(plan);
    for (size_t k = 0; k < 2 * FREE_TIMES; k++) {
        const size_t s = k % 2;
        const double t = free_times[k / 2];
        const double p = 1 - exp(-0.09 / (4 * free_diffusion[s] * t));
        if (p > 0.98) continue;
        expect_within("free: overlap Q(t)", value_at(results, "overlap", &s, t), p, 0, SIGMAS,
                      0.05);
        expect_within("free: chi_4(t) over p (1 - p)",
                      value_at(results, "four_point_susceptibility", &s, t), p * (1 - p), 0, SIGMAS,
                      0.1);
    }
    results_free(results);
}
END_TEST

// The limit t -> 0 of what has been lost over q^2 t, which hard bodies take on as sqrt(t). What was
// there before: `whole`, or 1 if NULL.
static double first_slope(const ResultSeries *series, const ResultSeries *whole, size_t replica,
                          size_t begin, double q) {
    const ResultAxis *time = &series->axis[series->axes - 1];
    double x[200], y[200];
    size_t count = 0;
    for (size_t k = 0; k < time->count; k++) {
        if (!(time->values[k] > 0)) continue;
        const size_t at = replica * series->size + begin + k;
        const double lost = (whole ? whole->values[at] : 1) - series->values[at];
        x[count] = sqrt(time->values[k]);
        y[count] = lost / (q * q * time->values[k]);
        count++;
    }
    return fit_line(x, y, NULL, count).intercept;
}

// Self: D0; collective, not normalised: D0 as well, that is D0/S(q) normalised.
START_TEST(any_interaction_leaves_the_first_slope) {
    const double interval = 0.004, step = interval * interval / 2;
    Plan *plan = new_plan(system_of(2, 400, 0.4, 1), interval, 5, 0.05, 32);
    const OptionReals q = {.count = 2, .values = {3, 6}};
    const ObservableKind *kinds[] = {&observable_self_scattering,
                                     &observable_collective_scattering};
    for (int k = 0; k < 2; k++) {
        Settings *settings = observe(plan, kinds[k]);
        set_number(settings, &kinds[k]->options, "times.first", 20 * step);
        set_number(settings, &kinds[k]->options, "times.last", 500 * step);
        set_number(settings, &kinds[k]->options, "times.per_decade", 5);
        set_number(settings, &kinds[k]->options, "origins", 4);
        set_wave_numbers(settings, q);
    }
    Results *results = simulate(plan);
    const ResultSeries *self = series_of(results, "measured", "self_scattering");
    const ResultSeries *all = series_of(results, "measured", "collective_scattering");
    const ResultSeries *ends = series_of(results, "measured", "collective_scattering_ends");
    const size_t self_times = self->axis[3].count, all_times = all->axis[2].count;
    for (size_t k = 0; k < 2; k++) {
        for (size_t r = 0; r < results->replicas; r++) {
            results_put_scalar(results, "measured", k ? "self 6" : "self 3", "", "", r,
                               first_slope(self, NULL, r, (4 * 2 + k) * self_times, q.values[k]));
            results_put_scalar(
                results, "measured", k ? "collective 6" : "collective 3", "", "", r,
                first_slope(all, ends, r, (2 + k) * all_times, all->axis[1].values[k]));
        }
    }
    static const char *const names[] = {"self 3", "self 6", "collective 3", "collective 6"};
    for (int k = 0; k < 4; k++) {
        printf("%s: ", names[k]);
        expect_within("first slope over q^2 D0", measured(results, names[k]), 1, 0.01, SIGMAS,
                      0.05);
    }
    results_free(results);
}
END_TEST

enum { FEW = 25 };

// Seen from the box or from the centre of mass: the same trajectories.
static Results *few_discs(int64_t frame) {
    Plan *plan = new_plan(system_of(2, FEW, 0.6, 2), 0.05, 20, 20, 32);
    const OptionReals q = {.count = 1, .values = {5}};
    const ObservableKind *kinds[] = {&observable_self_scattering,
                                     &observable_collective_scattering};
    for (int k = 0; k < 2; k++) {
        Settings *settings = observe(plan, kinds[k]);
        set_number(settings, &kinds[k]->options, "times.first", 0.0125);
        set_number(settings, &kinds[k]->options, "times.last", 1.25);
        set_number(settings, &kinds[k]->options, "times.per_decade", 2);
        set_number(settings, &kinds[k]->options, "frame", (double)frame);
        set_wave_numbers(settings, q);
    }
    set_number(&plan->stages[1].observations[1].settings, &observable_collective_scattering.options,
               "shell.width", 1);
    return simulate(plan);
}

// The centre of mass diffuses freely and independently of all that is seen from it: exp(-q^2 t/N),
// q being that of the vector and not of its shell, is all that the frame of the box adds.
START_TEST(the_centre_of_mass_diffuses_freely) {
    Results *box = few_discs(FRAME_BOX), *centre = few_discs(FRAME_CENTRE_OF_MASS);
    static const char *const names[2][2] = {
        {"self_scattering", "self_scattering_centred"},
        {"collective_scattering_normalised", "collective_scattering_centred"}};
    for (int k = 0; k < 2; k++) {
        const ResultSeries *seen[2] = {series_of(box, "measured", names[k][0]),
                                       series_of(centre, "measured", names[k][1])};
        const ResultAxis *time = &seen[0]->axis[seen[0]->axes - 1];
        const double q = seen[0]->axis[seen[0]->axes - 2].values[0];
        const size_t begin = seen[0]->size - time->count; // of all species, the mean direction
        for (size_t t = time->count - 3; t < time->count; t++) {
            const double factor = exp(-q * q * time->values[t] / FEW);
            for (size_t r = 0; r < box->replicas; r++) {
                const size_t at = r * seen[0]->size + begin + t;
                results_put_scalar(box, "measured", k ? "together" : "alone", "", "", r,
                                   seen[0]->values[at] - factor * seen[1]->values[at] + 1);
            }
            expect_within("1 + what is seen from the box less what the centre's diffusion leaves",
                          measured(box, k ? "together" : "alone"), 1, 0, SIGMAS, 0.02);
        }
    }
    results_free(box);
    results_free(centre);
}
END_TEST

static const double RATE = 2;

// In a flow, along the gradient, which no strain mixes with another direction.
static Results *few_in_flow(int64_t frame) {
    Plan *plan = new_plan(system_of(2, FEW, 0.6, 2), 0.05, 20, 20, 32);
    plan->stages[1].drive.flow.rate = RATE;
    const ObservableKind *kinds[] = {&observable_self_scattering,
                                     &observable_non_affine_displacement};
    for (int k = 0; k < 2; k++) {
        Settings *settings = observe(plan, kinds[k]);
        set_number(settings, &kinds[k]->options, "times.first", 0.0125);
        set_number(settings, &kinds[k]->options, "times.last", 1.25);
        set_number(settings, &kinds[k]->options, "times.per_decade", 2);
        set_number(settings, &kinds[k]->options, "frame", (double)frame);
    }
    set_wave_numbers(&plan->stages[1].observations[0].settings,
                     (OptionReals){.count = 1, .values = {3}});
    return simulate(plan);
}

// Element of direction y at a lag, of all species together.
static size_t along_y(const ResultSeries *series, size_t lag) {
    const size_t lags = series->axis[series->axes - 1].count;
    const size_t directions = series->axis[1].count;
    return ((series->axis[0].count - 1) * directions + 1) * lags + lag;
}

// Displacements beside the flow are linear in the coordinates, so that the centre adds its own, of
// a free particle with D0/N: 2 t/N along the gradient, and the factor exp(-q^2 t/N).
START_TEST(in_a_flow_the_centre_of_mass_is_free_too) {
    Results *box = few_in_flow(FRAME_BOX), *centre = few_in_flow(FRAME_CENTRE_OF_MASS);
    static const char *const names[2][2] = {
        {"self_scattering", "self_scattering_centred"},
        {"non_affine_displacement", "non_affine_displacement_centred"}};
    for (int k = 0; k < 2; k++) {
        const ResultSeries *seen[2] = {series_of(box, "measured", names[k][0]),
                                       series_of(centre, "measured", names[k][1])};
        const ResultAxis *time = &seen[0]->axis[seen[0]->axes - 1];
        for (size_t t = time->count - 3; t < time->count; t++) {
            const double share = time->values[t] / FEW;
            for (size_t r = 0; r < box->replicas; r++) {
                const size_t at = r * seen[0]->size + along_y(seen[0], t);
                const double here = seen[0]->values[at], about = seen[1]->values[at];
                results_put_scalar(box, "measured", k ? "displaced" : "scattered", "", "", r,
                                   k ? (here - about) / (2 * share)
                                     : here - exp(-9 * share) * about + 1);
            }
            expect_within(k ? "what the centre adds to <dy^2> over 2 t/N"
                            : "1 + what is seen from the box less what the centre leaves",
                          measured(box, k ? "displaced" : "scattered"), 1, 0, SIGMAS,
                          k ? 0.15 : 0.02);
        }
    }
    results_free(box);
    results_free(centre);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("scattering");
    ADD_CASE(suite, free_particles_scatter_exponentially, 1);
    ADD_CASE(suite, free_particles_have_gaussian_displacements, 1);
    ADD_CASE(suite, free_particles_do_not_move_together, 1);
    ADD_CASE(suite, any_interaction_leaves_the_first_slope, 1);
    ADD_CASE(suite, the_centre_of_mass_diffuses_freely, 1);
    ADD_CASE(suite, in_a_flow_the_centre_of_mass_is_free_too, 1);
    return run_suite(suite);
}
