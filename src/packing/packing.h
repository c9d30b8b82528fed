// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a valid State: sizes, species at random on a lattice of swollen-down particles, then growth
// to the wanted density: of discs and spheres while the event-driven dynamics runs (Lubachevsky and
// Stillinger 1990), of bodies with an axis between cycles of Monte Carlo. Or a crystal.
#pragma once

#include "rng/rng.h"
#include "state/state.h"

#include <stdatomic.h>

typedef struct PackingReport {
    double seconds;       // wall time it took
    int64_t windows;      // of the growing dynamics, or cycles of Monte Carlo
    double lattice_scale; // of the diameters at the start
} PackingReport;

// A pure function of (system, key). `stop`, if not NULL, is polled: when it becomes non-zero the
// packing is given up with INTERRUPTED.
Status packing_create(State **out, const System *system, RngKey key, const atomic_int *stop,
                      PackingReport *report);

// BAD_DATA with a sentence if this density cannot be reached from the start asked for.
Status packing_check(const System *system);
