// SPDX-License-Identifier: GPL-3.0-or-later
// Logarithmic lags on a grid of time origins.
#include "observables/lags.h"

#include <math.h>

static int64_t between(int64_t value, int64_t least, int64_t most) {
    return value < least ? least : value > most ? most : value;
}

static int64_t whole_ticks(const Clock *clock, double time) {
    return between((int64_t)rint(fmin(time / clock->tick, 9e18)), 1, clock->ticks);
}

static int64_t round_up(int64_t value, int64_t unit) {
    return (value + unit - 1) / unit * unit;
}

static int64_t round_near(double value, int64_t unit) {
    return (int64_t)rint(value / (double)unit) * unit;
}

static void append(Lags *lags, int64_t tick) {
    const int64_t before = lags->count ? lags->ticks[lags->count - 1] : 0;
    if (tick > before && lags->count < LAGS_MOST) lags->ticks[lags->count++] = tick;
}

Lags lags_of(const Clock *clock, double first, double last, int64_t per_decade, int64_t origins) {
    const int64_t step = clock->ticks_per_step;
    const int64_t shortest = first > 0 ? whole_ticks(clock, first) : 1;
    const int64_t longest =
        last > 0 ? whole_ticks(clock, last) : between(clock->ticks / 3, 1, clock->ticks);
    Lags lags = {.spacing = round_up(between(longest / origins, 1, longest), step)};
    const double ratio = pow(10, 1 / (double)per_decade);
    for (double lag = (double)shortest; lag <= (double)longest * (1 + 1e-9); lag *= ratio) {
        // One whole step is always among the lags: it is where Brownian motion begins.
        if (lags.count && lags.ticks[lags.count - 1] < step && lag > (double)step) {
            append(&lags, step);
        }
        const int64_t unit = lag < (double)step           ? 1
                             : lag < (double)lags.spacing ? step
                                                          : lags.spacing;
        append(&lags, round_near(lag, unit));
    }
    append(&lags, round_near((double)longest, longest < step ? 1 : lags.spacing));
    while (lags.count > 1 && lags.ticks[lags.count - 1] > clock->ticks) lags.count--;
    lags.slots = (size_t)between(lags.ticks[lags.count - 1] / lags.spacing, 1, INT64_MAX);
    return lags;
}

int64_t lags_next(const Lags *lags, const Clock *clock, int64_t after) {
    if (after < 0) return 0;
    const int64_t origin = after / lags->spacing * lags->spacing;
    int64_t next = origin + lags->spacing;
    for (size_t k = 0; k < lags->count && lags->ticks[k] < lags->spacing; k++) {
        if (origin + lags->ticks[k] <= after) continue;
        next = origin + lags->ticks[k];
        break;
    }
    return next <= clock->ticks ? next : INT64_MAX;
}

void lags_ending(const Lags *lags, int64_t tick, size_t *begin, size_t *end) {
    const bool at_origin = lags_is_origin(lags, tick);
    *begin = *end = 0;
    for (size_t k = 0; k < lags->count; k++) {
        const int64_t lag = lags->ticks[k];
        const bool ends =
            at_origin ? lag >= lags->spacing && lag <= tick : lag == tick % lags->spacing;
        if (ends && *begin == *end) *begin = k;
        if (ends) *end = k + 1;
    }
}
