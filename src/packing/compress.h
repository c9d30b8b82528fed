// SPDX-License-Identifier: GPL-3.0-or-later
// Slow compression of bodies by Monte Carlo: the sizes grow while the bodies move. Internal to
// packing.
#pragma once

#include "packing/packing.h"

// How the sizes grow beyond those asked for, so that contacts open when they are set back.
static const double COMPRESS_MARGIN = 1e-10;

// Bodies at places where they do not overlap at `scale` times their sizes: turns their axes at
// random, and brings them to their sizes.
Status compress_bodies(State *state, RngKey key, double scale, const atomic_int *stop,
                       PackingReport *report);
