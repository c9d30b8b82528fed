// SPDX-License-Identifier: GPL-3.0-or-later
// Monte Carlo of single-particle moves. As dynamic Monte Carlo, with a calibrated clock, its time
// is that of Brownian dynamics (Jabbari-Farouji and Trizac, J. Chem. Phys. 137, 054107, 2012;
// Garcia Daza, Puertas, Cuetos and Patti); without a clock it brings a suspension to equilibrium.
// The propagators are propagator_dynamic_monte_carlo and propagator_monte_carlo; packing uses the
// chain.
#pragma once

#include "dmc/chain.h"
