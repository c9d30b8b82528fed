// SPDX-License-Identifier: GPL-3.0-or-later
// Correlation functions of a random walk across the edges of the box, against slow twins that go
// through all frames, all particles and all vectors with the C library's own functions.
#include "observe.h"

#include "base/constants.h"
#include "observables/lags.h"
#include "observables/versines.h"

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

// Compares every element of self_scattering. `waits`: origins, or NULL for many.
static void compare_self(const Walked *w, const Lags *lags) {
    const ResultSeries *f = series_of(w->results, "quiescent", "self_scattering");
    const ResultAxis *axis = f->axis;
    const size_t ways = axis[1].count - 1, numbers = axis[2].count, times = lags_rows(lags);
    ck_assert_uint_eq(f->size, (WALK_SPECIES + 1) * (ways + 1) * numbers * times);
    for (size_t s = 0; s <= WALK_SPECIES; s++) {
        const Range range = range_of(w->state, s);
        for (size_t q = 0; q < numbers; q++) {
            for (size_t row = 0; row < times; row++) {
                const int64_t only = lags->waits ? lags->wait[row / lags->count] : -1;
                double mean = 0;
                for (size_t d = 0; d < ways; d++) {
                    const Vector vector = vector_along(axis[1].labels[d], axis[2].values[q]);
                    const double slow =
                        slow_mean(lags, row % lags->count, only, range, cosine_seen, &vector);
                    const double got =
                        f->values[((s * (ways + 1) + d) * numbers + q) * times + row];
                    ck_assert(isnan(slow) ? isnan(got) : fabs(slow - got) < 1e-12);
                    mean += slow / (double)ways;
                }
                const double got = f->values[((s * (ways + 1) + ways) * numbers + q) * times + row];
                ck_assert(isnan(mean) ? isnan(got) : fabs(mean - got) < 1e-12);
            }
        }
    }
}

static const OptionReals WAVE_NUMBERS = {.count = 3, .values = {1.1, 3, 7.5}};
static const OptionReals WAITING_TIMES = {.count = 3, .values = {0, 21, 100}};

// _i: bit 0 dimension, bit 1 waiting times.
START_TEST(self_scattering_agrees_with_its_slow_twin) {
    const ObservableKind *kind = &observable_self_scattering;
    Settings settings = settings_of(&kind->options);
    set_list(&settings, kind, "wave_numbers", WAVE_NUMBERS);
    set_number(&settings, &kind->options, "origins", 10);
    if (_i & 2) set_list(&settings, kind, "waiting_times", WAITING_TIMES);
    Walked w = walked(kind, &settings, 2 + (_i & 1));
    const LagSettings chosen = {.per_decade = 10,
                                .origins = 10,
                                .waiting_times = _i & 2 ? WAITING_TIMES : (OptionReals){0}};
    const Lags lags = lags_chosen(&chosen, &w.clock);
    ck_assert_uint_eq(lags.waits, _i & 2 ? 3 : 0);
    compare_self(&w, &lags);
    forget(&w);
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

int main(void) {
    Suite *suite = suite_create("correlators");
    TCase *c = tcase_create("correlators");
    tcase_set_timeout(c, 60);
    tcase_add_loop_test(c, self_scattering_agrees_with_its_slow_twin, 0, 4);
    tcase_add_test(c, versines_have_the_same_bits_on_every_path);
    tcase_add_test(c, what_cannot_be_correlated_is_refused_with_a_sentence);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
