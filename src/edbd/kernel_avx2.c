// SPDX-License-Identifier: GPL-3.0-or-later
// The window kernel for one instruction set; kernel.h has it.
#include "edbd/kernel.h"

ENGINE_KERNEL(avx2)
