// SPDX-License-Identifier: GPL-3.0-or-later
// The plain, slow twin of the chain of bodies: the same proposals, every pair looked at in doubles,
// no list, no cell, no bound.
#pragma once

#include "dmc/bodies.h"

typedef struct ReferenceBodies ReferenceBodies;

// Borrows the state until free, as chain_create.
Status reference_bodies_create(ReferenceBodies **out, const ChainSettings *settings, State *state,
                               RngKey key);
void reference_bodies_free(ReferenceBodies *reference);
void reference_bodies_set_amplitude(ReferenceBodies *reference, size_t species,
                                    const Amplitude *amplitude);
// Makes the trials and brings the State up to date.
void reference_bodies_run(ReferenceBodies *reference, int64_t trials, Tally *tally);
