// SPDX-License-Identifier: GPL-3.0-or-later
// Observers on states made by hand, whose answer is known: ideal gases, straight flights, random
// walks, lattices; and slow twins that look at every pair and every vector.
#include "observe.h"
#include "suite.h"

#include "base/constants.h"
#include "observables/density_modes.h"
#include "observables/labels.h"
#include "observables/lags.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"

#include <stdlib.h>

static const RngKey KEY = {.seed = 20261125, .replica = 3};
static const double SIGMAS = 5; // two-sided p = 6e-7

static double flight_speed(int axis, size_t i) {
    return 0.01 * (1 + axis) * (1 + (double)(i % 7));
}

static void fly(State *state, int64_t tick) {
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            fold(state, a, i, (double)i / 10 - flight_speed(a, i) * (double)tick);
        }
    }
}

static void scatter_at(State *state, int64_t tick) {
    scatter(state, KEY, (uint64_t)tick);
}

static void stay(State *state, int64_t tick) {
    (void)state;
    (void)tick;
}

START_TEST(lags_ascend_and_are_whole_steps_beyond_a_step) {
    const Clock clock = clock_of(160000, 16);
    const Lags lags = lags_of(&clock, 0, 0, 10, 64);
    bool has_one_step = false;
    ck_assert_int_eq(lags.ticks[0], 1);
    ck_assert_int_eq(lags.spacing % 16, 0);
    for (size_t k = 0; k < lags.count; k++) {
        if (k > 0) ck_assert_int_gt(lags.ticks[k], lags.ticks[k - 1]);
        if (lags.ticks[k] > 16) ck_assert_int_eq(lags.ticks[k] % 16, 0);
        if (lags.ticks[k] > 17 * lags.spacing) ck_assert_int_eq(lags.ticks[k] % lags.spacing, 0);
        // Beyond the shortest lags no step of the ladder is far from 10^(1/10) = 1.26.
        if (lags.ticks[k] > 10 * 16) {
            const double ratio = (double)lags.ticks[k] / (double)lags.ticks[k - 1];
            ck_assert_double_eq_tol(ratio, 1.26, k + 1 < lags.count ? 0.1 : 0.2);
        }
        has_one_step |= lags.ticks[k] == 16;
    }
    ck_assert(has_one_step);
    ck_assert_int_gt(lags.ticks[lags.count - 1], 160000 / 4);
    ck_assert_int_le(lags.ticks[lags.count - 1], 160000 / 3 + lags.spacing);
    ck_assert_uint_le(lags.slots, 65);
}
END_TEST

START_TEST(looks_are_even_and_never_too_many) {
    for (int64_t steps = 1; steps < 300; steps += 7) {
        const Clock clock = clock_of(steps * 4, 4);
        const int64_t period = looks_period(&clock, 50);
        int64_t count = 0;
        for (int64_t t = looks_after(&clock, period, -1); t <= clock.ticks;
             t = looks_after(&clock, period, t), count++) {
            ck_assert_int_eq(t % 4, 0);
            ck_assert_int_gt(t, 0);
        }
        ck_assert_int_eq(count, looks_count(&clock, period));
        ck_assert_int_le(count, 50);
        ck_assert_int_ge(count, steps < 50 ? steps / 2 : 25);
    }
}
END_TEST

START_TEST(straight_flight_is_ballistic_across_the_box_edges) {
    System system = system_of(2, 70, 0.3, 2);
    State *state = new_state(&system);
    const Clock clock = clock_of(900, 3);
    const ObservableKind *kind = &observable_mean_squared_displacement;
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, fly, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *msd = series_of(results, "quiescent", "mean_squared_displacement");
    ck_assert_uint_eq(msd->axis[0].count, 3); // small, big, all
    ck_assert_uint_eq(msd->axis[1].count, 3); // x, y, total
    const size_t lags = msd->axis[2].count;
    // Speeds of i % 7 over 35 + 35 particles: <(1..7)^2> = 20.
    for (size_t s = 0; s < 3; s++) {
        for (size_t k = 0; k < lags; k++) {
            const double ticks = msd->axis[2].values[k] / clock.tick;
            const double expected = 20 * 1e-4 * ticks * ticks;
            const double *at = msd->values + s * 3 * lags + k;
            ck_assert_double_eq_tol(at[0] / expected, 1, 1e-9);
            ck_assert_double_eq_tol(at[lags] / expected, 4, 1e-9);
            ck_assert_double_eq_tol(at[2 * lags] / expected, 5, 1e-9);
        }
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

// All frames of a random walk, to be walked along and to be averaged over by the slow twin.
enum { WALK_TICKS = 700, WALKERS = 60 };
static double walk[WALK_TICKS + 1][3][WALKERS];

static void make_walk(void) {
    Rng rng = rng_open(KEY, STREAM_VELOCITY, 0, 0);
    for (int t = 1; t <= WALK_TICKS; t++) {
        for (int a = 0; a < 3; a++) {
            for (int i = 0; i < WALKERS; i++) {
                walk[t][a][i] = walk[t - 1][a][i] + 0.3 * rng_normal(&rng);
            }
        }
    }
}

static void walk_to(State *state, int64_t tick) {
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < WALKERS; i++) fold(state, a, i, walk[tick][a][i]);
    }
}

static double walked(int64_t from, int64_t to, int axis) {
    double sum = 0;
    for (int i = 0; i < WALKERS; i++) {
        const double step = walk[to][axis][i] - walk[from][axis][i];
        sum += step * step;
    }
    return sum / WALKERS;
}

START_TEST(random_walk_agrees_with_its_slow_twin_and_diffuses) {
    make_walk();
    System system = system_of(3, WALKERS, 0.2, 1);
    State *state = new_state(&system);
    const Clock clock = clock_of(WALK_TICKS, 1);
    const ObservableKind *kind = &observable_mean_squared_displacement;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "origins", 20);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, walk_to, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *msd = series_of(results, "quiescent", "mean_squared_displacement");
    const Lags lags = lags_of(&clock, 0, 0, 10, 20);
    ck_assert_uint_eq(msd->axis[2].count, lags.count);
    for (size_t k = 0; k < lags.count; k++) {
        for (int a = 0; a < 3; a++) {
            double sum = 0, origins = 0;
            for (int64_t t = 0; t + lags.ticks[k] <= WALK_TICKS; t += lags.spacing, origins++) {
                sum += walked(t, t + lags.ticks[k], a);
            }
            const double got = msd->values[(size_t)a * lags.count + k];
            ck_assert_double_eq_tol(got, sum / origins, 1e-11);
            // <x^2> = 0.09 per tick; the windows that do not overlap are independent.
            const double windows = fmax((double)WALK_TICKS / (double)lags.ticks[k], 1);
            const double independent = fmin(windows, origins) * WALKERS;
            const double expected = 0.09 * (double)lags.ticks[k];
            ck_assert_double_eq_tol(got / expected, 1, SIGMAS * sqrt(2 / independent));
        }
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

// The first of some systems, and of some ways to be there, in which it can be measured.
static System system_with(const ObservableKind *kind, int64_t particles, Clock *clock) {
    static const Drive steady = {.flow = {.rate = 0.5}};
    static const Drive oscillating = {.flow = {.oscillation = {0.1, 0.125}}}; // 20 steps a cycle
    static const Drive pulled = {.pull = {.species = "small", .peclet = 0.05}};
    static const struct {
        bool flies;
        const Drive *drive;
    } ways[] = {
        {true, NULL}, {false, NULL}, {true, &steady}, {true, &oscillating}, {false, &pulled}};
    const System systems[] = {system_of(2, particles, 0.4, 2), oriented_system(particles, 2),
                              oriented_system(particles, 1), soft_system(particles, 36)};
    enum { WAYS = sizeof ways / sizeof *ways };
    const Settings settings = settings_of(&kind->options);
    for (size_t i = 0; i < WAYS * sizeof systems / sizeof *systems; i++) {
        clock->flies = ways[i % WAYS].flies;
        clock->drive = ways[i % WAYS].drive;
        const System *system = &systems[i / WAYS];
        if (!kind->check || kind->check(&settings, system, clock) == OK) return *system;
    }
    ck_abort_msg("%s can be measured nowhere: %s", kind->name, status_sentence());
}

// Every observable, its state at half time saved and loaded into a fresh one.
START_TEST(an_observer_saved_and_loaded_goes_on_bit_for_bit) {
    const ObservableKind *kind = observable_kinds[_i];
    Clock clock = clock_of(600, 5);
    System system = system_with(kind, 90, &clock);
    State *state = new_state(&system);
    const Settings settings = settings_of(&kind->options);
    Observer *straight = new_observer(kind, &settings, state, &clock);
    Observer *first = new_observer(kind, &settings, state, &clock);
    Observer *second = new_observer(kind, &settings, state, &clock);
    watch(straight, state, scatter_at, -1, 600);
    watch(first, state, scatter_at, -1, 300);
    Archive saved = archive_writer();
    kind->archive(first, &saved);
    Archive loaded = archive_reader(saved.bytes, saved.size);
    kind->archive(second, &loaded);
    ck_assert_int_eq(archive_status(&loaded, true), OK);
    watch(second, state, scatter_at, 300, 600);
    Archive a = archive_writer(), b = archive_writer();
    kind->archive(straight, &a);
    kind->archive(second, &b);
    ck_assert_uint_eq(a.size, b.size);
    ck_assert_int_eq(memcmp(a.bytes, b.bytes, a.size), 0);
    archive_free(&saved);
    archive_free(&a);
    archive_free(&b);
    kind->free(straight);
    kind->free(first);
    kind->free(second);
    state_free(state);
}
END_TEST

START_TEST(memory_is_estimated_within_a_factor_of_two_of_what_is_saved) {
    const ObservableKind *kind = observable_kinds[_i];
    Clock clock = clock_of(60000, 5);
    System system = system_with(kind, 2000, &clock);
    State *state = new_state(&system);
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    Archive saved = archive_writer();
    kind->archive(observer, &saved);
    ck_assert_uint_gt(2 * kind->memory(&settings, &system, &clock), saved.size);
    archive_free(&saved);
    kind->free(observer);
    state_free(state);
}
END_TEST

// Distance of the nearest images by trying all of them.
static double nearest_distance(const State *state, size_t i, size_t j) {
    double least = INFINITY;
    for (int n = 0; n < 27; n++) {
        const int shift[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        double square = 0;
        for (int a = 0; a < state->box.dimension; a++) {
            const double x =
                state->position[a][i] - state->position[a][j] + shift[a] * state->box.edge[a];
            square += x * x;
        }
        least = fmin(least, sqrt(square));
    }
    return least;
}

// _i: dimension 2 or 3, box cubic or elongated.
START_TEST(near_pairs_are_those_of_all_pairs) {
    System system = system_of(2 + _i % 2, 150, 0.3, 2);
    if (_i >= 2) {
        system.aspect.count = system.dimension;
        for (int a = 0; a < 3; a++) system.aspect.values[a] = a == 0 ? 5 : 1;
    }
    State *state = new_state(&system);
    scatter(state, KEY, 0);
    double range = state->box.edge[0] / 2;
    for (int a = 1; a < state->box.dimension; a++) range = fmin(range, state->box.edge[a] / 2);
    for (; range > 0.2; range *= 0.8) { // down to two, three, four, ... cells
        NearPairs *pairs = NULL;
        ck_assert_int_eq(near_pairs_create(&pairs, &state->box, state->count, range), OK);
        near_pairs_sort(pairs, state);
        size_t found = 0, expected = 0;
        double sum = 0, expected_sum = 0;
        for (size_t slot = 0; slot < state->count; slot++) {
            const size_t candidates = near_pairs_row(pairs, slot);
            for (size_t k = 0; k < candidates; k++) {
                const double r = pairs->distance[k];
                found++;
                sum += r * (double)(pairs->particle[slot] + pairs->partner[k]);
            }
        }
        for (size_t i = 0; i < state->count; i++) {
            for (size_t j = 0; j < i; j++) {
                const double r = nearest_distance(state, i, j);
                if (r >= range) continue;
                expected++;
                expected_sum += r * (double)(i + j);
            }
        }
        ck_assert_uint_eq(found, expected);
        ck_assert_double_eq_tol(sum, expected_sum, 1e-9 * (1 + expected_sum));
        near_pairs_free(pairs);
    }
    state_free(state);
}
END_TEST

// chi^2 of `values` around 1 with relative errors 1/sqrt(counts), in deviations from its mean.
static double chi_deviation(double chi, double bins) {
    return (chi - bins) / sqrt(2 * bins);
}

START_TEST(ideal_gas_has_no_structure) {
    System system = system_of(2 + _i, 300, 0.3, 2);
    State *state = new_state(&system);
    const Clock clock = clock_of(1000, 5);
    const ObservableKind *kind = &observable_pair_distribution;
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *g = series_of(results, "quiescent", "pair_distribution");
    const size_t bins = g->axis[1].count;
    const double spacing = g->axis[1].values[1] - g->axis[1].values[0];
    for (size_t pair = 0; pair < 3; pair++) {
        double chi = 0, used = 0;
        for (size_t k = 0; k < bins; k++) {
            const double r = g->axis[1].values[k];
            const double shell = _i == 0 ? 2 * PI * r * spacing : 4 * PI * r * r * spacing;
            const double pairs = pair == 1 ? 150 * 150 : 150 * 149 / 2.0;
            const double counts = 100 * pairs * shell / box_volume(&state->box);
            if (counts < 20) continue;
            const double deviation = g->values[pair * bins + k] - 1;
            chi += deviation * deviation * counts;
            used++;
        }
        ck_assert_double_gt(used, 50);
        ck_assert_double_lt(fabs(chi_deviation(chi, used)), SIGMAS);
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

// Counts over all pairs, and the ideal gas's by the definition: one pair of the two species
// anywhere.
START_TEST(pair_distribution_agrees_with_its_slow_twin) {
    const int dimension = 2 + _i;
    System system = system_of(dimension, 61, 0.2, 2);
    State *state = new_state(&system);
    scatter(state, KEY, 5);
    for (size_t i = 0; i < state->count; i++) state->diameter[i] *= 1 + 0.01 * (double)(i % 10);
    const Clock clock = clock_of(5, 5);
    const ObservableKind *kind = &observable_pair_distribution;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "distances.spacing", 0.25);
    set_number(&settings, &kind->options, "contact.spacing", 0.05);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, stay, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *g = series_of(results, "quiescent", "pair_distribution");
    const ResultSeries *near = series_of(results, "quiescent", "contact_distribution");
    const ResultSeries *weight = series_of(results, "quiescent", "contact_weight");
    const size_t bins = g->axis[1].count, near_bins = near->axis[1].count;
    double counts[3][40] = {{0}}, near_counts[3][8] = {{0}}, pairs[3] = {0}, contacts[3] = {0};
    ck_assert_uint_le(bins, 40);
    ck_assert_uint_eq(near_bins, 4);
    for (size_t i = 0; i < state->count; i++) {
        for (size_t j = 0; j < i; j++) {
            const size_t pair = pair_index(state->species_of[i], state->species_of[j], 2);
            const double contact = (state->diameter[i] + state->diameter[j]) / 2;
            const double r = nearest_distance(state, i, j);
            if (r < 0.25 * (double)bins) counts[pair][(size_t)(r / 0.25)]++;
            if (r < 1.2 * contact) near_counts[pair][(size_t)fmax((r / contact - 1) / 0.05, 0)]++;
            pairs[pair]++;
            contacts[pair] += pow(contact, dimension);
        }
    }
    const double volume = box_volume(&state->box), ball = dimension == 2 ? PI : 4 * PI / 3;
    for (size_t pair = 0; pair < 3; pair++) {
        for (size_t k = 0; k < bins; k++) {
            const double shell =
                ball * (pow(0.25 * (double)(k + 1), dimension) - pow(0.25 * (double)k, dimension));
            ck_assert_double_eq_tol(g->values[pair * bins + k],
                                    counts[pair][k] * volume / (pairs[pair] * shell), 1e-9);
        }
        for (size_t k = 0; k < near_bins; k++) {
            const double shell = ball * (pow(1 + 0.05 * (double)(k + 1), dimension) -
                                         pow(1 + 0.05 * (double)k, dimension));
            ck_assert_double_eq_tol(near->values[pair * near_bins + k],
                                    near_counts[pair][k] * volume / (contacts[pair] * shell), 1e-9);
        }
        const double solid_angle = dimension * ball;
        ck_assert_double_eq_tol(weight->values[pair],
                                solid_angle * contacts[pair] / (dimension * 61 * volume), 1e-12);
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

START_TEST(ideal_gas_scatters_as_its_particles) {
    System system = system_of(2 + _i, 200, 0.3, 2);
    State *state = new_state(&system);
    const Clock clock = clock_of(1000, 5);
    const ObservableKind *kind = &observable_structure_factor;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "looks", 200);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *s = series_of(results, "quiescent", "structure_factor");
    ck_assert_uint_eq(s->axis[0].count, 4);
    const size_t shells = s->axis[1].count;
    double sum[4] = {0};
    for (size_t k = 0; k < shells; k++) {
        for (size_t p = 0; p < 4; p++) sum[p] += s->values[p * shells + k];
        const double parts = s->values[k] + 2 * s->values[shells + k] + s->values[2 * shells + k];
        ck_assert_double_eq_tol(s->values[3 * shells + k], parts, 1e-12);
    }
    const ResultSeries *in_time = series_of(results, "quiescent", "structure_factor_stretches");
    const size_t stretches = in_time->axis[1].count; // of as many looks each
    ck_assert_uint_eq(stretches, 10);
    for (size_t k = 0; k < shells; k++) {
        double total = 0;
        for (size_t t = 0; t < stretches; t++) total += in_time->values[k * stretches + t];
        ck_assert_double_eq_tol(total / (double)stretches, s->values[3 * shells + k], 1e-12);
    }
    // |rho|^2/N is exponential: a shell of n vectors and 200 looks has the error 1/sqrt(200 n).
    const double error = 1 / sqrt(200.0 * 20 * (double)shells); // n >= 20 in all but a few
    ck_assert_double_eq_tol(sum[0] / (double)shells, 0.5, SIGMAS * 0.5 * error);
    ck_assert_double_eq_tol(sum[1] / (double)shells, 0, SIGMAS * 0.5 * error);
    ck_assert_double_eq_tol(sum[3] / (double)shells, 1, SIGMAS * error);
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

// exp(i q.r) summed with the C library, over every vector that the observer may choose.
static double slow_structure(const State *state, double from, double to, double *mean_q) {
    double sum = 0, vectors = 0, lengths = 0;
    const int most = 40;
    for (int nx = -most; nx <= most; nx++) {
        for (int ny = -most; ny <= most; ny++) {
            const double qx = 2 * PI * nx / state->box.edge[0];
            const double qy = 2 * PI * ny / state->box.edge[1];
            const double q = sqrt(qx * qx + qy * qy);
            if (q < from || q >= to || (nx == 0 && ny == 0)) continue;
            double real = 0, imaginary = 0;
            for (size_t i = 0; i < state->count; i++) {
                const double phase = qx * state->position[0][i] + qy * state->position[1][i];
                real += cos(phase);
                imaginary += sin(phase);
            }
            sum += (real * real + imaginary * imaginary) / (double)state->count;
            lengths += q;
            vectors++;
        }
    }
    *mean_q = lengths / vectors;
    return sum / vectors;
}

START_TEST(structure_factor_agrees_with_its_slow_twin) {
    System system = system_of(2, 101, 0.3, 2);
    system.aspect.count = 2;
    system.aspect.values[0] = 1;
    system.aspect.values[1] = 2;
    State *state = new_state(&system);
    scatter(state, KEY, 7);
    const Clock clock = clock_of(5, 5);
    const ObservableKind *kind = &observable_structure_factor;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "wave_numbers.last", 6);
    set_number(&settings, &kind->options, "wave_numbers.spacing", 0.5);
    set_number(&settings, &kind->options, "wave_numbers.vectors", 0);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, stay, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *s = series_of(results, "quiescent", "structure_factor");
    const size_t shells = s->axis[1].count;
    ck_assert_uint_eq(shells, 12);
    for (size_t k = 0; k < shells; k++) {
        double mean_q;
        const double slow = slow_structure(state, 0.5 * (double)k, 0.5 * (double)(k + 1), &mean_q);
        ck_assert_double_eq_tol(s->values[3 * shells + k], slow, 1e-10);
        ck_assert_double_eq_tol(s->axis[1].values[k], mean_q, 1e-12);
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

START_TEST(density_modes_have_the_same_bits_on_every_path) {
    enum { VECTORS = 500 };
    System system = system_of(2 + _i, 333, 0.3, 1);
    State *state = new_state(&system);
    scatter(state, KEY, 1);
    LatticeVector vectors[VECTORS];
    for (int v = 0; v < VECTORS; v++) {
        vectors[v] = (LatticeVector){{v / 60, v / 5 % 12 - 6, _i ? v % 5 - 2 : 0}};
    }
    static const char *const paths[] = {"portable", "avx2", "avx512"};
    double real[3][VECTORS] = {{0}}, imaginary[3][VECTORS] = {{0}};
    for (int p = 0; p < 3; p++) {
        DensityModes *modes = NULL;
        setenv("PERRIN_CPU", paths[p], 1);
        ck_assert_int_eq(density_modes_create(&modes, 2 + _i, vectors, VECTORS), OK);
        density_modes_add(modes, &state->box, state->position, 0, 333, real[p], imaginary[p]);
        density_modes_free(modes);
    }
    unsetenv("PERRIN_CPU");
    ck_assert_int_eq(memcmp(real[0], real[1], sizeof real[0]), 0);
    ck_assert_int_eq(memcmp(real[0], real[2], sizeof real[0]), 0);
    ck_assert_int_eq(memcmp(imaginary[0], imaginary[1], sizeof real[0]), 0);
    ck_assert_int_eq(memcmp(imaginary[0], imaginary[2], sizeof real[0]), 0);
    for (int v = 0; v < VECTORS; v++) {
        double c = 0, s = 0;
        for (size_t i = 0; i < state->count; i++) {
            double phase = 0;
            for (int a = 0; a < 2 + _i; a++) {
                phase += 2 * PI * vectors[v].n[a] * state->position[a][i] / state->box.edge[a];
            }
            c += cos(phase);
            s += sin(phase);
        }
        ck_assert_double_eq_tol(real[0][v], c, 1e-10);
        ck_assert_double_eq_tol(imaginary[0][v], s, 1e-10);
    }
    state_free(state);
}
END_TEST

START_TEST(square_lattice_scatters_at_its_reciprocal_vectors_only) {
    System system = system_of(2, 100, 0.3, 1);
    State *state = new_state(&system);
    for (size_t i = 0; i < 100; i++) {
        state->position[0][i] = (double)(i % 10) / 10 * state->box.edge[0];
        state->position[1][i] = (double)(i / 10) / 10 * state->box.edge[1];
    }
    LatticeVector vectors[3] = {{{3, 4, 0}}, {{10, -20, 0}}, {{11, 0, 0}}};
    DensityModes *modes = NULL;
    ck_assert_int_eq(density_modes_create(&modes, 2, vectors, 3), OK);
    double real[3] = {0}, imaginary[3] = {0};
    density_modes_add(modes, &state->box, state->position, 0, 100, real, imaginary);
    ck_assert_double_eq_tol(real[0], 0, 1e-11);
    ck_assert_double_eq_tol(real[1], 100, 1e-11);
    ck_assert_double_eq_tol(real[2], 0, 1e-11);
    ck_assert_double_eq_tol(imaginary[1], 0, 1e-11);
    density_modes_free(modes);
    state_free(state);
}
END_TEST

// It may give wrong numbers, it must not bring the program down.
START_TEST(a_forged_count_of_pressure_blocks_is_survived) {
    System system = system_of(2, 50, 0.4, 1);
    State *state = new_state(&system);
    const Clock clock = clock_of(80, 2);
    const ObservableKind *kind = &observable_pressure;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "blocks", 4);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    Archive saved = archive_writer();
    kind->archive(observer, &saved);
    const uint64_t all_done = 4; // behind the tag of eight bytes
    memcpy(saved.bytes + 8, &all_done, sizeof all_done);
    Archive forged = archive_reader(saved.bytes, saved.size);
    kind->archive(observer, &forged);
    ck_assert_int_eq(archive_status(&forged, true), OK);
    ck_assert_int_eq(kind->see(observer, kind->next(observer, -1), state, &(Tally){0}), OK);
    archive_free(&saved);
    kind->free(observer);
    state_free(state);
}
END_TEST

START_TEST(pressure_is_that_of_the_collisions_told) {
    System system = system_of(2, 50, 0.4, 1);
    State *state = new_state(&system);
    const Clock clock = clock_of(80, 2);
    const ObservableKind *kind = &observable_pressure;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "blocks", 4);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    Tally tally = {0};
    for (int64_t tick = kind->next(observer, -1); tick <= 80; tick = kind->next(observer, tick)) {
        tally.collisions = (uint64_t)(3 * tick);
        tally.exchange[0][0] = 5.0 * (double)tick;
        tally.exchange[1][1] = 7.0 * (double)tick;
        tally.exchange[0][1] = 1000;
        ck_assert_int_eq(kind->see(observer, tick, state, &tally), OK);
    }
    Results *results = written(observer, state);
    // 12 per tick of flight time 0.25, over dim N kT = 100: Z = 1 + 0.48.
    const double density = 50 / box_volume(&state->box);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "compressibility_factor"), 1.48, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "pressure"), 1.48 * density, 1e-12);
    // 3 collisions per tick are 6 partners over 50 particles and 0.25 of time.
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "collision_rate"), 0.48, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "collisions_per_step"), 0.24, 1e-12);
    const ResultSeries *blocks = series_of(results, "quiescent", "pressure");
    ck_assert_uint_eq(blocks->size, 4);
    for (size_t b = 0; b < 4; b++) {
        ck_assert_double_eq_tol(blocks->values[b], 1.48 * density, 1e-12);
    }
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

static void heat(State *state, int64_t tick) {
    Rng rng = rng_open(KEY, STREAM_VELOCITY, (uint64_t)tick, 0);
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            state->velocity[a][i] = rng_normal(&rng) / sqrt(state->mass[i]);
        }
    }
}

START_TEST(normal_velocities_are_maxwellian_whatever_the_mass) {
    System system = system_of(2, 1000, 0.4, 2);
    system.species[1].mass = 2.7;
    State *state = new_state(&system);
    const Clock clock = clock_of(200, 1);
    const ObservableKind *kind = &observable_velocity_distribution;
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, heat, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *p = series_of(results, "quiescent", "velocity_distribution");
    const size_t bins = p->axis[1].count;
    const double samples = 500 * 2 * 200, spacing = 0.1;
    for (size_t s = 0; s < 3; s++) {
        double chi = 0, used = 0;
        for (size_t k = 0; k < bins; k++) {
            const double u = p->axis[1].values[k];
            const double share = (erf((u + 0.05) / sqrt(2)) - erf((u - 0.05) / sqrt(2))) / 2;
            const double expected = share * samples * (s == 2 ? 2 : 1);
            if (expected < 20) continue;
            const double counts = p->values[s * bins + k] * spacing * samples * (s == 2 ? 2 : 1);
            chi += (counts - expected) * (counts - expected) / expected;
            used++;
        }
        ck_assert_double_gt(used, 50);
        ck_assert_double_lt(fabs(chi_deviation(chi, used)), SIGMAS);
    }
    const double error = sqrt(2 / samples);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "kinetic_temperature_big"), 1,
                            SIGMAS * error);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "kinetic_temperature"), 1,
                            SIGMAS * error / sqrt(2));
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

START_TEST(snapshot_is_the_last_configuration) {
    System system = system_of(3, 20, 0.3, 2);
    State *state = new_state(&system);
    const Clock clock = clock_of(40, 2);
    const ObservableKind *kind = &observable_snapshot;
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, clock.ticks);
    Results *results = written(observer, state);
    scatter_at(state, 40);
    const ResultSeries *rows = series_of(results, "quiescent", "snapshot");
    ck_assert_uint_eq(rows->axis[0].count, 20);
    for (size_t i = 0; i < 20; i++) {
        for (size_t a = 0; a < 3; a++) {
            ck_assert_double_eq(rows->values[5 * i + a], state->position[a][i]);
        }
        ck_assert_double_eq(rows->values[5 * i + 3], i < 10 ? 1 : 1.4);
        ck_assert_double_eq(rows->values[5 * i + 4], i < 10 ? 0 : 1);
    }
    const ResultSeries *box = series_of(results, "quiescent", "snapshot_box");
    ck_assert_double_eq(box->values[2], state->box.edge[2]);
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

// Over all pairs and with the library's pow. _i: exponent 36, 12 or 7.
START_TEST(energy_agrees_with_its_slow_twin) {
    static const double exponents[] = {36, 12, 7};
    const double n = exponents[_i];
    System system = soft_system(150, n);
    State *state = new_state(&system);
    for (size_t i = 0; i < state->count; i++) state->diameter[i] = 0.9 + 0.002 * (double)i;
    const Clock clock = clock_of(10, 1);
    const ObservableKind *kind = &observable_energy;
    const Settings settings = settings_of(&kind->options);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, clock.ticks);
    Results *results = written(observer, state);
    const ResultSeries *series = series_of(results, "quiescent", "energy");
    double sum = 0, half = state->box.edge[0] / 2;
    for (int64_t t = 1; t <= 10; t++) {
        scatter_at(state, t);
        double expected = 0, left_out = 0;
        for (size_t i = 0; i < state->count; i++) {
            for (size_t j = 0; j < i; j++) {
                const double r = nearest_distance(state, i, j);
                const double u = pow((state->diameter[i] + state->diameter[j]) / 2 / r, n);
                *(r < half && u > 5e-7 ? &expected : &left_out) += u / 150;
            }
        }
        const double got = series->values[t - 1];
        ck_assert_double_le(fabs(got - expected), left_out + 1e-12 * expected);
        ck_assert_double_gt(got, 0);
        sum += got;
    }
    const double energy = scalar_of(results, "quiescent", "energy");
    ck_assert_double_eq_tol(energy / (sum / 10), 1, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "compressibility_factor_virial"),
                            1 + n * energy / 3, 1e-9 * energy);
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

START_TEST(energy_is_refused_where_there_is_none) {
    const System hard = system_of(3, 100, 0.4, 1);
    System two = soft_system(100, 36);
    two.species[1] = two.species[0];
    two.species_count = 2;
    two.species[1].exponent = 12;
    const Clock clock = clock_of(100, 1);
    const Settings settings = settings_of(&observable_energy.options);
    ck_assert_int_eq(observable_energy.check(&settings, &hard, &clock), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "is hard"));
    ck_assert_int_eq(observable_energy.check(&settings, &two, &clock), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "one whole number"));
}
END_TEST

// _i: soft spheres, or bodies with an axis.
START_TEST(what_has_no_contact_distance_has_no_contact_values) {
    System system = _i == 0 ? soft_system(100, 36) : oriented_system(100, 2);
    State *state = new_state(&system);
    const Clock clock = clock_of(100, 1);
    const ObservableKind *kind = &observable_pair_distribution;
    const Settings settings = settings_of(&kind->options);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), OK);
    Observer *observer = new_observer(kind, &settings, state, &clock);
    watch(observer, state, scatter_at, -1, clock.ticks);
    Results *results = written(observer, state);
    series_of(results, "quiescent", "pair_distribution");
    ck_assert_ptr_null(results_find_series(results, "quiescent", "contact_distribution"));
    ck_assert_ptr_null(results_find_series(results, "quiescent", "contact_weight"));
    results_free(results);
    kind->free(observer);
    state_free(state);
}
END_TEST

static void expect_refusal(const ObservableKind *kind, const char *option, double value,
                           const char *words) {
    const System system = system_of(2, 100, 0.4, 2);
    const Clock clock = clock_of(1000, 5);
    Settings settings = settings_of(&kind->options);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), OK);
    set_number(&settings, &kind->options, option, value);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), words) != NULL, "'%s'", status_sentence());
}

START_TEST(what_cannot_be_measured_is_refused_with_a_sentence) {
    expect_refusal(&observable_mean_squared_displacement, "times.last", 501,
                   "longer than the stage");
    expect_refusal(&observable_mean_squared_displacement, "times.first", 400, "times.first = 400");
    expect_refusal(&observable_pair_distribution, "distances.last", 50, "half of the box edge");
    expect_refusal(&observable_structure_factor, "wave_numbers.last", 0.1, "2 pi/L");
}
END_TEST

START_TEST(pairs_of_species_are_numbered_as_they_are_named) {
    System system = system_of(2, 30, 0.3, 3);
    Labels labels;
    labels_of_pairs(&labels, &system, "total");
    ck_assert_uint_eq(labels.count, 7);
    ck_assert_str_eq(labels.names[pair_index(0, 0, 3)], "small-small");
    ck_assert_str_eq(labels.names[pair_index(2, 0, 3)], "small-bigger");
    ck_assert_str_eq(labels.names[pair_index(1, 2, 3)], "big-bigger");
    ck_assert_str_eq(labels.names[pair_index(2, 2, 3)], "bigger-bigger");
    ck_assert_str_eq(labels.names[6], "total");
}
END_TEST

static Suite *suite(void) {
    Suite *s = suite_create("observables");
    TCase *c = tcase_create("observables");
    size_t kinds = 0;
    while (observable_kinds[kinds]) kinds++;
    tcase_set_timeout(c, 120);
    tcase_add_test(c, lags_ascend_and_are_whole_steps_beyond_a_step);
    tcase_add_test(c, looks_are_even_and_never_too_many);
    tcase_add_test(c, straight_flight_is_ballistic_across_the_box_edges);
    tcase_add_test(c, random_walk_agrees_with_its_slow_twin_and_diffuses);
    tcase_add_loop_test(c, an_observer_saved_and_loaded_goes_on_bit_for_bit, 0, (int)kinds);
    tcase_add_loop_test(c, memory_is_estimated_within_a_factor_of_two_of_what_is_saved, 0,
                        (int)kinds);
    tcase_add_loop_test(c, near_pairs_are_those_of_all_pairs, 0, 4);
    tcase_add_loop_test(c, ideal_gas_has_no_structure, 0, 2);
    tcase_add_loop_test(c, pair_distribution_agrees_with_its_slow_twin, 0, 2);
    tcase_add_loop_test(c, ideal_gas_scatters_as_its_particles, 0, 2);
    tcase_add_test(c, structure_factor_agrees_with_its_slow_twin);
    tcase_add_loop_test(c, density_modes_have_the_same_bits_on_every_path, 0, 2);
    tcase_add_test(c, square_lattice_scatters_at_its_reciprocal_vectors_only);
    tcase_add_test(c, a_forged_count_of_pressure_blocks_is_survived);
    tcase_add_test(c, pressure_is_that_of_the_collisions_told);
    tcase_add_test(c, normal_velocities_are_maxwellian_whatever_the_mass);
    tcase_add_test(c, snapshot_is_the_last_configuration);
    tcase_add_loop_test(c, energy_agrees_with_its_slow_twin, 0, 3);
    tcase_add_test(c, energy_is_refused_where_there_is_none);
    tcase_add_loop_test(c, what_has_no_contact_distance_has_no_contact_values, 0, 2);
    tcase_add_test(c, what_cannot_be_measured_is_refused_with_a_sentence);
    tcase_add_test(c, pairs_of_species_are_numbered_as_they_are_named);
    suite_add_tcase(s, c);
    return s;
}

int main(void) {
    return run_suite(suite());
}
