// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of state of hard discs and spheres, Z = P V/(N kT), to hold simulations against.
#pragma once

#include "state/system.h"

// Equal discs at packing fraction eta.
double henderson(double eta); // Henderson, Mol. Phys. 30, 971 (1975)
double
baus_colot(double eta); // Baus & Colot, Phys. Rev. A 36, 3912 (1987); Weysser, thesis, eq. 2.6
double discs_resummed(
    double eta); // Pade [4/5] of B2..B10 of Clisby & McCoy, J. Stat. Phys. 122, 15 (2006)

// Equal spheres.
double carnahan_starling(double eta); // J. Chem. Phys. 51, 635 (1969)
double kolafa(double eta);            // Kolafa's correction of it: Boublik & Nezbeda 1986, eq. 4.46

// Mixtures and polydisperse systems; `moment[p]` is the mean of diameter^p over particles.
double disc_mixture(double eta, const double moment[4],
                    double pure);                           // from Z of equal discs:
                                                            // Santos, Yuste & Lopez de Haro 1999
double jenkins_mancini(double eta, const double moment[4]); // J. Appl. Mech. 54, 27 (1987)
double sphere_mixture(double eta, const double moment[4]);  // Boublik 1970; Mansoori et al. 1971

// 1 + B2 rho of the mixture: the dilute limit.
double second_virial(const System *system);

// The best of these for a system, and which it is.
typedef struct EquationOfState {
    double compressibility_factor;
    const char *name;
} EquationOfState;

EquationOfState equation_of_state(const System *system);
