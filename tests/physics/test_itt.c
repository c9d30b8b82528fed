// SPDX-License-Identifier: GPL-3.0-or-later
// Mode-coupling theory under shear: its kernels against plain double sums, its limits without
// memory and without shear, symmetry, order of accuracy, an independent solution; mixtures against
// what they are when their species are alike.
#include "suite.h"

#include "itt/flow.h"
#include "itt/kernel.h"
#include "itt/transient.h"

#include "base/memory.h"
#include "mct/correlators.h"
#include "mct/critical.h"
#include "oz/oz.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

static const Mixture DISCS = {2, 1, {1}, {1}};
static const Mixture BINARY = {2, 2, {1, 1.4}, {0.6, 0.4}};
static const double PI = 3.14159265358979323846;

// ---- What the tests share ----------------------------------------------------------------------

// c_ab(q) of a closure, up to three times the cutoff.
static Direct *direct_of(Closure closure, const Mixture *mixture, double packing_fraction,
                         double cutoff) {
    enum { COUNT = 3000 };
    Oz *oz = NULL;
    Direct *direct = NULL;
    const Structure *structure = NULL;
    double q[COUNT];
    const double spacing = 3 * cutoff / COUNT;
    for (size_t i = 0; i < COUNT; i++) q[i] = direct_wave_number(spacing, i);
    ck_assert_int_eq(oz_create(&oz, closure, mixture, q, COUNT), OK);
    ck_assert_msg(oz_solve(oz, packing_fraction, &structure) == OK, "%s", status_sentence());
    ck_assert_int_eq(
        direct_create(&direct, mixture, structure->density, spacing, structure->direct, COUNT), OK);
    oz_free(oz);
    return direct;
}

static Direct *direct_of_discs(double packing_fraction, double cutoff) {
    return direct_of(CLOSURE_FUNDAMENTAL, &DISCS, packing_fraction, cutoff);
}

static Direct *direct_of_binary(double packing_fraction, double cutoff) {
    return direct_of(CLOSURE_PERCUS_YEVICK, &BINARY, packing_fraction, cutoff);
}

// c_ab(q) = height exp(-q^2/2) of all pairs of species.
static Direct *direct_of_bells(const Mixture *mixture, double height) {
    enum { COUNT = 2000 };
    Direct *direct = NULL;
    double c[MIXTURE_PAIRS_MOST * COUNT];
    for (size_t i = 0; i < mixture_pairs(mixture) * COUNT; i++)
        c[i] = height * exp(-pow(direct_wave_number(0.02, i % COUNT), 2) / 2);
    ck_assert_int_eq(direct_create(&direct, mixture, 1, 0.02, c, COUNT), OK);
    return direct;
}

static Direct *direct_of_bell(double height) {
    return direct_of_bells(&DISCS, height);
}

static Plane *plane_of(double cutoff, double spacing) {
    Plane *plane = NULL;
    ck_assert_int_eq(plane_create(&plane, cutoff, spacing), OK);
    return plane;
}

typedef struct Run {
    Plane *plane;
    Direct *direct;
    Transient *transient;
    Flow *flow;
    double most, strain_at_most; // of the stress
} Run;

static void see(Run *run, const double *phi, double time) {
    flow_see(run->flow, time, phi);
    if (flow_stress(run->flow) > run->most) {
        run->most = flow_stress(run->flow);
        run->strain_at_most = transient_strain(run->transient);
    }
}

static Run run_with(Direct *direct, double cutoff, double spacing,
                    const TransientSettings *settings) {
    Run run = {.plane = plane_of(cutoff, spacing), .direct = direct};
    ck_assert_msg(transient_create(&run.transient, run.plane, direct, settings) == OK, "%s",
                  status_sentence());
    ck_assert_int_eq(flow_create(&run.flow, run.plane, direct, settings->shear_rate), OK);
    see(&run, transient_collective(run.transient), 0);
    return run;
}

static Run run_new(Direct *direct, double cutoff, double spacing, double rate, size_t block,
                   bool tagged) {
    return run_with(direct, cutoff, spacing,
                    &(TransientSettings){rate, block, tagged, .diffusion = {1, 1}});
}

// F_ab = (Phi S)_ab at entry k of the fields.
static void run_correlators(const Run *run, size_t k, SmallMatrix f) {
    const size_t species = run->direct->mixture.species;
    SmallMatrix phi, factor;
    for (size_t n = 0; n < species * species; n++)
        phi[n / species][n % species] =
            transient_collective(run->transient)[n * run->plane->size + k];
    direct_factor(run->direct, hypot(run->plane->x[k], run->plane->y[k]), factor);
    small_multiply(species, phi, factor, f);
}

static void run_until(Run *run, double time) {
    while (transient_time(run->transient) < time * (1 - 1e-9)) {
        ck_assert_msg(transient_advance(run->transient) == OK, "%s", status_sentence());
        see(run, transient_collective(run->transient), transient_time(run->transient));
    }
}

static void run_free(Run *run) {
    flow_free(run->flow);
    transient_free(run->transient);
    direct_free(run->direct);
    plane_free(run->plane);
}

// ---- Tables and readings -----------------------------------------------------------------------

START_TEST(a_table_has_its_function_and_its_slope) {
    Direct *direct = direct_of_bell(2);
    for (double q = 0; q < 5; q += 0.0137) {
        ck_assert_double_eq_tol(direct_value(direct, 0, q), 2 * exp(-q * q / 2), 1e-8);
        ck_assert_double_eq_tol(direct_slope(direct, 0, q), -2 * q * exp(-q * q / 2), 1e-6);
    }
    ck_assert_double_eq(direct_value(direct, 0, 1e6), 0);
    ck_assert_double_eq(direct_slope(direct, 0, 1e6), 0);
    direct_free(direct);
}
END_TEST

static double cubic(double x, double y) {
    return 1 + x - 2 * y + 0.3 * x * y - 0.1 * y * y + 0.02 * y * y * y;
}

// What is cubic in q_y is read exactly where its four neighbours are on the plane.
START_TEST(advected_readings_are_exact_for_cubics) {
    Plane *plane = plane_of(10, 0.5);
    double *field = memory_new(plane->size, sizeof *field);
    double *one = memory_new(plane->size, sizeof *one);
    double *sum = memory_new(plane->size, sizeof *sum);
    for (size_t k = 0; k < plane->size; k++) {
        one[k] = 1;
        if (plane->area[k] > 0) field[k] = cubic(plane->x[k], plane->y[k]);
    }
    for (double strain = -0.9; strain < 1; strain += 0.31) {
        for (size_t k = 0; k < plane->size; k++) sum[k] = 0;
        plane_add_advected(plane, strain, field, one, sum, 1);
        for (size_t k = 0; k < plane->size; k++) {
            const double x = plane->x[k], y = plane->y[k] - strain * x;
            if (!(plane->area[k] > 0) || hypot(x, fabs(y) + 1) > 10) continue;
            ck_assert_double_eq_tol(sum[k], cubic(x, y), 1e-11);
        }
    }
    memory_free(field);
    memory_free(one);
    memory_free(sum);
    plane_free(plane);
}
END_TEST

// ---- The slow twin: double sums over wave vectors ----------------------------------------------

typedef struct Vector {
    double x, y;
} Vector;

static Vector advect(Vector q, double strain) {
    return (Vector){q.x, q.y - strain * q.x};
}

static double dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y;
}

// Some correlators that are even in q and nothing else: Phi_ab is not Phi_ba.
static double some_phi(size_t a, size_t b, Vector q) {
    const double even = exp(-0.02 * q.x * q.x - 0.03 * q.y * q.y + 0.025 * q.x * q.y);
    return (a == b ? 1 : 0.3) * even + (0.1 + 0.2 * (double)a - 0.1 * (double)b) * sin(q.x * q.y);
}

// Of all pairs, [a][b][size]; the first is that of a tagged particle, too.
static double *some_field(const Plane *plane, size_t species) {
    double *phi = memory_new(species * species * plane->size, sizeof *phi);
    for (size_t n = 0; n < species * species; n++) {
        for (size_t k = 0; k < plane->size; k++) {
            const Vector q = {plane->x[k], plane->y[k]};
            if (plane->area[k] > 0)
                phi[n * plane->size + k] = some_phi(n / species, n % species, q);
        }
    }
    return phi;
}

static bool inside(const Plane *plane, Vector q) {
    return hypot(q.x, q.y) < plane->cutoff * (1 + 1e-9);
}

static void c_of(const Direct *direct, Vector q, SmallMatrix c) {
    const size_t species = direct->mixture.species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++)
            c[a][b] = direct_value(direct, mixture_pair(species, a, b), sqrt(dot(q, q)));
    }
}

static void factor_of(const Direct *direct, Vector q, SmallMatrix factor) {
    direct_factor(direct, sqrt(dot(q, q)), factor);
}

// F = Phi S
static void correlators_of(const Direct *direct, Vector q, SmallMatrix f) {
    const size_t species = direct->mixture.species;
    SmallMatrix phi, factor;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++) phi[a][b] = some_phi(a, b, q);
    }
    factor_of(direct, q, factor);
    small_multiply(species, phi, factor, f);
}

// Both wave vectors that q falls into, at one of the two times.
typedef struct Split {
    Vector q, k, p;
    SmallMatrix c_k, c_p;
} Split;

static Split split_of(const Direct *direct, Vector q, Vector k, Vector p) {
    Split split = {.q = q, .k = k, .p = p};
    c_of(direct, k, split.c_k);
    c_of(direct, p, split.c_p);
    return split;
}

// q.k c_ab(k) delta_ad + q.p c_ad(p) delta_ab
static double vertex(Split *s, size_t a, size_t b, size_t d) {
    return (a == d ? dot(s->q, s->k) * s->c_k[a][b] : 0) +
           (a == b ? dot(s->q, s->p) * s->c_p[a][d] : 0);
}

// The sums over species of one k, as they stand.
static void add_vertices(size_t species, Split *late, Split *early, SmallMatrix f_k,
                         SmallMatrix f_p, SmallMatrix sum) {
    const size_t four = species * species * species * species;
    for (size_t a = 0; a < species; a++) {
        for (size_t c = 0; c < species; c++) {
            for (size_t n = 0; n < four; n++) {
                const size_t b = n % species, d = n / species % species;
                const size_t e = n / species / species % species,
                             g = n / species / species / species;
                sum[a][c] += vertex(late, a, b, d) * vertex(early, c, e, g) * f_k[b][e] * f_p[d][g];
            }
        }
    }
}

typedef void Term(const Direct *direct, Split *late, Split *early, SmallMatrix sum);

static void collective_term(const Direct *direct, Split *late, Split *early, SmallMatrix sum) {
    SmallMatrix f_k, f_p;
    correlators_of(direct, early->k, f_k);
    correlators_of(direct, early->p, f_p);
    add_vertices(direct->mixture.species, late, early, f_k, f_p, sum);
}

// Of tagged particles, on the diagonal: twice, since k is a density fluctuation and p is not.
static void tagged_term(const Direct *direct, Split *late, Split *early, SmallMatrix sum) {
    const size_t species = direct->mixture.species;
    SmallMatrix f;
    correlators_of(direct, early->k, f);
    for (size_t s = 0; s < species; s++) {
        for (size_t n = 0; n < species * species; n++)
            sum[s][s] += 2 * dot(late->q, late->k) * late->c_k[s][n / species] *
                         f[n / species][n % species] * early->c_k[n % species][s] *
                         dot(early->q, early->k) * some_phi(0, 0, early->p);
    }
}

// rho/(2 q^2 q'^2) times the sum over wave vectors.
static void sum_at(const Plane *plane, const Direct *direct, Vector q, double strain, Term *term,
                   SmallMatrix sum) {
    const double h = plane->spacing;
    const Vector late = advect(q, strain);
    for (int i = 0; i < SMALL_MOST * SMALL_MOST; i++) sum[i / SMALL_MOST][i % SMALL_MOST] = 0;
    for (int i = -plane->last; i <= plane->last; i++) {
        for (int j = -plane->last; j <= plane->last; j++) {
            const Vector k = {i * h, j * h}, p = {q.x - k.x, q.y - k.y};
            if (!inside(plane, k) || !inside(plane, p)) continue;
            Split now = split_of(direct, late, advect(k, strain), advect(p, strain));
            Split then = split_of(direct, q, k, p);
            term(direct, &now, &then, sum);
        }
    }
    const double scale = direct->density / (2 * dot(q, q) * dot(late, late)) * pow(h / (2 * PI), 2);
    for (int i = 0; i < SMALL_MOST * SMALL_MOST; i++) sum[i / SMALL_MOST][i % SMALL_MOST] *= scale;
}

static void memory_at(const Plane *plane, const Direct *direct, Vector q, double strain,
                      SmallMatrix memory) {
    const size_t species = direct->mixture.species;
    SmallMatrix sum, late_factor;
    sum_at(plane, direct, q, strain, collective_term, sum);
    for (size_t a = 0; a < species; a++) {
        for (size_t c = 0; c < species; c++)
            sum[a][c] /= direct->mixture.fraction[a] * direct->mixture.fraction[c];
    }
    factor_of(direct, advect(q, strain), late_factor);
    small_multiply(species, late_factor, sum, memory);
}

static void expect_near(double number, double expected) {
    ck_assert_double_eq_tol(number, expected, 1e-11 * (1 + fabs(expected)));
}

static void compare_with_double_sums(Direct *direct, double strain) {
    static const double FREE[] = {1, 1};
    const size_t species = direct->mixture.species;
    Plane *plane = plane_of(9, 0.75);
    Kernel *kernel = NULL;
    double *phi = some_field(plane, species);
    double *memory = memory_new(species * species * plane->size, sizeof *memory);
    double *tagged = memory_new(species * plane->size, sizeof *tagged);
    ck_assert_int_eq(kernel_create(&kernel, plane, direct, FREE), OK);
    kernel_set_strain(kernel, strain);
    kernel_memory(kernel, phi, memory);
    for (size_t s = 0; s < species; s++) kernel_tagged(kernel, s, phi, tagged + s * plane->size);
    for (size_t k = 0; k < plane->size; k += 7) {
        const Vector q = {plane->x[k], plane->y[k]};
        SmallMatrix expected;
        if (!(plane->area[k] > 0) || dot(q, q) == 0) continue;
        memory_at(plane, direct, q, strain, expected);
        for (size_t n = 0; n < species * species; n++)
            expect_near(memory[n * plane->size + k], expected[n / species][n % species]);
        sum_at(plane, direct, q, strain, tagged_term, expected);
        for (size_t s = 0; s < species; s++)
            expect_near(tagged[s * plane->size + k], expected[s][s]);
    }
    memory_free(phi);
    memory_free(memory);
    memory_free(tagged);
    kernel_free(kernel);
    direct_free(direct);
    plane_free(plane);
}

START_TEST(kernels_are_double_sums_over_wave_vectors) {
    for (double strain = 0; strain < 2; strain += 0.65)
        compare_with_double_sums(direct_of_discs(0.6, 9), strain);
    compare_with_double_sums(direct_of_discs(0.6, 9), -0.3);
    compare_with_double_sums(direct_of_binary(0.6, 9), 0);
    compare_with_double_sums(direct_of_binary(0.6, 9), -0.3);
    compare_with_double_sums(direct_of_binary(0.6, 9), 1.3);
}
END_TEST

// The friction of each species, summed as it stands.
static void friction_at(const Plane *plane, const Direct *direct, double strain, size_t s,
                        double friction[2][2]) {
    const double h = plane->spacing;
    const size_t species = direct->mixture.species;
    for (int i = -plane->last; i <= plane->last; i++) {
        for (int j = -plane->last; j <= plane->last; j++) {
            const Vector k = {i * h, j * h}, late = advect(k, strain);
            SmallMatrix f, c, late_c;
            if (!inside(plane, k)) continue;
            correlators_of(direct, k, f);
            c_of(direct, k, c);
            c_of(direct, late, late_c);
            double sum = 0;
            for (size_t n = 0; n < species * species; n++)
                sum += late_c[s][n / species] * f[n / species][n % species] * c[n % species][s];
            sum *= direct->density * pow(h / (2 * PI), 2) * some_phi(0, 0, k);
            friction[0][0] += sum * k.x * late.x;
            friction[0][1] += sum * k.x * late.y;
            friction[1][0] += sum * k.y * late.x;
            friction[1][1] += sum * k.y * late.y;
        }
    }
}

START_TEST(frictions_of_displacements_are_sums_over_wave_vectors) {
    static const double FREE[] = {1, 1};
    const double strain = 0.4;
    Plane *plane = plane_of(9, 0.75);
    Direct *direct = _i == 0 ? direct_of_discs(0.6, 9) : direct_of_binary(0.6, 9);
    Kernel *kernel = NULL;
    double *phi = some_field(plane, direct->mixture.species);
    double *memory = some_field(plane, direct->mixture.species);
    ck_assert_int_eq(kernel_create(&kernel, plane, direct, FREE), OK);
    kernel_set_strain(kernel, strain);
    kernel_memory(kernel, phi, memory);
    for (size_t s = 0; s < direct->mixture.species; s++) {
        double friction[2][2], expected[2][2] = {{0}};
        kernel_displacement(kernel, s, phi, friction);
        friction_at(plane, direct, strain, s, expected);
        for (int a = 0; a < 4; a++) expect_near(friction[a / 2][a % 2], expected[a / 2][a % 2]);
    }
    memory_free(memory);
    memory_free(phi);
    kernel_free(kernel);
    direct_free(direct);
    plane_free(plane);
}
END_TEST

// ---- Without memory ----------------------------------------------------------------------------

// int_0^t q(t')^2 dt'
static double free_decay(Vector q, double rate, double t) {
    return dot(q, q) * t - rate * q.x * q.y * t * t + rate * rate * q.x * q.x * t * t * t / 3;
}

static void compare_ideal_displacements(const Run *run, size_t s, double diffusion, double rate) {
    const double t = transient_time(run->transient);
    const double xx = 1 + rate * rate * t * t / 3, xy = -rate * t / 2, diagonal = (xx + 1) / 2;
    const double expected[] = {xx, 1, diagonal + xy, diagonal - xy};
    const double tolerance[] = {1e-4, 1e-9, 2e-4, 1e-4};
    for (int d = 0; d < TRANSIENT_DIRECTIONS; d++)
        ck_assert_double_eq_tol(transient_displacement(run->transient, s, d) /
                                    (2 * diffusion * t * expected[d]),
                                1, tolerance[d]);
}

// An ideal gas of two species: exp(-D int q(t')^2) of each and nothing between them, and of
// displacements (Weysser, thesis, eq. 5.37) dx^2 = 2 D t (1 + (rate t)^2/3), dy^2 = 2 D t.
START_TEST(an_ideal_gas_is_exact) {
    const double rate = 2, end = 1.5;
    const TransientSettings settings = {rate, 256, true, {1, 0.6}};
    Run run = run_with(direct_of_bells(&BINARY, 0), 6, 0.5, &settings);
    const size_t size = run.plane->size;
    double error = 0;
    while (transient_time(run.transient) < end) {
        run_until(&run, transient_time(run.transient) * 1.001 + 1e-9);
        const double t = transient_time(run.transient);
        for (size_t n = 0; n < 4 * size; n++) {
            const size_t a = n / size / 2, b = n / size % 2, k = n % size;
            const Vector q = {run.plane->x[k], run.plane->y[k]};
            const double exact =
                run.plane->area[k] > 0 ? exp(-settings.diffusion[a] * free_decay(q, rate, t)) : 0;
            error =
                fmax(error, fabs(transient_collective(run.transient)[n] - (a == b ? exact : 0)));
            error = fmax(error, fabs(transient_tagged(run.transient, a)[k] - exact));
        }
        for (size_t s = 0; s < 2; s++)
            compare_ideal_displacements(&run, s, settings.diffusion[s], rate);
    }
    ck_assert_double_lt(error, 1e-4);
    ck_assert_double_eq(flow_stress(run.flow), 0);
    run_free(&run);
}
END_TEST

// With c of order e the memory is of order e^2 and the distortion of order e, without memory:
// rate k_x d(S + dS)/dk_y = 2 k^2 dS, when it is stationary.
START_TEST(a_dilute_distortion_solves_its_equation) {
    const double rate = 3, height = -1e-5, h = 0.125;
    Run run = run_new(direct_of_bell(height), 7, h, rate, 64, false);
    const Plane *plane = run.plane;
    run_until(&run, 20);
    const double *distortion = flow_distortion(run.flow);
    for (int i = 0; i <= 16; i++) {
        for (int j = -16; j <= 16; j++) {
            const size_t k = plane_place(plane, i, j);
            const double x = plane->x[k], y = plane->y[k], square = x * x + y * y;
            const double slope = (8 * (distortion[k + 1] - distortion[k - 1]) -
                                  (distortion[k + 2] - distortion[k - 2])) /
                                 (12 * h);
            const double source = rate * x * -y * height * exp(-square / 2);
            const double left = source + rate * x * slope, right = 2 * square * distortion[k];
            ck_assert_double_eq_tol(left / height, right / height, 2e-3);
        }
    }
    run_free(&run);
}
END_TEST

// Likewise its stress, e^2 times an integral over free decays.
START_TEST(a_dilute_stress_is_an_integral) {
    const double rate = 3, height = 1e-5, h = 0.25, step = 1e-3;
    Run run = run_new(direct_of_bell(height), 7, h, rate, 128, false);
    double stress = 0, normal = 0;
    run_until(&run, 20);
    for (size_t k = 0; k < run.plane->size; k++) {
        const Vector q = {run.plane->x[k], run.plane->y[k]};
        if (q.x == 0 || q.y == 0) continue;
        for (double t = step / 2; t < 6; t += step) {
            const Vector late = advect(q, rate * t);
            const double f = rate * step * run.plane->area[k] / 2 * q.x * q.y *
                             exp(-(dot(q, q) + dot(late, late)) / 2 - 2 * free_decay(q, rate, t));
            stress += f * late.x * late.y;
            normal += f * (late.x * late.x - late.y * late.y);
            if (free_decay(q, rate, t) > 20) break;
        }
    }
    ck_assert_double_eq_tol(flow_stress(run.flow) / (height * height) / stress, 1, 2e-3);
    ck_assert_double_eq_tol(flow_normal_difference(run.flow) / (height * height) / normal, 1, 2e-3);
    run_free(&run);
}
END_TEST

// ---- Without shear -----------------------------------------------------------------------------

typedef struct Rest {
    Grid *grid;
    Oz *oz;
    const Structure *structure;
    Correlators *correlators;
} Rest;

static Rest rest_new(Closure closure, const Mixture *mixture, double packing_fraction,
                     double cutoff, const double *diffusion) {
    Rest rest;
    const CorrelatorSettings settings = {128, {diffusion[0], diffusion[1]}, true};
    const size_t count = (size_t)(cutoff * 16 / PI);
    ck_assert_int_eq(grid_create(&rest.grid, 2, count, cutoff), OK);
    ck_assert_int_eq(oz_create(&rest.oz, closure, mixture, rest.grid->wave_number, count), OK);
    ck_assert_int_eq(oz_solve(rest.oz, packing_fraction, &rest.structure), OK);
    ck_assert_int_eq(correlators_create(&rest.correlators, rest.grid, rest.structure, &settings),
                     OK);
    return rest;
}

static void rest_free(Rest *rest) {
    correlators_free(rest->correlators);
    oz_free(rest->oz);
    grid_free(rest->grid);
}

// A field of the isotropic solution by the cubic through the four nearest wave numbers.
static double rest_value(const Rest *rest, const double *values, double q) {
    const double *wave = rest->grid->wave_number;
    double sum = 0;
    size_t m = 1;
    while (m + 3 < rest->grid->count && wave[m + 1] < q) m++;
    for (size_t i = m - 1; i < m + 3; i++) {
        double weight = 1;
        for (size_t j = m - 1; j < m + 3; j++)
            if (j != i) weight *= (q - wave[j]) / (wave[i] - wave[j]);
        sum += weight * values[i];
    }
    return sum;
}

// G = rho^2/(32 pi) int dq q^3 tr (c' F)^2 (Weysser, thesis, eq. 5.14 at rest, summed over pairs).
static double rest_modulus(const Rest *rest, const Direct *direct) {
    double sum = 0;
    const Grid *grid = rest->grid;
    const size_t species = direct->mixture.species;
    const double *phi = correlators_collective(rest->correlators);
    for (size_t m = 0; m < grid->count; m++) {
        const double q = grid->wave_number[m];
        SmallMatrix f, slope, product;
        for (size_t n = 0; n < species * species; n++) {
            const size_t pair = mixture_pair(species, n / species, n % species);
            f[n / species][n % species] = phi[pair * grid->stride + m];
            slope[n / species][n % species] = direct_slope(direct, pair, q);
        }
        small_multiply(species, slope, f, product);
        for (size_t n = 0; n < species * species; n++)
            sum += grid->k_weight[m] * q * q * product[n / species][n % species] *
                   product[n % species][n / species];
    }
    return direct->density * direct->density * sum / 16;
}

// What is compared at a time: the modulus, displacements, correlators at some wave vectors.
enum { WAVES = 8, NUMBERS = 1 + 2 + WAVES * (4 + 2) };

static double compared_wave(size_t i) {
    return 3 + 2.4 * (double)i;
}

static void rest_numbers(const Rest *rest, const Direct *direct, double out[NUMBERS]) {
    const size_t species = direct->mixture.species, stride = rest->grid->stride;
    const double *collective = correlators_collective(rest->correlators);
    size_t n = 0;
    out[n++] = rest_modulus(rest, direct);
    for (size_t s = 0; s < species; s++)
        out[n++] = correlators_displacement(rest->correlators)[s] / 2;
    for (size_t i = 0; i < WAVES; i++) {
        const double q = compared_wave(i);
        for (size_t e = 0; e < species * species; e++) {
            const size_t pair = mixture_pair(species, e / species, e % species);
            out[n++] = rest_value(rest, collective + pair * stride, q);
        }
        for (size_t s = 0; s < species; s++)
            out[n++] = rest_value(rest, correlators_self(rest->correlators) + s * stride, q);
    }
}

// At this time, straight between two of the grid.
static void rest_at(Rest *rest, const Direct *direct, double time, double out[NUMBERS]) {
    double before[NUMBERS] = {0}, then = 0;
    while (correlators_time(rest->correlators) < time) {
        then = correlators_time(rest->correlators);
        rest_numbers(rest, direct, before);
        ck_assert_int_eq(correlators_advance(rest->correlators), OK);
    }
    rest_numbers(rest, direct, out);
    const double u = (time - then) / (correlators_time(rest->correlators) - then);
    for (int i = 0; i < NUMBERS; i++) out[i] = before[i] + u * (out[i] - before[i]);
}

// Correlators of species over the square root of what both are without neighbours, x_a x_b; of one
// species over S(q).
static void compare_correlators(const Run *run, double wave, const double *expected) {
    const size_t species = run->direct->mixture.species;
    const double *fraction = run->direct->mixture.fraction;
    const int place = (int)rint(wave / run->plane->spacing);
    const size_t x = plane_place(run->plane, place, 0), y = plane_place(run->plane, 0, place);
    SmallMatrix along, across, rest;
    run_correlators(run, x, along);
    run_correlators(run, y, across);
    direct_factor(run->direct, wave, rest);
    for (size_t e = 0; e < species * species; e++) {
        const size_t a = e / species, b = e % species;
        const double most = species > 1 ? sqrt(fraction[a] * fraction[b]) : rest[a][b];
        ck_assert_double_eq_tol(along[a][b] / most, expected[e] / most, 2e-3);
        ck_assert_double_eq_tol(across[a][b] / most, along[a][b] / most, species > 1 ? 1e-8 : 1e-9);
    }
    for (size_t s = 0; s < species; s++)
        ck_assert_double_eq_tol(transient_tagged(run->transient, s)[x],
                                expected[species * species + s], 2e-3);
}

static void compare_at_rest(const Run *run, const double expected[NUMBERS]) {
    const size_t species = run->direct->mixture.species;
    ck_assert_double_eq_tol(flow_modulus(run->flow), expected[0], 1e-2 * expected[0] + 1e-2);
    for (size_t s = 0; s < species; s++) {
        const double along = transient_displacement(run->transient, s, 0);
        ck_assert_double_eq_tol(along / expected[1 + s], 1, 5e-3);
        ck_assert_double_eq_tol(transient_displacement(run->transient, s, 1), along, 1e-9);
    }
    for (size_t i = 0; i < WAVES; i++)
        compare_correlators(run, compared_wave(i),
                            expected + 1 + species + i * species * (species + 1));
}

// The solver on the plane at rest and the isotropic one have nothing in common but the equations.
START_TEST(at_rest_it_is_the_isotropic_theory) {
    static const double FREE[2][2] = {{1, 1}, {1, 0.7}};
    const double cutoff = 24;
    const Closure closure = _i == 0 ? CLOSURE_FUNDAMENTAL : CLOSURE_PERCUS_YEVICK;
    const Mixture *mixture = _i == 0 ? &DISCS : &BINARY;
    const double packing_fraction = _i == 0 ? 0.64 : 0.6;
    const TransientSettings settings = {0, 64, true, {FREE[_i][0], FREE[_i][1]}};
    Run run =
        run_with(direct_of(closure, mixture, packing_fraction, cutoff), cutoff, 0.3, &settings);
    Rest rest = rest_new(closure, mixture, packing_fraction, cutoff, FREE[_i]);
    for (double t = 1e-3; t < 2e2; t *= 10) {
        double expected[NUMBERS] = {0};
        run_until(&run, t);
        rest_at(&rest, run.direct, transient_time(run.transient), expected);
        compare_at_rest(&run, expected);
    }
    ck_assert_double_eq(flow_stress(run.flow), 0);
    rest_free(&rest);
    run_free(&run);
}
END_TEST

// Largest correlator that is left of all at rest, long after a fluid would have relaxed.
static double left_at_rest(double packing_fraction, double cutoff, double spacing) {
    Run run = run_new(direct_of_binary(packing_fraction, cutoff), cutoff, spacing, 0, 32, false);
    double most = 0;
    run_until(&run, 1e7);
    for (size_t k = 1; k < run.plane->size; k++) {
        SmallMatrix f;
        if (hypot(run.plane->x[k], run.plane->y[k]) < 1) continue;
        run_correlators(&run, k, f);
        most = fmax(most, f[0][0] + f[1][1]);
    }
    run_free(&run);
    return most;
}

// The transition is where the isotropic theory of mixtures has it, but for the spacing.
START_TEST(a_mixture_is_arrested_where_the_isotropic_theory_says) {
    const double cutoff = 18;
    CriticalPoint *point = NULL;
    const CriticalSearch search = {.mixture = BINARY,
                                   .closure = CLOSURE_PERCUS_YEVICK,
                                   .count = 92,
                                   .last = cutoff,
                                   .low = 0.6,
                                   .high = 0.76};
    ck_assert_msg(critical_find(&point, &search) == OK, "%s", status_sentence());
    const double critical = point->packing_fraction;
    critical_free(point);
    ck_assert_double_lt(left_at_rest(0.995 * critical, cutoff, 0.6), 1e-6);
    ck_assert_double_gt(left_at_rest(1.005 * critical, cutoff, 0.6), 0.3);
}
END_TEST

// Linear response: a fluid that is sheared slowly has the viscosity that Green and Kubo's integral
// over the isotropic theory at rest gives.
START_TEST(slow_shear_has_the_viscosity_of_rest) {
    static const double FREE[] = {1, 0.7};
    const double packing_fraction = 0.6, cutoff = 24, rate = 1e-3;
    const TransientSettings settings = {rate, 64, false, {1, 0.7}};
    Run run = run_with(direct_of_binary(packing_fraction, cutoff), cutoff, 0.3, &settings);
    Rest rest = rest_new(CLOSURE_PERCUS_YEVICK, &BINARY, packing_fraction, cutoff, FREE);
    double viscosity = 0, time = 0, modulus = rest_modulus(&rest, run.direct);
    run_until(&run, 1e3);
    while (time < 1e3) {
        ck_assert_int_eq(correlators_advance(rest.correlators), OK);
        const double before = modulus, then = time;
        time = correlators_time(rest.correlators);
        modulus = rest_modulus(&rest, run.direct);
        viscosity += (time - then) * (before + modulus) / 2;
    }
    ck_assert_double_eq_tol(flow_stress(run.flow) / rate / viscosity, 1, 5e-3);
    rest_free(&rest);
    run_free(&run);
}
END_TEST

// ---- Species that are alike --------------------------------------------------------------------

static const Mixture LABELS = {2, 2, {1, 1}, {0.3, 0.7}};

// The same discs under two names.
static Direct *direct_of_labels(const Direct *discs, double cutoff) {
    Direct *direct = NULL;
    double *c = memory_new(3 * discs->count, sizeof *c);
    for (size_t i = 0; i < 3 * discs->count; i++)
        c[i] = direct_value(discs, 0, direct_wave_number(discs->spacing, i % discs->count));
    ck_assert_int_eq(direct_create(&direct, &LABELS, discs->density,
                                   3 * cutoff / (double)discs->count, c, discs->count),
                     OK);
    memory_free(c);
    return direct;
}

// F_ab = x_a delta_ab Phi^s + x_a x_b (F - Phi^s): correlators of labels are those of all discs and
// of a tagged one.
static double labels_error(const Run *all, const Run *labels) {
    double error = 0;
    for (size_t k = 0; k < all->plane->size; k++) {
        SmallMatrix f, one;
        if (!(all->plane->area[k] > 0)) continue;
        run_correlators(all, k, one);
        run_correlators(labels, k, f);
        const double tagged = transient_tagged(all->transient, 0)[k];
        for (size_t a = 0; a < 2; a++) {
            for (size_t b = 0; b < 2; b++) {
                const double xx = LABELS.fraction[a] * LABELS.fraction[b];
                const double expected =
                    (a == b ? LABELS.fraction[a] * tagged : 0) + xx * (one[0][0] - tagged);
                error = fmax(error, fabs(f[a][b] - expected));
            }
            error = fmax(error, fabs(transient_tagged(labels->transient, a)[k] - tagged));
        }
    }
    return error;
}

START_TEST(a_mixture_of_discs_that_are_alike_is_one_species) {
    const double cutoff = 12;
    Run all = run_new(direct_of_discs(0.69, cutoff), cutoff, 0.6, 1, 32, true);
    Run labels = run_new(direct_of_labels(all.direct, cutoff), cutoff, 0.6, 1, 32, true);
    for (double strain = 0.01; strain < 10; strain *= 5) {
        run_until(&all, strain);
        run_until(&labels, strain);
        ck_assert_double_lt(labels_error(&all, &labels), 5e-9);
        ck_assert_double_eq_tol(flow_stress(labels.flow), flow_stress(all.flow), 5e-9);
        ck_assert_double_eq_tol(flow_normal_difference(labels.flow),
                                flow_normal_difference(all.flow), 5e-9);
        for (int d = 0; d < TRANSIENT_DIRECTIONS; d++) {
            const double expected = transient_displacement(all.transient, 0, d);
            for (size_t s = 0; s < 2; s++)
                ck_assert_double_eq_tol(transient_displacement(labels.transient, s, d) / expected,
                                        1, 5e-9);
        }
        const double *three = flow_distortion(labels.flow), *one = flow_distortion(all.flow);
        const size_t size = all.plane->size;
        for (size_t k = 0; k < size; k++)
            ck_assert_double_eq_tol(three[k] + 2 * three[size + k] + three[2 * size + k], one[k],
                                    5e-9);
    }
    run_free(&all);
    run_free(&labels);
}
END_TEST

// ---- Under shear -------------------------------------------------------------------------------

// q_y -> -q_y and rate -> -rate: the stress changes its sign, the rest is mirrored.
START_TEST(shear_the_other_way_is_the_mirror_image) {
    static Direct *(*const direct_at[])(double, double) = {direct_of_discs, direct_of_binary};
    Run there = run_new(direct_at[_i](0.69, 12), 12, 0.6, 1, 32, true);
    Run back = run_new(direct_at[_i](0.69, 12), 12, 0.6, -1, 32, true);
    const size_t species = there.direct->mixture.species;
    run_until(&there, 0.5);
    run_until(&back, 0.5);
    const double *phi = transient_collective(there.transient);
    const double *mirror = transient_collective(back.transient);
    for (int i = 0; i <= there.plane->last; i++) {
        for (int j = -there.plane->half[i]; j <= there.plane->half[i]; j++) {
            for (size_t n = 0; n < species * species; n++) {
                const size_t entry = n * there.plane->size;
                ck_assert_double_eq_tol(phi[entry + plane_place(there.plane, i, j)],
                                        mirror[entry + plane_place(there.plane, i, -j)], 1e-7);
            }
        }
    }
    ck_assert_double_eq_tol(flow_stress(there.flow), -flow_stress(back.flow), 5e-9);
    ck_assert_double_eq_tol(flow_normal_difference(there.flow), flow_normal_difference(back.flow),
                            5e-9);
    for (size_t s = 0; s < species; s++) {
        for (int d = 0; d < 2; d++)
            ck_assert_double_eq_tol(transient_displacement(there.transient, s, d),
                                    transient_displacement(back.transient, s, d), 5e-9);
        ck_assert_double_eq_tol(transient_displacement(there.transient, s, 2),
                                transient_displacement(back.transient, s, 3), 5e-9);
    }
    run_free(&there);
    run_free(&back);
}
END_TEST

static double stress_with(size_t block) {
    Run run = run_new(direct_of_discs(0.69, 12), 12, 0.6, 1, block, false);
    run_until(&run, 8);
    const double stress = flow_stress(run.flow);
    run_free(&run);
    return stress;
}

START_TEST(in_time_it_is_of_second_order) {
    const double coarse = stress_with(64), middle = stress_with(128), fine = stress_with(256);
    ck_assert_double_eq_tol((coarse - middle) / (middle - fine), 4, 1);
    ck_assert_double_lt(fabs(fine / middle - 1), 1e-4);
}
END_TEST

// In the end dy^2 = 2 D_y t and dx^2 = (2/3) D_y rate^2 t^3 (Weysser, thesis, eqs 5.29-5.31).
START_TEST(displacements_along_the_flow_grow_with_the_third_power) {
    const double rate = 0.5;
    Run run = run_new(direct_of_discs(0.69, 15), 15, 0.6, rate, 64, true);
    run_until(&run, 4000 / rate);
    const double t = transient_time(run.transient);
    const double slow = transient_displacement(run.transient, 0, 1) / (2 * t);
    ck_assert(slow > 0 && slow < 0.5);
    ck_assert_double_eq_tol(transient_displacement(run.transient, 0, 0) /
                                (2.0 / 3 * slow * rate * rate * t * t * t),
                            1, 5e-3);
    run_free(&run);
}
END_TEST

// A glass yields: at low rates the stress no longer depends on the rate, and the correlators decay
// as functions of the strain.
START_TEST(a_glass_has_a_yield_stress_and_a_fluid_a_viscosity) {
    double stress[2][2];
    const double fractions[2] = {0.62, 0.70}, rates[2] = {1e-3, 1e-4};
    for (int f = 0; f < 2; f++) {
        for (int r = 0; r < 2; r++) {
            Run run = run_new(direct_of_discs(fractions[f], 24), 24, 0.6, rates[r], 32, false);
            run_until(&run, 6 / rates[r]);
            stress[f][r] = flow_stress(run.flow);
            run_free(&run);
        }
    }
    ck_assert_double_eq_tol(stress[0][0] / stress[0][1], 10, 0.05);
    ck_assert_double_eq_tol(stress[1][0] / stress[1][1], 1, 0.06);
}
END_TEST

// Discs of fundamental measure theory at 0.69754438, a hundredth above their transition, cutoff 30,
// spacing 0.3: an independent program found these numbers, on another grid of times.
START_TEST(an_independent_solution_is_met) {
    static const struct {
        double rate, stress, most, strain, normal;
    } cases[] = {{0.1, 2.1078, 3.5681, 0.288, 0.3878}, {0.001, 1.9849, 3.2960, 0.277, 0.3638}};
    for (size_t i = 0; i < 2; i++) {
        Run run = run_new(direct_of_discs(0.69754438, 30), 30, 0.3, cases[i].rate, 64, false);
        run_until(&run, 10 / cases[i].rate);
        ck_assert_double_eq_tol(flow_stress(run.flow), cases[i].stress, 2e-4);
        ck_assert_double_eq_tol(run.most, cases[i].most, 5e-4);
        ck_assert_double_eq_tol(run.strain_at_most, cases[i].strain, 0.009); // steps of the strain
        ck_assert_double_eq_tol(flow_normal_difference(run.flow), cases[i].normal, 2e-4);
        run_free(&run);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("itt");
    TCase *tests = tcase_create("mode-coupling theory under shear");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, a_table_has_its_function_and_its_slope);
    tcase_add_test(tests, advected_readings_are_exact_for_cubics);
    tcase_add_test(tests, kernels_are_double_sums_over_wave_vectors);
    tcase_add_loop_test(tests, frictions_of_displacements_are_sums_over_wave_vectors, 0, 2);
    tcase_add_test(tests, an_ideal_gas_is_exact);
    tcase_add_test(tests, a_dilute_distortion_solves_its_equation);
    tcase_add_test(tests, a_dilute_stress_is_an_integral);
    tcase_add_loop_test(tests, at_rest_it_is_the_isotropic_theory, 0, 2);
    tcase_add_test(tests, a_mixture_is_arrested_where_the_isotropic_theory_says);
    tcase_add_test(tests, slow_shear_has_the_viscosity_of_rest);
    tcase_add_test(tests, a_mixture_of_discs_that_are_alike_is_one_species);
    tcase_add_loop_test(tests, shear_the_other_way_is_the_mirror_image, 0, 2);
    tcase_add_test(tests, in_time_it_is_of_second_order);
    tcase_add_test(tests, displacements_along_the_flow_grow_with_the_third_power);
    tcase_add_test(tests, a_glass_has_a_yield_stress_and_a_fluid_a_viscosity);
    tcase_add_test(tests, an_independent_solution_is_met);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
