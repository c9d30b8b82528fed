// SPDX-License-Identifier: GPL-3.0-or-later
// Whether what a thread works on is still wanted. Long iterations ask, deep below whoever was told
// to stop; as with sentences of errors, each thread has its own.
#pragma once

#include "base/status.h"

#include <stdatomic.h>

void patience_set(const atomic_int *stop); // ends where this is not 0; NULL: never
Status patience_check(void);               // INTERRUPTED once it has ended
