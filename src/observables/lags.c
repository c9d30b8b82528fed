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

// Lags beyond so many spacings are rounded to whole spacings, which moves them by 3 % at most.
static const int64_t SPACINGS_FAR = 16;

Lags lags_of(const Clock *clock, double first, double last, int64_t per_decade, int64_t origins) {
    const int64_t step = clock->ticks_per_step;
    const int64_t shortest = first > 0 ? whole_ticks(clock, first) : 1;
    const int64_t longest =
        last > 0 ? whole_ticks(clock, last) : between(clock->ticks / 3, 1, clock->ticks);
    Lags lags = {.spacing = round_up(between(longest / origins, 1, longest), step)};
    const int64_t far = SPACINGS_FAR * lags.spacing;
    const double ratio = pow(10, 1 / (double)per_decade);
    const double before_last = (double)longest / sqrt(ratio); // no near twin of the longest lag
    for (double lag = (double)shortest; lag < before_last; lag *= ratio) {
        // One whole step is always among the lags: it is where Brownian motion begins.
        if (lags.count && lags.ticks[lags.count - 1] < step && lag > (double)step) {
            append(&lags, step);
        }
        append(&lags, round_near(lag, lag < (double)step  ? 1
                                      : lag < (double)far ? step
                                                          : lags.spacing));
    }
    append(&lags, round_near((double)longest, longest < step ? 1 : lags.spacing));
    while (lags.count > 1 && lags.ticks[lags.count - 1] > clock->ticks) lags.count--;
    lags.slots = (size_t)round_up(lags.ticks[lags.count - 1], lags.spacing) / lags.spacing;
    return lags;
}

int64_t lags_next(const Lags *lags, const Clock *clock, int64_t after) {
    if (after < 0) return 0;
    int64_t next = after - after % lags->spacing + lags->spacing;
    for (size_t k = 0; k < lags->count && lags->ticks[k] < next; k++) {
        const int64_t since = after - lags->ticks[k];
        const int64_t end =
            since < 0 ? lags->ticks[k] : after - since % lags->spacing + lags->spacing;
        if (end < next) next = end;
    }
    return next <= clock->ticks ? next : INT64_MAX;
}

Lags lags_chosen(const LagSettings *settings, const Clock *clock) {
    return lags_of(clock, settings->first, settings->last, settings->per_decade, settings->origins);
}

Status lags_check(const char *observable, const LagSettings *settings, const Clock *clock) {
    const double time = clock->tick * (double)clock->ticks;
    const double last = settings->last > 0 ? settings->last : time / 3;
    if (last > time * (1 + 1e-9)) {
        return status_fail(BAD_DATA,
                           "%s: times.last = %g is longer than the stage '%s' of %g %s; make the "
                           "stage longer or the lag shorter",
                           observable, last, clock->stage, time, clock->unit);
    }
    if (settings->first > last) {
        return status_fail(BAD_DATA,
                           "%s: times.first = %g is beyond the longest lag of %g %s; make it "
                           "shorter",
                           observable, settings->first, last, clock->unit);
    }
    if (lags_chosen(settings, clock).count == LAGS_MOST) {
        return status_fail(BAD_DATA,
                           "%s: more than %d lags; make times.per_decade smaller or the range of "
                           "times shorter",
                           observable, LAGS_MOST - 1);
    }
    return OK;
}

void lags_times(const Lags *lags, const Clock *clock, double *times) {
    for (size_t k = 0; k < lags->count; k++) times[k] = (double)lags->ticks[k] * clock->tick;
}
