// SPDX-License-Identifier: GPL-3.0-or-later
// Structure factors that simulations of ours have measured, from their results.h5: of one run, or
// of all that lie in a folder, a packing fraction each.
#pragma once

#include "oz/measured.h"

typedef struct Measurements Measurements;

// `path`: a results.h5, a run directory, or a folder of run directories such as a sweep makes.
// `stage`: which of a run's stages; "": the only one in which structure_factor was observed.
// BAD_DATA with a sentence if there is none, or if the mixtures are not the same.
Status measurements_read(Measurements **out, const char *path, const char *stage);
void measurements_free(Measurements *measurements);

const Mixture *measurements_mixture(const Measurements *measurements);
size_t measurements_count(const Measurements *measurements);    // of packing fractions
size_t measurements_replicas(const Measurements *measurements); // of the run with the fewest

// Smoothed: of all replicas, or without every replica whose number, modulo `groups` > 1, is
// `omitted`.
Status measurements_fit(Measured **out, const Measurements *measurements, size_t groups,
                        size_t omitted);
