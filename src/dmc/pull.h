// SPDX-License-Identifier: GPL-3.0-or-later
// Trials of the particle that a constant force pulls (Garcia Daza, Puertas, Cuetos and Patti,
// active microrheology by dynamic Monte Carlo: [GD]), and what a free one gains by them.
//
// A uniform trial of half-widths d is accepted as Metropolis has it, the work of the force counted
// as energy. A drifted trial is normal about D F t with the variance 2 D t of its time t, which is
// that of a uniform one, d^2/3: the ratio of going there and back cancels the work, so that a free
// particle accepts every trial and drifts and diffuses exactly, however far it goes at a time.
#pragma once

#include "rng/rng.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ChainPull {
    size_t particle;
    int axis;             // of the force
    double force;         // in kT/d
    bool drifted;         // else uniform
    double along, across; // half-widths d on the axis and on the others, in d
} ChainPull;

typedef struct PullTrial {
    double shift[3]; // in d
    double thermal;  // rise of energy that passes without the force, in kT
    double afforded; // the same with it: the trial is accepted if the energy rises by less
} PullTrial;

// The tracer is tried once in every cycle of `count` trials, before the first of them, and not
// where the chain draws it among the others: a random number of trials would add to how far drift
// spreads.
static inline bool pull_is_due(const ChainPull *pull, int64_t k, size_t count) {
    return pull && k % (int64_t)count == 0;
}

// How many trials from number k on, of the particles `who` & `mask`, are others' and in its cycle;
// 0: number k is drawn for the tracer. At most `most`; all if none is pulled.
size_t pull_calm(const ChainPull *pull, int64_t k, size_t count, const uint32_t *who, uint32_t mask,
                 size_t most);

// The tracer's trial before number k of the chain: a pure function of (key, k).
PullTrial pull_trial(const ChainPull *pull, RngKey key, int64_t k, int dimension);

// Of a free particle and uniform trials, exactly, for f = F d/kT >= 0: mean displacement over d,
// and acceptance. For small f these are f/6 (1 - 3 f/8 ...) and 1 - f/4.
double pull_drift(double f);
double pull_acceptance(double f);
