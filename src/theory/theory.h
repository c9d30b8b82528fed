// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the theory: what the section `theory` of a run file says, and the calculation of it, in
// slices, into Results with the names and axes that the observables of a simulation have.
#pragma once

#include "base/option.h"
#include "oz/measured.h"
#include "results/results.h"
#include "theory/measurements.h"

#include <stdbool.h>

enum { THEORY_NAME_SIZE = 32 };

typedef struct TheorySpecies {
    char name[THEORY_NAME_SIZE];
    double diameter, fraction;
    double diffusion; // free, in D0
} TheorySpecies;

// What can be calculated: bits of `calculate`.
typedef enum TheoryPart {
    THEORY_STRUCTURE,
    THEORY_FORMS,
    THEORY_CRITICAL,
    THEORY_EXPONENTS,
    THEORY_CORRELATORS,
    THEORY_BETA,
    THEORY_MASTER,
    THEORY_FLOW_CURVE,
    THEORY_PARTS
} TheoryPart;

// Where a measured structure comes from.
typedef struct TheoryInput {
    char file[OPTION_TEXT_SIZE];  // "": none
    char stage[OPTION_TEXT_SIZE]; // "": the only one
    int64_t groups;               // of replicas, left out in turn for errors; 1: no errors
} TheoryInput;

typedef struct TheoryPlan {
    int64_t dimension;
    int64_t structure;                   // a Closure
    TheoryInput input;                   // of CLOSURE_MEASURED
    double packing_fraction, separation; // one of them: separation is phi/phi_c - 1
    int64_t wave_numbers;
    double last_wave_number;
    uint64_t calculate;                // bits 1 << TheoryPart
    char search_key[OPTION_TEXT_SIZE]; // of the transition; "": packing fraction
    double search_low, search_high;
    OptionReals correlator_wave_numbers;
    double first_time, last_time;
    int64_t times_per_decade, block;
    double beta_shear;            // c (shear rate t_sigma)^2
    double first_rate, last_rate; // of the flow curve of the isotropically sheared model
    int64_t rates_per_decade;
    size_t species_count; // 0: no theory run
    TheorySpecies species[MIXTURE_SPECIES_MOST];
} TheoryPlan;

extern const OptionTable theory_options;
extern const OptionTable theory_species_options;

// Species of any theory: a fraction left out is what the others leave; BAD_DATA with a sentence if
// they leave none.
void theory_complete_species(TheorySpecies *species, size_t count);
Status theory_check_species(const TheorySpecies *species, size_t count);
Mixture theory_mixture_of(int dimension, const TheorySpecies *species, size_t count);

void theory_complete(TheoryPlan *plan);      // what follows from other keys: a fraction left out
Status theory_check(const TheoryPlan *plan); // BAD_DATA with a sentence
// Likewise, whether files that are read are there and fit; which is told apart by their checksum, 0
// of a closure.
Status theory_check_input(const TheoryPlan *plan, uint32_t *checksum);
MeasurementsInput theory_input(const TheoryPlan *plan); // of a measured structure
size_t theory_memory(const TheoryPlan *plan);
double theory_seconds(const TheoryPlan *plan); // rough
const char *theory_structure_name(const TheoryPlan *plan);

typedef struct Theory Theory;
// From the structure that the plan asks for: `measured`, which is borrowed, where it is of files.
Status theory_create(Theory **out, const TheoryPlan *plan, const Measured *measured);
void theory_free(Theory *theory);

// A slice of the work: mostly below a second. Results are put in as they come.
Status theory_advance(Theory *theory, Results *results);
bool theory_finished(const Theory *theory);
double theory_progress(const Theory *theory);   // 0 to 1
const char *theory_doing(const Theory *theory); // "critical point"
double theory_time(const Theory *theory);       // of the correlators, in d^2/D0; 0 before
