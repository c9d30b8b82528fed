// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and units as physicists write them.
#pragma once

#include "base/text.h"
#include "results/results.h"

// 5.123(4): the error, in brackets, in units of the last digits. It is rounded to one or two
// digits by the rule of the Particle Data Group (Review of Particle Physics, introduction,
// "Rounding"). Without an error (one replica) six digits of the value; "-" for no number.
void notation_estimate(Text *text, Estimate estimate);

// A unit or symbol in typeset form: d^2/D0 becomes d²/D₀, sqrt(m/kT) becomes √(m/kT),
// 1/d becomes d⁻¹.
void notation_unit(Text *text, const char *unit);

// A name in words: long_time_diffusion becomes "long time diffusion".
void notation_name(Text *text, const char *name);
