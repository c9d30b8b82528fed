// SPDX-License-Identifier: GPL-3.0-or-later
// Goes through the results and derives what can be.
#include "analysis/analysis.h"

#include "analysis/derive.h"
#include "state/equation_of_state.h"

#include <stdio.h>
#include <string.h>

// What is made of a series of this name: a row after the other, with the system or without.
static const struct {
    const char *observable;
    Status (*alone)(Results *results, const ResultSeries *series);
    Status (*with)(Results *results, const ResultSeries *series, const System *system);
    size_t axes_most; // 0: any
} derivations[] = {
    // With an axis of waiting times: what ages has no coefficient.
    {"mean_squared_displacement", .alone = derive_diffusion, .axes_most = 3},
    {"mean_squared_displacement", .with = derive_free_displacement, .axes_most = 3},
    {"mean_squared_displacement_centred", .alone = derive_diffusion, .axes_most = 3},
    {"directional_displacement", .alone = derive_directional_diffusion},
    {"directional_displacement", .with = derive_free_bodies},
    {"orientation_correlation", .alone = derive_relaxation},
    {"orientation_correlation", .with = derive_free_bodies},
    {"contact_distribution", .alone = derive_contact},
    {"virtual_compression", .with = derive_compression},
    {"structure_factor_stretches", .alone = derive_structure_peak},
    {"structure_peak", .alone = derive_drift},
    {"energy", .alone = derive_drift},
    {"bond_order", .alone = derive_drift},
    {"pressure", .alone = derive_drift},
    {"self_scattering", .alone = derive_factorisation},
    {"self_scattering", .alone = derive_kohlrausch},
    {"self_scattering", .alone = derive_scaled},
    {"self_scattering", .alone = derive_against_strain},
    {"self_scattering", .alone = derive_shift},
    {"self_scattering", .alone = derive_transient},
    {"non_affine_displacement", .alone = derive_diffusion_across_flow},
    {"non_affine_displacement", .alone = derive_exponent},
    {"non_affine_displacement", .alone = derive_transient},
    {"non_affine_displacement_centred", .alone = derive_diffusion_across_flow},
    {"non_affine_displacement_centred", .alone = derive_exponent},
    {"non_affine_displacement_centred", .alone = derive_transient},
    {"advected_scattering", .alone = derive_normalised_advected},
    {"advected_scattering_normalised", .alone = derive_kohlrausch},
    {"advected_scattering_normalised", .alone = derive_against_strain},
    {"advected_scattering_normalised", .alone = derive_transient},
    {"collective_scattering_ends", .alone = derive_normalised_scattering},
    {"collective_scattering_about_centre_ends", .alone = derive_centred_scattering},
    {"collective_scattering_normalised", .alone = derive_factorisation},
    {"collective_scattering_normalised", .alone = derive_kohlrausch},
    {"collective_scattering_normalised", .alone = derive_scaled},
    {"collective_scattering_normalised", .alone = derive_shift},
    {"self_scattering_centred", .alone = derive_factorisation},
    {"self_scattering_centred", .alone = derive_kohlrausch},
    {"self_scattering_centred", .alone = derive_scaled},
    {"self_scattering_centred", .alone = derive_against_strain},
    {"self_scattering_centred", .alone = derive_shift},
    {"self_scattering_centred", .alone = derive_transient},
    {"collective_scattering_centred", .alone = derive_factorisation},
    {"collective_scattering_centred", .alone = derive_kohlrausch},
    {"collective_scattering_centred", .alone = derive_scaled},
    {"collective_scattering_centred", .alone = derive_shift},
    {"planar_structure_factor", .alone = derive_structure_change},
    {"structure_factor_cuts", .alone = derive_structure_change},
    {"quartic_displacement", .with = derive_non_gaussian},
    {"overlap_square", .with = derive_susceptibility},
    {"overlap_square_centred", .with = derive_susceptibility},
    {"stress", .alone = derive_start_up},
    {"stress_harmonics", .alone = derive_harmonics},
    {"contact_stress", .with = derive_contact_stress},
    {"contact_directions", .alone = derive_contact_angles},
    {"stress_wandering", .with = derive_viscosity},
    {"stress_wandering", .with = derive_moduli},
    {"tracer_passage", .alone = derive_friction},
    {"tracer_passage", .with = derive_friction_limits},
};

static Status derive_from(Results *results, size_t index, const System *system) {
    for (size_t i = 0; i < sizeof derivations / sizeof *derivations; i++) {
        const ResultSeries *series = &results->series[index]; // moves when the results grow
        const size_t most = derivations[i].axes_most;
        if (strcmp(series->observable, derivations[i].observable) != 0) continue;
        if (most > 0 && series->axes > most) continue;
        TRY(derivations[i].alone ? derivations[i].alone(results, series)
                                 : derivations[i].with(results, series, system));
    }
    return OK;
}

static Status put_equation(Results *results, const char *stage, const System *system) {
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

Status analysis_equation(Results *results, const Plan *plan) {
    static const char *const PRESSURES[] = {"pressure", "contact_distribution",
                                            "virtual_compression"};
    if (!equation_of_state_known(&plan->system)) return OK;
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Stage *stage = &plan->stages[s];
        bool measured = false;
        for (size_t i = 0; i < sizeof PRESSURES / sizeof *PRESSURES; i++)
            measured = measured || results_find_series(results, stage->name, PRESSURES[i]);
        const bool driven = drive_kinds(&stage->drive) != 0; // out of equilibrium
        if (measured && !driven) TRY(put_equation(results, stage->name, &plan->system));
    }
    return OK;
}

Status analysis_derive(Results *results, const System *system) {
    for (size_t i = 0; i < results->series_count; i++) TRY(derive_from(results, i, system));
    return OK;
}

static Status centre(Results *results, const System *system, const char *stage,
                     const char *observable, const char *name) {
    const ResultSeries *scattering = results_find_series(results, stage, observable);
    if (!scattering || scattering->axes < 2) return OK;
    const size_t added = results->series_count;
    TRY(derive_centred(results, scattering, name, centre_diffusion(system)));
    return added < results->series_count ? derive_from(results, added, system) : OK;
}

Status analysis_centre(Results *results, const Plan *plan) {
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Clock clock = plan_clock(plan, s);
        if (!clock.thermostatted || clock.drive) continue;
        TRY(centre(results, &plan->system, clock.stage, "self_scattering",
                   "self_scattering_centred"));
        TRY(centre(results, &plan->system, clock.stage, "collective_scattering_normalised",
                   "collective_scattering_centred"));
    }
    return OK;
}
