// SPDX-License-Identifier: GPL-3.0-or-later
// Errors by leaving out.
#pragma once

#include <stddef.h>

// The jackknife's pseudo-value of a replica (Efron, SIAM monograph 38, 1982), from a number found
// with all `replicas` and without this one; of a single replica, the number itself. Of two, that of
// the other: what the jackknife takes off as bias would be noise, of the size of the error at
// least.
static inline double pseudo_value(size_t replicas, double all, double without) {
    if (replicas < 3) return replicas < 2 ? all : without;
    return (double)replicas * all - (double)(replicas - 1) * without;
}
