// SPDX-License-Identifier: GPL-3.0-or-later
// Goes through the results and derives what can be.
#include "analysis/analysis.h"

#include "analysis/derive.h"
#include "state/equation_of_state.h"

#include <stdio.h>
#include <string.h>

Status derive_theory(Results *results, const char *stage, const System *system) {
    if (!equation_of_state_known(system)) return OK;
    const EquationOfState theory = equation_of_state(system);
    const double pressure = system_number_density(system) * theory.compressibility_factor;
    const char *unit = system->dimension == 2 ? "kT/d^2" : "kT/d^3";
    char of_factor[RESULT_TEXT], of_pressure[RESULT_TEXT];
    snprintf(of_factor, sizeof of_factor, "P V/(N kT) of the equation of state: %s.", theory.name);
    snprintf(of_pressure, sizeof of_pressure, "P of the equation of state: %s.", theory.name);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(results_put_scalar(results, stage, "compressibility_factor_theory", "", of_factor,
                               replica, theory.compressibility_factor));
        TRY(results_put_scalar(results, stage, "pressure_theory", unit, of_pressure, replica,
                               pressure));
    }
    return OK;
}

static Status derive_from(Results *results, const ResultSeries *series, const System *system) {
    const char *observable = series->observable;
    if (strcmp(observable, "mean_squared_displacement") == 0) {
        if (series->axes > 3) return OK; // of waiting times: what ages has no coefficient
        TRY(derive_diffusion(results, series));
        return derive_free_displacement(results, series, system);
    }
    if (strcmp(observable, "directional_displacement") == 0) {
        TRY(derive_directional_diffusion(results, series));
        return derive_free_bodies(results, series, system);
    }
    if (strcmp(observable, "orientation_correlation") == 0) {
        TRY(derive_relaxation(results, series));
        return derive_free_bodies(results, series, system);
    }
    if (strcmp(observable, "contact_distribution") == 0) {
        TRY(derive_contact(results, series));
        return derive_theory(results, series->stage, system);
    }
    if (strcmp(observable, "virtual_compression") == 0) {
        TRY(derive_compression(results, series, system));
        return derive_theory(results, series->stage, system);
    }
    if (strcmp(observable, "energy") == 0 || strcmp(observable, "bond_order") == 0) {
        return derive_drift(results, series);
    }
    if (strcmp(observable, "pressure") == 0) {
        TRY(derive_drift(results, series));
        return derive_theory(results, series->stage, system);
    }
    if (strcmp(observable, "self_scattering") == 0 ||
        strcmp(observable, "collective_scattering_normalised") == 0) {
        const ResultSeries scattering = *series; // each adds series, which moves those there are
        TRY(derive_kohlrausch(results, &scattering));
        TRY(derive_factorisation(results, &scattering));
        return derive_scaled(results, &scattering);
    }
    if (strcmp(observable, "planar_structure_factor") == 0 ||
        strcmp(observable, "structure_factor_cuts") == 0) {
        return derive_structure_change(results, series);
    }
    if (strcmp(observable, "collective_scattering_ends") == 0) {
        return derive_normalised_scattering(results, series);
    }
    if (strcmp(observable, "quartic_displacement") == 0) {
        return derive_non_gaussian(results, series, system);
    }
    if (strcmp(observable, "contact_stress") == 0) {
        return derive_contact_stress(results, series, system);
    }
    if (strcmp(observable, "contact_directions") == 0) {
        return derive_contact_angles(results, series);
    }
    if (strcmp(observable, "stress_wandering") == 0) {
        return derive_viscosity(results, series, system);
    }
    if (strcmp(observable, "overlap_square") == 0) {
        return derive_susceptibility(results, series, system);
    }
    return OK;
}

Status analysis_derive(Results *results, const System *system) {
    for (size_t i = 0; i < results->series_count; i++) {
        TRY(derive_from(results, &results->series[i], system));
    }
    return OK;
}
