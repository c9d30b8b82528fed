// SPDX-License-Identifier: GPL-3.0-or-later
// One equation of motion under shear, for all wave vectors (Weysser, thesis, eqs 5.10 and 5.17):
// dPhi_q/dt + rate_q(t) [Phi_q + int_0^t m_q(t, t') dPhi_q/dt' dt'] = 0, where m_q(t, t') is the
// kernel of lag t - t' read at q(t'). Phi, rate and m are matrices of species, or plain numbers.
// On a grid of times whose spacing doubles from block to block (Fuchs et al., J. Phys.: Condens.
// Matter 3, 5047, 1991); the integral is cut at t/2: over recent times the kernel by its averages
// over intervals times differences of Phi, over early times Phi by its averages times differences
// of the kernel. Inside itt/ only.
#pragma once

#include "base/archive.h"
#include "itt/plane.h"

#include <stdbool.h>

typedef struct Relaxation {
    const Plane *plane;
    size_t species, size;             // of a matrix, all its entries
    size_t block;                     // intervals of a block, even
    double *phi, *memory;             // [block + 1][size], memory by its lag
    double *phi_mean;                 // [block/2 + 1][size]: over interval (i - 1, i)
    double *memory_mean;              // likewise
    double *known, *weight;           // [size]: Phi = known + weight memory jump
    double *jump;                     // [size]: 1 - phi_mean[1]
    double *image, *residue;          // [size]: of the iteration before
    double *part, *inverse, *scratch; // [size]
} Relaxation;

Status relaxation_create(Relaxation *relaxation, const Plane *plane, size_t species, size_t block);
void relaxation_free(Relaxation *relaxation);
size_t relaxation_fields(size_t block); // numbers per wave vector and entry of a matrix

double *relaxation_phi(const Relaxation *relaxation, size_t i);
double *relaxation_memory(const Relaxation *relaxation, size_t i);

// Phi at time i to second order in it, from the kernel at lag 0 and the rates at rest and then.
void relaxation_expand(Relaxation *relaxation, size_t i, double time, const double *rest,
                       const double *rate);
// Averages over interval i from its ends, where they will be asked for.
void relaxation_average(Relaxation *relaxation, size_t i);

// Makes ready for time i with what is known before: extrapolates Phi, adds up the integral. `shear`
// is the strain of one interval.
void relaxation_prepare(Relaxation *relaxation, size_t i, double step, double shear,
                        const double *rate);
// Phi at time i from its kernel, with one slow direction taken out; the largest change.
double relaxation_iterate(Relaxation *relaxation, size_t i, bool first);

// Every second point becomes the older half of the next block.
void relaxation_decimate(Relaxation *relaxation);

// Saves what the next time is found from, or loads it into one of the same plane and block.
void relaxation_archive(Relaxation *relaxation, Archive *archive);
