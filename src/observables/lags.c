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
    Lags lags = {.spacing = round_up(round_up(longest, origins) / origins, step)};
    const int64_t far = SPACINGS_FAR * lags.spacing, within_step = clock->whole_steps ? step : 1;
    const double ratio = pow(10, 1 / (double)per_decade);
    const double before_last = (double)longest / sqrt(ratio); // no near twin of the longest lag
    for (double lag = (double)shortest; lag < before_last; lag *= ratio) {
        // One whole step is always among the lags: it is where Brownian motion begins.
        if (lags.count && lags.ticks[lags.count - 1] < step && lag > (double)step) {
            append(&lags, step);
        }
        append(&lags, round_near(lag, lag < (double)step  ? within_step
                                      : lag < (double)far ? step
                                                          : lags.spacing));
    }
    append(&lags, round_near((double)longest, longest < step ? within_step : lags.spacing));
    while (lags.count > 1 && lags.ticks[lags.count - 1] > clock->ticks) lags.count--;
    for (size_t k = 0; k < lags.count; k++) lags.phase[k] = lags.ticks[k] % lags.spacing;
    lags.slots = (size_t)round_up(lags.ticks[lags.count - 1], lags.spacing) / lags.spacing;
    return lags;
}

static int64_t next_of_waits(const Lags *lags, int64_t after) {
    int64_t next = INT64_MAX;
    for (size_t w = 0; w < lags->waits; w++) {
        const int64_t wait = lags->wait[w];
        if (wait > after && wait < next) next = wait;
        for (size_t k = 0; k < lags->count; k++) {
            if (wait + lags->ticks[k] <= after) continue;
            if (wait + lags->ticks[k] < next) next = wait + lags->ticks[k];
            break;
        }
    }
    return next;
}

static int64_t next_of_many(const Lags *lags, int64_t after) {
    if (after < 0) return 0;
    const int64_t origin = after - after % lags->spacing; // the last
    int64_t next = origin + lags->spacing;
    for (size_t k = 0; k < lags->count && lags->ticks[k] < next; k++) {
        const int64_t end = origin + lags->phase[k]; // of the lag from the origin or an earlier one
        if (end > after && end < next && end >= lags->ticks[k]) next = end;
    }
    return next;
}

int64_t lags_next(const Lags *lags, const Clock *clock, int64_t after) {
    const int64_t next = lags->waits > 0 ? next_of_waits(lags, after) : next_of_many(lags, after);
    return next <= clock->ticks ? next : INT64_MAX;
}

// The steady shear rate of the stage, in the clock's unit of time; 0 without.
static double steady_rate(const Clock *clock) {
    return clock->drive ? fabs(clock->drive->flow.rate) : 0;
}

static OptionReals waits_chosen(const LagSettings *settings, const Clock *clock) {
    const double rate = steady_rate(clock);
    if (settings->waiting_strain.count == 0 || rate == 0) return settings->waiting_times;
    OptionReals waits = settings->waiting_strain;
    for (int64_t w = 0; w < waits.count; w++) waits.values[w] /= rate;
    return waits;
}

// Whole steps after the stage began; a time within a step of the one before is left out.
static void add_waits(Lags *lags, const OptionReals *times, const Clock *clock) {
    for (int64_t w = 0; w < times->count; w++) {
        const double steps = times->values[w] / (clock->tick * (double)clock->ticks_per_step);
        const int64_t wait = (int64_t)rint(steps) * clock->ticks_per_step;
        if (lags->waits > 0 && wait <= lags->wait[lags->waits - 1]) continue;
        lags->wait[lags->waits++] = wait;
    }
    lags->slots = lags->waits;
}

Lags lags_chosen(const LagSettings *settings, const Clock *clock) {
    const OptionReals waits = waits_chosen(settings, clock);
    const bool many = waits.count == 0;
    // Lags from one origin need not end at another.
    const int64_t origins = many ? settings->origins : clock->ticks;
    Lags lags = lags_of(clock, settings->first, settings->last, settings->per_decade, origins);
    if (!many) add_waits(&lags, &waits, clock);
    lags.by_strain = settings->waiting_strain.count > 0;
    return lags;
}

// In what they are given in: times, or strains of a steady flow.
static Status check_waits(const char *observable, const LagSettings *settings, const Clock *clock) {
    const bool strains = settings->waiting_strain.count > 0;
    const OptionReals *waits = strains ? &settings->waiting_strain : &settings->waiting_times;
    const char *word = strains ? "strain" : "time";
    const double end = clock->tick * (double)clock->ticks * (strains ? steady_rate(clock) : 1);
    for (int64_t w = 0; w < waits->count; w++) {
        if (w > 0 && !(waits->values[w] > waits->values[w - 1])) {
            return status_fail(BAD_DATA, "%s: waiting %ss must ascend, but %g follows %g",
                               observable, word, waits->values[w], waits->values[w - 1]);
        }
        if (!(waits->values[w] < end)) {
            return status_fail(BAD_DATA,
                               "%s: a waiting %s of %g is not within the stage '%s' of %g%s%s; "
                               "make the stage longer or the %s shorter",
                               observable, word, waits->values[w], clock->stage, end,
                               strains ? "" : " ", strains ? "" : clock->unit, word);
        }
    }
    return OK;
}

static Status check_strains(const char *observable, const LagSettings *settings,
                            const Clock *clock) {
    if (settings->waiting_strain.count == 0) return OK;
    if (settings->waiting_times.count > 0)
        return status_fail(BAD_DATA,
                           "%s: waiting_times and waiting_strain are two ways to say the same; "
                           "give one",
                           observable);
    if (steady_rate(clock) > 0) return OK;
    return status_fail(BAD_DATA,
                       "%s: waiting_strain needs a steady shear_rate, which the stage '%s' does "
                       "not have; give waiting_times",
                       observable, clock->stage);
}

Status lags_check(const char *observable, const LagSettings *settings, const Clock *clock) {
    const double time = clock->tick * (double)clock->ticks;
    const double last = settings->last > 0 ? settings->last : time / 3;
    TRY(check_strains(observable, settings, clock));
    TRY(check_waits(observable, settings, clock));
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

// Of the last waiting time, which leaves the least room.
void lags_describe(const LagSettings *settings, const Clock *clock, Text *lines) {
    const Lags lags = lags_chosen(settings, clock);
    if (lags.waits == 0) return;
    const int64_t wait = lags.wait[lags.waits - 1], room = clock->ticks - wait;
    size_t seen = 0;
    while (seen < lags.count && lags.ticks[seen] <= room) seen++;
    if (seen == lags.count) return;
    // A longest lag of a third of the stage grows with it.
    const int64_t longest = lags.ticks[lags.count - 1];
    const int64_t needed = wait + (settings->last > 0 ? longest : (wait + 1) / 2);
    const double rate = steady_rate(clock);
    text_add(lines,
             "%zu of %zu lags have no value where the waiting %s is %.6g: ", lags.count - seen,
             lags.count, lags.by_strain ? "strain" : "time",
             (double)wait * clock->tick * (lags.by_strain ? rate : 1));
    text_add(lines, "they end after the stage; make it %.6g %s long", (double)needed * clock->tick,
             clock->unit);
    if (rate > 0) text_add(lines, " (a strain of %.6g)", (double)needed * clock->tick * rate);
    text_add(lines, ", or times.last %.6g at most\n", (double)room * clock->tick);
}

void lags_times(const Lags *lags, const Clock *clock, double *times) {
    for (size_t k = 0; k < lags->count; k++) times[k] = (double)lags->ticks[k] * clock->tick;
}

size_t lags_axes(const Lags *lags, const Clock *clock, double *values, ResultAxis *axes) {
    size_t count = 0;
    if (lags->waits > 0) {
        const double unit = lags->by_strain ? clock->tick * steady_rate(clock) : clock->tick;
        for (size_t w = 0; w < lags->waits; w++) values[w] = (double)lags->wait[w] * unit;
        axes[count++] = (ResultAxis){.name = lags->by_strain ? "waiting_strain" : "waiting_time",
                                     .unit = lags->by_strain ? "" : clock->unit,
                                     .count = lags->waits,
                                     .values = values};
    }
    double *times = values + lags->waits;
    lags_times(lags, clock, times);
    axes[count++] =
        (ResultAxis){.name = "time", .unit = clock->unit, .count = lags->count, .values = times};
    return count;
}
