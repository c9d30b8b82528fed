// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of the correlators of one structure after infinite time.
#pragma once

#include "mct/grid.h"
#include "oz/oz.h"

#include <stdbool.h>

typedef struct Forms {
    bool glass;         // whether anything is left
    size_t count;       // of wave numbers
    double *collective; // F_ab(q), [pair][count]
    double *self;       // of tagged particles, [species][count]
    double
        localisation[MIXTURE_SPECIES_MOST]; // length r_l: dr^2 -> 2 dim r_l^2; infinite in a fluid
} Forms;

Status forms_create(Forms **out, const Grid *grid, const Structure *structure);
void forms_free(Forms *forms);
