// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of analysis_derive, one for each kind of series, and what they share.
#pragma once

#include "numerics/jackknife.h"
#include "results/results.h"
#include "state/system.h"

#include <stdbool.h>
#include <stdint.h>

// The shape of a series that is made of another: its axes and its unit. A name that begins with '_'
// stands behind that of the other. The sentence is that of series.def until it is given.
ResultSeries derive_shape(const ResultSeries *of, const char *name);

// Rows of a series are counted over its first `axes` axes. The row of `other` at the same species,
// wave number and so on as a row of `series`; NO_ROW if there is none.
#define NO_ROW SIZE_MAX
size_t derive_same_row(const ResultSeries *series, size_t row, const ResultSeries *other,
                       size_t axes);
// Whether all rows of `series` have one in `other`.
bool derive_has_rows(const ResultSeries *series, const ResultSeries *other, size_t axes);

// Whether a stage flows unsteadily, as its correlators tell: then nothing in it is stationary.
bool derive_unsteady(const Results *results, const char *stage);
// Whether a force along this direction drives the stage; NULL: along any.
bool derive_forced(const Results *results, const char *stage, const char *direction);

Status derive_diffusion(Results *results, const ResultSeries *displacement);
Status derive_directional_diffusion(Results *results, const ResultSeries *displacement);
Status derive_diffusion_across_flow(Results *results, const ResultSeries *displacement);
Status derive_relaxation(Results *results, const ResultSeries *correlation);
// These two add a series, so that the one given is no longer valid afterwards.
Status derive_free_displacement(Results *results, const ResultSeries *displacement,
                                const System *system);
Status derive_free_bodies(Results *results, const ResultSeries *series, const System *system);
Status derive_contact(Results *results, const ResultSeries *distribution);
Status derive_compression(Results *results, const ResultSeries *compression, const System *system);
// Likewise.
Status derive_drift(Results *results, const ResultSeries *blocks);
Status derive_structure_peak(Results *results, const ResultSeries *stretches);
Status derive_structure_change(Results *results, const ResultSeries *structure);
Status derive_factorisation(Results *results, const ResultSeries *scattering);
// The free diffusion of the centre of mass in D0, and functions without it.
double centre_diffusion(const System *system);
Status derive_centred(Results *results, const ResultSeries *scattering, const char *name,
                      double diffusion);
Status derive_shift(Results *results, const ResultSeries *scattering);
Status derive_scaled(Results *results, const ResultSeries *scattering);
Status derive_against_strain(Results *results, const ResultSeries *scattering);
Status derive_kohlrausch(Results *results, const ResultSeries *scattering);
Status derive_normalised_scattering(Results *results, const ResultSeries *ends);
Status derive_centred_scattering(Results *results, const ResultSeries *ends);
Status derive_normalised_advected(Results *results, const ResultSeries *scattering);
Status derive_exponent(Results *results, const ResultSeries *displacement);
Status derive_transient(Results *results, const ResultSeries *waited);
Status derive_non_gaussian(Results *results, const ResultSeries *quartic, const System *system);
Status derive_start_up(Results *results, const ResultSeries *stress);
Status derive_harmonics(Results *results, const ResultSeries *moduli);
Status derive_contact_stress(Results *results, const ResultSeries *series, const System *system);
Status derive_contact_angles(Results *results, const ResultSeries *series);
Status derive_viscosity(Results *results, const ResultSeries *wandering, const System *system);
Status derive_moduli(Results *results, const ResultSeries *wandering, const System *system);
Status derive_friction(Results *results, const ResultSeries *passage);
Status derive_friction_limits(Results *results, const ResultSeries *passage, const System *system);
Status derive_susceptibility(Results *results, const ResultSeries *square, const System *system);
