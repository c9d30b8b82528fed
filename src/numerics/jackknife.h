// SPDX-License-Identifier: GPL-3.0-or-later
// Errors by leaving out.
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

// The jackknife's pseudo-value of a replica (Efron, SIAM monograph 38, 1982), from a number found
// with all `replicas` and without this one; of a single replica, the number itself. Of two, that of
// the other: what the jackknife takes off as bias would be noise, of the size of the error at
// least.
static inline double pseudo_value(size_t replicas, double all, double without) {
    if (replicas < 3) return replicas < 2 ? all : without;
    return (double)replicas * all - (double)(replicas - 1) * without;
}

// Of all replicas, values[r * stride], where what was found without each of them stands. What is
// not found without one of them is not told: the mean of the others' pseudo-values would be off.
static inline void pseudo_values(size_t replicas, double all, double *values, size_t stride) {
    bool found = isfinite(all);
    for (size_t r = 0; r < replicas && replicas > 1; r++)
        found = found && isfinite(values[r * stride]);
    for (size_t r = 0; r < replicas; r++) {
        double *value = values + r * stride;
        *value = found ? pseudo_value(replicas, all, *value) : (double)NAN;
    }
}
