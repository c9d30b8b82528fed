// SPDX-License-Identifier: GPL-3.0-or-later
// A trial is refused if a surface passes another. The number of surfaces passed has the mean
// rho g S <(v.n)+>: g the contact value, S the surface of the excluded body, v the displacement
// where they touch, n the normal there. The chance of passing none, averaged over displacements, is
// nearly exp(-mean + variance/2), the variance being that of |v| at given direction.
#include "dmc/predict.h"

#include "base/constants.h"
#include "dmc/amplitude.h"
#include "state/equation_of_state.h"

#include <math.h>

static const double DENSEST_KNOWN = 0.7; // packing fraction up to which equations of state hold

// Of |D| for displacements uniform in a square or cube of half-width 1, or normal with the same
// variance 1/3 along each axis: mean, and mean square minus its square.
typedef struct Length {
    double mean, variance;
} Length;

static Length displacement_length(int dimension, bool gaussian) {
    static const double mean[2][2] = {{0.7651957164641777, 0.9605919564548167},
                                      {0.7236012545582677, 0.9213177319235613}};
    const double m = mean[gaussian][dimension - 2];
    return (Length){m, dimension / 3.0 - m * m};
}

// Soft spheres stand for hard ones of the diameter of Barker and Henderson, d Gamma(1 - 1/n).
static Body hard_body(const Species *species) {
    Body body = species_body(species);
    if (!shape_is_hard(body.shape)) body.diameter *= tgamma(1 - 1 / body.exponent);
    return body;
}

// Of a convex body, in 3D: surface and integrated mean curvature.
static double surface(const Body *body) {
    if (body->shape == SHAPE_PLATELET) return PI / 2 * body->diameter * body->diameter;
    return PI * body->diameter * (body->diameter + body->length);
}

static double curvature(const Body *body) {
    if (body->shape == SHAPE_PLATELET) return PI * PI / 2 * body->diameter;
    return 2 * PI * body->diameter + PI * body->length;
}

// Surface (perimeter in 2D) of the body that b's centre may not enter, averaged over b's axis.
static double excluded_surface(const Body *a, const Body *b) {
    if (shape_dimension(a->shape) == 2) return PI * (a->diameter + b->diameter);
    return surface(a) + surface(b) + curvature(a) * curvature(b) / (2 * PI);
}

static double share(const System *system, size_t species) {
    return system->species[species].fraction;
}

static double second_virial(const System *system) { // rho B2
    double sum = 0;
    for (size_t a = 0; a < system->species_count; a++) {
        for (size_t b = 0; b < system->species_count; b++) {
            const Body body = hard_body(&system->species[a]),
                       other = hard_body(&system->species[b]);
            sum += share(system, a) * share(system, b) * shape_second_virial(&body, &other);
        }
    }
    return system_number_density(system) * sum;
}

static bool has_shape(const System *system, ShapeKind shape) {
    for (size_t s = 0; s < system->species_count; s++) {
        if (system->species[s].shape == (int64_t)shape) return true;
    }
    return false;
}

// As hard spheres or discs of these sizes.
static double contact_of_balls(const System *system) {
    System hard = *system;
    for (size_t s = 0; s < system->species_count; s++) {
        const Body body = hard_body(&system->species[s]);
        hard.species[s].diameter = body.diameter;
        hard.species[s].shape = system->dimension == 2 ? SHAPE_DISC : SHAPE_SPHERE;
    }
    hard.number_density = 0;
    hard.packing_fraction =
        fmin(system_number_density(system) * system_mean_volume(&hard), DENSEST_KNOWN);
    if (system->dimension == 2) hard.packing_fraction = system_packing_fraction(system);
    return (equation_of_state(&hard).compressibility_factor - 1) /
           (equation_second_virial(&hard) - 1);
}

// The pair distribution at contact, averaged over pairs, from the pressure: (Z - 1)/(rho B2).
static double contact_value(const System *system) {
    // B3/B2^2 of platelets: Eppenga and Frenkel, Mol. Phys. 52, 1303 (1984).
    if (has_shape(system, SHAPE_PLATELET)) return 1 + 0.4447 * second_virial(system);
    if (!has_shape(system, SHAPE_SPHEROCYLINDER)) return contact_of_balls(system);
    // Parsons (1979) and Lee (1987): Z - 1 over that of second virial coefficients depends on the
    // density as for spheres, for which it is the contact value of Carnahan and Starling.
    const double phi = fmin(system_packing_fraction(system), DENSEST_KNOWN);
    return (1 - phi / 2) / pow(1 - phi, 3);
}

// Mean square of the lever of a point of the surface, for rotations about one axis across the
// body's, seen along the normal.
static double lever_square(const Body *body) {
    const double d = body->diameter, length = body->length;
    if (body->shape == SHAPE_PLATELET) return d * d / 8;
    // Cylinder and caps by their surfaces.
    return length * length * (length / 12 + d / 6) / (length + d);
}

// Mean number of surfaces that a trial with amplitude 1 along the axis passes: small rotations.
static double passed(const System *system, size_t species, const ChainSettings *settings) {
    const Body body = hard_body(&system->species[species]);
    const Diffusion diffusion = species_diffusion(&system->species[species]);
    const int dimension = (int)system->dimension;
    const Length length = displacement_length(dimension, settings->gaussian);
    double all_surfaces = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Body other = hard_body(&system->species[s]);
        all_surfaces += share(system, s) * excluded_surface(&body, &other);
    }
    // <|v.n|> of displacements without direction, and how rotations and anisotropy lengthen v.
    const double projected = length.mean * (dimension == 2 ? 2 / PI : 0.5);
    const double across = diffusion.perpendicular / diffusion.parallel;
    double longer = (1 + (dimension - 1) * across) / dimension;
    // A turn of variance 2 D_rot t about each axis across, with parallel^2 = 6 D_par t.
    if (shape_is_oriented(body.shape))
        longer += diffusion.rotational / diffusion.parallel * lever_square(&body);
    return system_number_density(system) * contact_value(system) * all_surfaces / 2 * projected *
           sqrt(longer);
}

static double relative_variance(const System *system, const ChainSettings *settings) {
    const Length length = displacement_length((int)system->dimension, settings->gaussian);
    return length.variance / (length.mean * length.mean);
}

// -ln A = m - v m^2/2, which stops growing at m = 1/v.
double predict_acceptance(const System *system, size_t species, double parallel,
                          const ChainSettings *settings) {
    const double v = relative_variance(system, settings);
    const double m = fmin(parallel * passed(system, species, settings), 1 / v);
    return exp(-m + v * m * m / 2);
}

double predict_step(const System *system, size_t species, double acceptance,
                    const ChainSettings *settings) {
    const double v = relative_variance(system, settings), wanted = -log(acceptance);
    const double m = (1 - sqrt(fmax(0, 1 - 2 * v * wanted))) / v;
    return m / passed(system, species, settings);
}
