// SPDX-License-Identifier: GPL-3.0-or-later
// The memory kernel as a convolution (Weysser, thesis, eqs 3.4-3.6 with the arguments put right).
// The vertex is a polynomial in the components of k and p = q - k times c(k) and c(p), so that
// M_ab(q) = rho/(d x_a x_b q^2) int d^dr { J0(qr) (T0 phi - Y Z) + (d - 1) J2(qr) (T2 phi + Y Z) }
// with phi = FT_0[Phi_ab], T_n = FT_n[k^2 (c Phi c)_ab], Y = FT_1[k (c Phi)_ab] and Z = FT_1[k (Phi
// c)_ab], FT_n the transform with the (in three dimensions spherical) Bessel function of order n.
#include "mct/model.h"

#include "base/memory.h"
#include "mct/lines.h"

#include <math.h>
#include <string.h>

enum { PHI, X, Y, Z, SOURCES };                   // sources of a pair
enum { R_PHI, R_T0, R_T2, R_Y, R_Z, TRANSFORMS }; // its transforms

static double *line(const Model *model, double *field, size_t index) {
    return field + index * model->grid->stride;
}

static const double *line_of(const Model *model, const double *field, size_t a, size_t b) {
    return field + mixture_pair(model->species, a, b) * model->grid->stride;
}

void model_matrix(const Model *model, const double *field, size_t m, SmallMatrix matrix) {
    for (size_t a = 0; a < model->species; a++) {
        for (size_t b = a; b < model->species; b++)
            matrix[a][b] = matrix[b][a] = line_of(model, field, a, b)[m];
    }
}

void model_put(const Model *model, double *field, size_t m, SmallMatrix matrix) {
    for (size_t a = 0; a < model->species; a++) {
        for (size_t b = a; b < model->species; b++)
            line(model, field, mixture_pair(model->species, a, b))[m] =
                a == b ? matrix[a][a] : (matrix[a][b] + matrix[b][a]) / 2;
    }
}

double model_product(const Model *model, const double *a, const double *b) {
    double sum = 0;
    for (size_t i = 0; i < model->species; i++) {
        for (size_t j = i; j < model->species; j++)
            sum += (i == j ? 1 : 2) * model->grid->lines->dot(line_of(model, a, i, j),
                                                              line_of(model, b, i, j),
                                                              model->grid->stride);
    }
    return sum;
}

static Status allocate(Model *model) {
    const size_t stride = model->grid->stride;
    TRY(NEW_ARRAY(model->factor, model->size));
    TRY(NEW_ARRAY(model->inverse, model->size));
    TRY(NEW_ARRAY(model->direct, model->size));
    TRY(NEW_ARRAY(model->scale, model->size));
    TRY(NEW_ARRAY(model->sources, model->size * SOURCES));
    TRY(NEW_ARRAY(model->product, model->species * model->species * stride));
    for (int power = 0; power < 3; power++) TRY(NEW_ARRAY(model->powers[power], stride));
    return OK;
}

Status model_create(Model **out, const Grid *grid, const Structure *structure) {
    Model *model = NULL;
    *out = NULL;
    ASSERT(structure->count == grid->count);
    TRY(NEW(model));
    model->grid = grid;
    model->mixture = structure->mixture;
    model->species = structure->mixture.species;
    model->pairs = mixture_pairs(&structure->mixture);
    model->size = model->pairs * grid->stride;
    const Status status = allocate(model);
    if (status != OK) {
        model_free(model);
        return status;
    }
    for (size_t m = 0; m < grid->count; m++) {
        for (int power = 0; power < 3; power++)
            model->powers[power][m] = grid->k_weight[m] * pow(grid->wave_number[m], power);
    }
    model_set(model, structure);
    *out = model;
    return OK;
}

void model_set(Model *model, const Structure *structure) {
    const Grid *grid = model->grid;
    const double *fraction = model->mixture.fraction;
    model->mixture = structure->mixture;
    model->density = structure->density;
    model->packing_fraction = structure->packing_fraction;
    for (size_t pair = 0; pair < model->pairs; pair++) {
        memcpy(line(model, model->direct, pair), structure->direct + pair * grid->count,
               grid->count * sizeof(double));
        memcpy(line(model, model->factor, pair), structure->factor + pair * grid->count,
               grid->count * sizeof(double));
    }
    for (size_t a = 0; a < model->species; a++) {
        for (size_t b = a; b < model->species; b++) {
            const size_t pair = mixture_pair(model->species, a, b);
            for (size_t m = 0; m < grid->count; m++) {
                line(model, model->inverse, pair)[m] =
                    (a == b) / fraction[a] - model->density * line(model, model->direct, pair)[m];
                line(model, model->scale, pair)[m] =
                    model->density /
                    (grid->dimension * fraction[a] * fraction[b] * pow(grid->wave_number[m], 2));
            }
        }
    }
}

void model_free(Model *model) {
    if (!model) return;
    memory_free(model->factor);
    memory_free(model->inverse);
    memory_free(model->direct);
    memory_free(model->scale);
    memory_free(model->sources);
    memory_free(model->product);
    for (int power = 0; power < 3; power++) memory_free(model->powers[power]);
    memory_free(model);
}

// product = left right, of fields or products, all as [a][b][stride] lines.
static void add_product(double *sum, const double *left, const double *right, size_t count) {
    for (size_t m = 0; m < count; m++) sum[m] += left[m] * right[m];
}

static void weigh(double *out, const double *weight, const double *values, size_t count) {
    for (size_t m = 0; m < count; m++) out[m] = weight[m] * values[m];
}

// c Phi for all ordered pairs of species.
static void fill_products(Model *model, const double *phi) {
    const size_t stride = model->grid->stride, species = model->species;
    memset(model->product, 0, species * species * stride * sizeof(double));
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++) {
            for (size_t e = 0; e < species; e++)
                add_product(line(model, model->product, a * species + b),
                            line_of(model, model->direct, a, e), line_of(model, phi, e, b), stride);
        }
    }
}

// Of one species whose second vertex has its wave numbers stretched: X = c c' Phi, Y = c Phi, Z =
// c' Phi.
static void fill_stretched(Model *model, const double *phi) {
    const size_t stride = model->grid->stride;
    double *sources = model->sources;
    for (size_t m = 0; m < model->grid->count; m++) {
        const double direct = model->direct[m], stretched = model->stretched[m];
        sources[PHI * stride + m] = model->powers[0][m] * phi[m];
        sources[X * stride + m] = model->powers[2][m] * direct * stretched * phi[m];
        sources[Y * stride + m] = model->powers[1][m] * direct * phi[m];
        sources[Z * stride + m] = model->powers[1][m] * stretched * phi[m];
    }
}

static void fill_sources(Model *model, const double *phi) {
    const size_t stride = model->grid->stride, species = model->species;
    if (model->stretched) {
        fill_stretched(model, phi);
        return;
    }
    fill_products(model, phi);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            double *sources = line(model, model->sources, mixture_pair(species, a, b) * SOURCES);
            double *x = sources + X * stride;
            memset(x, 0, stride * sizeof *x);
            for (size_t e = 0; e < species; e++)
                add_product(x, line(model, model->product, a * species + e),
                            line_of(model, model->direct, e, b), stride);
            weigh(x, model->powers[2], x, stride);
            weigh(sources + PHI * stride, model->powers[0], line_of(model, phi, a, b), stride);
            weigh(sources + Y * stride, model->powers[1],
                  line(model, model->product, a * species + b), stride);
            weigh(sources + Z * stride, model->powers[1],
                  line(model, model->product, b * species + a), stride);
        }
    }
}

// The Bessel functions at one radius.
typedef struct Row {
    const double *j[GRID_ORDERS];
} Row;

static Row row_at(const Grid *grid, size_t n) {
    Row row;
    for (int order = 0; order < GRID_ORDERS; order++)
        row.j[order] = grid->table[order] + n * grid->stride;
    return row;
}

static void transform_pair(const Model *model, const Row *row, size_t a, size_t b,
                           double transforms[TRANSFORMS]) {
    const size_t stride = model->grid->stride;
    const Lines *with = model->grid->lines;
    const double *sources = model->sources + mixture_pair(model->species, a, b) * SOURCES * stride;
    with->dots(row->j, sources + PHI * stride, sources + X * stride, sources + Y * stride, stride,
               transforms);
    transforms[R_Z] = a == b && !model->stretched
                          ? transforms[R_Y]
                          : with->dot(row->j[1], sources + Z * stride, stride);
}

static void add_back(const Model *model, const Row *row, size_t pair, double g0, double g2,
                     double *field) {
    const size_t stride = model->grid->stride;
    model->grid->lines->add(field + pair * stride, g0, row->j[0], g2, row->j[2], stride);
}

static void scale(const Model *model, double *field) {
    for (size_t i = 0; i < model->size; i++) field[i] *= model->scale[i];
}

void model_memory(Model *model, const double *phi, double *memory) {
    const Grid *grid = model->grid;
    fill_sources(model, phi);
    memset(memory, 0, model->size * sizeof *memory);
    for (size_t n = 0; n < grid->radii; n++) {
        const Row row = row_at(grid, n);
        for (size_t a = 0; a < model->species; a++) {
            for (size_t b = a; b < model->species; b++) {
                double t[TRANSFORMS];
                transform_pair(model, &row, a, b, t);
                const double both = t[R_Y] * t[R_Z];
                add_back(model, &row, mixture_pair(model->species, a, b),
                         grid->r_weight[n] * (t[R_T0] * t[R_PHI] - both),
                         grid->r_weight[n] * (grid->dimension - 1) * (t[R_T2] * t[R_PHI] + both),
                         memory);
            }
        }
    }
    scale(model, memory);
}

Status radial_create(Radial *radial, const Model *model) {
    return NEW_ARRAY(radial->values, model->pairs * TRANSFORMS * model->grid->radii);
}

void radial_free(Radial *radial) {
    memory_free(radial->values);
    radial->values = NULL;
}

static double *radial_at(const Model *model, const Radial *radial, size_t pair, size_t n) {
    return radial->values + (pair * model->grid->radii + n) * TRANSFORMS;
}

void model_transform(Model *model, const double *phi, Radial *radial) {
    fill_sources(model, phi);
    for (size_t n = 0; n < model->grid->radii; n++) {
        const Row row = row_at(model->grid, n);
        for (size_t a = 0; a < model->species; a++) {
            for (size_t b = a; b < model->species; b++)
                transform_pair(model, &row, a, b,
                               radial_at(model, radial, mixture_pair(model->species, a, b), n));
        }
    }
}

void model_slope(Model *model, const Radial *phi, const double *h, double *slope) {
    const Grid *grid = model->grid;
    fill_sources(model, h);
    memset(slope, 0, model->size * sizeof *slope);
    for (size_t n = 0; n < grid->radii; n++) {
        const Row row = row_at(grid, n);
        for (size_t a = 0; a < model->species; a++) {
            for (size_t b = a; b < model->species; b++) {
                const size_t pair = mixture_pair(model->species, a, b);
                const double *f = radial_at(model, phi, pair, n);
                double t[TRANSFORMS];
                transform_pair(model, &row, a, b, t);
                const double both = t[R_Y] * f[R_Z] + f[R_Y] * t[R_Z];
                const double g0 = t[R_T0] * f[R_PHI] + f[R_T0] * t[R_PHI] - both;
                const double g2 = t[R_T2] * f[R_PHI] + f[R_T2] * t[R_PHI] + both;
                add_back(model, &row, pair, grid->r_weight[n] * g0,
                         grid->r_weight[n] * (grid->dimension - 1) * g2, slope);
            }
        }
    }
    scale(model, slope);
}

// What g gives at one radius, times the transforms of Phi, to the sources: the transposed of the
// map from sources to M.
static void spread_pair(Model *model, const Row *row, size_t n, size_t a, size_t b,
                        const double f[TRANSFORMS], const double *g) {
    const Grid *grid = model->grid;
    const size_t stride = grid->stride, pair = mixture_pair(model->species, a, b);
    const Lines *with = model->grid->lines;
    double *sources = model->sources + pair * SOURCES * stride;
    const double g0 = grid->r_weight[n] * with->dot(row->j[0], g + pair * stride, stride);
    const double g2 =
        grid->r_weight[n] * (grid->dimension - 1) * with->dot(row->j[2], g + pair * stride, stride);
    with->add(sources + PHI * stride, g0 * f[R_T0] + g2 * f[R_T2], row->j[0], 0, row->j[0], stride);
    with->add(sources + X * stride, g0 * f[R_PHI], row->j[0], g2 * f[R_PHI], row->j[2], stride);
    with->add(sources + Y * stride, (g2 - g0) * f[R_Z], row->j[1], 0, row->j[1], stride);
    with->add(sources + Z * stride, (g2 - g0) * f[R_Y], row->j[1], 0, row->j[1], stride);
}

static double *source_line(const Model *model, size_t a, size_t b, int source) {
    return model->sources +
           (mixture_pair(model->species, a, b) * SOURCES + (size_t)source) * model->grid->stride;
}

// phi + c x c + c y + (c y)^T at one wave number, the transposed of fill_sources.
static void gather(const Model *model, size_t m, double *adjoint) {
    const size_t species = model->species;
    SmallMatrix phi, x, y, c, cx, cxc, cy;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            phi[a][b] = phi[b][a] = model->powers[0][m] * source_line(model, a, b, PHI)[m];
            x[a][b] = x[b][a] = model->powers[2][m] * source_line(model, a, b, X)[m];
            y[a][b] = model->powers[1][m] * source_line(model, a, b, Y)[m];
            y[b][a] = model->powers[1][m] * source_line(model, a, b, Z)[m];
        }
    }
    model_matrix(model, model->direct, m, c);
    small_multiply(species, c, x, cx);
    small_multiply(species, cx, c, cxc);
    small_multiply(species, c, y, cy);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++) phi[a][b] += cxc[a][b] + cy[a][b] + cy[b][a];
    }
    model_put(model, adjoint, m, phi);
}

void model_adjoint(Model *model, const Radial *phi, const double *g, double *adjoint) {
    const Grid *grid = model->grid;
    memset(model->sources, 0, model->size * SOURCES * sizeof(double));
    for (size_t i = 0; i < model->size; i++) adjoint[i] = model->scale[i] * g[i];
    for (size_t n = 0; n < grid->radii; n++) {
        const Row row = row_at(grid, n);
        for (size_t a = 0; a < model->species; a++) {
            for (size_t b = a; b < model->species; b++)
                spread_pair(model, &row, n, a, b,
                            radial_at(model, phi, mixture_pair(model->species, a, b), n), adjoint);
        }
    }
    for (size_t m = 0; m < grid->count; m++) gather(model, m, adjoint);
}

// rho/(d q^2) int d^dr { J0(qr) T0 phi + (d - 1) J2(qr) T2 phi } with T_n of the species itself: of
// the vertex only the part with the collective correlator is there (Weysser, thesis, eq. 3.20).
static void tagged_memory(const Model *model, const Radial *phi, size_t a, const double *source,
                          double *memory) {
    const Grid *grid = model->grid;
    const size_t pair = mixture_pair(model->species, a, a);
    const double fraction = model->mixture.fraction[a];
    memset(memory, 0, grid->stride * sizeof *memory);
    for (size_t n = 0; n < grid->radii; n++) {
        const Row row = row_at(grid, n);
        const double *f = radial_at(model, phi, pair, n);
        const double self =
            grid->r_weight[n] * model->grid->lines->dot(row.j[0], source, grid->stride);
        add_back(model, &row, 0, f[R_T0] * self, (grid->dimension - 1) * f[R_T2] * self, memory);
    }
    for (size_t m = 0; m < grid->count; m++)
        memory[m] *= model->scale[pair * grid->stride + m] * fraction * fraction;
}

void model_tagged(Model *model, const Radial *phi, const double *self, double *memory) {
    const size_t stride = model->grid->stride;
    for (size_t a = 0; a < model->species; a++) {
        double *source = line(model, model->product, a); // which nobody needs any more
        weigh(source, model->powers[0], self + a * stride, stride);
        tagged_memory(model, phi, a, source, memory + a * stride);
    }
}

void model_displacement(const Model *model, const double *self, double *memory) {
    const size_t stride = model->grid->stride;
    for (size_t a = 0; a < model->species; a++)
        memory[a] = model->density / model->grid->dimension *
                    model->grid->lines->dot(source_line(model, a, a, X), self + a * stride, stride);
}
