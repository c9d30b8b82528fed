// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of the theory under the names and axes of the observables of a simulation. Inside theory/
// only.
#pragma once

#include "oz/oz.h"
#include "theory/theory.h"

// What series mean is in results/series.def.

// Series on the axes pair and wave_number, values [pair][count].
Status put_pairs(Results *results, const TheoryPlan *plan, const char *name,
                 const double *wave_number, size_t count, const double *values);
// On species and wave_number, values [species][count].
Status put_species(Results *results, const TheoryPlan *plan, const char *name,
                   const double *wave_number, size_t count, const double *values);
// Pair distributions at contact and the pressure that follows from them, unless the closed form has
// none.
Status put_contacts(Results *results, const TheoryPlan *plan, const Structure *structure);
Status put_curve(Results *results, const char *name, const char *unit_of_time, const double *time,
                 size_t count, const double *values);
// Stresses against shear rates.
Status put_rates(Results *results, const char *name, const TheoryPlan *plan, const double *rate,
                 size_t count, const double *stress);

// Correlators as they were kept, [time][pair or species][wave number].
typedef struct Kept {
    size_t waves, times, times_most;
    double wave_number[OPTION_LIST_SIZE];
    size_t index[OPTION_LIST_SIZE];                     // of the wave numbers on the grid
    double start[MIXTURE_PAIRS_MOST][OPTION_LIST_SIZE]; // S_ab, what the correlators begin at
    const char *unit_of_time;
    double *time;
    double *collective, *self, *displacement; // self and displacement NULL: none
} Kept;
Status put_kept(Results *results, const TheoryPlan *plan, const Kept *kept, const char *collective);
// Collective correlators over what they begin at: collective_scattering_normalised.
Status put_normalised(Results *results, const TheoryPlan *plan, const Kept *kept);
