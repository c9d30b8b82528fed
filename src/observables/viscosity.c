// SPDX-License-Identifier: GPL-3.0-or-later
// How far the integral of the shear stress wanders at rest: with S(t) the integral of sigma_xy over
// a time t, G(t) = V <S(t)^2>/(2 kT), whose slope dG/dt is Einstein and Helfand's viscosity eta(t)
// (Weysser, thesis, eq. 4.37, with the 1/2 that its second form lacks); analysis takes the slope.
// The stress is that of collisions: velocities which are redrawn carry none of their own.
//
// At rest no direction is marked, so besides sigma_xy the other shear stresses that the tensor has
// in turned frames are squared as well: 2 in the plane, 5 in space, which do not correlate.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/history.h"
#include "observables/put.h"

#include <math.h>
#include <string.h>

typedef struct ViscositySettings {
    LagSettings lags;
} ViscositySettings;

static const Option rows[] = {
    LAG_OPTIONS_OF(ViscositySettings, lags, 10, 256),
};

enum { SHEARS_MOST = 5 };

typedef struct Viscosity {
    Observer observer;
    History history; // of the integrals since the stage began
    double *sums;    // [lag], of mean squares of the integrals over it
} Viscosity;

static size_t shears_of(int dimension) {
    return dimension == 2 ? 2 : SHEARS_MOST;
}

// The integrals of the shear stresses times the volume, in kT and flight time but for their sign.
static void shears_in(const Tally *tally, int dimension, double shears[SHEARS_MOST]) {
    const double(*sum)[3] = tally->exchange;
    shears[0] = sum[0][1];
    shears[1] = (sum[0][0] - sum[1][1]) / 2;
    if (dimension == 2) return;
    shears[2] = sum[0][2];
    shears[3] = sum[1][2];
    shears[4] = (2 * sum[2][2] - sum[0][0] - sum[1][1]) / (2 * sqrt(3));
}

static const LagSettings *lag_settings(const Settings *settings) {
    return &((const ViscositySettings *)settings->bytes)->lags;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    if (!clock->flies) {
        return status_fail(BAD_DATA, "viscosity: Monte Carlo counts no collisions, from which it "
                                     "is measured; use the method event-driven");
    }
    if (!clock->thermostatted) {
        return status_fail(BAD_DATA, "viscosity: Newtonian flight carries momentum that is not "
                                     "counted; use the method event-driven");
    }
    TRY(observer_check_rest("viscosity", "stress or oscillatory_stress", clock));
    return lags_check("viscosity", lag_settings(settings), clock);
}

static void discard(Observer *observer) {
    Viscosity *self = (Viscosity *)observer;
    history_clear(&self->history);
    memory_free(self->sums);
    memory_free(self);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    Viscosity *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_viscosity, .clock = *clock};
    Status status = history_make(&self->history, &lags, shears_of(state->box.dimension));
    if (status == OK) status = NEW_ARRAY(self->sums, lags.count);
    return observer_begin(out, &self->observer, status);
}

static int64_t next(const Observer *observer, int64_t after) {
    return lags_next(&((const Viscosity *)observer)->history.lags, &observer->clock, after);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Viscosity *self = (Viscosity *)observer;
    History *history = &self->history;
    double now[SHEARS_MOST];
    shears_in(tally, state->box.dimension, now);
    for (size_t k = 0; k < history->lags.count && history->lags.ticks[k] <= tick; k++) {
        size_t row = 0;
        const double *then = history_begun(history, tick, k, &row);
        if (!then) continue;
        double squares = 0;
        for (size_t c = 0; c < history->width; c++) {
            squares += (now[c] - then[c]) * (now[c] - then[c]);
        }
        self->sums[row] += squares / (double)history->width;
    }
    history_keep(history, tick, now);
    return OK;
}

static const uint64_t VISCOSITY_TAG = 0x5649534330303031; // "VISC0001"

static void archive(Observer *observer, Archive *archive) {
    Viscosity *self = (Viscosity *)observer;
    archive_tag(archive, VISCOSITY_TAG);
    history_archive(&self->history, archive);
    archive_f64(archive, self->sums, lags_rows(&self->history.lags));
}

static Status put(const Viscosity *self, const State *state, double *values, double *times,
                  Results *results, size_t replica) {
    const Clock *clock = &self->observer.clock;
    const Lags *lags = &self->history.lags;
    const double unit_of_time = clock->tick / clock->flight_time;
    const double factor = unit_of_time * unit_of_time / (2 * box_volume(&state->box));
    for (size_t k = 0; k < lags->count; k++) {
        values[k] = factor * self->sums[k] / (double)self->history.seen[k];
    }
    ResultSeries shape = {.axes = 0};
    strcpy(shape.unit, state->box.dimension == 2 ? "kT d^2/D0^2" : "kT d/D0^2");
    shape.axes = lags_axes(lags, clock, times, shape.axis);
    return observer_put_series(&self->observer, "stress_wandering", &shape, results, replica,
                               values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Viscosity *self = (const Viscosity *)observer;
    const Lags *lags = &self->history.lags;
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, lags->count);
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags));
    if (status == OK) status = put(self, state, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    return sizeof(Viscosity) + history_memory(&lags, shears_of((int)system->dimension)) +
           lags.count * sizeof(double);
}

const ObservableKind observable_viscosity = {
    .name = "viscosity",
    .about = "Zero-shear viscosity from the fluctuations of the shear stress at rest (Einstein and "
             "Helfand).",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(ViscositySettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
