// SPDX-License-Identifier: GPL-3.0-or-later
// The memory kernel as products in space. Advection is a matrix, q' = G q, hence k' = G k and
// q'.k' = q.(g k) with the symmetric g = G^T G. With X = c c' a, B_i = k_i c a, E_m = k_m c' a,
//   2 sum over k of the vertices = 2 q_i q_l (g_lm) [k_i k_m X * a + B_i * E_m],
// eight transforms to space and, as only what is symmetric in i and l counts, three back.
#include "itt/kernel.h"

#include "base/constants.h"
#include "base/memory.h"
#include "itt/fourier.h"

#include <math.h>

// What is transformed: a; B and E, which are odd; k_i k_m X
enum { A, BX, BY, EX, EY, XX_X, XY_X, YY_X, SOURCES };

struct Kernel {
    const Plane *plane;
    const Direct *direct;
    Fourier *fourier;
    double strain;
    double *factor, *c;            // [size]: S_k and c_k
    double *weight[SOURCES];       // [size]: of Phi in each source
    double *space[SOURCES];        // the sources in space
    double *tagged;                // in space
    double *product[KERNEL_PAIRS]; // in space
    double *back;                  // [size]
    double *source;                // [size]
    double *rate, *tagged_rate;    // [size]
    double *scale, *tagged_scale;  // [size]: rho spacing^2/(2 pi)^2 /(q^2 q'^2), with S_q' and not
};

static Status allocate(Kernel *k) {
    const size_t size = k->plane->size, room = fourier_size(k->fourier);
    double **const fields[] = {&k->factor, &k->c,           &k->back,  &k->source,
                               &k->rate,   &k->tagged_rate, &k->scale, &k->tagged_scale};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) TRY(NEW_ARRAY(*fields[i], size));
    for (int i = 0; i < SOURCES; i++) {
        TRY(NEW_ARRAY(k->weight[i], size));
        TRY(NEW_ARRAY(k->space[i], room));
    }
    for (int i = 0; i < KERNEL_PAIRS; i++) TRY(NEW_ARRAY(k->product[i], room));
    return NEW_ARRAY(k->tagged, room);
}

// All that does not depend on the strain. Between the columns weights stay zero, and so do fields.
static void fill_at_rest(Kernel *k) {
    const Plane *plane = k->plane;
    for (size_t i = 0; i < plane->size; i++) {
        const double q = hypot(plane->x[i], plane->y[i]);
        k->c[i] = direct_value(k->direct, q);
        k->factor[i] = direct_factor(k->direct, q);
        if (!(plane->area[i] > 0)) continue;
        k->weight[A][i] = k->factor[i];
        k->weight[BX][i] = plane->x[i] * k->c[i] * k->factor[i];
        k->weight[BY][i] = plane->y[i] * k->c[i] * k->factor[i];
    }
}

Status kernel_create(Kernel **out, const Plane *plane, const Direct *direct) {
    Kernel *k = NULL;
    *out = NULL;
    TRY(NEW(k));
    k->plane = plane;
    k->direct = direct;
    Status status = fourier_create(&k->fourier, plane);
    if (status == OK) status = allocate(k);
    if (status != OK) {
        kernel_free(k);
        return status;
    }
    fill_at_rest(k);
    kernel_set_strain(k, 0);
    *out = k;
    return OK;
}

void kernel_free(Kernel *k) {
    if (!k) return;
    double *const fields[] = {k->factor, k->c,           k->back,  k->source,      k->tagged,
                              k->rate,   k->tagged_rate, k->scale, k->tagged_scale};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) memory_free(fields[i]);
    for (int i = 0; i < SOURCES; i++) {
        memory_free(k->weight[i]);
        memory_free(k->space[i]);
    }
    for (int i = 0; i < KERNEL_PAIRS; i++) memory_free(k->product[i]);
    fourier_free(k->fourier);
    memory_free(k);
}

void kernel_set_strain(Kernel *k, double strain) {
    const Plane *plane = k->plane;
    const double cell = k->direct->density * pow(plane->spacing / (2 * PI), 2);
    k->strain = strain;
    for (size_t i = 0; i < plane->size; i++) {
        if (!(plane->area[i] > 0)) continue;
        const double x = plane->x[i], y = plane->y[i], later = y - strain * x;
        const double square = x * x + y * y, late_square = x * x + later * later;
        const double late_c = direct_value(k->direct, sqrt(late_square));
        const double late_factor = 1 / (1 - k->direct->density * late_c);
        k->rate[i] = late_square / late_factor;
        k->tagged_rate[i] = late_square;
        k->tagged_scale[i] = square > 0 ? cell / (square * late_square) : 0;
        k->scale[i] = late_factor * k->tagged_scale[i];
        k->weight[EX][i] = x * late_c * k->factor[i];
        k->weight[EY][i] = y * late_c * k->factor[i];
        const double both = k->c[i] * late_c * k->factor[i];
        k->weight[XX_X][i] = x * x * both;
        k->weight[XY_X][i] = x * y * both;
        k->weight[YY_X][i] = y * y * both;
    }
}

const double *kernel_rate(const Kernel *k) {
    return k->rate;
}

const double *kernel_tagged_rate(const Kernel *k) {
    return k->tagged_rate;
}

static void transform_sources(Kernel *k, const double *phi) {
    for (int s = 0; s < SOURCES; s++) {
        for (size_t i = 0; i < k->plane->size; i++) k->source[i] = k->weight[s][i] * phi[i];
        if (s >= BX && s <= EY)
            fourier_odd(k->fourier, k->source, k->space[s]);
        else
            fourier_even(k->fourier, k->source, k->space[s]);
    }
}

// From N_im = U_im a - b_i e_m (the sines of odd fields carry the sign) to the part of N g that is
// symmetric, the off-diagonal twice.
static void multiply_collective(Kernel *k) {
    const double s = k->strain, gxx = 1 + s * s, gxy = -s;
    double *const *f = k->space, *const *out = k->product;
    const size_t room = fourier_size(k->fourier);
    for (size_t r = 0; r < room; r++) {
        const double a = f[A][r];
        const double xx = f[XX_X][r] * a - f[BX][r] * f[EX][r];
        const double xy = f[XY_X][r] * a - f[BX][r] * f[EY][r];
        const double yx = f[XY_X][r] * a - f[BY][r] * f[EX][r];
        const double yy = f[YY_X][r] * a - f[BY][r] * f[EY][r];
        out[0][r] = xx * gxx + xy * gxy;
        out[1][r] = xx * gxy + xy + yx * gxx + yy * gxy;
        out[2][r] = yx * gxy + yy;
    }
}

// Likewise without B and E: a tagged particle has one way to share q with a density fluctuation.
static void multiply_tagged(Kernel *k) {
    const double s = k->strain, gxx = 1 + s * s, gxy = -s;
    double *const *f = k->space, *const *out = k->product;
    const size_t room = fourier_size(k->fourier);
    for (size_t r = 0; r < room; r++) {
        const double a = k->tagged[r];
        const double xx = f[XX_X][r] * a, xy = f[XY_X][r] * a, yy = f[YY_X][r] * a;
        out[0][r] = xx * gxx + xy * gxy;
        out[1][r] = xx * gxy + xy + xy * gxx + yy * gxy;
        out[2][r] = xy * gxy + yy;
    }
}

// memory = scale times the sum over i, l of q_i q_l times the products, back from space.
static void collect(Kernel *k, const double *scale, double *memory) {
    const Plane *plane = k->plane;
    const double *const left[] = {plane->x, plane->x, plane->y};
    const double *const right[] = {plane->x, plane->y, plane->y};
    for (int pair = 0; pair < KERNEL_PAIRS; pair++) {
        fourier_back(k->fourier, k->product[pair], k->back);
        for (size_t i = 0; i < plane->size; i++) {
            const double term = scale[i] * left[pair][i] * right[pair][i] * k->back[i];
            memory[i] = pair == 0 ? term : memory[i] + term;
        }
    }
}

void kernel_memory(Kernel *k, const double *phi, double *memory) {
    transform_sources(k, phi);
    multiply_collective(k);
    collect(k, k->scale, memory);
}

void kernel_tagged(Kernel *k, const double *tagged, double *memory) {
    fourier_even(k->fourier, tagged, k->tagged);
    multiply_tagged(k);
    collect(k, k->tagged_scale, memory);
}

void kernel_displacement(Kernel *k, const double *phi, const double *tagged,
                         double friction[2][2]) {
    const Plane *plane = k->plane;
    double xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < plane->size; i++) {
        const double f = plane->area[i] * phi[i] * tagged[i];
        xx += f * k->weight[XX_X][i];
        xy += f * k->weight[XY_X][i];
        yy += f * k->weight[YY_X][i];
    }
    // K_ij = sum k_i k'_j with k' = (k_x, k_y - strain k_x).
    const double rho = k->direct->density;
    friction[0][0] = rho * xx;
    friction[0][1] = rho * (xy - k->strain * xx);
    friction[1][0] = rho * xy;
    friction[1][1] = rho * (yy - k->strain * xy);
}
