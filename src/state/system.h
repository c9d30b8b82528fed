// SPDX-License-Identifier: GPL-3.0-or-later
// The suspension as the run file describes it: a plain value, before any particle exists.
// Lengths in d, masses in units of the reference mass m, kT = 1.
#pragma once

#include "base/option.h"
#include "base/status.h"
#include "box/box.h"
#include "shapes/diffusion.h"

#include <stddef.h>
#include <stdint.h>

enum { SPECIES_MOST = 16, NAME_SIZE = 32 };

typedef enum SpreadKind { SPREAD_NONE, SPREAD_GAUSSIAN, SPREAD_UNIFORM, SPREADS } SpreadKind;

// How packing begins.
typedef enum StartKind { START_COMPRESSED, START_CRYSTAL, STARTS } StartKind;

typedef struct Species {
    char name[NAME_SIZE];
    int64_t shape;       // ShapeKind
    double diameter;     // mean, in d
    double length;       // of the cylinder of a spherocylinder, without caps, in d
    double exponent;     // of a soft sphere
    Diffusion diffusion; // as the run file gives it; 0: built in
    double mass;         // in m: D_a = thermostat_interval kT/(2 m_a)
    int64_t count;       // of its particles; 0: by its fraction
    double fraction;     // of the particles of all species without a count, by number
    int64_t spread;      // SpreadKind of the diameters
    double spread_width; // standard deviation over mean diameter (polydispersity)
} Species;

typedef struct System {
    int64_t dimension; // 2 or 3
    int64_t particles;
    double packing_fraction; // 0 when number_density is given
    double number_density;   // in d^-dimension; 0 when packing_fraction is given
    OptionReals aspect;      // edge ratios of the box; empty: all edges equal
    int64_t start;           // StartKind
    size_t species_count;
    Species species[SPECIES_MOST];
} System;

extern const OptionTable system_options;  // scalar keys of `system:`
extern const OptionTable species_options; // keys of one entry of `system.species:`
extern const char *const spread_names[SPREADS + 1];
extern const char *const start_names[STARTS + 1];

// How many particles of each species: its count, or the largest remainders of fraction * (what the
// counts leave), summing exactly.
void system_counts(const System *system, size_t counts[SPECIES_MOST]);

// BAD_DATA with a sentence if counts and fractions do not share out all particles, some to each.
Status system_check_counts(const System *system);

Body species_body(const Species *species); // of the mean size
bool system_is_oriented(const System *system);

// Of a free particle, in kT/(eta d): what the run file gives, the rest built in.
Diffusion species_diffusion(const Species *species);
// BAD_DATA with a sentence if some species has no diffusion tensor to base a clock on.
Status system_check_diffusion(const System *system);
// The unit of times, d^2/D0, has this D0: that of the first species, mean over directions.
double system_reference_diffusion(const System *system);

double system_mean_volume(const System *system); // per particle, spread included, in d^dimension
double system_packing_fraction(const System *system); // whichever of the two was given
double system_number_density(const System *system);   // in d^-dimension
Box system_box(const System *system);

// Mean of diameter^power over particles, spread included; power 1, 2 or 3 (both kinds of spread are
// symmetric, so these depend on the width alone).
double system_diameter_moment(const System *system, int power);
