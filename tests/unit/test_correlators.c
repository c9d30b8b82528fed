// SPDX-License-Identifier: GPL-3.0-or-later
// Correlation functions of a random walk across the edges of the box, against slow twins that go
// through all frames, all particles and all vectors with the C library's own functions.
#include "observe.h"
#include "suite.h"

#include "analysis/analysis.h"
#include "base/constants.h"
#include "observables/frame.h"
#include "observables/lags.h"
#include "observables/versines.h"

#include <stdio.h>
#include <stdlib.h>

static const RngKey KEY = {.seed = 20261125, .replica = 5};

enum { WALK_TICKS = 300, WALKERS = 51, WALK_SPECIES = 2 };
static double walk[WALK_TICKS + 1][3][WALKERS];

static void make_walk(const State *state) {
    Rng rng = rng_open(KEY, STREAM_VELOCITY, 0, 0);
    for (int t = 0; t <= WALK_TICKS; t++) {
        for (int a = 0; a < 3; a++) {
            for (int i = 0; i < WALKERS; i++) {
                walk[t][a][i] = t == 0 ? rng_uniform(&rng) * state->box.edge[a]
                                       : walk[t - 1][a][i] + 0.15 * rng_normal(&rng);
            }
        }
    }
}

static void stay(State *state, int64_t tick) {
    (void)state;
    (void)tick;
}

static void walk_to(State *state, int64_t tick) {
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < WALKERS; i++) fold(state, a, i, walk[tick][a][i]);
    }
}

// What an observable says of the walk. `settings` with a dimension of 2 or 3.
typedef struct Walked {
    System system;
    State *state;
    Clock clock;
    Results *results;
} Walked;

static Walked walked(const ObservableKind *kind, const Settings *settings, int dimension) {
    Walked w = {.system = system_of(dimension, WALKERS, 0.2, WALK_SPECIES),
                .clock = clock_of(WALK_TICKS, 2)};
    w.state = new_state(&w.system);
    make_walk(w.state);
    ck_assert_msg(kind->check(settings, &w.system, &w.clock) == OK, "%s", status_sentence());
    Observer *observer = new_observer(kind, settings, w.state, &w.clock);
    watch(observer, w.state, walk_to, -1, WALK_TICKS);
    w.results = written(observer, w.state);
    kind->free(observer);
    return w;
}

static void forget(Walked *w) {
    results_free(w->results);
    state_free(w->state);
}

static void set_list(Settings *settings, const ObservableKind *kind, const char *name,
                     OptionReals list) {
    for (size_t i = 0; i < kind->options.count; i++) {
        const Option *row = &kind->options.rows[i];
        if (strcmp(row->name, name) == 0) memcpy(settings->bytes + row->offset, &list, sizeof list);
    }
}

// The particles of a species, or all.
typedef struct Range {
    size_t begin, end;
} Range;

static Range range_of(const State *state, size_t species) {
    size_t counts[SPECIES_MOST];
    system_counts(&state->system, counts);
    if (species == WALK_SPECIES) return (Range){0, WALKERS};
    return species == 0 ? (Range){0, counts[0]} : (Range){counts[0], WALKERS};
}

// A mean over particles and over the origins that the lags say, or from one origin alone.
typedef double (*Seen)(const double *from_to[2][3], size_t particle, const void *what);

static double slow_mean(const Lags *lags, size_t k, int64_t only, Range range, Seen seen,
                        const void *what) {
    double sum = 0, count = 0;
    for (int64_t t = 0; t + lags->ticks[k] <= WALK_TICKS; t++) {
        if (only >= 0 ? t != only : t % lags->spacing != 0) continue;
        const double *from_to[2][3];
        for (int a = 0; a < 3; a++) {
            from_to[0][a] = walk[t][a];
            from_to[1][a] = walk[t + lags->ticks[k]][a];
        }
        for (size_t i = range.begin; i < range.end; i++, count++) sum += seen(from_to, i, what);
    }
    return sum / count;
}

typedef struct Vector {
    double q[3];
} Vector;

static double cosine_seen(const double *from_to[2][3], size_t i, const void *what) {
    const Vector *vector = what;
    double phase = 0;
    for (int a = 0; a < 3; a++) phase += vector->q[a] * (from_to[1][a][i] - from_to[0][a][i]);
    return cos(phase);
}

static const struct {
    const char *name;
    double x, y, z;
} WAYS[] = {{"x", 1, 0, 0},    {"y", 0, 1, 0},    {"z", 0, 0, 1},
            {"xy", 1, 1, 0},   {"-xy", 1, -1, 0}, {"xz", 1, 0, 1},
            {"-xz", 1, 0, -1}, {"yz", 0, 1, 1},   {"-yz", 0, 1, -1}};

static Vector vector_along(const char *name, double q) {
    for (size_t k = 0; k < sizeof WAYS / sizeof *WAYS; k++) {
        if (strcmp(WAYS[k].name, name) != 0) continue;
        const double length =
            sqrt(WAYS[k].x * WAYS[k].x + WAYS[k].y * WAYS[k].y + WAYS[k].z * WAYS[k].z);
        return (Vector){{q * WAYS[k].x / length, q * WAYS[k].y / length, q * WAYS[k].z / length}};
    }
    ck_abort_msg("no direction '%s'", name);
}

static int64_t only_origin(const Lags *lags, size_t row) {
    return lags->waits ? lags->wait[row / lags->count] : -1;
}

static void compare(double got, double slow, double scale) {
    ck_assert_msg(isnan(slow) ? isnan(got) : fabs(got - slow) < 1e-11 * scale, "%.17g, not %.17g",
                  got, slow);
}

// Every element of self_scattering.
static void compare_self(const Walked *w, const Lags *lags) {
    const ResultSeries *f = series_of(w->results, "quiescent", "self_scattering");
    const ResultAxis *axis = f->axis;
    const size_t ways = axis[1].count - 1, numbers = axis[2].count, times = lags_rows(lags);
    ck_assert_uint_eq(f->size, (WALK_SPECIES + 1) * (ways + 1) * numbers * times);
    for (size_t s = 0; s <= WALK_SPECIES; s++) {
        const Range range = range_of(w->state, s);
        for (size_t q = 0; q < numbers; q++) {
            for (size_t row = 0; row < times; row++) {
                const int64_t only = only_origin(lags, row);
                double mean = 0;
                for (size_t d = 0; d < ways; d++) {
                    const Vector vector = vector_along(axis[1].labels[d], axis[2].values[q]);
                    const double slow =
                        slow_mean(lags, row % lags->count, only, range, cosine_seen, &vector);
                    const double got =
                        f->values[((s * (ways + 1) + d) * numbers + q) * times + row];
                    compare(got, slow, 1);
                    mean += slow / (double)ways;
                }
                const double got = f->values[((s * (ways + 1) + ways) * numbers + q) * times + row];
                compare(got, mean, 1);
            }
        }
    }
}

static const OptionReals WAVE_NUMBERS = {.count = 3, .values = {1.1, 3, 7.5}};
static const OptionReals WAITING_TIMES = {.count = 3, .values = {0, 21, 100}};

// The lags that both an observer with these settings and its twin have.
static Lags lags_with(const Walked *w, int64_t per_decade, int64_t origins, bool waiting) {
    const LagSettings chosen = {.per_decade = per_decade,
                                .origins = origins,
                                .waiting_times = waiting ? WAITING_TIMES : (OptionReals){0}};
    return lags_chosen(&chosen, &w->clock);
}

// _i: bit 0 dimension, bit 1 waiting times.
START_TEST(self_scattering_agrees_with_its_slow_twin) {
    const ObservableKind *kind = &observable_self_scattering;
    Settings settings = settings_of(&kind->options);
    set_list(&settings, kind, "wave_numbers", WAVE_NUMBERS);
    set_number(&settings, &kind->options, "origins", 10);
    if (_i & 2) set_list(&settings, kind, "waiting_times", WAITING_TIMES);
    Walked w = walked(kind, &settings, 2 + (_i & 1));
    const Lags lags = lags_with(&w, 10, 10, _i & 2);
    ck_assert_uint_eq(lags.waits, _i & 2 ? 3 : 0);
    compare_self(&w, &lags);
    forget(&w);
}
END_TEST

// Re rho_a*(q) rho_b(q) between two frames, for every vector of the half lattice in the shell.
static double slow_products(const State *state, const double low_high[2], int64_t from, int64_t to,
                            Range a, Range b) {
    double sum = 0, count = 0;
    const int planes = state->box.dimension == 3 ? 12 : 0;
    for (int x = 0; x <= 12; x++) {
        for (int y = -12; y <= 12; y++) {
            for (int z = -planes; z <= planes; z++) {
                if (x < 0 || (x == 0 && (y < 0 || (y == 0 && z <= 0)))) continue;
                const double q[3] = {2 * PI * x / state->box.edge[0],
                                     2 * PI * y / state->box.edge[1],
                                     2 * PI * z / state->box.edge[2]};
                const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
                if (length < low_high[0] || length >= low_high[1]) continue;
                double modes[2][2] = {{0, 0}, {0, 0}};
                for (size_t i = 0; i < WALKERS; i++) {
                    double phase[2] = {0, 0};
                    for (int d = 0; d < state->box.dimension; d++) {
                        phase[0] += q[d] * walk[from][d][i];
                        phase[1] += q[d] * walk[to][d][i];
                    }
                    const bool in[2] = {i >= a.begin && i < a.end, i >= b.begin && i < b.end};
                    for (int k = 0; k < 2; k++) {
                        if (!in[k]) continue;
                        modes[k][0] += cos(phase[k]);
                        modes[k][1] += sin(phase[k]);
                    }
                }
                sum += modes[0][0] * modes[1][0] + modes[0][1] * modes[1][1];
                count++;
            }
        }
    }
    return sum / count / WALKERS;
}

// Of a pair of species after a number of ticks, as the observer has it.
static double slow_collective(const State *state, const Lags *lags, int64_t only, int64_t ticks,
                              const double low_high[2], size_t a, size_t b) {
    double sum = 0, count = 0;
    const Range one = range_of(state, a), other = range_of(state, b);
    for (int64_t t = 0; t + ticks <= WALK_TICKS; t++) {
        if (only >= 0 ? t != only : t % lags->spacing != 0) continue;
        sum += (slow_products(state, low_high, t, t + ticks, one, other) +
                slow_products(state, low_high, t, t + ticks, other, one)) /
               2;
        count++;
    }
    return sum / count;
}

// _i: bit 0 dimension, bit 1 waiting times.
START_TEST(collective_scattering_agrees_with_its_slow_twin) {
    const ObservableKind *kind = &observable_collective_scattering;
    Settings settings = settings_of(&kind->options);
    set_list(&settings, kind, "wave_numbers", (OptionReals){2, {1.5, 2.9}});
    set_number(&settings, &kind->options, "shell.width", 0.9);
    set_number(&settings, &kind->options, "shell.vectors", 0);
    set_number(&settings, &kind->options, "times.per_decade", 2);
    set_number(&settings, &kind->options, "origins", 4);
    if (_i & 2) set_list(&settings, kind, "waiting_times", WAITING_TIMES);
    Walked w = walked(kind, &settings, 2 + (_i & 1));
    const Lags lags = lags_with(&w, 2, 4, _i & 2);
    const ResultSeries *f = series_of(w.results, "quiescent", "collective_scattering");
    const size_t groups = lags.waits ? lags.waits : 1, times = lags.count + 1;
    ck_assert_uint_eq(f->size, 4 * 2 * groups * times);
    static const size_t pairs[3][2] = {{0, 0}, {0, 1}, {1, 1}};
    const double shells[2][2] = {{1.05, 1.95}, {2.45, 3.35}};
    for (size_t e = 0; e < 2 * groups * times; e++) {
        const size_t shell = e / (groups * times), group = e / times % groups, time = e % times;
        const int64_t ticks = time ? lags.ticks[time - 1] : 0;
        double total = 0;
        for (size_t pair = 0; pair < 3; pair++) {
            const double slow =
                slow_collective(w.state, &lags, lags.waits ? lags.wait[group] : -1, ticks,
                                shells[shell], pairs[pair][0], pairs[pair][1]);
            compare(f->values[pair * 2 * groups * times + e], slow, 1);
            total += pair == 1 ? 2 * slow : slow;
        }
        compare(f->values[3 * 2 * groups * times + e], total, 1);
    }
    forget(&w);
}
END_TEST

START_TEST(collective_scattering_begins_at_the_structure_factor) {
    const System system = system_of(2 + _i, 300, 0.3, 2);
    State *state = new_state(&system);
    scatter(state, KEY, 1);
    const Clock clock = clock_of(400, 2);
    const ObservableKind *kinds[] = {&observable_structure_factor,
                                     &observable_collective_scattering};
    Settings settings[2];
    for (int k = 0; k < 2; k++) settings[k] = settings_of(&kinds[k]->options);
    set_list(&settings[1], kinds[1], "wave_numbers", (OptionReals){3, {3.1, 6.1, 9.7}});
    Results *results[2];
    for (int k = 0; k < 2; k++) {
        ck_assert_int_eq(kinds[k]->check(&settings[k], &system, &clock), OK);
        Observer *observer = new_observer(kinds[k], &settings[k], state, &clock);
        watch(observer, state, stay, -1, 400);
        results[k] = written(observer, state);
        kinds[k]->free(observer);
    }
    const ResultSeries *s = series_of(results[0], "quiescent", "structure_factor");
    const ResultSeries *f = series_of(results[1], "quiescent", "collective_scattering");
    const size_t times = f->axis[2].count;
    for (size_t q = 0; q < 3; q++) {
        size_t shell = 0;
        while (s->axis[1].values[shell] < f->axis[1].values[q] - 1e-9) shell++;
        ck_assert_double_eq_tol(s->axis[1].values[shell], f->axis[1].values[q], 1e-12);
        for (size_t pair = 0; pair < 4; pair++) {
            const double expected = s->values[pair * s->axis[1].count + shell];
            for (size_t k = 0; k < times; k++) // nothing moves
                ck_assert_double_eq_tol(f->values[(pair * 3 + q) * times + k], expected, 1e-12);
        }
    }
    for (int k = 0; k < 2; k++) results_free(results[k]);
    state_free(state);
}
END_TEST

// The same walk, of particles that are carried along besides.
static void walk_adrift(State *state, int64_t tick) {
    static const double drift[3] = {0.31, -0.17, 0.08}; // every tick
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < WALKERS; i++)
            fold(state, a, i, walk[tick][a][i] + drift[a] * (double)tick);
    }
}

// What is seen from the centre of mass does not know what carries all particles along: the walk at
// rest and adrift look the same. _i: bit 0 dimension, the others who looks.
START_TEST(drift_is_not_seen_from_the_centre_of_mass) {
    static const struct {
        const ObservableKind *kind;
        const char *name;
    } looks[] = {{&observable_self_scattering, "self_scattering_centred"},
                 {&observable_collective_scattering, "collective_scattering_about_centre"},
                 {&observable_mean_squared_displacement, "mean_squared_displacement_centred"},
                 {&observable_overlap, "overlap_square_centred"},
                 {&observable_non_affine_displacement, "non_affine_displacement_centred"}};
    const ObservableKind *kind = looks[_i >> 1].kind;
    const char *name = looks[_i >> 1].name;
    static const Mover movers[2] = {walk_to, walk_adrift};
    const System system = system_of(2 + (_i & 1), WALKERS, 0.2, WALK_SPECIES);
    const Clock clock = clock_of(WALK_TICKS, 2);
    Settings settings = settings_of(&kind->options);
    if (_i < 4) set_list(&settings, kind, "wave_numbers", (OptionReals){2, {1.5, 2.9}});
    if (kind == &observable_collective_scattering)
        set_number(&settings, &kind->options, "shell.width", 0.9);
    if (kind == &observable_overlap) set_number(&settings, &kind->options, "distance", 1);
    set_number(&settings, &kind->options, "frame", FRAME_CENTRE_OF_MASS);
    State *state = new_state(&system);
    Results *results[2];
    make_walk(state);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), OK);
    for (int k = 0; k < 2; k++) {
        Observer *observer = new_observer(kind, &settings, state, &clock);
        watch(observer, state, movers[k], -1, WALK_TICKS);
        results[k] = written(observer, state);
        kind->free(observer);
    }
    const ResultSeries *rest = series_of(results[0], "quiescent", name);
    const ResultSeries *adrift = series_of(results[1], "quiescent", name);
    for (size_t e = 0; e < rest->size; e++)
        ck_assert_double_eq_tol(adrift->values[e], rest->values[e], 1e-10);
    for (int k = 0; k < 2; k++) results_free(results[k]);
    state_free(state);
}
END_TEST

// What `perrin check` says of shells with more vectors than are taken, and nothing where all are.
// Between 9.9 and 10.1 there are 264 of q and -q in a box of 40.7, in any direction.
START_TEST(what_a_shell_leaves_out_is_said) {
    static const struct {
        const ObservableKind *kind;
        const char *vectors, *said;
    } cases[] = {
        {&observable_collective_scattering, "shell.vectors", "30 of up to about 264 wave"},
        {&observable_structure_factor, "wave_numbers.vectors", "30 of up to about 262 wave"}};
    const System system = system_of(2, 1000, 0.7, 2);
    const Clock clock = clock_of(1000, 5);
    for (size_t i = 0; i < 2; i++) {
        const ObservableKind *kind = cases[i].kind;
        Settings settings = settings_of(&kind->options);
        if (i == 0)
            set_list(&settings, kind, "wave_numbers", (OptionReals){2, {0.5, 10}});
        else
            set_number(&settings, &kind->options, "wave_numbers.last", 10);
        for (int all = 0; all < 2; all++) {
            Text lines = {0};
            if (all) set_number(&settings, &kind->options, cases[i].vectors, 0);
            ck_assert_int_eq(observable_describe(kind, &settings, &system, &clock, &lines), OK);
            ck_assert_msg(all ? text_words(&lines)[0] == '\0'
                              : strstr(text_words(&lines), cases[i].said) != NULL,
                          "'%s'", text_words(&lines));
            text_free(&lines);
        }
    }
}
END_TEST

static double length_of(const double *from_to[2][3], size_t i, int dimension) {
    double square = 0;
    for (int a = 0; a < dimension; a++) square += pow(from_to[1][a][i] - from_to[0][a][i], 2);
    return sqrt(square);
}

typedef struct Wanted {
    int dimension;
    double low, high; // of the lengths that are counted; or low is the power of a moment
} Wanted;

static double moment_seen(const double *from_to[2][3], size_t i, const void *what) {
    const Wanted *wanted = what;
    return pow(length_of(from_to, i, wanted->dimension), wanted->low);
}

static double range_seen(const double *from_to[2][3], size_t i, const void *what) {
    const Wanted *wanted = what;
    const double length = length_of(from_to, i, wanted->dimension);
    return length >= wanted->low && length < wanted->high;
}

// values[species][row] against the twin.
static void compare_rows(const Walked *w, const char *observable, const Lags *lags, Seen seen,
                         const Wanted *wanted) {
    const ResultSeries *series = series_of(w->results, "quiescent", observable);
    const size_t row_count = lags_rows(lags);
    ck_assert_uint_eq(series->size, (WALK_SPECIES + 1) * row_count);
    for (size_t e = 0; e < series->size; e++) {
        const size_t row = e % row_count;
        const double slow = slow_mean(lags, row % lags->count, only_origin(lags, row),
                                      range_of(w->state, e / row_count), seen, wanted);
        compare(series->values[e], slow, 100);
    }
}

// _i: bit 0 dimension, bit 1 waiting times.
START_TEST(moments_agree_with_their_slow_twin) {
    const ObservableKind *kind = &observable_non_gaussian_parameter;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "origins", 10);
    if (_i & 2) set_list(&settings, kind, "waiting_times", WAITING_TIMES);
    Walked w = walked(kind, &settings, 2 + (_i & 1));
    const Lags lags = lags_with(&w, 10, 10, _i & 2);
    const Wanted second = {2 + (_i & 1), 2, 0}, fourth = {2 + (_i & 1), 4, 0};
    compare_rows(&w, "squared_displacement", &lags, moment_seen, &second);
    compare_rows(&w, "quartic_displacement", &lags, moment_seen, &fourth);
    forget(&w);
}
END_TEST

START_TEST(overlap_agrees_with_its_slow_twin) {
    const ObservableKind *kind = &observable_overlap;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "origins", 10);
    set_number(&settings, &kind->options, "distance", 0.5);
    if (_i & 2) set_list(&settings, kind, "waiting_times", WAITING_TIMES);
    Walked w = walked(kind, &settings, 2 + (_i & 1));
    const Lags lags = lags_with(&w, 10, 10, _i & 2);
    const Wanted inside = {2 + (_i & 1), 0, 0.5};
    compare_rows(&w, "overlap", &lags, range_seen, &inside);
    // The mean square, from one origin, is the square of the mean.
    const ResultSeries *q = series_of(w.results, "quiescent", "overlap");
    const ResultSeries *square = series_of(w.results, "quiescent", "overlap_square");
    for (size_t e = 0; e < q->size; e++) {
        if (_i & 2)
            compare(square->values[e], q->values[e] * q->values[e], 1);
        else
            ck_assert_double_ge(square->values[e], q->values[e] * q->values[e] - 1e-15);
    }
    forget(&w);
}
END_TEST

START_TEST(van_hove_function_agrees_with_its_slow_twin) {
    const ObservableKind *kind = &observable_van_hove;
    const int dimension = 2 + (_i & 1);
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "origins", 10);
    set_number(&settings, &kind->options, "distances.spacing", 0.25);
    if (_i & 2) set_list(&settings, kind, "waiting_times", WAITING_TIMES);
    Walked w = walked(kind, &settings, dimension);
    const Lags lags = lags_with(&w, 1, 10, _i & 2);
    const ResultSeries *g = series_of(w.results, "quiescent", "van_hove");
    const size_t bins = 12, row_count = lags_rows(&lags);
    ck_assert_uint_eq(g->size, (WALK_SPECIES + 1) * row_count * bins);
    for (size_t e = 0; e < g->size; e++) {
        const size_t row = e / bins % row_count;
        const Wanted bin = {dimension, 0.25 * (double)(e % bins), 0.25 * (double)(e % bins + 1)};
        const double volume = dimension == 2 ? PI * (bin.high * bin.high - bin.low * bin.low)
                                             : 4 * PI / 3 * (pow(bin.high, 3) - pow(bin.low, 3));
        const double slow = slow_mean(&lags, row % lags.count, only_origin(&lags, row),
                                      range_of(w.state, e / bins / row_count), range_seen, &bin);
        compare(g->values[e], slow / volume, 100);
    }
    forget(&w);
}
END_TEST

// Pseudo-values of the fluctuation of an overlap that is known: their mean is the unbiased
// variance over all origins of all replicas, where replicas have one origin each.
START_TEST(susceptibility_is_the_unbiased_variance) {
    const System system = system_of(2, 100, 0.4, 1);
    static const double overlaps[] = {0.31, 0.28, 0.35, 0.30, 0.26};
    static const char *const names[] = {"small"};
    const double time = 1;
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 5), OK);
    double mean = 0, variance = 0;
    for (size_t r = 0; r < 5; r++) {
        ResultSeries shape = {
            .stage = "quiescent",
            .observable = "overlap",
            .axes = 2,
            .axis = {{.name = "species", .unit = "", .count = 1, .labels = names},
                     {.name = "time", .unit = "d^2/D0", .count = 1, .values = &time}}};
        const double square = overlaps[r] * overlaps[r];
        ck_assert_int_eq(results_put_series(results, &shape, r, &overlaps[r]), OK);
        strcpy(shape.observable, "overlap_square");
        ck_assert_int_eq(results_put_series(results, &shape, r, &square), OK);
        mean += overlaps[r] / 5;
    }
    for (size_t r = 0; r < 5; r++) variance += pow(overlaps[r] - mean, 2) / 4;
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const ResultSeries *chi = series_of(results, "quiescent", "four_point_susceptibility");
    const Estimate estimate = results_series_estimate(results, chi, 0);
    ck_assert_double_eq_tol(estimate.value, 100 * variance, 1e-12);
    ck_assert_double_gt(estimate.error, 0);
    results_free(results);
}
END_TEST

// One of which has hardly a denominator: 2 f(all) - f(other) would be below 0 where f of each is
// not.
START_TEST(of_two_replicas_each_gives_its_own_value) {
    static const double wave[1] = {6}, above[2] = {0.5, 0.3}, below[2] = {1, 0.1};
    const System system = system_of(2, WALKERS, 0.2, 1);
    static const char *const names[2] = {"collective_scattering", "collective_scattering_ends"};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    for (size_t k = 0; k < 2; k++) {
        ResultSeries shape = {
            .stage = "quiescent",
            .axes = 1,
            .axis = {{.name = "wave_number", .unit = "1/d", .count = 1, .values = wave}}};
        strcpy(shape.observable, names[k]);
        for (size_t r = 0; r < 2; r++)
            ck_assert_int_eq(results_put_series(results, &shape, r, (k ? below : above) + r), OK);
    }
    ck_assert_int_eq(analysis_derive(results, &system), OK);
    const ResultSeries *ratio = series_of(results, "quiescent", "collective_scattering_normalised");
    const Estimate mean = results_series_estimate(results, ratio, 0);
    ck_assert_double_eq_tol(mean.value, (0.5 + 3) / 2, 1e-12);
    ck_assert_double_eq_tol(mean.error, (3 - 0.5) / 2, 1e-12);
    results_free(results);
}
END_TEST

START_TEST(versines_have_the_same_bits_on_every_path) {
    enum { COUNT = 1000 };
    static _Alignas(64) double x[COUNT];
    static const char *const paths[] = {"portable", "avx2", "avx512"};
    Rng rng = rng_open(KEY, STREAM_VELOCITY, 0, 1);
    double slow = 0, sums[3];
    for (int i = 0; i < COUNT; i++) x[i] = 3 * rng_normal(&rng);
    for (int i = 0; i < COUNT; i++) slow += 2 * pow(sin(PI * 0.7 * x[i]), 2);
    for (int p = 0; p < 3; p++) {
        setenv("PERRIN_CPU", paths[p], 1);
        sums[p] = versines_sum(x, COUNT, 0.7);
    }
    unsetenv("PERRIN_CPU");
    ck_assert_double_eq_tol(sums[0], slow, 1e-11);
    ck_assert_mem_eq(&sums[0], &sums[1], sizeof(double));
    ck_assert_mem_eq(&sums[0], &sums[2], sizeof(double));
}
END_TEST

static void expect_refusal(const ObservableKind *kind, const char *option, OptionReals list,
                           const char *words) {
    const System system = system_of(2, 100, 0.4, 2);
    const Clock clock = clock_of(1000, 5);
    Settings settings = settings_of(&kind->options);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), OK);
    set_list(&settings, kind, option, list);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), words) != NULL, "'%s'", status_sentence());
}

START_TEST(what_cannot_be_correlated_is_refused_with_a_sentence) {
    const ObservableKind *kind = &observable_self_scattering;
    expect_refusal(kind, "wave_numbers", (OptionReals){2, {0.1, 3}}, "0.1 is below 2 pi/L");
    expect_refusal(kind, "wave_numbers", (OptionReals){2, {3, 2}}, "must ascend, but 2 follows 3");
    expect_refusal(&observable_collective_scattering, "wave_numbers", (OptionReals){1, {0.1}},
                   "0.1 is below 2 pi/L");
    expect_refusal(&observable_collective_scattering, "wave_numbers", (OptionReals){2, {3, 3.1}},
                   "overlap; make shell.width = 0.2 smaller");
    expect_refusal(&observable_collective_scattering, "wave_numbers", (OptionReals){1, {0.63}},
                   "no wave vector of the box");
    expect_refusal(kind, "waiting_times", (OptionReals){1, {501}}, "not within the stage");
    expect_refusal(kind, "waiting_times", (OptionReals){2, {5, 5}}, "must ascend");
    Settings settings = settings_of(&kind->options);
    const System system = system_of(2, 100, 0.4, 2);
    const Clock clock = clock_of(1000, 5);
    set_number(&settings, &kind->options, "directions", 4);
    ck_assert_int_eq(kind->check(&settings, &system, &clock), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), "no direction with z") != NULL, "'%s'",
                  status_sentence());
}
END_TEST

// Of a waiting time that leaves the longer lags no room, and after the advice.
START_TEST(lags_that_end_after_the_stage_are_told) {
    const ObservableKind *kind = &observable_overlap;
    const System system = system_of(2, 100, 0.4, 2);
    Settings settings = settings_of(&kind->options);
    Clock clock = clock_of(1000, 5);
    const double tick = clock.tick;
    set_list(&settings, kind, "waiting_times", (OptionReals){3, {0, 500 * tick, 800 * tick}});
    set_number(&settings, &kind->options, "times.last", 400 * tick);
    const struct {
        int64_t ticks;
        double last;
        bool told;
    } cases[] = {{1000, 400 * tick, true}, {1000, 200 * tick, false}, {1200, 400 * tick, false},
                 {1199, 400 * tick, true}, {1000, 0, true}, // a third of the stage
                 {1200, 0, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text lines = {0};
        char advice[100];
        clock.ticks = cases[i].ticks;
        set_number(&settings, &kind->options, "times.last", cases[i].last);
        snprintf(advice, sizeof advice, "make it %.6g %s long, or times.last %.6g at most\n",
                 1200 * tick, clock.unit, (double)(clock.ticks - 800) * tick);
        ck_assert_int_eq(observable_describe(kind, &settings, &system, &clock, &lines), OK);
        ck_assert_msg((strstr(text_words(&lines), advice) != NULL) == cases[i].told, "%zu: '%s'", i,
                      text_words(&lines));
        ck_assert(cases[i].told || text_words(&lines)[0] == '\0');
        text_free(&lines);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("correlators");
    TCase *c = tcase_create("correlators");
    tcase_set_timeout(c, 60);
    tcase_add_loop_test(c, self_scattering_agrees_with_its_slow_twin, 0, 4);
    tcase_add_loop_test(c, collective_scattering_agrees_with_its_slow_twin, 0, 4);
    tcase_add_loop_test(c, collective_scattering_begins_at_the_structure_factor, 0, 2);
    tcase_add_loop_test(c, drift_is_not_seen_from_the_centre_of_mass, 0, 10);
    tcase_add_test(c, what_a_shell_leaves_out_is_said);
    tcase_add_loop_test(c, moments_agree_with_their_slow_twin, 0, 4);
    tcase_add_loop_test(c, overlap_agrees_with_its_slow_twin, 0, 4);
    tcase_add_loop_test(c, van_hove_function_agrees_with_its_slow_twin, 0, 4);
    tcase_add_test(c, susceptibility_is_the_unbiased_variance);
    tcase_add_test(c, of_two_replicas_each_gives_its_own_value);
    tcase_add_test(c, versines_have_the_same_bits_on_every_path);
    tcase_add_test(c, what_cannot_be_correlated_is_refused_with_a_sentence);
    tcase_add_test(c, lags_that_end_after_the_stage_are_told);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
