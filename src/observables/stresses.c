// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses from exchanged momentum.
#include "observables/stresses.h"

const char *const stress_names[STRESSES_MOST] = {
    "shear_stress", "normal_stress_difference", "mean_pressure", "second_normal_stress_difference"};

const char *stress_unit(int dimension) {
    return dimension == 2 ? "kT/d^2" : "kT/d^3";
}

void stresses_of(const double exchange[3][3], double kinetic, const Box *box, double flight,
                 double stresses[STRESSES_MOST]) {
    const double volume = box_volume(box), scale = 1 / (volume * flight);
    double trace = 0;
    for (int a = 0; a < box->dimension; a++) trace += exchange[a][a];
    stresses[0] = -scale * exchange[0][1];
    stresses[1] = scale * (exchange[1][1] - exchange[0][0]);
    stresses[2] = kinetic / volume + scale * trace / (double)box->dimension;
    stresses[3] = box->dimension == 2 ? 0 : scale * (exchange[2][2] - exchange[1][1]);
}
