// SPDX-License-Identifier: GPL-3.0-or-later
// The temperature that velocities have.
#pragma once

#include "state/state.h"

// Of the motion relative to the centre of mass and to the flow, in kT: sum m (v - V)^2/(dim (N -
// 1)). Collisions know relative velocities only, so this is the temperature that sets their rate
// where no thermostat does; Newtonian flight conserves it.
double temperature_relative(const State *state);
