// SPDX-License-Identifier: GPL-3.0-or-later
// Free diffusion coefficients. Rods: the slender-body expansion of a surface of revolution with
// radius (d/2) h(x) at x half-lengths from its middle, h = (1 - x^16)^(1/16) being a cylinder with
// rounded ends; with h = sqrt(1 - x^2) it is that of the prolate ellipsoid.
#include "shapes/diffusion.h"

#include "base/constants.h"

#include <math.h>

// (p + 1) times the integral of x^p ln h(x) from 0 to 1, for p = 0 and 2. The series of ln h sums
// to
// -(psi(1 + (p + 1)/16) + gamma)/16, with the digamma function and Euler's constant.
static const double MEAN_LOG_FOR_TRANSLATION = -0.0061476359275892809;
static const double MEAN_LOG_FOR_ROTATION = -0.0170135634288520252;

static Diffusion rod_diffusion(const Body *body) {
    const double length = body->length + body->diameter;
    const double slender = log(4 * length / body->diameter);
    const double translation = slender - MEAN_LOG_FOR_TRANSLATION;
    const double rotation = slender - MEAN_LOG_FOR_ROTATION;
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
