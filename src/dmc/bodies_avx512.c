// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of bodies for one instruction set; bodies_kernel.h has it.
#include "dmc/bodies_kernel.h"

BODIES_KERNEL(avx512)
