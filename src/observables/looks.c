// SPDX-License-Identifier: GPL-3.0-or-later
// Evenly spaced looks.
#include "observables/looks.h"

int64_t looks_period(const Clock *clock, int64_t most) {
    const int64_t steps = clock->ticks / clock->ticks_per_step;
    const int64_t period = steps / most + (steps % most != 0);
    return clock->ticks_per_step * (period < 1 ? 1 : period);
}

int64_t looks_after(const Clock *clock, int64_t period, int64_t after) {
    const int64_t looks_done = after < 0 ? 0 : after / period;
    return looks_done < looks_count(clock, period) ? (looks_done + 1) * period : INT64_MAX;
}

int64_t looks_next(const Observer *observer, int64_t after) {
    return looks_after(&observer->clock, observer->period, after);
}

int64_t looks_count(const Clock *clock, int64_t period) {
    return clock->ticks / period;
}
