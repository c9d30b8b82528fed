// SPDX-License-Identifier: GPL-3.0-or-later
// Mode-coupling theory: the kernel against the direct integral over wave vectors, its derivative
// and adjoint, and glass transitions against values computed with another program.
#include "suite.h"

#include "mct/critical.h"
#include "mct/glass.h"
#include "mct/lines.h"

#include "base/cpu.h"
#include "base/memory.h"
#include "numerics/quadrature.h"

#include <check.h>
#include <math.h>
#include <string.h>

// Smooth stand-ins for c_ab(q) and Phi_ab(q), which the kernel takes as they come.
static double direct_like(size_t pair, double q) {
    static const double strength[] = {-3, -4, -5.5}, width[] = {9, 7, 6};
    return strength[pair] * exp(-q * q / (width[pair] * width[pair]));
}

static double correlator_like(size_t pair, double q) {
    static const double strength[] = {0.6, -0.2, 0.5}, width[] = {8, 6, 7};
    return strength[pair] * (1 + 0.3 * q * q / 10) * exp(-q * q / (width[pair] * width[pair]));
}

typedef struct Fixture {
    Mixture mixture;
    Grid *grid;
    Model *model;
    double *phi, *h, *g, *out, *back;
} Fixture;

static Fixture fixture_new(int dimension, size_t species) {
    Fixture f = {.mixture = {dimension, species, {1, 1.4}, {species == 1 ? 1 : 0.4, 0.6}}};
    ck_assert_int_eq(grid_create(&f.grid, dimension, 200, 40), OK);
    Structure s = {.mixture = f.mixture, .density = 0.8, .count = f.grid->count};
    const size_t pairs = mixture_pairs(&f.mixture);
    ck_assert_int_eq(NEW_ARRAY(s.direct, pairs * s.count), OK);
    ck_assert_int_eq(NEW_ARRAY(s.factor, pairs * s.count), OK);
    for (size_t i = 0; i < pairs * s.count; i++)
        s.direct[i] = direct_like(i / s.count, f.grid->wave_number[i % s.count]);
    ck_assert_int_eq(model_create(&f.model, f.grid, &s), OK);
    memory_free(s.direct);
    memory_free(s.factor);
    double **const fields[] = {&f.phi, &f.h, &f.g, &f.out, &f.back};
    for (size_t i = 0; i < 5; i++) ck_assert_int_eq(NEW_ARRAY(*fields[i], f.model->size), OK);
    for (size_t pair = 0; pair < pairs; pair++) {
        for (size_t m = 0; m < f.grid->count; m++) {
            const size_t i = pair * f.grid->stride + m;
            const double q = f.grid->wave_number[m];
            f.phi[i] = correlator_like(pair, q);
            f.h[i] = (1.5 + sin(3.0 * (double)(i % 97))) * exp(-q * q / 200);
            f.g[i] = (1.5 + cos(2.0 * (double)(i % 89))) * exp(-q * q / 300);
        }
    }
    return f;
}

static void fixture_free(Fixture *f) {
    double *const fields[] = {f->phi, f->h, f->g, f->out, f->back};
    for (size_t i = 0; i < 5; i++) memory_free(fields[i]);
    model_free(f->model);
    grid_free(f->grid);
}

static size_t pair_of(const Fixture *f, size_t a, size_t b) {
    return mixture_pair(f->mixture.species, a, b);
}

// The vertex of species a with a', a'' (Weysser, thesis, eq. 3.5): q.k c_k^{aa'} delta_{aa''} + q.p
// c_p^{aa''} delta_{aa'}.
static double vertex(const Fixture *f, size_t a, size_t first, size_t second, const double dot[2],
                     double k, double p) {
    double sum = 0;
    if (second == a) sum += dot[0] * direct_like(pair_of(f, a, first), k);
    if (first == a) sum += dot[1] * direct_like(pair_of(f, a, second), p);
    return sum;
}

// The second vertex may have its wave numbers stretched, as the isotropically sheared model has it.
static double species_sum(const Fixture *f, size_t a, size_t b, const double dot[2], double k,
                          double p, double stretch) {
    const size_t species = f->mixture.species;
    double sum = 0;
    for (size_t i = 0; i < species * species * species * species; i++) {
        const size_t a1 = i % species, a2 = i / species % species;
        const size_t b1 = i / species / species % species, b2 = i / species / species / species;
        sum += vertex(f, a, a1, a2, dot, k, p) *
               vertex(f, b, b1, b2, dot, stretch * k, stretch * p) *
               correlator_like(pair_of(f, a1, b1), k) * correlator_like(pair_of(f, a2, b2), p);
    }
    return sum;
}

// M_ab(q) = rho/(2 x_a x_b q^4) int d^dk/(2 pi)^d vertices Phi_k Phi_p, p = q - k, in polar
// coordinates: the slow twin.
static double direct_integral(const Fixture *f, size_t a, size_t b, double q, double stretch) {
    enum { K = 256, ANGLES = 128 };
    const int d = f->mixture.dimension;
    double k[K], k_weight[K], angle[ANGLES], angle_weight[ANGLES], sum = 0;
    quadrature_legendre(K, 0, 40, k, k_weight);
    quadrature_legendre(ANGLES, 0, M_PI, angle, angle_weight);
    for (size_t i = 0; i < K; i++) {
        for (size_t j = 0; j < ANGLES; j++) {
            const double qk = q * k[i] * cos(angle[j]);
            const double dot[2] = {qk, q * q - qk};
            const double p = sqrt(q * q + k[i] * k[i] - 2 * qk);
            const double shell = d == 2 ? 2 * k[i] : 2 * M_PI * sin(angle[j]) * k[i] * k[i];
            sum +=
                k_weight[i] * angle_weight[j] * shell * species_sum(f, a, b, dot, k[i], p, stretch);
        }
    }
    const double *x = f->mixture.fraction;
    return 0.8 / (2 * x[a] * x[b] * pow(q, 4)) * sum / pow(2 * M_PI, d);
}

START_TEST(the_kernel_is_the_direct_double_integral) {
    static const size_t at[] = {0, 3, 20, 35};
    for (int which = 0; which < 4; which++) {
        Fixture f = fixture_new(2 + which % 2, 1 + (size_t)which / 2);
        model_memory(f.model, f.phi, f.out);
        for (size_t i = 0; i < 4; i++) {
            for (size_t a = 0; a < f.mixture.species; a++) {
                for (size_t b = a; b < f.mixture.species; b++) {
                    const double direct = direct_integral(&f, a, b, f.grid->wave_number[at[i]], 1);
                    const double kernel = f.out[pair_of(&f, a, b) * f.grid->stride + at[i]];
                    ck_assert_double_eq_tol(kernel, direct, 1e-9 * fabs(f.out[0]));
                    ck_assert_double_eq_tol(kernel, direct, 1e-6 * fabs(direct));
                }
            }
        }
        fixture_free(&f);
    }
}
END_TEST

START_TEST(the_kernel_with_a_stretched_vertex_is_the_direct_double_integral) {
    static const size_t at[] = {0, 3, 20, 35};
    for (int dimension = 2; dimension <= 3; dimension++) {
        Fixture f = fixture_new(dimension, 1);
        for (size_t m = 0; m < f.grid->count; m++)
            f.g[m] = direct_like(0, 1.3 * f.grid->wave_number[m]);
        f.model->stretched = f.g;
        model_memory(f.model, f.phi, f.out);
        for (size_t i = 0; i < 4; i++) {
            const double direct = direct_integral(&f, 0, 0, f.grid->wave_number[at[i]], 1.3);
            ck_assert_double_eq_tol(f.out[at[i]], direct, 1e-9 * fabs(f.out[0]));
        }
        fixture_free(&f);
    }
}
END_TEST

// What the coefficient of shear takes of it: c of both vertices at the mean of c and c', less M at
// half their difference, is the kernel with one vertex stretched, symmetric in the species.
START_TEST(a_stretched_vertex_of_a_mixture_is_the_mean_of_both) {
    static const size_t at[] = {0, 3, 20, 35};
    static const double STRETCH = 1.3;
    for (int dimension = 2; dimension <= 3; dimension++) {
        Fixture f = fixture_new(dimension, 2);
        for (int half = 0; half < 2; half++) {
            for (size_t i = 0; i < f.model->pairs * f.grid->count; i++) {
                const size_t pair = i / f.grid->count, m = i % f.grid->count;
                const double q = f.grid->wave_number[m];
                f.model->direct[pair * f.grid->stride + m] =
                    (direct_like(pair, STRETCH * q) + (half ? -1 : 1) * direct_like(pair, q)) / 2;
            }
            model_memory(f.model, f.phi, half ? f.back : f.out);
        }
        for (size_t i = 0; i < 4; i++) {
            for (size_t pair = 0; pair < 3; pair++) {
                const size_t a = pair / 2, b = (pair + 1) / 2, n = pair * f.grid->stride + at[i];
                const double q = f.grid->wave_number[at[i]];
                const double direct = (direct_integral(&f, a, b, q, STRETCH) +
                                       direct_integral(&f, b, a, q, STRETCH)) /
                                      2;
                ck_assert_double_eq_tol(f.out[n] - f.back[n], direct, 1e-9 * fabs(f.out[0]));
            }
        }
        fixture_free(&f);
    }
}
END_TEST

START_TEST(slope_is_the_derivative_and_adjoint_its_transpose) {
    static const double STEP = 1e-4;
    for (int which = 0; which < 4; which++) {
        Fixture f = fixture_new(2 + which % 2, 1 + (size_t)which / 2);
        Radial radial;
        ck_assert_int_eq(radial_create(&radial, f.model), OK);
        model_transform(f.model, f.phi, &radial);
        model_slope(f.model, &radial, f.h, f.out);
        model_adjoint(f.model, &radial, f.g, f.back);
        const double there = model_product(f.model, f.g, f.out);
        ck_assert_double_eq_tol(model_product(f.model, f.back, f.h), there, 1e-11 * fabs(there));
        double *above = f.back, *below = f.g, largest = 0;
        for (size_t i = 0; i < f.model->size; i++) {
            largest = fmax(largest, fabs(f.out[i]));
            f.phi[i] += STEP * f.h[i];
        }
        model_memory(f.model, f.phi, above);
        for (size_t i = 0; i < f.model->size; i++) f.phi[i] -= 2 * STEP * f.h[i];
        model_memory(f.model, f.phi, below);
        for (size_t i = 0; i < f.model->size; i++)
            ck_assert_double_eq_tol((above[i] - below[i]) / (2 * STEP), f.out[i], 1e-8 * largest);
        radial_free(&radial);
        fixture_free(&f);
    }
}
END_TEST

// The inner loops give the same bits on every instruction set that this processor has.
START_TEST(instruction_sets_agree_to_the_bit) {
    enum { STRIDE = 104, LINES = 9 };
    static const Lines *const paths[CPU_PATHS] = {&lines_portable, &lines_avx2, &lines_avx512};
    double *a = memory_new(STRIDE * LINES, sizeof *a), *sums[2];
    ck_assert_ptr_nonnull(a);
    for (size_t i = 0; i < STRIDE * LINES; i++) a[i] = sin(1.7 * (double)i) / (1 + (double)(i % 7));
    for (int k = 0; k < 2; k++) ck_assert_int_eq(NEW_ARRAY(sums[k], STRIDE), OK);
    for (int path = 1; path <= (int)cpu_path(); path++) {
        const double *const j[3] = {a, a + STRIDE, a + 2 * STRIDE};
        double dots[2][5];
        for (int k = 0; k < 2; k++) {
            const Lines *with = paths[k * path];
            dots[k][4] = with->dot(a, a + 3 * STRIDE, STRIDE);
            with->dots(j, a + 4 * STRIDE, a + 5 * STRIDE, a + 6 * STRIDE, STRIDE, dots[k]);
            memset(sums[k], 0, STRIDE * sizeof(double));
            with->add(sums[k], 0.3, a, -0.7, a + STRIDE, STRIDE);
            with->history(sums[k], STRIDE, 7, a, STRIDE, a + 8 * STRIDE, a + 7 * STRIDE, -STRIDE);
        }
        ck_assert_mem_eq(dots[0], dots[1], sizeof dots[0]);
        ck_assert_mem_eq(sums[0], sums[1], STRIDE * sizeof(double));
    }
    memory_free(a);
    for (int k = 0; k < 2; k++) memory_free(sums[k]);
}
END_TEST

// The curvature is the coefficient that the extrapolation knows least well: how well depends on how
// far from a parabola phi(s) is.
static CriticalPoint *found(const CriticalSearch *search, double curvature_error) {
    CriticalPoint *point = NULL;
    ck_assert_msg(critical_find(&point, search) == OK, "%s", status_sentence());
    ck_assert_double_eq_tol(point->curvature / point->expected_curvature, 1, curvature_error);
    return point;
}

// Another program of ours, spectral as well: Percus-Yevick spheres, cutoff 60, phi_c to 1e-7.
START_TEST(spheres_freeze_where_another_program_says) {
    const Mixture spheres = {3, 1, {1}, {1}};
    CriticalPoint *point =
        found(&(CriticalSearch){spheres, CLOSURE_PERCUS_YEVICK, 306, 60, 0.45, 0.6}, 5e-4);
    ck_assert_double_eq_tol(point->packing_fraction, 0.5158142, 1e-7);
    // Of the literature, on coarser grids: 0.735, 0.312, 0.583, 2.46 (Franosch et al. 1997).
    ck_assert_double_eq_tol(point->exponents.lambda, 0.735, 2e-3);
    ck_assert_double_eq_tol(point->exponents.a, 0.312, 1e-3);
    ck_assert_double_eq_tol(point->exponents.b, 0.583, 4e-3);
    ck_assert_double_eq_tol(point->exponents.gamma, 2.46, 0.02);
    const double percus_yevick = point->packing_fraction;
    critical_free(point);
    // Verlet and Weis rescale the packing fraction: f - f^2/16 is that of Percus-Yevick.
    point = found(&(CriticalSearch){spheres, CLOSURE_VERLET_WEIS, 306, 60, 0.45, 0.6}, 5e-4);
    ck_assert_double_eq_tol(point->packing_fraction, 8 * (1 - sqrt(1 - percus_yevick / 4)), 1e-6);
    critical_free(point);
}
END_TEST

// The grid of the literature: q_i = (i + offset) spacing, double integrals as plain sums over all
// triangles of wave numbers (Bengtzelius 1986; in two dimensions Bayer et al. 2007, where an offset
// of 0.303 takes the leading error of the edges away). Only S(q) is shared with what is tested.
enum { TRIANGLES_MOST = 300 };
typedef struct Triangles {
    int dimension;
    size_t count;
    double offset, spacing, density;
    double q[TRIANGLES_MOST], direct[TRIANGLES_MOST], factor[TRIANGLES_MOST], form[TRIANGLES_MOST];
    double *weight;
} Triangles;

// What a triangle's two form factors are multiplied by, triangle after triangle.
static void triangles_weigh(Triangles *t) {
    double *weight = t->weight;
    for (size_t i = 0; i < t->count; i++) {
        const double q = t->q[i];
        const double scale = t->density * pow(t->spacing, 2) / (8 * M_PI * M_PI * pow(q, 4));
        for (size_t j = 0; j < t->count; j++) {
            for (size_t l = i > j ? i - j : j - i; l <= i + j && l < t->count; l++) {
                const double k = t->q[j], p = t->q[l], qk = q * q + k * k - p * p;
                const double vertex = qk * t->direct[j] + (q * q - k * k + p * p) * t->direct[l];
                const double edge = t->dimension == 2 ? sqrt(4 * q * q * k * k - qk * qk) : 4 * q;
                *weight++ = scale * k * p * vertex * vertex / edge;
            }
        }
    }
}

static void triangles_sum(const Triangles *t, double *memory) {
    const double *weight = t->weight;
    for (size_t i = 0; i < t->count; i++) {
        memory[i] = 0;
        for (size_t j = 0; j < t->count; j++) {
            double sum = 0;
            for (size_t l = i > j ? i - j : j - i; l <= i + j && l < t->count; l++)
                sum += *weight++ * t->form[l];
            memory[i] += sum * t->form[j];
        }
    }
}

// Whether form factors are left when they no longer change.
static bool triangles_freeze(Triangles *t, double packing_fraction) {
    const Mixture one = {t->dimension, 1, {1}, {1}};
    const Structure *s = NULL;
    Oz *oz = NULL;
    for (size_t i = 0; i < t->count; i++) t->q[i] = ((double)i + t->offset) * t->spacing;
    ck_assert_int_eq(oz_create(&oz, CLOSURE_PERCUS_YEVICK, &one, t->q, t->count), OK);
    ck_assert_msg(oz_solve(oz, packing_fraction, &s) == OK, "%s", status_sentence());
    t->density = s->density;
    memcpy(t->direct, s->direct, t->count * sizeof *t->direct);
    memcpy(t->factor, s->factor, t->count * sizeof *t->factor);
    memcpy(t->form, s->factor, t->count * sizeof *t->form);
    oz_free(oz);
    ck_assert_int_eq(NEW_ARRAY(t->weight, t->count * t->count * t->count), OK);
    triangles_weigh(t);
    double change = 1, most = 1, next[TRIANGLES_MOST], memory[TRIANGLES_MOST];
    while (change > 1e-9 && most > 0.1) {
        change = most = 0;
        triangles_sum(t, memory);
        for (size_t i = 0; i < t->count; i++) {
            next[i] = t->factor[i] - 1 / (1 / t->factor[i] + memory[i]);
            change = fmax(change, fabs(next[i] - t->form[i]) / t->factor[i]);
            most = fmax(most, next[i] / t->factor[i]);
        }
        memcpy(t->form, next, t->count * sizeof *next);
    }
    memory_free(t->weight);
    return most > 0.1;
}

// Values that another program found on this grid; the limit of a fine one is our own at the same
// cutoff, nearer than the grid's error.
START_TEST(the_grid_of_the_literature_has_its_own_transition) {
    static const struct {
        int dimension;
        size_t count;
        double offset, phi, error, low, high;
    } known[] = {{3, 100, 0.5, 0.515912, 1.1e-4, 0.45, 0.6},
                 {2, 100, 0.303, 0.692658, 1.5e-3, 0.6, 0.74},
                 {2, 300, 0.303, 0.691430, 1.5e-4, 0.6, 0.74}};
    for (int i = 0; i < 3; i++) {
        Triangles t = {.dimension = known[i].dimension,
                       .count = known[i].count,
                       .offset = known[i].offset,
                       .spacing = 40.0 / (double)known[i].count};
        ck_assert(!triangles_freeze(&t, known[i].phi - 4e-6));
        ck_assert(triangles_freeze(&t, known[i].phi + 4e-6));
        const Mixture one = {t.dimension, 1, {1}, {1}};
        CriticalPoint *point = found(
            &(CriticalSearch){one, CLOSURE_PERCUS_YEVICK, 204, 40, known[i].low, known[i].high},
            5e-4);
        ck_assert(point->packing_fraction < known[i].phi - known[i].error / 2);
        ck_assert(point->packing_fraction > known[i].phi - known[i].error);
        critical_free(point);
    }
}
END_TEST

// Discs 5/7 and 1/3: the other program, transforms, cutoff and count as given (lengths in the
// larger diameter). Of the last mixture, whose lambda changes most with the distance from the
// transition, the two extrapolations agree to 1.5e-5 of lambda.
START_TEST(binary_discs_freeze_where_another_program_says) {
    static const struct {
        double ratio, small, phi, lambda, a, b, gamma, error, last;
        size_t count;
    } known[] = {{5.0 / 7, 0.5, 0.685874, 0.71866, 0.31897, 0.60981, 2.38745, 1e-5, 59.84, 305},
                 {5.0 / 7, 0.2, 0.688301, 0.70649, 0.32422, 0.62996, 2.33585, 1e-5, 59.84, 305},
                 {1.0 / 3, 0.5, 0.693955, 0.75236, 0.30352, 0.55433, 2.54930, 1e-5, 119.9, 611},
                 {1.0 / 3, 0.87, 0.706447, 0.81584, 0.26977, 0.44957, 2.96560, 2e-5, 119.9, 611}};
    for (int i = 0; i < 4; i++) {
        const Mixture mixture = {2, 2, {known[i].ratio, 1}, {known[i].small, 1 - known[i].small}};
        CriticalPoint *point = found(&(CriticalSearch){mixture, CLOSURE_PERCUS_YEVICK,
                                                       known[i].count, known[i].last, 0.6, 0.74},
                                     5e-4);
        ck_assert_double_eq_tol(point->packing_fraction, known[i].phi, 1e-6);
        ck_assert_double_eq_tol(point->exponents.lambda, known[i].lambda, known[i].error);
        ck_assert_double_eq_tol(point->exponents.a, known[i].a, known[i].error);
        ck_assert_double_eq_tol(point->exponents.b, known[i].b, 2 * known[i].error);
        ck_assert_double_eq_tol(point->exponents.gamma, known[i].gamma, 10 * known[i].error);
        critical_free(point);
    }
}
END_TEST

// Equal discs: the other program's exponents hardly depend on its grid, 0.69530 at 100 and 0.69532
// at 300 wave numbers up to 40.
START_TEST(equal_discs_have_the_exponents_of_another_program) {
    const Mixture discs = {2, 1, {1}, {1}};
    CriticalPoint *point =
        found(&(CriticalSearch){discs, CLOSURE_PERCUS_YEVICK, 204, 40, 0.6, 0.74}, 5e-4);
    ck_assert_double_eq_tol(point->exponents.lambda, 0.69532, 1e-4);
    ck_assert_double_eq_tol(point->exponents.a, 0.32890, 1e-4);
    ck_assert_double_eq_tol(point->exponents.b, 0.64853, 2e-4);
    ck_assert_double_eq_tol(point->exponents.gamma, 2.29117, 1e-3);
    critical_free(point);
}
END_TEST

// Another program's phi_c of equal discs with other closures, cutoff 60: it solves them on coarser
// grids, to a few 1e-4.
START_TEST(closures_freeze_where_another_program_says) {
    static const struct {
        Closure closure;
        double phi;
    } known[] = {{CLOSURE_HYPERNETTED_CHAIN, 0.6809}, {CLOSURE_MODIFIED_VERLET, 0.6959}};
    const Mixture discs = {2, 1, {1}, {1}};
    for (int i = 0; i < 2; i++) {
        CriticalPoint *point =
            found(&(CriticalSearch){discs, known[i].closure, 305, 60, 0.6, 0.72}, 2e-3);
        ck_assert_double_eq_tol(point->packing_fraction, known[i].phi, 5e-4);
        critical_free(point);
    }
}
END_TEST

// phi_c from finer grids approaches its limit faster than any power of the range.
START_TEST(the_transition_converges_in_the_grid) {
    static const struct {
        Mixture mixture;
        Closure closure;
        double low, high, limit, error, first, second;
    } known[] = {
        {{2, 1, {1}, {1}}, CLOSURE_FUNDAMENTAL, 0.6, 0.74, 0.6906, 5e-5, 1.5e-3, 1e-4},
        {{3, 1, {1}, {1}}, CLOSURE_PERCUS_YEVICK, 0.45, 0.6, 0.515814, 1.5e-5, 2e-4, 5e-6},
    };
    for (int k = 0; k < 2; k++) {
        double phi[3];
        for (size_t i = 0; i < 3; i++) {
            const size_t count = 102 + 51 * i; // range 8, 12, 16 at cutoff 40
            CriticalPoint *point = found(&(CriticalSearch){known[k].mixture, known[k].closure,
                                                           count, 40, known[k].low, known[k].high},
                                         5e-4);
            phi[i] = point->packing_fraction;
            critical_free(point);
        }
        ck_assert_double_eq_tol(phi[2], known[k].limit, known[k].error); // the other program
        ck_assert(fabs(phi[0] - phi[2]) < known[k].first);
        ck_assert(fabs(phi[1] - phi[2]) < known[k].second);
        ck_assert(fabs(phi[1] - phi[2]) < 0.2 * fabs(phi[0] - phi[2]));
    }
}
END_TEST

START_TEST(a_bracket_that_holds_no_transition_is_refused) {
    const Mixture spheres = {3, 1, {1}, {1}};
    CriticalPoint *point = NULL;
    CriticalSearch search = {spheres, CLOSURE_PERCUS_YEVICK, 60, 30, 0.3, 0.45};
    ck_assert_int_eq(critical_find(&point, &search), BAD_DATA);
    search.low = 0.55;
    search.high = 0.58;
    ck_assert_int_eq(critical_find(&point, &search), BAD_DATA);
    ck_assert_ptr_null(point);
    // Along another number the sentence says what is at both ends.
    search = (CriticalSearch){.mixture = {3, 2, {0.8, 1}, {0.5, 0.5}},
                              .closure = CLOSURE_PERCUS_YEVICK,
                              .count = 60,
                              .last = 30,
                              .axis = MIXTURE_FRACTION,
                              .packing_fraction = 0.48,
                              .low = 0.2,
                              .high = 0.6,
                              .name = "theory.species.small.fraction"};
    ck_assert_int_eq(critical_find(&point, &search), BAD_DATA);
    ck_assert_ptr_nonnull(
        strstr(status_sentence(), "theory.species.small.fraction from 0.2 to 0.6"));
    ck_assert_ptr_nonnull(strstr(status_sentence(), "a fluid"));
    search.packing_fraction = 0.56;
    ck_assert_int_eq(critical_find(&point, &search), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "a glass"));
}
END_TEST

// Two species that are alike are one: all that is known of the transition, shear among it.
START_TEST(a_mixture_of_equals_is_one_species) {
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double low = dimension == 2 ? 0.6 : 0.45, high = dimension == 2 ? 0.74 : 0.57;
        CriticalPoint *one = found(
            &(CriticalSearch){{dimension, 1, {1}, {1}}, CLOSURE_PERCUS_YEVICK, 102, 40, low, high},
            1e-3);
        CriticalPoint *two = found(
            &(CriticalSearch){
                {dimension, 2, {1, 1}, {0.3, 0.7}}, CLOSURE_PERCUS_YEVICK, 102, 40, low, high},
            1e-3);
        ck_assert_double_eq_tol(two->packing_fraction, one->packing_fraction, 1e-7);
        ck_assert_double_eq_tol(two->exponents.lambda, one->exponents.lambda, 1e-5);
        ck_assert_double_eq_tol(two->slope, one->slope, 1e-4);
        ck_assert_double_eq_tol(two->shear, one->shear, 1e-5);
        critical_free(one);
        critical_free(two);
    }
}
END_TEST

// A point of the line phi_c(fraction, size ratio) is the same whichever way it is crossed: along
// the packing fraction to phi_c, then at phi_c along composition and size. Slopes along the line
// belong together: dsigma = C_x dx/x + C_phi dphi/phi = 0. Here sigma hardly changes with x, so
// that states with the same s lie up to a tenth of x apart, where x is less of a parabola in s.
START_TEST(the_transition_is_found_along_any_number) {
    static const struct {
        MixtureAxis axis;
        double value, low, high;
    } lines[] = {{MIXTURE_FRACTION, 0.5, 0.2, 0.7}, {MIXTURE_DIAMETER, 1.0 / 3, 0.28, 0.5}};
    const Mixture mixture = {2, 2, {1.0 / 3, 1}, {0.5, 0.5}};
    CriticalSearch search = {mixture, CLOSURE_PERCUS_YEVICK, 153, 60, 0.6, 0.74};
    CriticalPoint *point = found(&search, 2e-3);
    for (int i = 0; i < 2; i++) {
        CriticalSearch along = search;
        along.axis = lines[i].axis;
        along.species = 0;
        along.packing_fraction = point->packing_fraction;
        along.low = lines[i].low;
        along.high = lines[i].high;
        CriticalPoint *other = found(&along, 0.03);
        ck_assert_double_eq_tol(other->value, lines[i].value, 1e-5);
        ck_assert_double_eq_tol(other->packing_fraction, point->packing_fraction, 1e-12);
        ck_assert_double_eq_tol(other->exponents.lambda, point->exponents.lambda, 2e-4);
        ck_assert_double_eq_tol(other->shear, point->shear, 2e-3 * point->shear);
        // A step along the line, either way.
        static const double STEP = 1e-3;
        double phi[2];
        for (int up = 0; up < 2; up++) {
            CriticalSearch beside = search;
            mixture_on(&(MixtureLine){along.axis, 0, mixture, 0},
                       lines[i].value * (1 + (up ? STEP : -STEP)), &beside.mixture, &phi[up]);
            CriticalPoint *next = found(&beside, 2e-3);
            phi[up] = next->packing_fraction;
            critical_free(next);
        }
        const double rise = (phi[1] - phi[0]) / (2 * STEP * point->packing_fraction);
        // What composition does to sigma nearly cancels: errors are those of the parts.
        ck_assert_double_eq_tol(other->slope, -point->slope * rise, 5e-4 * point->slope);
        critical_free(other);
    }
    critical_free(point);
}
END_TEST

// A table of the literature (Goetze 1984 and later): lambda, a, b, gamma (Weysser, thesis,
// eq. 3.19). The last is that of the thesis' gamma, 2.4969, to its four digits.
START_TEST(exponents_follow_from_lambda) {
    static const struct {
        double lambda, a, b, gamma, error;
    } known[] = {{0.7, 0.3269591, 0.640741, 2.3095898, 1e-6},
                 {0.707106781, 0.323962, 0.628938, 2.338380, 3e-6},
                 {0.735, 0.3116601, 0.5828671, 2.4621406, 1e-6},
                 {0.74, 0.309357, 0.574639, 2.486366, 3e-6},
                 {0.74213, 0.30837, 0.57114, 2.4969, 3e-5}};
    Exponents e;
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(exponents_of(known[i].lambda, &e), OK);
        ck_assert_double_eq_tol(e.a, known[i].a, known[i].error);
        ck_assert_double_eq_tol(e.b, known[i].b, known[i].error);
        ck_assert_double_eq_tol(e.gamma, known[i].gamma, 3 * known[i].error);
        ck_assert_double_eq_tol(tgamma(1 - e.a) * tgamma(1 - e.a) / tgamma(1 - 2 * e.a),
                                known[i].lambda, 1e-10);
        ck_assert_double_eq_tol(tgamma(1 + e.b) * tgamma(1 + e.b) / tgamma(1 + 2 * e.b),
                                known[i].lambda, 1e-10);
    }
    ck_assert_int_eq(exponents_of(0.5, &e), OK);
    ck_assert_double_eq_tol(e.b, 1, 1e-9);
    ck_assert_int_eq(exponents_of(1, &e), BAD_DATA);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("mct");
    TCase *tests = tcase_create("theory");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, the_kernel_is_the_direct_double_integral);
    tcase_add_test(tests, the_kernel_with_a_stretched_vertex_is_the_direct_double_integral);
    tcase_add_test(tests, a_stretched_vertex_of_a_mixture_is_the_mean_of_both);
    tcase_add_test(tests, slope_is_the_derivative_and_adjoint_its_transpose);
    tcase_add_test(tests, instruction_sets_agree_to_the_bit);
    tcase_add_test(tests, spheres_freeze_where_another_program_says);
    tcase_add_test(tests, binary_discs_freeze_where_another_program_says);
    tcase_add_test(tests, equal_discs_have_the_exponents_of_another_program);
    tcase_add_test(tests, closures_freeze_where_another_program_says);
    tcase_add_test(tests, the_transition_converges_in_the_grid);
    tcase_add_test(tests, a_bracket_that_holds_no_transition_is_refused);
    tcase_add_test(tests, a_mixture_of_equals_is_one_species);
    tcase_add_test(tests, the_transition_is_found_along_any_number);
    tcase_add_test(tests, exponents_follow_from_lambda);
    suite_add_tcase(suite, tests);
    TCase *sums = tcase_create("literature");
    tcase_set_timeout(sums, 600);
    tcase_add_test(sums, the_grid_of_the_literature_has_its_own_transition);
    suite_add_tcase(suite, sums);
    return run_suite(suite);
}
