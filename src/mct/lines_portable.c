// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over lines of wave numbers for one instruction set; lines_kernel.h has them.
#include "mct/lines_kernel.h"

LINES_KERNEL(portable)
