// SPDX-License-Identifier: GPL-3.0-or-later
// Observers of a random walk in a flow that tilts the box by several whole turns, against slow
// twins that know only where every particle is, unfolded, and what the strain is.
#include "observe.h"
#include "suite.h"

#include "base/constants.h"
#include "observables/lags.h"

static const RngKey KEY = {.seed = 20261125, .replica = 6};
enum { TICKS = 300, STEP = 2, WALKERS = 51, SPECIES = 2 };
static const double RATE = 0.026; // in the clock's unit, of which a tick is half: 3.9 in all

static double walk[TICKS + 1][3][WALKERS];

static double strain_at(int64_t tick) {
    return RATE * 0.5 * (double)tick;
}

static void make_walk(const State *state) {
    Rng rng = rng_open(KEY, STREAM_VELOCITY, 0, 0);
    for (int t = 0; t <= TICKS; t++) {
        for (int a = 2; a >= 0; a--) {
            for (int i = 0; i < WALKERS; i++) {
                walk[t][a][i] = t == 0 ? rng_uniform(&rng) * state->box.edge[a]
                                       : walk[t - 1][a][i] + 0.15 * rng_normal(&rng);
                if (a == 0 && t > 0)
                    walk[t][0][i] += (strain_at(t) - strain_at(t - 1)) * walk[t][1][i];
            }
        }
    }
}

static void walk_to(State *state, int64_t tick) {
    Box *box = &state->box;
    const double wanted = strain_at(tick) * box->edge[1];
    while (fabs(wanted - box_displacement(box)) > 1e-13 * box->edge[0]) {
        const double step = wanted - box_displacement(box), most = 0.4 * box->edge[0];
        box_shear(box, fmax(fmin(step, most), -most));
    }
    for (size_t i = 0; i < WALKERS; i++) {
        for (int a = 1; a < box->dimension; a++) fold(state, a, i, walk[tick][a][i]);
        fold(state, 0, i, walk[tick][0][i] - state->image[1][i] * box_displacement(box));
    }
}

typedef struct Walked {
    System system;
    State *state;
    Drive drive;
    Clock clock;
    Results *results;
} Walked;

static void begin(Walked *w, int dimension) {
    w->system = system_of(dimension, WALKERS, 0.2, SPECIES);
    w->system.aspect = (OptionReals){.count = dimension, .values = {1.2, 1, 0.9}};
    w->drive = (Drive){.flow.rate = RATE};
    w->clock = clock_of(TICKS, STEP);
    w->clock.drive = &w->drive;
    w->state = new_state(&w->system);
    make_walk(w->state);
}

static void observe_walk(Walked *w, const ObservableKind *kind, const Settings *settings) {
    ck_assert_msg(kind->check(settings, &w->system, &w->clock) == OK, "%s", status_sentence());
    Observer *observer = new_observer(kind, settings, w->state, &w->clock);
    watch(observer, w->state, walk_to, -1, TICKS);
    w->results = written(observer, w->state);
    kind->free(observer);
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

static const OptionReals WAITING_STRAIN = {.count = 3, .values = {0, 0.26, 1.3}};

// The lags that both an observer with these settings and its twin have.
static Lags lags_with(const Walked *w, int64_t per_decade, int64_t origins, bool waiting) {
    const LagSettings chosen = {.per_decade = per_decade,
                                .origins = origins,
                                .waiting_strain = waiting ? WAITING_STRAIN : (OptionReals){0}};
    return lags_chosen(&chosen, &w->clock);
}

static bool is_origin(const Lags *lags, size_t row, int64_t tick) {
    return lags->waits ? lags->wait[row / lags->count] == tick : tick % lags->spacing == 0;
}

typedef struct Range {
    size_t begin, end;
} Range;

static Range range_of(const State *state, size_t species) {
    size_t counts[SPECIES_MOST];
    system_counts(&state->system, counts);
    if (species == SPECIES) return (Range){0, WALKERS};
    return species == 0 ? (Range){0, counts[0]} : (Range){counts[0], WALKERS};
}

// q.r at a tick, with the wave vector that the flow has made of q by then.
static double advected_phase(const double q[3], double strain, int64_t tick, size_t i) {
    const double now[3] = {q[0], q[1] - strain * q[0], q[2]};
    double phase = 0;
    for (int a = 0; a < 3; a++) phase += now[a] * walk[tick][a][i];
    return phase;
}

static double slow_self(const Lags *lags, size_t row, Range range, const double q[3]) {
    const int64_t lag = lags->ticks[row % lags->count];
    double sum = 0, count = 0;
    for (int64_t t = 0; t + lag <= TICKS; t++) {
        if (!is_origin(lags, row, t)) continue;
        const double strain = strain_at(t + lag) - strain_at(t);
        for (size_t i = range.begin; i < range.end; i++, count++)
            sum += cos(advected_phase(q, strain, t + lag, i) - advected_phase(q, 0, t, i));
    }
    return sum / count;
}

// _i: bit 0 dimension, bit 1 waiting strains.
START_TEST(a_wave_vector_goes_with_the_flow) {
    static const double ways[4][2] = {
        {1, 0}, {0, 1}, {M_SQRT1_2, M_SQRT1_2}, {M_SQRT1_2, -M_SQRT1_2}};
    const ObservableKind *kind = &observable_self_scattering;
    Walked w;
    begin(&w, 2 + (_i & 1));
    Settings settings = settings_of(&kind->options);
    const uint64_t in_plane = 0x1b;
    for (size_t k = 0; k < kind->options.count; k++) {
        if (strcmp(kind->options.rows[k].name, "directions") == 0)
            memcpy(settings.bytes + kind->options.rows[k].offset, &in_plane, sizeof in_plane);
    }
    set_list(&settings, kind, "wave_numbers", (OptionReals){2, {1.3, 4}});
    set_number(&settings, &kind->options, "origins", 10);
    if (_i & 2) set_list(&settings, kind, "waiting_strain", WAITING_STRAIN);
    observe_walk(&w, kind, &settings);
    const Lags lags = lags_with(&w, 10, 10, _i & 2);
    const size_t row_count = lags_rows(&lags);
    const ResultSeries *f = series_of(w.results, "quiescent", "self_scattering");
    ck_assert_uint_eq(f->size, 3 * 5 * 2 * row_count);
    if (_i & 2) {
        ck_assert_str_eq(f->axis[3].name, "waiting_strain");
        ck_assert_double_eq_tol(f->axis[3].values[2], 1.3, 1e-12);
    }
    for (size_t s = 0; s < 3; s++) {
        for (size_t d = 0; d < 4; d++) {
            for (size_t n = 0; n < 2; n++) {
                const double number = n ? 4 : 1.3;
                const double q[3] = {number * ways[d][0], number * ways[d][1], 0};
                for (size_t row = 0; row < row_count; row++) {
                    const double slow = slow_self(&lags, row, range_of(w.state, s), q);
                    const double got = f->values[((s * 5 + d) * 2 + n) * row_count + row];
                    ck_assert(isnan(slow) ? isnan(got) : fabs(got - slow) < 1e-10);
                }
            }
        }
    }
    forget(&w);
}
END_TEST

// By its definition: component c of x, y, (z,) xy.
static double slow_non_affine(const Lags *lags, size_t row, Range range, int c, int dimension) {
    const int64_t lag = lags->ticks[row % lags->count];
    double sum = 0, count = 0;
    for (int64_t t = 0; t + lag <= TICKS; t++) {
        if (!is_origin(lags, row, t)) continue;
        const double strain = strain_at(t + lag) - strain_at(t);
        for (size_t i = range.begin; i < range.end; i++, count++) {
            double moved[3];
            for (int a = 0; a < 3; a++) moved[a] = walk[t + lag][a][i] - walk[t][a][i];
            moved[0] -= strain * walk[t + lag][1][i];
            sum += c == dimension ? moved[0] * moved[1] : moved[c] * moved[c];
        }
    }
    return sum / count;
}

// _i: bit 0 dimension, bit 1 waiting strains.
START_TEST(non_affine_displacements_agree_with_their_definition) {
    const ObservableKind *kind = &observable_non_affine_displacement;
    const int dimension = 2 + (_i & 1);
    Walked w;
    begin(&w, dimension);
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "origins", 10);
    if (_i & 2) set_list(&settings, kind, "waiting_strain", WAITING_STRAIN);
    observe_walk(&w, kind, &settings);
    const Lags lags = lags_with(&w, 10, 10, _i & 2);
    const size_t row_count = lags_rows(&lags);
    const ResultSeries *f = series_of(w.results, "quiescent", "non_affine_displacement");
    ck_assert_uint_eq(f->size, 3 * (size_t)(dimension + 1) * row_count);
    ck_assert_str_eq(f->axis[1].labels[dimension], "xy");
    const double *got = f->values;
    for (size_t s = 0; s < 3; s++) {
        for (int c = 0; c <= dimension; c++) {
            for (size_t row = 0; row < row_count; row++, got++) {
                const double slow = slow_non_affine(&lags, row, range_of(w.state, s), c, dimension);
                ck_assert(isnan(slow) ? isnan(*got) : fabs(*got - slow) < 1e-10 * (1 + fabs(slow)));
            }
        }
    }
    forget(&w);
}
END_TEST

// S in a pixel from all vectors of the tilted lattice, of all particles, and how many they are.
static double slow_pixel(const Walked *w, double qx, double qy, double spacing, double *members) {
    const double *edge = w->state->box.edge;
    double sum = 0;
    *members = 0;
    for (int64_t t = STEP; t <= TICKS; t += STEP) {
        for (int x = -9; x <= 9; x++) {
            const double along = 2 * PI * x / edge[0];
            const int middle = (int)rint(strain_at(t) * along * edge[1] / (2 * PI));
            for (int y = middle - 9; y <= middle + 9; y++) {
                const double q[3] = {along, 2 * PI * y / edge[1] - strain_at(t) * along, 0};
                if (x == 0 && y == 0) continue;
                if (fabs(q[0] - qx) >= spacing / 2 || fabs(q[1] - qy) >= spacing / 2) continue;
                double real = 0, imaginary = 0;
                for (size_t i = 0; i < WALKERS; i++) {
                    real += cos(advected_phase(q, 0, t, i));
                    imaginary += sin(advected_phase(q, 0, t, i));
                }
                sum += (real * real + imaginary * imaginary) / WALKERS;
                ++*members;
            }
        }
    }
    return sum / *members;
}

// _i: dimension.
START_TEST(the_lattice_of_wave_vectors_tilts_with_the_box) {
    const ObservableKind *kind = &observable_planar_structure_factor;
    const double spacing = 1.37;
    Walked w;
    begin(&w, 2 + _i);
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "wave_numbers.last", 2);
    set_number(&settings, &kind->options, "wave_numbers.spacing", spacing);
    if (_i == 1) {
        set_number(&settings, &kind->options, "wave_numbers.last", 3);
        set_number(&settings, &kind->options, "wave_numbers.spacing", 2.37);
    }
    observe_walk(&w, kind, &settings);
    const ResultSeries *s = series_of(w.results, "quiescent", "planar_structure_factor");
    ck_assert_uint_eq(s->axis[1].count, 3);
    for (size_t x = 0; x < 3; x++) {
        for (size_t y = 0; y < 3; y++) {
            double members = 0;
            const double slow = slow_pixel(&w, s->axis[1].values[x], s->axis[2].values[y],
                                           _i == 1 ? 2.37 : spacing, &members);
            ck_assert_double_gt(members, 100);
            ck_assert_double_eq_tol(s->values[27 + x * 3 + y], slow, 1e-9);
        }
    }
    forget(&w);
}
END_TEST

typedef struct Cell {
    double along[2], low, high;
} Cell;

// Re rho_a*(q) rho_b(q(t)) over all vectors of the lattice at tick t that lie in the cell.
static double slow_products(const Walked *w, const Cell *cell, int64_t t, int64_t lag, Range a,
                            Range b, double *members) {
    const double *edge = w->state->box.edge, strain = strain_at(t + lag) - strain_at(t);
    double sum = 0;
    for (int x = 0; x <= 12; x++) {
        const double along = 2 * PI * x / edge[0];
        const int middle = (int)rint(strain_at(t) * along * edge[1] / (2 * PI));
        for (int y = x == 0 ? 1 : middle - 12; y <= middle + 12; y++) {
            const double q[3] = {along, 2 * PI * y / edge[1] - strain_at(t) * along, 0};
            const double length = hypot(q[0], q[1]);
            if (length < cell->low || length >= cell->high) continue;
            if (fabs(q[0] * cell->along[0] + q[1] * cell->along[1]) < length * cos(PI / 9))
                continue;
            double modes[2][2] = {{0}};
            for (size_t i = 0; i < WALKERS; i++) {
                const double phase[2] = {advected_phase(q, 0, t, i),
                                         advected_phase(q, strain, t + lag, i)};
                if (i >= a.begin && i < a.end) {
                    modes[0][0] += cos(phase[0]);
                    modes[0][1] += sin(phase[0]);
                }
                if (i >= b.begin && i < b.end) {
                    modes[1][0] += cos(phase[1]);
                    modes[1][1] += sin(phase[1]);
                }
            }
            sum += modes[0][0] * modes[1][0] + modes[0][1] * modes[1][1];
            ++*members;
        }
    }
    return sum;
}

static double slow_advected(const Walked *w, const Lags *lags, size_t group, size_t time,
                            const Cell *cell, size_t a, size_t b) {
    const int64_t lag = time == 0 ? 0 : lags->ticks[time - 1];
    double sum = 0, members = 0, none = 0;
    for (int64_t t = 0; t + lag <= TICKS; t++) {
        if (!is_origin(lags, group * lags->count, t)) continue;
        const Range one = range_of(w->state, a), other = range_of(w->state, b);
        sum += 0.5 * slow_products(w, cell, t, lag, one, other, &members) +
               0.5 * slow_products(w, cell, t, lag, other, one, &none);
    }
    return sum / members / WALKERS;
}

// _i: bit 0 dimension, bit 1 waiting strains.
START_TEST(waves_of_the_density_go_with_the_flow) {
    static const double ways[4][2] = {
        {1, 0}, {0, 1}, {M_SQRT1_2, M_SQRT1_2}, {M_SQRT1_2, -M_SQRT1_2}};
    static const size_t pairs[3][2] = {{0, 0}, {0, 1}, {1, 1}};
    const ObservableKind *kind = &observable_advected_scattering;
    Walked w;
    begin(&w, 2 + (_i & 1));
    Settings settings = settings_of(&kind->options);
    set_list(&settings, kind, "wave_numbers", (OptionReals){2, {1.6, 3.1}});
    set_number(&settings, &kind->options, "cell.width", 1.2);
    set_number(&settings, &kind->options, "cell.angle", 20);
    set_number(&settings, &kind->options, "cell.vectors", 200);
    set_number(&settings, &kind->options, "times.per_decade", 3);
    set_number(&settings, &kind->options, "origins", 4);
    if (_i & 2) set_list(&settings, kind, "waiting_strain", WAITING_STRAIN);
    observe_walk(&w, kind, &settings);
    const Lags lags = lags_with(&w, 3, 4, _i & 2);
    const size_t groups = lags.waits ? lags.waits : 1, times = lags.count + 1;
    const ResultSeries *f = series_of(w.results, "quiescent", "advected_scattering");
    ck_assert_uint_eq(f->size, 4 * 8 * groups * times);
    for (size_t cell = 0; cell < 8; cell++) {
        const double number = cell % 2 ? 3.1 : 1.6;
        const Cell where = {{ways[cell / 2][0], ways[cell / 2][1]}, number - 0.6, number + 0.6};
        for (size_t e = 0; e < groups * times; e++) {
            double total = 0;
            for (size_t p = 0; p < 3; p++) {
                const double slow = slow_advected(&w, &lags, e / times, e % times, &where,
                                                  pairs[p][0], pairs[p][1]);
                const double got = f->values[(p * 8 + cell) * groups * times + e];
                ck_assert(isnan(slow) ? isnan(got) : fabs(got - slow) < 1e-9);
                total += p == 1 ? 2 * slow : slow;
            }
            const double got = f->values[(24 + cell) * groups * times + e];
            ck_assert(isnan(total) ? isnan(got) : fabs(got - total) < 1e-9);
        }
    }
    forget(&w);
}
END_TEST

// What does not move but with the flow is remembered for ever.
static void only_flow(State *state, int64_t tick) {
    for (size_t i = 0; i < WALKERS; i++) {
        walk[tick][0][i] = walk[0][0][i] + strain_at(tick) * walk[0][1][i];
        for (int a = 1; a < 3; a++) walk[tick][a][i] = walk[0][a][i];
    }
    walk_to(state, tick);
}

START_TEST(an_affine_flow_forgets_nothing) {
    const ObservableKind *kind = &observable_advected_scattering;
    Walked w;
    begin(&w, 2);
    Settings settings = settings_of(&kind->options);
    set_list(&settings, kind, "wave_numbers", (OptionReals){1, {3.1}});
    set_number(&settings, &kind->options, "cell.vectors", 5);
    set_list(&settings, kind, "waiting_strain", WAITING_STRAIN);
    ck_assert_int_eq(kind->check(&settings, &w.system, &w.clock), OK);
    Observer *observer = new_observer(kind, &settings, w.state, &w.clock);
    watch(observer, w.state, only_flow, -1, TICKS);
    w.results = written(observer, w.state);
    kind->free(observer);
    const ResultSeries *f = series_of(w.results, "quiescent", "advected_scattering");
    const size_t times = f->axis[4].count;
    for (size_t e = 0; e < f->size; e++)
        ck_assert_double_eq_tol(f->values[e], f->values[e - e % times], 1e-9);
    forget(&w);
}
END_TEST

static void expect_refusal(const Walked *w, const ObservableKind *kind, const Settings *settings,
                           const char *words) {
    ck_assert_int_eq(kind->check(settings, &w->system, &w->clock), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), words) != NULL, "%s", status_sentence());
}

START_TEST(what_is_of_rest_says_so_in_a_flow) {
    Walked w;
    begin(&w, 2);
    const struct {
        const ObservableKind *kind;
        const char *instead;
    } of_rest[] = {{&observable_mean_squared_displacement, "non_affine_displacement"},
                   {&observable_structure_factor, "planar_structure_factor"},
                   {&observable_collective_scattering, "advected_scattering"}};
    for (size_t k = 0; k < 3; k++) {
        const Settings settings = settings_of(&of_rest[k].kind->options);
        expect_refusal(&w, of_rest[k].kind, &settings, of_rest[k].instead);
    }
    state_free(w.state);
}
END_TEST

START_TEST(a_waiting_strain_needs_a_steady_rate) {
    Walked w;
    begin(&w, 2);
    const ObservableKind *kind = &observable_self_scattering;
    Settings settings = settings_of(&kind->options);
    set_list(&settings, kind, "waiting_strain", WAITING_STRAIN);
    ck_assert_int_eq(kind->check(&settings, &w.system, &w.clock), OK);
    set_list(&settings, kind, "waiting_strain", (OptionReals){1, {4}});
    expect_refusal(&w, kind, &settings, "not within the stage");
    set_list(&settings, kind, "waiting_strain", WAITING_STRAIN);
    set_list(&settings, kind, "waiting_times", (OptionReals){1, {0}});
    expect_refusal(&w, kind, &settings, "give one");
    set_list(&settings, kind, "waiting_times", (OptionReals){0});
    w.clock.drive = NULL;
    expect_refusal(&w, kind, &settings, "needs a steady shear_rate");
    state_free(w.state);
}
END_TEST

START_TEST(the_settings_of_every_observable_have_room) {
    for (size_t k = 0; observable_kinds[k]; k++)
        ck_assert_uint_le(observable_kinds[k]->options.size, SETTINGS_SIZE);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("sheared");
    TCase *tests = tcase_create("sheared");
    tcase_set_timeout(tests, 60);
    tcase_add_loop_test(tests, a_wave_vector_goes_with_the_flow, 0, 4);
    tcase_add_loop_test(tests, non_affine_displacements_agree_with_their_definition, 0, 4);
    tcase_add_loop_test(tests, the_lattice_of_wave_vectors_tilts_with_the_box, 0, 2);
    tcase_add_loop_test(tests, waves_of_the_density_go_with_the_flow, 0, 4);
    tcase_add_test(tests, an_affine_flow_forgets_nothing);
    tcase_add_test(tests, what_is_of_rest_says_so_in_a_flow);
    tcase_add_test(tests, a_waiting_strain_needs_a_steady_rate);
    tcase_add_test(tests, the_settings_of_every_observable_have_room);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
