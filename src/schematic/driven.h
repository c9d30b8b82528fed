// SPDX-License-Identifier: GPL-3.0-or-later
// F12 under shear that varies in time (Weysser, thesis, eqs 6.8-6.11): Phi(t, s) for all beginnings
// s and the stress sigma(t) = int_0^t rate(s) v_sigma Phi^2(t, s) ds of shear that begins at t = 0.
// The grid of beginnings is uniform over a period; that of ages doubles until it meets it, so that
// short times are resolved as finely as wanted at the cost of a few blocks.
#pragma once

#include "schematic/f12.h"
#include "schematic/strain.h"

#include <stddef.h>

typedef struct DrivenSettings {
    F12 model;
    Strain strain;
    size_t moments; // times of a period, at least 8
    size_t periods; // how many
    size_t block;   // points of a block of ages while their grid doubles, a multiple of 4
} DrivenSettings;

typedef struct Driven Driven;

Status driven_create(Driven **out, const DrivenSettings *settings);
void driven_free(Driven *driven);
void driven_advance(Driven *driven); // the next age
bool driven_finished(const Driven *driven);

double driven_age(const Driven *driven);
double driven_correlator(const Driven *driven, size_t moment); // Phi(s + age, s) of this beginning

size_t driven_count(const Driven *driven);          // times with a stress: moments x periods
double driven_time(const Driven *driven, size_t i); // ascending, from the first moment after 0
double driven_strain(const Driven *driven, size_t i);
double driven_stress(const Driven *driven, size_t i); // known once all ages up to its time are

// What an age costs, in multiplications: to say how far it is.
double driven_share(const Driven *driven);

// Of the stress over the last period of an oscillation: sigma = sum over n of storage sin(n omega
// t)
// + loss cos(n omega t).
typedef struct Harmonic {
    double storage, loss;
} Harmonic;
Harmonic driven_harmonic(const Driven *driven, int n);
