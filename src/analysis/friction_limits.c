// SPDX-License-Identifier: GPL-3.0-or-later
// What theory says of the friction of a sphere pulled through spheres of its size, to be drawn
// beside the simulation: 1 + 2 phi for a vanishing and 1 + phi for an infinite force (Squires and
// Brady, Phys. Fluids 17, 073101, 2005: dilute, without hydrodynamic interactions), and the same
// with the pair distribution at contact, g, by which there are more neighbours in a dense bath. It
// is that of Carnahan and Starling; soft spheres count as hard ones of the diameter of Barker and
// Henderson, the integral of 1 - exp(-r^-n), in which 2 phi is an excluded volume as well.
#include "analysis/derive.h"
#include "state/equation_of_state.h"

#include <math.h>
#include <string.h>

static bool are_equal_spheres(const System *system) {
    const Species *first = &system->species[0];
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        if (species->shape != SHAPE_SPHERE && species->shape != SHAPE_SOFT_SPHERE) return false;
        if (species->shape != first->shape || species->exponent != first->exponent) return false;
        if (species->diameter != first->diameter || species->spread_width > 0) return false;
    }
    return true;
}

// Over the diameter.
static double hard_diameter(const Species *species) {
    return species->shape == SHAPE_SOFT_SPHERE ? tgamma(1 - 1 / species->exponent) : 1;
}

Status derive_friction_limits(Results *results, const ResultSeries *passage, const System *system) {
    if (!are_equal_spheres(system)) return OK;
    char stage[RESULT_NAME];
    strcpy(stage, passage->stage);
    const double hard = hard_diameter(&system->species[0]);
    const double phi = system_packing_fraction(system), eta = phi * hard * hard * hard;
    const double contact = (equation_carnahan_starling(eta) - 1) / (4 * eta);
    const struct {
        const char *quantity;
        double value;
    } limits[] = {
        {"friction_weak", 1 + 2 * phi},
        {"friction_strong", 1 + phi},
        {"friction_weak_contact", 1 + 2 * eta * contact},
        {"friction_strong_contact", 1 + eta * contact},
    };
    for (size_t r = 0; r < results->replicas; r++) {
        for (size_t k = 0; k < sizeof limits / sizeof *limits; k++) {
            TRY(results_put_scalar(results, stage, limits[k].quantity, "", NULL, r,
                                   limits[k].value));
        }
    }
    return OK;
}
