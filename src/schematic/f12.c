// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of F12 in closed form.
#include "schematic/f12.h"

#include <math.h>

bool f12_is_discontinuous(double v2) {
    return v2 > 1;
}

double f12_critical_v1(double v2) {
    return f12_is_discontinuous(v2) ? 2 * sqrt(v2) - v2 : 1;
}

// (1 - f_c)/f_c = 1/(sqrt(v2) - 1)
double f12_v1_at(double v2, double separation) {
    const double unit = f12_is_discontinuous(v2) ? 1 / (sqrt(v2) - 1) : 1;
    return f12_critical_v1(v2) + separation * unit;
}

// The larger root of (v1 + v2 f)(1 - f) = 1, as long as there is one.
double f12_plateau(const F12 *model) {
    const double v1 = model->v1, v2 = model->v2;
    if (v1 < f12_critical_v1(v2)) return 0;
    const double root = sqrt(fmax(0, (v1 + v2) * (v1 + v2) - 4 * v2)); // 0 at the transition
    // The form that does not divide by v2, which may be 0, where v1 > v2.
    const double f = v1 > v2 ? 2 * (v1 - 1) / (root + v1 - v2) : (v2 - v1 + root) / (2 * v2);
    return fmax(f, 0);
}

Status f12_exponents(const F12 *model, Exponents *exponents) {
    if (!f12_is_discontinuous(model->v2))
        return status_fail(BAD_DATA,
                           "v2 = %g: the plateau grows from 0, and the exponents of a plateau that "
                           "comes up at once need v2 > 1",
                           model->v2);
    return exponents_of(1 / sqrt(model->v2), exponents);
}

double f12_shear_coefficient(const F12 *model) {
    const F12 critical = {.v1 = f12_critical_v1(model->v2), .v2 = model->v2};
    const double f = f12_plateau(&critical), rest = (1 - f) * model->critical_strain;
    return 2 * f / (rest * rest);
}

double f12_coupling(const F12 *model, double phi) {
    return (model->v1 + model->v2 * phi) * phi;
}

double f12_strain_decay(const F12 *model, double strain) {
    const double x = strain / model->critical_strain;
    return 1 / (1 + x * x);
}

double f12_modulus_at(const F12 *model, double strain) {
    if (model->softening == 0) return model->modulus;
    const double x = strain / model->softening;
    return model->modulus * (1 - x * x) * exp(-x * x);
}
