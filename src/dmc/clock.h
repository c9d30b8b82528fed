// SPDX-License-Identifier: GPL-3.0-or-later
// What a Monte Carlo cycle (N trials) is worth in time.
//
// Free diffusion gives a trial the time parallel^2/(6 D_parallel) at acceptance 1. Interactions
// slow that down: by the acceptance A (acceptance-rescaling, "VA"), or by what is left of the mean
// squared displacement, per attempt or after a whole cycle (diffusion-matching, "VD"). Measured
// while the chain runs; the time of a tick is the same for all replicas, and the number of trials
// made in it follows from the measurement.
#pragma once

#include "dmc/chain.h"

typedef enum ClockKind { CLOCK_ACCEPTANCE, CLOCK_MATCHING, CLOCKS } ClockKind;

// What diffusion is matched.
typedef enum MatchedMotion {
    MATCH_PARALLEL,
    MATCH_PERPENDICULAR,
    MATCH_ROTATIONAL,
    MATCHES
} MatchedMotion;

// The displacement per attempt, or after one whole cycle, which contains back-scattering and is the
// letter of the paper.
typedef enum MatchedSpan { MATCH_PER_CYCLE, MATCH_PER_ATTEMPT, SPANS } MatchedSpan;

typedef struct ClockSettings {
    int64_t kind;   // ClockKind
    int64_t motion; // MatchedMotion
    int64_t span;   // MatchedSpan
} ClockSettings;

// Fills all amplitudes of a species from its amplitude along the body axis and its diffusion
// tensor; eqs 8, 9 (corrected) of Jabbari-Farouji and Trizac.
Amplitude amplitude_matched(double parallel, const Diffusion *diffusion,
                            const ChainSettings *chain);

// BAD_DATA with a sentence where rotations would have no meaning (a >= 1/2).
Status amplitude_check(double parallel, const Diffusion *diffusion, const ChainSettings *chain);
