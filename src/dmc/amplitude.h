// SPDX-License-Identifier: GPL-3.0-or-later
// How far each motion of a body may be tried: one amplitude is given, the others follow from its
// diffusion tensor, so that a free body diffuses along, across and about its axis at one pace
// (Jabbari-Farouji and Trizac, J. Chem. Phys. 137, 054107, 2012: [JT]; Garcia Daza et al.).
#pragma once

#include "dmc/chain.h"

// D_perp/D_par sets the displacement across the axis, D_rot/D_par the rotation: [JT] eq. 9 with
// its ratio turned the right way up, or, for ROTATION_TANGENT, its limit of small steps.
Amplitude amplitude_matched(double parallel, const Diffusion *diffusion,
                            const ChainSettings *settings);

// The smallest `parallel` whose rotation has no such meaning any more (a = 1/2); infinite where
// nothing rotates.
double amplitude_limit(const Diffusion *diffusion, const ChainSettings *settings);

// Means over the trials of a free body, all of which are accepted: what a MoveTally counts, and
// what is lost of the second Legendre polynomial.
typedef struct FreeMove {
    MoveSquares squares;
    double second; // 1 - <P2(u'.u)>
} FreeMove;

FreeMove amplitude_free_move(const Amplitude *amplitude, int dimension,
                             const ChainSettings *settings);
