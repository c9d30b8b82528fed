// SPDX-License-Identifier: GPL-3.0-or-later
// Transient correlators of a mixture of discs after shear has been switched on at t = 0 (Weysser,
// thesis, chapter 5): of density fluctuations at q and, at time t, at the advected q(t) = (q_x, q_y
// - rate t q_x), in all directions, F = Phi S with F_ab of the later density of species a and the
// earlier of b; likewise of a tagged particle of each species; mean squared displacements. Over any
// number of decades of time. A rate of 0 is rest.
#pragma once

#include "base/archive.h"
#include "itt/direct.h"
#include "itt/plane.h"

#include <stdbool.h>

typedef struct TransientSettings {
    double shear_rate; // in D0/d^2
    size_t block;      // points of a block of the doubling grid of times, a multiple of 4; 0: 64
    bool tagged;       // also a tagged particle of each species
    double diffusion[MIXTURE_SPECIES_MOST]; // free, of the species, in D0
} TransientSettings;

enum { TRANSIENT_DIRECTIONS = 4 };
extern const char *const transient_direction[TRANSIENT_DIRECTIONS]; // of displacements

typedef struct Transient Transient;

// The plane and the structure must outlive the correlators.
Status transient_create(Transient **out, const Plane *plane, const Direct *direct,
                        const TransientSettings *settings);
void transient_free(Transient *transient);
// Bytes, about.
size_t transient_memory(double cutoff, double spacing, size_t species,
                        const TransientSettings *settings);

Status transient_advance(Transient *transient); // the next time of the grid

double transient_time(const Transient *transient);
double transient_strain(const Transient *transient);
// Phi, a field on the plane for each entry of the matrix, [a][b][size of the plane].
const double *transient_collective(const Transient *transient);
// A field on the plane, NULL if not wanted; NAN.
const double *transient_tagged(const Transient *transient, size_t species);
double transient_displacement(const Transient *transient, size_t species, int direction);

// Saves all of it, or loads it into one created with the same arguments.
void transient_archive(Transient *transient, Archive *archive);
