// SPDX-License-Identifier: GPL-3.0-or-later
// What the ways to a structure look like to each other. Inside oz/ only.
#pragma once

#include "oz/measured.h"
#include "oz/oz.h"

// Each fills `direct` and `contact` of a structure whose other fields are set.

void closed_spheres(Structure *structure); // Percus-Yevick, any mixture
void closed_verlet_weis(Structure *structure);
void closed_fundamental(Structure *structure);
void closed_baus_colot(Structure *structure);

typedef struct Discs Discs; // Percus-Yevick discs by collocation
Status discs_create(Discs **out, const Mixture *mixture, const double *wave_number, size_t count);
void discs_free(Discs *discs);
Status discs_solve(Discs *discs, Structure *structure, OzEffort *effort);

typedef struct Closures Closures; // any closure, on grids
Status closures_create(Closures **out, Closure closure, const Mixture *mixture,
                       const double *wave_number, size_t count);
void closures_free(Closures *closures);
Status closures_solve(Closures *closures, Structure *structure, OzEffort *effort);

// Measured structure: how many splines there are of a pair; their transforms at these wave numbers,
// transform[count][splines]; their coefficients at a packing fraction, UNHEALTHY if that is far
// from the states; their step at contact, outside less inside.
size_t measured_splines(const Measured *measured, size_t a, size_t b);
void measured_transforms(const Measured *measured, size_t a, size_t b, const double *q,
                         size_t count, double *transform);
Status measured_coefficients(const Measured *measured, double packing_fraction, size_t a, size_t b,
                             double *coefficients);
double measured_step(const Measured *measured, size_t a, size_t b, const double *coefficients);
