// SPDX-License-Identifier: GPL-3.0-or-later
// The stress that collisions carry, as numbers with names. With P_ab the momentum exchanged per
// volume and time of flight (Tally.exchange over V t), sigma_ab = -P_ab: sigma_xy is positive in
// steady shear v_x = rate y with rate > 0. Velocities that are redrawn carry no shear stress; to
// the pressure they add N kT/V.
#pragma once

#include "observables/observables.h"

enum { STRESSES_MOST = 4 };

extern const char *const stress_names[STRESSES_MOST]; // shear stress first

static inline size_t stress_count(int dimension) {
    return dimension == 2 ? 3 : 4;
}

const char *stress_unit(int dimension); // "kT/d^2"

// From what was exchanged over a time of flight; `kinetic` is N kT.
void stresses_of(const double exchange[3][3], double kinetic, const Box *box, double flight,
                 double stresses[STRESSES_MOST]);
