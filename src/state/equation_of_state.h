// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of state of hard discs and spheres, Z = P V/(N kT), to hold simulations against.
#pragma once

#include "state/system.h"

#include <stdbool.h>

// Equal discs at packing fraction eta.
// Henderson, Mol. Phys. 30, 971 (1975).
double equation_henderson(double eta);
// Baus & Colot, Phys. Rev. A 36, 3912 (1987); Weysser, thesis, eq. 2.6.
double equation_baus_colot(double eta);
// Pade approximant [4/5] of the virial coefficients B2 to B10 of Clisby & McCoy, J. Stat. Phys.
// 122, 15 (2006).
double equation_discs_resummed(double eta);

// Equal spheres.
// Carnahan & Starling, J. Chem. Phys. 51, 635 (1969).
double equation_carnahan_starling(double eta);
// Kolafa's correction of it, in Boublik & Nezbeda, Coll. Czech. Chem. Commun. 51, 2301 (1986).
double equation_kolafa(double eta);

// Mixtures and polydisperse systems; `moment[p]` is the mean of diameter^p over particles.
// Discs, from the Z of equal discs: Santos, Yuste & Lopez de Haro, Mol. Phys. 96, 1 (1999).
double equation_disc_mixture(double eta, const double moment[4], double pure);
// Jenkins & Mancini, J. Appl. Mech. 54, 27 (1987): the same with Henderson's Z.
double equation_jenkins_mancini(double eta, const double moment[4]);
// Spheres: Boublik, J. Chem. Phys. 53, 471 (1970); Mansoori et al., J. Chem. Phys. 54, 1523 (1971).
double equation_sphere_mixture(double eta, const double moment[4]);

// 1 + B2 rho of the mixture: the dilute limit.
double equation_second_virial(const System *system);

// The best of these for a system, and which it is.
typedef struct EquationOfState {
    double compressibility_factor;
    const char *name;
} EquationOfState;

EquationOfState equation_of_state(const System *system);
bool equation_of_state_known(const System *system); // hard discs and spheres only

// Collisions per particle and time of flight that this pressure means, each counted for both
// partners, in sqrt(kT/m)/d; of a mixture as if all particles had the mean diameter and mass 1.
double equation_collision_rate(const System *system);
