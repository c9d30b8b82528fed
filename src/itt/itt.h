// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the theory under shear: what the section `itt` of a run file says, and the calculation
// of it, in slices, into Results with the names and axes that the observables of a simulation have.
#pragma once

#include "base/archive.h"
#include "base/option.h"
#include "results/results.h"
#include "theory/theory.h"

#include <stdbool.h>

typedef struct IttPlan {
    bool given;                          // false: no run of this theory
    int64_t structure;                   // a Closure
    TheoryInput input;                   // of CLOSURE_MEASURED
    double packing_fraction, separation; // one of them: separation is phi/phi_c - 1
    double spacing, last_wave_number;
    double shear_rate;  // in D0/d^2
    double last_strain; // where the calculation ends
    int64_t block;
    int64_t tagged;
    OptionReals wave_numbers; // of the correlators kept
    double first_time;
    int64_t times_per_decade;
    size_t species_count; // 0: equal discs
    TheorySpecies species[MIXTURE_SPECIES_MOST];
} IttPlan;

extern const OptionTable itt_options;

void itt_complete(IttPlan *plan);      // what follows from other keys: a file is a structure
Status itt_check(const IttPlan *plan); // BAD_DATA with a sentence
// Likewise, whether files that are read are there and fit, with their checksum, 0 of a closure.
Status itt_check_input(const IttPlan *plan, uint32_t *checksum);
MeasurementsInput itt_input(const IttPlan *plan); // of a measured structure
size_t itt_memory(const IttPlan *plan);
double itt_seconds(const IttPlan *plan); // rough
const char *itt_structure_name(const IttPlan *plan);

typedef struct Itt Itt;
// From the structure that the plan asks for: `measured`, which is borrowed, where it is of files.
Status itt_create(Itt **out, const IttPlan *plan, const Measured *measured);
void itt_free(Itt *itt);

// A slice of the work: mostly below a second. Results are put in as they come.
Status itt_advance(Itt *itt, Results *results);
bool itt_finished(const Itt *itt);
double itt_progress(const Itt *itt);   // 0 to 1
const char *itt_doing(const Itt *itt); // "transients"
double itt_time(const Itt *itt);       // since shear began, in d^2/D0

// While the transients go on they can be saved. Loaded into one of the same plan that has just been
// created, the steps before are done again, and what follows has the bits of a run never stopped.
bool itt_can_save(const Itt *itt);
void itt_save(Itt *itt, Archive *archive);
Status itt_load(Itt *itt, Results *results, Archive *archive);
