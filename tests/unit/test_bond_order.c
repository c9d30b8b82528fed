// SPDX-License-Identifier: GPL-3.0-or-later
// Bond-orientational order of lattices, whose values are known, and of ideal gases.
#include "observe.h"
#include "suite.h"

// `edge` cells along each axis, each with the places of a basis in units of the cell.
typedef struct Lattice {
    const char *name;
    int dimension;
    double cell[3]; // in nearest distances
    size_t basis_count;
    double basis[4][3];
    double neighbours;
    double order; // local and global
} Lattice;

static const Lattice lattices[] = {
    {"triangular", 2, {1, 1.7320508075688772, 1}, 2, {{0, 0, 0}, {0.5, 0.5, 0}}, 1.4, 1},
    {"square", 2, {1, 1, 1}, 1, {{0, 0, 0}}, 1.2, 0},
    {"simple cubic", 3, {1, 1, 1}, 1, {{0, 0, 0}}, 1.2, 0.3535533906},
    {"body-centred",
     3,
     {1.1547005383792515, 1.1547005383792515, 1.1547005383792515},
     2,
     {{0, 0, 0}, {0.5, 0.5, 0.5}},
     1.1,
     0.6285393611},
    {"body-centred, two shells",
     3,
     {1.1547005383792515, 1.1547005383792515, 1.1547005383792515},
     2,
     {{0, 0, 0}, {0.5, 0.5, 0.5}},
     1.4,
     0.5106882308},
    {"face-centred",
     3,
     {1.4142135623730951, 1.4142135623730951, 1.4142135623730951},
     4,
     {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}},
     1.3,
     0.5745242597},
};

enum { EDGE = 6 };

// The nearest are 1.02 diameters apart.
static State *lattice_state(const Lattice *lattice) {
    System system = system_of(lattice->dimension, 0, 0, 1);
    system.particles = (int64_t)lattice->basis_count * EDGE * EDGE;
    if (lattice->dimension == 3) system.particles *= EDGE;
    system.number_density = 0.1;
    State *state = new_state(&system);
    for (int a = 0; a < lattice->dimension; a++) {
        state->box.edge[a] = EDGE * 1.02 * lattice->cell[a];
    }
    for (size_t i = 0; i < state->count; i++) {
        const size_t cell = i / lattice->basis_count;
        const size_t at[3] = {cell % EDGE, cell / EDGE % EDGE, cell / EDGE / EDGE};
        for (int a = 0; a < lattice->dimension; a++) {
            const double place = (double)at[a] + lattice->basis[i % lattice->basis_count][a];
            state->position[a][i] = (place + 0.25) * 1.02 * lattice->cell[a];
        }
    }
    return state;
}

static Results *looked_at(State *state, double neighbours) {
    const ObservableKind *kind = &observable_bond_order;
    Settings settings = settings_of(&kind->options);
    set_number(&settings, &kind->options, "neighbours", neighbours);
    const Clock clock = clock_of(4, 1);
    const Tally tally = {0};
    Observer *observer = new_observer(kind, &settings, state, &clock);
    for (int64_t tick = kind->next(observer, 0); tick <= clock.ticks;
         tick = kind->next(observer, tick)) {
        ck_assert_int_eq(kind->see(observer, tick, state, &tally), OK);
    }
    Results *results = written(observer, state);
    kind->free(observer);
    return results;
}

START_TEST(lattices_have_their_known_order) {
    const Lattice *lattice = &lattices[_i];
    State *state = lattice_state(lattice);
    Results *results = looked_at(state, lattice->neighbours);
    const double local = scalar_of(results, "quiescent", "bond_order_local");
    const double global = scalar_of(results, "quiescent", "bond_order_global");
    ck_assert_msg(fabs(local - lattice->order) < 1e-9, "%s: local %.10f, expected %.10f",
                  lattice->name, local, lattice->order);
    ck_assert_msg(fabs(global - lattice->order) < 1e-9, "%s: global %.10f, expected %.10f",
                  lattice->name, global, lattice->order);
    results_free(results);
    state_free(state);
}
END_TEST

// The bonds of an ideal gas point anywhere: the square of the global order falls as 1/N, and is
// below the 2/N of particles with a single bond each.
START_TEST(global_order_of_a_gas_falls_with_its_number) {
    double square[2] = {0};
    const int64_t particles[2] = {200, 2400};
    enum { SAMPLES = 200 };
    for (int size = 0; size < 2; size++) {
        const System system = system_of(2 + _i, particles[size], 0.4, 1);
        State *state = new_state(&system);
        for (uint64_t sample = 0; sample < SAMPLES; sample++) {
            scatter(state, (RngKey){.seed = 5}, sample);
            Results *results = looked_at(state, 1.4);
            const double global = scalar_of(results, "quiescent", "bond_order_global");
            square[size] += global * global / SAMPLES;
            results_free(results);
        }
        state_free(state);
    }
    // |psi|^2 is exponentially distributed in the worst case: each mean is known to 1/sqrt(200).
    ck_assert_double_eq_tol(square[0] / square[1] / 12, 1, 4 * sqrt(2.0 / SAMPLES));
    ck_assert_double_lt(square[0], 2.0 / 200);
}
END_TEST

// By the definition, with angles, for every pair.
START_TEST(it_agrees_with_its_slow_twin) {
    const System system = system_of(2, 300, 0.5, 2);
    State *state = new_state(&system);
    scatter(state, (RngKey){.seed = 8}, 1);
    double local = 0, real = 0, imaginary = 0;
    for (size_t i = 0; i < state->count; i++) {
        double c = 0, s = 0, bonds = 0;
        for (size_t j = 0; j < state->count; j++) {
            double r[3] = {state->position[0][j] - state->position[0][i],
                           state->position[1][j] - state->position[1][i], 0};
            box_nearest_image(&state->box, r);
            const double contact = (state->diameter[i] + state->diameter[j]) / 2;
            if (j == i || hypot(r[0], r[1]) >= 1.5 * contact) continue;
            c += cos(6 * atan2(r[1], r[0]));
            s += sin(6 * atan2(r[1], r[0]));
            bonds++;
        }
        if (bonds == 0) continue;
        local += hypot(c, s) / bonds / 300;
        real += c / bonds / 300;
        imaginary += s / bonds / 300;
    }
    Results *results = looked_at(state, 1.5);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "bond_order_local"), local, 1e-12);
    ck_assert_double_eq_tol(scalar_of(results, "quiescent", "bond_order_global"),
                            hypot(real, imaginary), 1e-12);
    results_free(results);
    state_free(state);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("bond_order");
    TCase *c = tcase_create("bond_order");
    tcase_set_timeout(c, 60);
    tcase_add_loop_test(c, lattices_have_their_known_order, 0, sizeof lattices / sizeof *lattices);
    tcase_add_loop_test(c, global_order_of_a_gas_falls_with_its_number, 0, 2);
    tcase_add_test(c, it_agrees_with_its_slow_twin);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
