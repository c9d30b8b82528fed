// SPDX-License-Identifier: GPL-3.0-or-later
// Transient correlators of equal discs after shear has been switched on at t = 0 (Weysser, thesis,
// chapter 5): Phi_q(t) of density fluctuations at q and, at time t, at the advected q(t) =
// (q_x, q_y - rate t q_x), in all directions; likewise of a tagged particle; mean squared
// displacements. Over any number of decades of time. A rate of 0 is rest.
#pragma once

#include "base/archive.h"
#include "itt/direct.h"
#include "itt/plane.h"

#include <stdbool.h>

typedef struct TransientSettings {
    double shear_rate; // in D0/d^2
    size_t block;      // points of a block of the doubling grid of times, a multiple of 4; 0: 64
    bool tagged;       // also a tagged particle
} TransientSettings;

enum { TRANSIENT_DIRECTIONS = 4 };
extern const char *const transient_direction[TRANSIENT_DIRECTIONS]; // of displacements

typedef struct Transient Transient;

// The plane and the structure must outlive the correlators.
Status transient_create(Transient **out, const Plane *plane, const Direct *direct,
                        const TransientSettings *settings);
void transient_free(Transient *transient);
// Bytes, about.
size_t transient_memory(double cutoff, double spacing, const TransientSettings *settings);

Status transient_advance(Transient *transient); // the next time of the grid

double transient_time(const Transient *transient);
double transient_strain(const Transient *transient);
const double *transient_collective(const Transient *transient); // a field on the plane
const double *transient_tagged(const Transient *transient);     // NULL if not wanted
double transient_displacement(const Transient *transient, int direction);

// Saves all of it, or loads it into one created with the same arguments.
void transient_archive(Transient *transient, Archive *archive);
