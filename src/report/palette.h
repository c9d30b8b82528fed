// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that people with any colour vision tell apart (Okabe & Ito, Color Universal Design,
// 2008), without their yellow, too light for lines on white. Curves and species use them in order.
#pragma once

enum { PALETTE_SIZE = 8 };

static const char *const PALETTE[PALETTE_SIZE] = {
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#888888",
};
