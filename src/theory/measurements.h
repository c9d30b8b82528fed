// SPDX-License-Identifier: GPL-3.0-or-later
// Structure factors that simulations of ours have measured, from their results.h5: of one run, or
// of all that lie in a folder, a packing fraction each.
#pragma once

#include "base/option.h"
#include "oz/measured.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Measurements Measurements;

typedef struct MeasurementsInput {
    const char *path;  // a results.h5, a run directory, or a folder of such, as a sweep makes
    const char *stage; // of the run; "": the only one in which structure_factor was observed
    Mixture mixture;   // diameters and fractions to 1 %
    bool transition;   // is looked for between packing fractions: two at least
} MeasurementsInput;

// BAD_DATA with a sentence if there is none, or of another mixture.
Status measurements_read(Measurements **out, const MeasurementsInput *input);
// The same; keeps nothing but the checksum.
Status measurements_check(const MeasurementsInput *input, uint32_t *checksum);
void measurements_free(Measurements *measurements);

const Mixture *measurements_mixture(const Measurements *measurements);
size_t measurements_replicas(const Measurements *measurements); // of the run with the fewest
// CRC-32C of what was read and can be used: the mixture, then of each run packing fraction, wave
// numbers and the factors of all replicas.
uint32_t measurements_checksum(const Measurements *measurements);

// Smoothed: of all replicas, or without every replica whose number, modulo `groups` > 1, is
// `omitted`.
Status measurements_fit(Measured **out, const Measurements *measurements, size_t groups,
                        size_t omitted);

// Rows of an option table, of a settings struct with such a path and stage.
#define MEASUREMENTS_OPTIONS(Type, path_field, stage_field, groups_field)                          \
    {.name = "structure.file",                                                                     \
     .type = OPTION_TEXT,                                                                          \
     .offset = offsetof(Type, path_field),                                                         \
     .unit = "",                                                                                   \
     .about = "A results.h5, a run directory, or a folder of such with a packing fraction each, "  \
              "as a sweep makes: structure_factor was observed there, best up to 40/d in shells "  \
              "of 0.1. Relative paths begin where perrin is run."},                                \
        {.name = "structure.stage",                                                                \
         .type = OPTION_TEXT,                                                                      \
         .offset = offsetof(Type, stage_field),                                                    \
         .unit = "",                                                                               \
         .about = "The stage whose structure_factor is read; empty: the only one that has it."},   \
    {                                                                                              \
        .name = "structure.groups", .type = OPTION_INTEGER,                                        \
        .offset = offsetof(Type, groups_field), .fallback = 8, .least = 1, .most = 1000,           \
        .unit = "",                                                                                \
        .about = "Replicas fall into so many groups, each of which is left out in turn and the "   \
                 "whole done again: from what then changes follow the errors of all numbers and "  \
                 "curves. It takes so many times longer, and once. 1: no errors.",                 \
    }
