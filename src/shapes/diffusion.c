// SPDX-License-Identifier: GPL-3.0-or-later
// Free diffusion coefficients. Rods: the slender-body expansion of a surface of revolution with
// radius (d/2) h(x) at x half-lengths from its middle, h = (1 - x^16)^(1/16) being a cylinder with
// rounded ends; with h = sqrt(1 - x^2) it is that of the prolate ellipsoid.
#include "shapes/diffusion.h"

#include "base/constants.h"

#include <gsl/gsl_integration.h>
#include <math.h>

enum { POINTS = 200 }; // of Gauss and Legendre: eight digits of ln h, whose singularity is weak

static double log_of_radius(double x) {
    return log1p(-pow(x, 16)) / 16;
}

// (power + 1) times the integral of x^power ln h(x) from 0 to 1.
static double mean_log_of_radius(int power) {
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(POINTS);
    double sum = 0;
    for (size_t i = 0; i < POINTS; i++) {
        double x, weight;
        gsl_integration_glfixed_point(0, 1, i, &x, &weight, table);
        sum += weight * (power + 1) * pow(x, power) * log_of_radius(x);
    }
    gsl_integration_glfixed_table_free(table);
    return sum;
}

static Diffusion rod_diffusion(const Body *body) {
    const double length = body->length + body->diameter;
    const double slender = log(4 * length / body->diameter);
    const double translation = slender - mean_log_of_radius(0);
    const double rotation = slender - mean_log_of_radius(2);
    return (Diffusion){.parallel = (translation - 1.5) / (2 * PI * length),
                       .perpendicular = (translation - 0.5) / (4 * PI * length),
                       .rotational = 3 * (rotation - 11.0 / 6) / (PI * length * length * length)};
}

static Diffusion sphere_diffusion(double diameter) {
    const double translation = 1 / (3 * PI * diameter);
    return (Diffusion){.parallel = translation, .perpendicular = translation};
}

static Diffusion platelet_diffusion(double diameter) {
    return (Diffusion){.parallel = 1 / (8 * diameter),
                       .perpendicular = 3 / (16 * diameter),
                       .rotational = 3 / (4 * diameter * diameter * diameter)};
}

Diffusion shape_diffusion(const Body *body) {
    switch (body->shape) {
    case SHAPE_DISC:
        return (Diffusion){.parallel = 1, .perpendicular = 1};
    case SHAPE_PLATELET:
        return platelet_diffusion(body->diameter);
    case SHAPE_SPHEROCYLINDER:
        return rod_diffusion(body);
    default:
        return sphere_diffusion(body->diameter);
    }
}

double diffusion_mean(const Diffusion *diffusion, int dimension) {
    return (diffusion->parallel + (dimension - 1) * diffusion->perpendicular) / dimension;
}
