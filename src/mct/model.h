// SPDX-License-Identifier: GPL-3.0-or-later
// The memory kernel of mode-coupling theory for one structure: functionals of partial correlators
// Phi_ab(q), all by pairs of species, [pair][stride of the grid]. Inside mct/ only.
#pragma once

#include "mct/grid.h"
#include "numerics/small.h"
#include "oz/oz.h"

#include <stdbool.h>

typedef struct Model {
    const Grid *grid;
    Mixture mixture;
    double density, packing_fraction;
    size_t species, pairs, size;       // size: pairs x stride, numbers in a field
    double *factor, *inverse, *direct; // S, S^-1, c
    double *sources;                   // [pair][4][stride], what is transformed to r
    double *product;                   // [a][b][stride]: c Phi
    double *powers[3];                 // [stride]: k_weight times k^0, k^1, k^2
    double *scale;                     // [size]: rho/(d x_a x_b q^2)
    const double *stretched; // [stride]: c of one species at wave numbers that shear has stretched,
                             // of the second of the two vertices; borrowed; NULL: as the first
} Model;

Status model_create(Model **out, const Grid *grid, const Structure *structure);
// Another structure of as many species on the same grid.
void model_set(Model *model, const Structure *structure);
void model_free(Model *model);

// M[Phi], quadratic in Phi.
void model_memory(Model *model, const double *phi, double *memory);

// The transforms of a correlator, kept for the functionals that are linear in another.
typedef struct Radial {
    double *values; // [pair][5][radii]
} Radial;
Status radial_create(Radial *radial, const Model *model);
void radial_free(Radial *radial);
void model_transform(Model *model, const double *phi, Radial *radial);

// The change of M[Phi] by h, to first order, and the adjoint of that map in the sum over wave
// numbers and species of the products of matrices.
void model_slope(Model *model, const Radial *phi, const double *h, double *slope);
void model_adjoint(Model *model, const Radial *phi, const double *g, double *adjoint);

// The memory kernels of tagged particles, [species][stride], from their own correlators; the
// transforms of the collective ones were the last thing done with this model.
void model_tagged(Model *model, const Radial *phi, const double *self, double *memory);
// Likewise the kernels of their mean squared displacements, [species].
void model_displacement(const Model *model, const double *self, double *memory);

// The full symmetric matrix of wave number m, and back.
void model_matrix(const Model *model, const double *field, size_t m, SmallMatrix matrix);
void model_put(const Model *model, double *field, size_t m, SmallMatrix matrix);

// sum over wave numbers and species of a_ab b_ab.
double model_product(const Model *model, const double *a, const double *b);
