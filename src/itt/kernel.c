// SPDX-License-Identifier: GPL-3.0-or-later
// The memory kernel as products in space. Advection is a matrix, q' = G q, hence k' = G k and
// q'.k' = q.(g k) with the symmetric g = G^T G. The sums over species are products of matrices at
// one wave vector: for each pair ac, with A = F_ac, B_i = k_i (F c)_ac, E_m = k_m (c' F)_ac and
// X = (c' F c)_ac,
//   sum over k of the vertices = 2 q_i q_l (g_lm) [k_i k_m X * A + B_i * E_m],
// eight transforms to space and, as only what is symmetric in i and l counts, three back.
#include "itt/kernel.h"

#include "base/constants.h"
#include "base/memory.h"
#include "itt/fourier.h"
#include "itt/matrix.h"

#include <math.h>
#include <string.h>

enum { F, FC, CF, CFC, PRODUCTS };   // of matrices: what is transformed, but for components
enum { A, BX, BY, EX, EY, SOURCES }; // in space, of one pair
enum { XX_X, XY_X, YY_X, VERTICES }; // likewise, kept of all pairs for tagged particles

struct Kernel {
    const Plane *plane;
    const Direct *direct;
    size_t species, entries; // entries of a matrix
    double diffusion[MIXTURE_SPECIES_MOST];
    Fourier *fourier;
    double strain;
    double *factor, *shared;       // matrices: S_k, and S_k c_k
    double *late_c, *late_factor;  // matrices: c and S at the advected wave vector
    double *products[PRODUCTS];    // matrices
    double *space[SOURCES];        // in space
    double *vertex;                // in space, [entry][VERTICES]
    double *tagged;                // in space
    double *product[KERNEL_PAIRS]; // in space
    double *back, *source;         // [size]
    double *partial;               // matrix: M
    double *rate, *tagged_rate;    // matrix, and [species][size]
    double *scale;                 // [size]: rho spacing^2/(2 pi)^2 /(q^2 q'^2)
};

static Status allocate(Kernel *k) {
    const size_t size = k->plane->size, room = fourier_size(k->fourier);
    double **const matrices[] = {&k->factor,      &k->shared, &k->late_c,
                                 &k->late_factor, &k->rate,   &k->partial};
    for (size_t i = 0; i < sizeof matrices / sizeof *matrices; i++)
        TRY(NEW_ARRAY(*matrices[i], k->entries * size));
    for (int i = 0; i < PRODUCTS; i++) TRY(NEW_ARRAY(k->products[i], k->entries * size));
    for (int i = 0; i < SOURCES; i++) TRY(NEW_ARRAY(k->space[i], room));
    for (int i = 0; i < KERNEL_PAIRS; i++) TRY(NEW_ARRAY(k->product[i], room));
    TRY(NEW_ARRAY(k->vertex, k->entries * VERTICES * room));
    TRY(NEW_ARRAY(k->tagged, room));
    TRY(NEW_ARRAY(k->back, size));
    TRY(NEW_ARRAY(k->source, size));
    TRY(NEW_ARRAY(k->tagged_rate, k->species * size));
    return NEW_ARRAY(k->scale, size);
}

// c_ab and the entry of the inverse of S at all wave vectors after this strain.
static void fill_pair(const Kernel *k, size_t a, size_t b, double strain, double *c,
                      double *inverse) {
    const Plane *plane = k->plane;
    const Direct *direct = k->direct;
    const size_t pair = mixture_pair(k->species, a, b);
    const double ideal = a == b ? 1 / direct->mixture.fraction[a] : 0;
    for (size_t i = 0; i < plane->size; i++) {
        const double x = plane->x[i], y = plane->y[i] - strain * x;
        c[i] = direct_value(direct, pair, sqrt(x * x + y * y));
        inverse[i] = ideal - direct->density * c[i];
    }
}

// c and S likewise. Between the columns q = 0.
static void fill_structure(const Kernel *k, double strain, double *c, double *factor) {
    const size_t size = k->plane->size;
    double *const matrices[] = {c, factor};
    for (size_t a = 0; a < k->species; a++) {
        for (size_t b = a; b < k->species; b++) {
            fill_pair(k, a, b, strain, matrix_entry(c, k->species, size, a, b),
                      matrix_entry(factor, k->species, size, a, b));
            for (int m = 0; b > a && m < 2; m++)
                memcpy(matrix_entry(matrices[m], k->species, size, b, a),
                       matrix_read(matrices[m], k->species, size, a, b), size * sizeof(double));
        }
    }
    matrix_invert(k->species, size, factor);
}

Status kernel_create(Kernel **out, const Plane *plane, const Direct *direct,
                     const double *diffusion) {
    Kernel *k = NULL;
    *out = NULL;
    TRY(NEW(k));
    k->plane = plane;
    k->direct = direct;
    k->species = direct->mixture.species;
    k->entries = k->species * k->species;
    for (size_t a = 0; a < k->species; a++) k->diffusion[a] = diffusion[a];
    Status status = fourier_create(&k->fourier, plane);
    if (status == OK) status = allocate(k);
    if (status != OK) {
        kernel_free(k);
        return status;
    }
    fill_structure(k, 0, k->late_c, k->factor);
    matrix_multiply(k->species, plane->size, k->factor, k->late_c, k->shared);
    kernel_set_strain(k, 0);
    *out = k;
    return OK;
}

void kernel_free(Kernel *k) {
    if (!k) return;
    double *const fields[] = {k->factor, k->shared,      k->late_c, k->late_factor,
                              k->rate,   k->vertex,      k->tagged, k->back,
                              k->source, k->tagged_rate, k->scale,  k->partial};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) memory_free(fields[i]);
    for (int i = 0; i < PRODUCTS; i++) memory_free(k->products[i]);
    for (int i = 0; i < SOURCES; i++) memory_free(k->space[i]);
    for (int i = 0; i < KERNEL_PAIRS; i++) memory_free(k->product[i]);
    fourier_free(k->fourier);
    memory_free(k);
}

static void fill_rate(Kernel *k, size_t i, double late_square) {
    const size_t size = k->plane->size;
    const Direct *direct = k->direct;
    for (size_t a = 0; a < k->species; a++) {
        const double free = k->diffusion[a] * late_square;
        const double weighted = free * direct->mixture.fraction[a] * direct->density;
        k->tagged_rate[a * size + i] = free;
        for (size_t b = 0; b < k->species; b++) {
            const size_t at = (a * k->species + b) * size + i;
            k->rate[at] = (a == b ? free : 0) - weighted * k->late_c[at];
        }
    }
}

void kernel_set_strain(Kernel *k, double strain) {
    const Plane *plane = k->plane;
    const double cell = k->direct->density * pow(plane->spacing / (2 * PI), 2);
    k->strain = strain;
    fill_structure(k, strain, k->late_c, k->late_factor);
    for (size_t i = 0; i < plane->size; i++) {
        const double x = plane->x[i], y = plane->y[i], later = y - strain * x;
        const double square = x * x + y * y, late_square = x * x + later * later;
        k->scale[i] = square > 0 ? cell / (square * late_square) : 0;
        fill_rate(k, i, late_square);
    }
}

const double *kernel_rate(const Kernel *k) {
    return k->rate;
}

const double *kernel_tagged_rate(const Kernel *k, size_t species) {
    return k->tagged_rate + species * k->plane->size;
}

static const double *product_of(const Kernel *k, int product, size_t a, size_t c) {
    return matrix_read(k->products[product], k->species, k->plane->size, a, c);
}

static double *vertex_of(const Kernel *k, size_t a, size_t c, int components) {
    return k->vertex +
           ((a * k->species + c) * VERTICES + (size_t)components) * fourier_size(k->fourier);
}

// field times component, which is odd; and times another, which is even.
static void transform_odd(Kernel *k, const double *field, const double *component, double *space) {
    for (size_t i = 0; i < k->plane->size; i++) k->source[i] = component[i] * field[i];
    fourier_odd(k->fourier, k->source, space);
}

static void transform_even(Kernel *k, const double *field, const double *one, const double *other,
                           double *space) {
    for (size_t i = 0; i < k->plane->size; i++) k->source[i] = one[i] * other[i] * field[i];
    fourier_even(k->fourier, k->source, space);
}

static void transform_sources(Kernel *k, size_t a, size_t c) {
    const double *x = k->plane->x, *y = k->plane->y;
    fourier_even(k->fourier, product_of(k, F, a, c), k->space[A]);
    transform_odd(k, product_of(k, FC, a, c), x, k->space[BX]);
    transform_odd(k, product_of(k, FC, a, c), y, k->space[BY]);
    transform_odd(k, product_of(k, CF, a, c), x, k->space[EX]);
    transform_odd(k, product_of(k, CF, a, c), y, k->space[EY]);
    transform_even(k, product_of(k, CFC, a, c), x, x, vertex_of(k, a, c, XX_X));
    transform_even(k, product_of(k, CFC, a, c), x, y, vertex_of(k, a, c, XY_X));
    transform_even(k, product_of(k, CFC, a, c), y, y, vertex_of(k, a, c, YY_X));
}

// From N_im = U_im a - b_i e_m (the sines of odd fields carry the sign) to the part of N g that is
// symmetric, the off-diagonal twice.
static void multiply_collective(Kernel *k, size_t a, size_t c) {
    const double s = k->strain, gxx = 1 + s * s, gxy = -s;
    const double *u_xx = vertex_of(k, a, c, XX_X), *u_xy = vertex_of(k, a, c, XY_X);
    const double *u_yy = vertex_of(k, a, c, YY_X);
    double *const *f = k->space, *const *out = k->product;
    const size_t room = fourier_size(k->fourier);
    for (size_t r = 0; r < room; r++) {
        const double partner = f[A][r];
        const double xx = u_xx[r] * partner - f[BX][r] * f[EX][r];
        const double xy = u_xy[r] * partner - f[BX][r] * f[EY][r];
        const double yx = u_xy[r] * partner - f[BY][r] * f[EX][r];
        const double yy = u_yy[r] * partner - f[BY][r] * f[EY][r];
        out[0][r] = xx * gxx + xy * gxy;
        out[1][r] = xx * gxy + xy + yx * gxx + yy * gxy;
        out[2][r] = yx * gxy + yy;
    }
}

// Likewise without B and E: a tagged particle has one way to share q with a density fluctuation.
static void multiply_tagged(Kernel *k, size_t species) {
    const double s = k->strain, gxx = 1 + s * s, gxy = -s;
    const double *u_xx = vertex_of(k, species, species, XX_X);
    const double *u_xy = vertex_of(k, species, species, XY_X);
    const double *u_yy = vertex_of(k, species, species, YY_X);
    double *const *out = k->product;
    const size_t room = fourier_size(k->fourier);
    for (size_t r = 0; r < room; r++) {
        const double a = k->tagged[r];
        const double xx = u_xx[r] * a, xy = u_xy[r] * a, yy = u_yy[r] * a;
        out[0][r] = xx * gxx + xy * gxy;
        out[1][r] = xx * gxy + xy + xy * gxx + yy * gxy;
        out[2][r] = xy * gxy + yy;
    }
}

// kernel = weight scale times the sum over i, l of q_i q_l times the products, back from space.
static void collect(Kernel *k, double weight, double *kernel) {
    const Plane *plane = k->plane;
    const double *const left[] = {plane->x, plane->x, plane->y};
    const double *const right[] = {plane->x, plane->y, plane->y};
    for (int pair = 0; pair < KERNEL_PAIRS; pair++) {
        fourier_back(k->fourier, k->product[pair], k->back);
        for (size_t i = 0; i < plane->size; i++) {
            const double term = weight * k->scale[i] * left[pair][i] * right[pair][i] * k->back[i];
            kernel[i] = pair == 0 ? term : kernel[i] + term;
        }
    }
}

static void multiply_matrices(Kernel *k, const double *phi) {
    const size_t size = k->plane->size;
    matrix_multiply(k->species, size, phi, k->factor, k->products[F]);
    matrix_multiply(k->species, size, phi, k->shared, k->products[FC]);
    matrix_multiply(k->species, size, k->late_c, k->products[F], k->products[CF]);
    matrix_multiply(k->species, size, k->late_c, k->products[FC], k->products[CFC]);
}

void kernel_memory(Kernel *k, const double *phi, double *memory) {
    const double *fraction = k->direct->mixture.fraction;
    multiply_matrices(k, phi);
    for (size_t a = 0; a < k->species; a++) {
        for (size_t c = 0; c < k->species; c++) {
            transform_sources(k, a, c);
            multiply_collective(k, a, c);
            collect(k, 1 / (fraction[a] * fraction[c]),
                    matrix_entry(k->partial, k->species, k->plane->size, a, c));
        }
    }
    matrix_multiply(k->species, k->plane->size, k->late_factor, k->partial, memory);
}

void kernel_tagged(Kernel *k, size_t species, const double *tagged, double *memory) {
    fourier_even(k->fourier, tagged, k->tagged);
    multiply_tagged(k, species);
    collect(k, 1, memory);
}

void kernel_displacement(const Kernel *k, size_t species, const double *tagged,
                         double friction[2][2]) {
    const Plane *plane = k->plane;
    const double *vertex = product_of(k, CFC, species, species);
    double xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < plane->size; i++) {
        const double f = plane->area[i] * vertex[i] * tagged[i];
        xx += f * plane->x[i] * plane->x[i];
        xy += f * plane->x[i] * plane->y[i];
        yy += f * plane->y[i] * plane->y[i];
    }
    // K_ij = sum k_i k'_j with k' = (k_x, k_y - strain k_x).
    const double rho = k->direct->density;
    friction[0][0] = rho * xx;
    friction[0][1] = rho * (xy - k->strain * xx);
    friction[1][0] = rho * xy;
    friction[1][1] = rho * (yy - k->strain * xy);
}
