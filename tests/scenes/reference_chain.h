// SPDX-License-Identifier: GPL-3.0-or-later
// The plain, slow twin of the chain of balls, for the tests and as the measure of the benches.
#pragma once

#include "dmc/chain.h"

extern const ChainKind reference_chain;
