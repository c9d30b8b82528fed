// SPDX-License-Identifier: GPL-3.0-or-later
// Mode-coupling theory under shear: its kernels against plain double sums, its limits without
// memory and without shear, symmetry, order of accuracy, an independent solution.
#include "suite.h"

#include "itt/flow.h"
#include "itt/kernel.h"
#include "itt/transient.h"

#include "base/memory.h"
#include "mct/correlators.h"
#include "oz/oz.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

static const Mixture DISCS = {2, 1, {1}, {1}};
static const double PI = 3.14159265358979323846;

// ---- What the tests share ----------------------------------------------------------------------

// c(q) of fundamental measure theory, up to three times the cutoff.
static Direct *direct_of_discs(double packing_fraction, double cutoff) {
    enum { COUNT = 3000 };
    Oz *oz = NULL;
    Direct *direct = NULL;
    const Structure *structure = NULL;
    double q[COUNT];
    const double spacing = 3 * cutoff / COUNT;
    for (size_t i = 0; i < COUNT; i++) q[i] = direct_wave_number(spacing, i);
    ck_assert_int_eq(oz_create(&oz, CLOSURE_FUNDAMENTAL, &DISCS, q, COUNT), OK);
    ck_assert_int_eq(oz_solve(oz, packing_fraction, &structure), OK);
    ck_assert_int_eq(direct_create(&direct, structure->density, spacing, structure->direct, COUNT),
                     OK);
    oz_free(oz);
    return direct;
}

// c(q) = height exp(-q^2/2)
static Direct *direct_of_bell(double height) {
    enum { COUNT = 2000 };
    Direct *direct = NULL;
    double c[COUNT];
    for (size_t i = 0; i < COUNT; i++)
        c[i] = height * exp(-pow(direct_wave_number(0.02, i), 2) / 2);
    ck_assert_int_eq(direct_create(&direct, 1, 0.02, c, COUNT), OK);
    return direct;
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

static Run run_new(Direct *direct, double cutoff, double spacing, double rate, size_t block,
                   bool tagged) {
    Run run = {.plane = plane_of(cutoff, spacing), .direct = direct};
    const TransientSettings settings = {rate, block, tagged};
    ck_assert_msg(transient_create(&run.transient, run.plane, direct, &settings) == OK, "%s",
                  status_sentence());
    ck_assert_int_eq(flow_create(&run.flow, run.plane, direct, rate), OK);
    see(&run, transient_collective(run.transient), 0);
    return run;
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
        ck_assert_double_eq_tol(direct_value(direct, q), 2 * exp(-q * q / 2), 1e-8);
        ck_assert_double_eq_tol(direct_slope(direct, q), -2 * q * exp(-q * q / 2), 1e-6);
    }
    ck_assert_double_eq(direct_value(direct, 1e6), 0);
    ck_assert_double_eq(direct_slope(direct, 1e6), 0);
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
        plane_add_advected(plane, strain, field, one, sum);
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

// Some correlator that is even in q and nothing else.
static double some_phi(Vector q) {
    return exp(-0.02 * q.x * q.x - 0.03 * q.y * q.y + 0.025 * q.x * q.y) + 0.1 * sin(q.x * q.y);
}

static double *some_field(const Plane *plane) {
    double *phi = memory_new(plane->size, sizeof *phi);
    for (size_t k = 0; k < plane->size; k++) {
        if (plane->area[k] > 0) phi[k] = some_phi((Vector){plane->x[k], plane->y[k]});
    }
    return phi;
}

static bool inside(const Plane *plane, Vector q) {
    return hypot(q.x, q.y) < plane->cutoff * (1 + 1e-9);
}

static double c_of(const Direct *direct, Vector q) {
    return direct_value(direct, sqrt(dot(q, q)));
}

// q.(k c_k + p c_p), and for a tagged particle without the second term.
static double vertex(const Direct *direct, Vector q, Vector k, Vector p, bool tagged) {
    return dot(q, k) * c_of(direct, k) + (tagged ? 0 : dot(q, p) * c_of(direct, p));
}

static double memory_at(const Plane *plane, const Direct *direct, Vector q, double strain,
                        bool tagged) {
    const double h = plane->spacing;
    const Vector late = advect(q, strain);
    const double late_factor = tagged ? 2 : direct_factor(direct, sqrt(dot(late, late)));
    double sum = 0;
    for (int i = -plane->last; i <= plane->last; i++) {
        for (int j = -plane->last; j <= plane->last; j++) {
            const Vector k = {i * h, j * h}, p = {q.x - k.x, q.y - k.y};
            if (!inside(plane, k) || !inside(plane, p)) continue;
            const double partner = tagged ? 1 : direct_factor(direct, sqrt(dot(p, p)));
            sum += direct_factor(direct, sqrt(dot(k, k))) * some_phi(k) * partner * some_phi(p) *
                   vertex(direct, q, k, p, tagged) *
                   vertex(direct, late, advect(k, strain), advect(p, strain), tagged);
        }
    }
    return late_factor * direct->density / (2 * dot(q, q) * dot(late, late)) * sum *
           pow(h / (2 * PI), 2);
}

static void compare_with_double_sum(double strain, bool tagged) {
    Plane *plane = plane_of(9, 0.75);
    Direct *direct = direct_of_discs(0.6, 9);
    Kernel *kernel = NULL;
    double *phi = some_field(plane), *memory = memory_new(plane->size, sizeof *memory);
    ck_assert_int_eq(kernel_create(&kernel, plane, direct), OK);
    kernel_set_strain(kernel, strain);
    kernel_memory(kernel, phi, memory);
    if (tagged) kernel_tagged(kernel, phi, memory);
    for (size_t k = 0; k < plane->size; k += 7) {
        const Vector q = {plane->x[k], plane->y[k]};
        if (!(plane->area[k] > 0) || dot(q, q) == 0) continue;
        const double expected = memory_at(plane, direct, q, strain, tagged);
        ck_assert_double_eq_tol(memory[k], expected, 1e-11 * (1 + fabs(expected)));
    }
    memory_free(phi);
    memory_free(memory);
    kernel_free(kernel);
    direct_free(direct);
    plane_free(plane);
}

START_TEST(kernels_are_double_sums_over_wave_vectors) {
    for (double strain = 0; strain < 2; strain += 0.65) {
        compare_with_double_sum(strain, false);
        compare_with_double_sum(strain, true);
    }
    compare_with_double_sum(-0.3, false);
}
END_TEST

START_TEST(frictions_of_displacements_are_sums_over_wave_vectors) {
    const double strain = 0.4, h = 0.75;
    Plane *plane = plane_of(9, h);
    Direct *direct = direct_of_discs(0.6, 9);
    Kernel *kernel = NULL;
    double *phi = some_field(plane), friction[2][2], expected[2][2] = {{0}};
    ck_assert_int_eq(kernel_create(&kernel, plane, direct), OK);
    kernel_set_strain(kernel, strain);
    kernel_displacement(kernel, phi, phi, friction);
    for (int i = -plane->last; i <= plane->last; i++) {
        for (int j = -plane->last; j <= plane->last; j++) {
            const Vector k = {i * h, j * h}, late = advect(k, strain);
            if (!inside(plane, k)) continue;
            const double f = direct->density * pow(h / (2 * PI), 2) * c_of(direct, k) *
                             c_of(direct, late) * direct_factor(direct, sqrt(dot(k, k))) *
                             pow(some_phi(k), 2);
            expected[0][0] += f * k.x * late.x;
            expected[0][1] += f * k.x * late.y;
            expected[1][0] += f * k.y * late.x;
            expected[1][1] += f * k.y * late.y;
        }
    }
    for (int a = 0; a < 4; a++)
        ck_assert_double_eq_tol(friction[a / 2][a % 2], expected[a / 2][a % 2], 1e-11);
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

// An ideal gas: exp(-int q(t')^2 dt'), and of displacements (Weysser, thesis, eq. 5.37)
// dx^2 = 2 t (1 + (rate t)^2/3), dy^2 = 2 t.
START_TEST(an_ideal_gas_is_exact) {
    const double rate = 2, end = 1.5;
    Run run = run_new(direct_of_bell(0), 6, 0.5, rate, 256, true);
    double error = 0;
    while (transient_time(run.transient) < end) {
        run_until(&run, transient_time(run.transient) * 1.001 + 1e-9);
        const double t = transient_time(run.transient);
        for (size_t k = 0; k < run.plane->size; k++) {
            const Vector q = {run.plane->x[k], run.plane->y[k]};
            if (!(run.plane->area[k] > 0)) continue;
            const double exact = exp(-free_decay(q, rate, t));
            error = fmax(error, fabs(transient_collective(run.transient)[k] - exact));
            error = fmax(error, fabs(transient_tagged(run.transient)[k] - exact));
        }
        const double xx = 2 * t * (1 + rate * rate * t * t / 3), xy = -rate * t * t;
        const double diagonal = (xx + 2 * t) / 2;
        ck_assert_double_eq_tol(transient_displacement(run.transient, 0) / xx, 1, 1e-4);
        ck_assert_double_eq_tol(transient_displacement(run.transient, 1) / (2 * t), 1, 1e-9);
        ck_assert_double_eq_tol(transient_displacement(run.transient, 2) / (diagonal + xy), 1,
                                2e-4);
        ck_assert_double_eq_tol(transient_displacement(run.transient, 3) / (diagonal - xy), 1,
                                1e-4);
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

static Rest rest_new(double packing_fraction, double cutoff) {
    Rest rest;
    const CorrelatorSettings settings = {128, {1}, true};
    const size_t count = (size_t)(cutoff * 16 / PI);
    ck_assert_int_eq(grid_create(&rest.grid, 2, count, cutoff), OK);
    ck_assert_int_eq(
        oz_create(&rest.oz, CLOSURE_FUNDAMENTAL, &DISCS, rest.grid->wave_number, count), OK);
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

// One number of the isotropic solution, over the structure factor or not, by the cubic through the
// four nearest wave numbers.
static double rest_value(const Rest *rest, const double *values, const double *over, double q) {
    const double *wave = rest->grid->wave_number;
    double sum = 0;
    size_t m = 1;
    while (m + 3 < rest->grid->count && wave[m + 1] < q) m++;
    for (size_t i = m - 1; i < m + 3; i++) {
        double weight = over ? 1 / over[i] : 1;
        for (size_t j = m - 1; j < m + 3; j++)
            if (j != i) weight *= (q - wave[j]) / (wave[i] - wave[j]);
        sum += weight * values[i];
    }
    return sum;
}

// G = 1/(32 pi) int dq q^3 (S'/S)^2 Phi^2 with S' = rho S^2 c' (Weysser, thesis, eq. 5.14 at rest).
static double rest_modulus(const Rest *rest, const Direct *direct) {
    double sum = 0;
    const Grid *grid = rest->grid;
    const double *phi = correlators_collective(rest->correlators);
    for (size_t m = 0; m < grid->count; m++) {
        const double q = grid->wave_number[m];
        sum +=
            grid->k_weight[m] * q * q * pow(direct->density * direct_slope(direct, q) * phi[m], 2);
    }
    return sum / 16;
}

// What is compared at a time: modulus, displacement, correlators at some wave vectors.
enum { WAVES = 8, NUMBERS = 2 + 2 * WAVES };

static double compared_wave(size_t i) {
    return 3 + 2.4 * (double)i;
}

static void rest_numbers(const Rest *rest, const Direct *direct, double out[NUMBERS]) {
    out[0] = rest_modulus(rest, direct);
    out[1] = correlators_displacement(rest->correlators)[0] / 2;
    for (size_t i = 0; i < WAVES; i++) {
        out[2 + i] = rest_value(rest, correlators_collective(rest->correlators),
                                rest->structure->factor, compared_wave(i));
        out[2 + WAVES + i] =
            rest_value(rest, correlators_self(rest->correlators), NULL, compared_wave(i));
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

static void compare_at_rest(const Run *run, const double expected[NUMBERS]) {
    const double *phi = transient_collective(run->transient);
    ck_assert_double_eq_tol(flow_modulus(run->flow), expected[0], 1e-2 * expected[0] + 1e-2);
    ck_assert_double_eq_tol(transient_displacement(run->transient, 0) / expected[1], 1, 5e-3);
    ck_assert_double_eq_tol(transient_displacement(run->transient, 1),
                            transient_displacement(run->transient, 0), 1e-9);
    for (size_t i = 0; i < WAVES; i++) {
        const int place = (int)rint(compared_wave(i) / run->plane->spacing);
        const size_t x = plane_place(run->plane, place, 0), y = plane_place(run->plane, 0, place);
        ck_assert_double_eq_tol(phi[x], expected[2 + i], 2e-3);
        ck_assert_double_eq_tol(phi[y], phi[x], 1e-9);
        ck_assert_double_eq_tol(transient_tagged(run->transient)[x], expected[2 + WAVES + i], 2e-3);
    }
}

// The solver on the plane at rest and the isotropic one have nothing in common but the equations.
START_TEST(at_rest_it_is_the_isotropic_theory) {
    const double packing_fraction = 0.64, cutoff = 24;
    Run run = run_new(direct_of_discs(packing_fraction, cutoff), cutoff, 0.3, 0, 64, true);
    Rest rest = rest_new(packing_fraction, cutoff);
    for (double t = 1e-3; t < 2e2; t *= 10) {
        double expected[NUMBERS];
        run_until(&run, t);
        rest_at(&rest, run.direct, transient_time(run.transient), expected);
        compare_at_rest(&run, expected);
    }
    ck_assert_double_eq(flow_stress(run.flow), 0);
    rest_free(&rest);
    run_free(&run);
}
END_TEST

// ---- Under shear -------------------------------------------------------------------------------

// q_y -> -q_y and rate -> -rate: the stress changes its sign, the rest is mirrored.
START_TEST(shear_the_other_way_is_the_mirror_image) {
    Run there = run_new(direct_of_discs(0.69, 12), 12, 0.6, 1, 32, true);
    Run back = run_new(direct_of_discs(0.69, 12), 12, 0.6, -1, 32, true);
    run_until(&there, 0.5);
    run_until(&back, 0.5);
    const double *phi = transient_collective(there.transient);
    const double *mirror = transient_collective(back.transient);
    for (int i = 0; i <= there.plane->last; i++) {
        for (int j = -there.plane->half[i]; j <= there.plane->half[i]; j++)
            ck_assert_double_eq_tol(phi[plane_place(there.plane, i, j)],
                                    mirror[plane_place(there.plane, i, -j)], 1e-7);
    }
    ck_assert_double_eq_tol(flow_stress(there.flow), -flow_stress(back.flow), 1e-6);
    ck_assert_double_eq_tol(flow_normal_difference(there.flow), flow_normal_difference(back.flow),
                            1e-6);
    for (int d = 0; d < 2; d++)
        ck_assert_double_eq_tol(transient_displacement(there.transient, d),
                                transient_displacement(back.transient, d), 1e-6);
    ck_assert_double_eq_tol(transient_displacement(there.transient, 2),
                            transient_displacement(back.transient, 3), 1e-6);
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
    const double slow = transient_displacement(run.transient, 1) / (2 * t);
    ck_assert(slow > 0 && slow < 0.5);
    ck_assert_double_eq_tol(transient_displacement(run.transient, 0) /
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
    tcase_add_test(tests, frictions_of_displacements_are_sums_over_wave_vectors);
    tcase_add_test(tests, an_ideal_gas_is_exact);
    tcase_add_test(tests, a_dilute_distortion_solves_its_equation);
    tcase_add_test(tests, a_dilute_stress_is_an_integral);
    tcase_add_test(tests, at_rest_it_is_the_isotropic_theory);
    tcase_add_test(tests, shear_the_other_way_is_the_mirror_image);
    tcase_add_test(tests, in_time_it_is_of_second_order);
    tcase_add_test(tests, displacements_along_the_flow_grow_with_the_third_power);
    tcase_add_test(tests, a_glass_has_a_yield_stress_and_a_fluid_a_viscosity);
    tcase_add_test(tests, an_independent_solution_is_met);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
