// SPDX-License-Identifier: GPL-3.0-or-later
// Suspensions of bodies with an axis to try chains on: put in at random while small, grown by
// rescaling, and looked through for overlaps pair by pair.
#pragma once

#include "dmc/chain.h"

// One species of the shape with `diameter` 1.
System bodies_system(ShapeKind shape, double length, int64_t particles, double number_density);

// Bodies in all directions that do not overlap at `scale` times their sizes. Aborts after many
// attempts.
State *bodies_state(const System *system, RngKey key, double scale);

// The same at full size: runs the chain with steps that suit, growing the bodies whenever they fit.
State *bodies_grown(const System *system, RngKey key);

// Pairs of the State that overlap at `scale` times their sizes: each looked at, in plain doubles.
size_t bodies_overlaps(const State *state, double scale);
