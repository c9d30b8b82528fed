// SPDX-License-Identifier: GPL-3.0-or-later
// density_block.h for the instruction set that this file is named for.
#include "observables/density_block.h"

void density_block_portable(const DensityModes *modes, double *real, double *imaginary) {
    density_block(modes, real, imaginary);
}
