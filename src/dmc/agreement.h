// SPDX-License-Identifier: GPL-3.0-or-later
// Whether all species keep one clock after a calibration: what a cycle of each was worth, noted in
// blocks.
#pragma once

#include "state/system.h"

#include <stdbool.h>

enum { AGREEMENT_BLOCKS = 16 };

typedef struct Agreement {
    double cycle[AGREEMENT_BLOCKS][SPECIES_MOST]; // by all blocks up to this, in d^2/D0
} Agreement;

// How far a species' clock is off that of the first one, relative to it; and its standard error.
double agreement_apart(const Agreement *agreement, size_t species);
double agreement_error(const Agreement *agreement, size_t species);

// Are they one clock, within 10 % and what chance explains?
bool agreement_holds(const Agreement *agreement, size_t species);
