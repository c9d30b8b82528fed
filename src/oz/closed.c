// SPDX-License-Identifier: GPL-3.0-or-later
// Structures in closed form. Percus-Yevick spheres: Lebowitz, Phys. Rev. 133, A895 (1964), as
// Baxter factorised it, J. Chem. Phys. 52, 4559 (1970); Verlet & Weis, Phys. Rev. A 5, 939 (1972);
// fundamental measure discs: Thorneywork et al., Mol. Phys. 116, 3245 (2018); Baus & Colot, Phys.
// Rev. A 36, 3912 (1987).
#include "oz/inside.h"

#include "base/constants.h"
#include "numerics/quadrature.h"

#include <gsl/gsl_sf_bessel.h>

#include <complex.h>
#include <math.h>

enum { RADII = 64 }; // points of quadrature over a core; enough for the wave numbers of theory

// Sums over species of the densities times powers of the diameter, times pi/6.
static double moment(const Structure *s, int power) {
    double sum = 0;
    for (size_t a = 0; a < s->mixture.species; a++)
        sum += s->mixture.fraction[a] * pow(s->mixture.diameter[a], power);
    return PI / 6 * s->density * sum;
}

// Baxter's factor function of pair ab, a polynomial on [(R_a - R_b)/2, (R_a + R_b)/2], transformed:
// Q_ab(q) = delta_ab - 2 pi sqrt(rho_a rho_b) int dr exp(iqr) Q_ab(r).
static double complex baxter_factor(const Structure *s, size_t a, size_t b, double q) {
    const Mixture *mixture = &s->mixture;
    const double size = mixture->diameter[a], void_fraction = 1 - moment(s, 3);
    const double contact = mixture_contact(mixture, a, b);
    const double slope = 1 / void_fraction + 3 * size * moment(s, 2) / pow(void_fraction, 2);
    const double offset = -1.5 * size * size * moment(s, 2) / pow(void_fraction, 2);
    double r[RADII], weight[RADII];
    quadrature_legendre(RADII, (size - mixture->diameter[b]) / 2, contact, r, weight);
    double complex sum = 0;
    for (size_t i = 0; i < RADII; i++) {
        const double value =
            slope / 2 * (r[i] * r[i] - contact * contact) + offset * (r[i] - contact);
        sum += weight[i] * value * (cos(q * r[i]) + I * sin(q * r[i]));
    }
    const double density = s->density * sqrt(mixture->fraction[a] * mixture->fraction[b]);
    return (a == b) - 2 * PI * density * sum;
}

// delta_ab - sqrt(rho_a rho_b) c_ab = sum_c Q_ca(-q) Q_cb(q).
static void spheres_at(Structure *s, size_t i) {
    const Mixture *mixture = &s->mixture;
    double complex factor[MIXTURE_SPECIES_MOST][MIXTURE_SPECIES_MOST];
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = 0; b < mixture->species; b++)
            factor[a][b] = baxter_factor(s, a, b, s->wave_number[i]);
    }
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = a; b < mixture->species; b++) {
            double complex sum = 0;
            for (size_t c = 0; c < mixture->species; c++) sum += conj(factor[c][a]) * factor[c][b];
            const double density = s->density * sqrt(mixture->fraction[a] * mixture->fraction[b]);
            s->direct[mixture_pair(mixture->species, a, b) * s->count + i] =
                ((a == b) - creal(sum)) / density;
        }
    }
}

void closed_spheres(Structure *s) {
    const Mixture *mixture = &s->mixture;
    const double void_fraction = 1 - moment(s, 3);
    for (size_t i = 0; i < s->count; i++) spheres_at(s, i);
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = a; b < mixture->species; b++) {
            const double reduced = mixture->diameter[a] * mixture->diameter[b] /
                                   (mixture->diameter[a] + mixture->diameter[b]);
            s->contact[mixture_pair(mixture->species, a, b)] =
                1 / void_fraction + 3 * moment(s, 2) * reduced / pow(void_fraction, 2);
        }
    }
}

// c(q) of equal Percus-Yevick spheres of diameter 1: the transform of -(c0 + c1 r + c3 r^3).
static double sphere_direct(double f, double q) {
    const double c0 = -pow(1 + 2 * f, 2) / pow(1 - f, 4),
                 c1 = 6 * f * pow(1 + f / 2, 2) / pow(1 - f, 4);
    double r[RADII], weight[RADII], sum = 0;
    quadrature_legendre(RADII, 0, 1, r, weight);
    for (size_t i = 0; i < RADII; i++)
        sum += weight[i] * r[i] * r[i] * gsl_sf_bessel_j0(q * r[i]) *
               (c0 + c1 * r[i] + f / 2 * c0 * pow(r[i], 3));
    return 4 * PI * sum;
}

// S(q; f) = S_PY(q (f_w/f)^(1/3); f_w) with f_w = f - f^2/16.
void closed_verlet_weis(Structure *s) {
    const double f = s->packing_fraction, effective = f - f * f / 16;
    const double diameter = s->mixture.diameter[0] * cbrt(effective / f);
    for (size_t i = 0; i < s->count; i++) {
        s->direct[i] = pow(diameter, 3) * sphere_direct(effective, s->wave_number[i] * diameter);
    }
    s->contact[0] = NAN;
}

// The Percus-Yevick-like c(q) of fundamental measure theory in two dimensions.
static double fundamental_direct(double f, double q) {
    const double j0 = gsl_sf_bessel_J0(q / 2), j1 = gsl_sf_bessel_J1(q / 2), v = 1 - f;
    const double square = 1.25 * v * v * q * q;
    return PI / (6 * v * v * v * q * q) *
           (-square * j0 * j0 + (4 * ((f - 20) * f + 7) + square) * j1 * j1 +
            2 * (f - 13) * v * q * j1 * j0);
}

void closed_fundamental(Structure *s) {
    const double d = s->mixture.diameter[0];
    for (size_t i = 0; i < s->count; i++)
        s->direct[i] = d * d * fundamental_direct(s->packing_fraction, s->wave_number[i] * d);
    s->contact[0] = NAN;
}

// Z(f) = sum_n c_n f^n/(1 - f)^2 (Weysser, thesis, eq. 2.6 with its indices put right), and the
// inverse compressibility X = d(f Z)/df.
static double baus_colot(double f, double *inverse_compressibility) {
    static const double c[] = {1, 0, 0.128, 0.0018, -0.0507, -0.0533, -0.0410};
    double sum = 0, slope = 0;
    for (int n = 6; n >= 0; n--) {
        slope = slope * f + sum;
        sum = sum * f + c[n];
    }
    const double z = sum / pow(1 - f, 2);
    *inverse_compressibility = z + f * (slope / pow(1 - f, 2) + 2 * sum / pow(1 - f, 3));
    return z;
}

// -c(r)/X inside the core: the overlap of two discs of diameter a.
static double baus_colot_shape(double a, double f, double r) {
    const double x = r / a;
    return 1 - a * a * f + a * a * f * 2 / PI * (acos(x) - x * sqrt(1 - x * x));
}

static double baus_colot_transform(double a, double f, double q) {
    double r[RADII], weight[RADII], sum = 0;
    quadrature_legendre(RADII, 0, 1, r, weight);
    for (size_t i = 0; i < RADII; i++)
        sum += weight[i] * r[i] * gsl_sf_bessel_J0(q * r[i]) * baus_colot_shape(a, f, r[i]);
    return 2 * PI * sum;
}

// The diameter a for which the compressibility is that of the equation of state: by bisection.
static double baus_colot_diameter(double f, double x) {
    double low = 1, high = 2;
    const double density = 4 * f / PI;
    const double wanted = (x - 1) / (density * x);
    const int sign = baus_colot_transform(low, f, 0) > wanted ? 1 : -1;
    for (int step = 0; step < 60; step++) {
        const double middle = (low + high) / 2;
        if (sign * (baus_colot_transform(middle, f, 0) - wanted) > 0)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

void closed_baus_colot(Structure *s) {
    double x;
    const double f = s->packing_fraction, d = s->mixture.diameter[0], z = baus_colot(f, &x);
    const double a = baus_colot_diameter(f, x);
    for (size_t i = 0; i < s->count; i++)
        s->direct[i] = -x * d * d * baus_colot_transform(a, f, s->wave_number[i] * d);
    s->contact[0] = (z - 1) / (2 * f);
}
