// SPDX-License-Identifier: GPL-3.0-or-later
// Correlators in time: collective Phi_ab(q, t), those of tagged particles and their mean squared
// displacements, for Brownian short-time dynamics, over any number of decades (Weysser, thesis, eqs
// 3.2-3.6 and 3.20-3.23); and the master curve of their final decay.
#pragma once

#include "mct/grid.h"
#include "oz/oz.h"

#include <stdbool.h>

typedef struct CorrelatorSettings {
    size_t block; // points of a block of the doubling grid, a multiple of 4; 0: 128
    double diffusion[MIXTURE_SPECIES_MOST]; // free, of the species, in D0
    bool tagged;                            // also tagged particles
    double
        shear_rate; // of the isotropically sheared model, one species and none tagged; 0: at rest
} CorrelatorSettings;

typedef struct Correlators Correlators;

// `structure` is at the wave numbers of the grid, which must outlive the correlators.
Status correlators_create(Correlators **out, const Grid *grid, const Structure *structure,
                          const CorrelatorSettings *settings);

// The master curve of the alpha decay at the transition, Phi -> form - amplitude t^b for t -> 0,
// with the fields of a CriticalPoint.
Status correlators_create_master(Correlators **out, const Grid *grid, const Structure *structure,
                                 const double *form, const double *amplitude, double b);
void correlators_free(Correlators *correlators);

// The next time of the grid.
Status correlators_advance(Correlators *correlators);

double correlators_time(const Correlators *correlators);
const double *correlators_collective(const Correlators *correlators); // [pair][stride of the grid]
const double *correlators_self(const Correlators *correlators);       // [species][stride]; NULL
const double *correlators_displacement(const Correlators *correlators); // [species]; NULL
size_t correlators_evaluations(const Correlators *correlators);         // of the kernel
