// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of state of hard discs and spheres.
#include "state/equation_of_state.h"

#include "base/constants.h"
#include "numerics/pade.h"

#include <math.h>

static const Body disc = {.shape = SHAPE_DISC, .diameter = 1};
static const Body sphere = {.shape = SHAPE_SPHERE, .diameter = 1};

static double square(double x) {
    return x * x;
}
static double cube(double x) {
    return x * x * x;
}

// sum of coefficients[k] x^k
static double polynomial(const double *coefficients, int degree, double x) {
    double sum = 0;
    for (int k = degree; k >= 0; k--) sum = sum * x + coefficients[k];
    return sum;
}

double equation_henderson(double eta) {
    return (1 + eta * eta / 8) / square(1 - eta);
}

double equation_baus_colot(double eta) {
    // (1 + sum c_k eta^k)/(1 - eta)^2. The thesis prints c_1 for what is c_2 = 0.128; c_1 = 0.
    static const double c[] = {1, 0, 0.1280, 0.0018, -0.0507, -0.0533, -0.0410};
    return polynomial(c, 6, eta) / square(1 - eta);
}

double equation_discs_resummed(double eta) {
    // Z = sum over k of b_k (B2 rho)^(k-1), b_k = B_k/B2^(k-1), B2 rho = 2 eta.
    static const double b[10] = {1,         1,         0.78200443, 0.53223180, 0.33355604,
                                 0.1988425, 0.1148728, 0.0649930,  0.0362193,  0.0199537};
    return pade(b, 4, 5, 2 * eta);
}

double equation_carnahan_starling(double eta) {
    static const double c[] = {1, 1, 1, -1};
    return polynomial(c, 3, eta) / cube(1 - eta);
}

double equation_kolafa(double eta) {
    static const double c[] = {1, 1, 1, -2.0 / 3, -2.0 / 3};
    return polynomial(c, 4, eta) / cube(1 - eta);
}

double equation_disc_mixture(double eta, const double moment[4], double pure) {
    const double likeness = square(moment[1]) / moment[2];
    return (1 - likeness) / (1 - eta) + likeness * pure;
}

double equation_jenkins_mancini(double eta, const double moment[4]) {
    return equation_disc_mixture(eta, moment, equation_henderson(eta));
}

double equation_sphere_mixture(double eta, const double moment[4]) {
    const double first = moment[1] * moment[2] / moment[3];
    const double second = cube(moment[2]) / square(moment[3]);
    const double free = 1 - eta;
    return 1 / free + 3 * first * eta / square(free) +
           second * square(eta) * (3 - eta) / cube(free);
}

static void diameter_moments(const System *system, double moment[4]) {
    moment[0] = 1;
    for (int p = 1; p < 4; p++) moment[p] = system_diameter_moment(system, p);
}

double equation_second_virial(const System *system) {
    // <(d_i + d_j)^dim> over independent pairs: half the excluded volume of each.
    double m[4];
    diameter_moments(system, m);
    const double density = system_number_density(system);
    if (system->dimension == 2) {
        return 1 + density * shape_second_virial(&disc, &disc) * (m[2] + square(m[1])) / 2;
    }
    return 1 + density * shape_second_virial(&sphere, &sphere) * (m[3] + 3 * m[1] * m[2]) / 4;
}

bool equation_of_state_known(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        const int64_t shape = system->species[s].shape;
        if (shape != SHAPE_DISC && shape != SHAPE_SPHERE) return false;
    }
    return true;
}

EquationOfState equation_of_state(const System *system) {
    const double eta = system_packing_fraction(system);
    double m[4];
    diameter_moments(system, m);
    const bool equal = m[2] <= square(m[1]) * (1 + 1e-12);
    if (system->dimension == 2 && equal) {
        return (EquationOfState){equation_discs_resummed(eta), "ten virial coefficients, resummed"};
    }
    if (system->dimension == 2) {
        return (EquationOfState){equation_disc_mixture(eta, m, equation_discs_resummed(eta)),
                                 "Santos, Yuste and Lopez de Haro, from ten virial coefficients"};
    }
    if (equal)
        return (EquationOfState){equation_kolafa(eta),
                                 "Carnahan and Starling, corrected by Kolafa"};
    return (EquationOfState){equation_sphere_mixture(eta, m),
                             "Boublik; Mansoori, Carnahan, Starling, Leland"};
}

double equation_collision_rate(const System *system) {
    // Virial theorem: partners meet with a mean normal velocity of sqrt(pi kT/m).
    const double excess = equation_of_state(system).compressibility_factor - 1;
    return 2 * (double)system->dimension * excess / (sqrt(PI) * system_diameter_moment(system, 1));
}
