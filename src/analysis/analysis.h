// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers from results: what needs a fit, an extrapolation or a theory. It reads the series that
// observers gave, whether fresh or from results.h5, and adds scalars (and series) per replica
// beside them, so that their errors are over replicas like all others.
#pragma once

#include "protocol/plan.h"
#include "results/results.h"
#include "state/system.h"

// For every stage that has the series:
//   short_time_diffusion, long_time_diffusion, long_time_window   of mean_squared_displacement
//   free_displacement, a series: 2 dim D0 t of each species        of the same
//   long_time_diffusion_parallel, _perpendicular, _along_director, _across_director and windows
//   free_diffusion_parallel, _perpendicular                       of the same
//   free_directional_displacement, a series                       of directional_displacement
//   relaxation_time_P1, relaxation_time_P2, orientation_plateau
//   free_orientation_correlation, a series                        of orientation_correlation
//   contact_value_A_B, compressibility_factor_contact             of contact_distribution
//   compressibility_factor_compression, pressure_compression      of virtual_compression
//   structure_peak, a series, and structure_peak_wave_number      of structure_factor_stretches
//   structure_peak_drift, pressure_drift, energy_drift, bond_order_local_drift, _global_drift
//                                                                 of these in blocks
//   collective_scattering_normalised, a series   of collective_scattering and its _ends
//   OBSERVABLE_relaxation_time and OBSERVABLE_kohlrausch_amplitude, _time, _exponent, _window and
//   _scan, series                        of self_scattering and collective_scattering_normalised
//   OBSERVABLE_plateau, _fall, _factorisation_X, _factorisation_Y, _factorisation_spread,
//   _factorisation_window, _scaled and, after a stage with another unit of time, _time_shift,
//   series                                                                   of the same two
//   non_gaussian_parameter, a series     of squared_displacement and quartic_displacement
//   four_point_susceptibility, a series                           of overlap and overlap_square
//   overshoot_strain, _stress, _height    of stress against strain, where there is an overshoot
//   third_harmonic, fifth_harmonic        of stress_harmonics
//   tracer_velocity, effective_friction, _earlier, _later          of tracer_passage
//   friction_weak, friction_strong, friction_weak_contact, friction_strong_contact: theory of the
//   same, equal spheres only
//   shear_stress_contact, normal_stress_difference_contact, pressure_contact   of contact_stress,
//   in space second_normal_stress_difference_contact too
//   contact_angle, a series                                        of contact_directions
//   zero_shear_viscosity and _window; viscosity and moduli_at_rest, series   of stress_wandering
// With several species, diffusion is given for all particles and, with _NAME, for each species.
Status analysis_derive(Results *results, const System *system);

// Of event-driven Brownian stages at rest: self_scattering_centred and
// collective_scattering_centred, functions about the centre of mass, and all that is made of
// scattering functions for them. After analysis_derive.
Status analysis_centre(Results *results, const Plan *plan);

// compressibility_factor_theory and pressure_theory, by the equation of state of hard discs or
// spheres, of the stages at rest that measured a pressure in some way.
Status analysis_equation(Results *results, const Plan *plan);

// Whether the stages at rest were in equilibrium: the scalar relaxation_share, a fact "equilibrium
// of STAGE" in words and, among the health, bond_order_of_STAGE and structure_peak_rise_of_STAGE.
// After both.
Status analysis_judge(Results *results, const Plan *plan);

// Of the quantities of many states over an axis of packing fractions (campaign/combine.h), for each
// OBSERVABLE_relaxation_time:
//   OBSERVABLE_critical_packing_fraction, _critical_exponent, _critical_misfit   gamma free
//   OBSERVABLE_critical_packing_fraction_at, a series over exponents             gamma given
//   OBSERVABLE_critical_scan, a series over the first packing fraction used
// of OBSERVABLE_scaled:  OBSERVABLE_scaled_spread, over scaled times
// of OBSERVABLE_plateau: OBSERVABLE_plateau_critical, _plateau_amplitude
// and of shear_stress over an axis of shear rates:
//   yield_stress, flow_curve_amplitude, flow_curve_exponent        the exponent free
//   yield_stress_at, a series over exponents                       the exponent given
Status analysis_derive_sweep(Results *results);
