// SPDX-License-Identifier: GPL-3.0-or-later
// Fixed points x = map(x) by Anderson's mixing: the combination of the last iterations whose
// residuals cancel best.
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct Anderson Anderson;

Status anderson_create(Anderson **out, size_t size, size_t depth);
void anderson_free(Anderson *anderson);
void anderson_restart(Anderson *anderson); // forgets what came before

// From x and its image to the next x, in place of x.
void anderson_mix(Anderson *anderson, double *x, const double *image);
