// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of balls for one instruction set; balls_kernel.h has it.
#include "dmc/balls_kernel.h"

BALLS_KERNEL(avx512)
