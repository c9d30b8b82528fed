// SPDX-License-Identifier: GPL-3.0-or-later
// Shear stress, normal stress differences and pressure from the momentum that collisions exchange
// (Weysser, thesis, ch. 5): over the stage, and in windows of it, whose axis is the strain where
// the shear is steady and the time where it is not. A stage that begins with the shear shows the
// overshoot; one that follows it gives the flow curve.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/put.h"
#include "observables/stresses.h"
#include "observables/temperature.h"

#include <math.h>
#include <string.h>

typedef struct StressSettings {
    int64_t windows;
    double average_from;
} StressSettings;

static const Option rows[] = {
    {.name = "windows",
     .type = OPTION_INTEGER,
     .offset = offsetof(StressSettings, windows),
     .fallback = 100,
     .least = 1,
     .most = 1000000,
     .unit = "",
     .about = "Windows of strain, or of time, over each of which the stress is averaged: at most "
              "so many, at least half of it."},
    {.name = "average_from",
     .type = OPTION_REAL,
     .offset = offsetof(StressSettings, average_from),
     .least = 0,
     .most = 1e12,
     .unit = "",
     .about =
         "Strain (time, where the shear is not steady) from which on the stress is averaged over "
         "the stage: after the start-up."},
};

typedef struct Stress {
    Observer observer;
    size_t windows, done;
    size_t first;        // window that is averaged over the stage
    double before[3][3]; // exchanged when the window began
    double *stresses;    // [windows][STRESSES_MOST]
} Stress;

static int64_t period_for(const Settings *settings, const Clock *clock) {
    return looks_period(clock, ((const StressSettings *)settings->bytes)->windows);
}

static double steady_rate(const Clock *clock) {
    return clock->drive ? clock->drive->flow.rate : 0;
}

// Of a tick, in strain where the shear is steady, or in time.
static double advance_of(const Clock *clock) {
    const double rate = steady_rate(clock);
    return clock->tick * (rate != 0 ? fabs(rate) : 1);
}

static size_t first_window(const Settings *settings, const Clock *clock) {
    const double from = ((const StressSettings *)settings->bytes)->average_from;
    const double window = (double)period_for(settings, clock) * advance_of(clock);
    return (size_t)ceil(fmin(from / window, 1e9) * (1 - 1e-9));
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    if (!clock->flies) {
        return status_fail(BAD_DATA, "stress: Monte Carlo counts no collisions, from which it is "
                                     "measured; contact_stress gives it from configurations");
    }
    const int64_t windows = looks_count(clock, period_for(settings, clock));
    if ((int64_t)first_window(settings, clock) < windows) return OK;
    return status_fail(BAD_DATA,
                       "stress: average_from = %g leaves nothing of the stage '%s' of %g; make it "
                       "smaller",
                       ((const StressSettings *)settings->bytes)->average_from, clock->stage,
                       (double)clock->ticks * advance_of(clock));
}

static void discard(Observer *observer) {
    memory_free(((Stress *)observer)->stresses);
    memory_free(observer);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    (void)state;
    Stress *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_stress, .clock = *clock};
    self->observer.period = period_for(settings, clock);
    self->windows = (size_t)looks_count(clock, self->observer.period);
    self->first = first_window(settings, clock);
    return observer_begin(out, &self->observer,
                          NEW_ARRAY(self->stresses, self->windows * STRESSES_MOST));
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Stress *self = (Stress *)observer;
    const size_t window = (size_t)(tick / self->observer.period) - 1;
    ASSERT(window < self->windows);
    double exchange[3][3];
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) exchange[a][b] = tally->exchange[a][b] - self->before[a][b];
    }
    const double temperature = observer->clock.thermostatted ? 1 : temperature_relative(state);
    stresses_of(exchange, (double)state->count * temperature, &state->box,
                (double)self->observer.period * observer->clock.flight_time,
                self->stresses + window * STRESSES_MOST);
    memcpy(self->before, tally->exchange, sizeof self->before);
    self->done = window + 1;
    return OK;
}

static const uint64_t STRESS_TAG = 0x5354524553303031; // "STRES001"

static void archive(Observer *observer, Archive *archive) {
    Stress *self = (Stress *)observer;
    uint64_t done = self->done;
    archive_tag(archive, STRESS_TAG);
    archive_u64(archive, &done, 1);
    archive_require(archive, done <= self->windows, "it has a window of stress too many");
    archive_f64(archive, &self->before[0][0], 9);
    archive_f64(archive, self->stresses, self->windows * STRESSES_MOST);
    if (archive_status(archive, false) == OK) self->done = (size_t)done;
}

// Of the windows [begin, end); NaN of none.
static double mean_of(const Stress *self, size_t stress, size_t begin, size_t end) {
    double sum = 0, windows = 0;
    for (size_t w = begin; w < end; w++, windows++) {
        sum += self->stresses[w * STRESSES_MOST + stress];
    }
    return sum / windows;
}

// Windows are put together into stretches; those of twice the length tell of correlations that
// reach from one to the next. A flow makes configurations anew over strains of the order of one, so
// that less than STRAIN_LEAST, however many its windows are, tells nothing.
enum { STRETCHES = 16 };
static const double STRAIN_LEAST = 2;

// Who looks at every chance ends at a lucky one: of windows correlated over a tenth of a strain,
// means that were to be known to 1 % were wrong by 1.4 %. Looks therefore are rare, each after a
// fifth more windows than the last, and errors taken for larger than they seem.
static const double CAUTION = 1.2;

// Standard error of the shear stress from so many stretches.
static double error_from(const Stress *self, size_t stretches) {
    const size_t length = (self->done - self->first) / stretches;
    double sum = 0, squares = 0;
    for (size_t k = 0; k < stretches; k++) {
        const size_t begin = self->first + k * length;
        const double mean = mean_of(self, 0, begin, begin + length);
        sum += mean;
        squares += mean * mean;
    }
    const double count = (double)stretches, mean = sum / count;
    return sqrt(fmax(squares / count - mean * mean, 0) / (count - 1));
}

static bool is_look(size_t windows) {
    size_t look = STRETCHES;
    while (look < windows) look += STRETCHES * (1 + look / (5 * STRETCHES));
    return look == windows;
}

static double relative_error(const Observer *observer) {
    const Stress *self = (const Stress *)observer;
    if (self->done <= self->first || !is_look(self->done - self->first)) return INFINITY;
    const double windows = (double)(self->done - self->first);
    if (windows * (double)self->observer.period * advance_of(&observer->clock) < STRAIN_LEAST) {
        return INFINITY;
    }
    const double error = fmax(error_from(self, STRETCHES), error_from(self, STRETCHES / 2));
    return CAUTION * error / fabs(mean_of(self, 0, self->first, self->done));
}

static double stage_mean(const Stress *self, size_t stress) {
    return mean_of(self, stress, self->first, self->done);
}

static Status put_scalars(const Stress *self, const State *state, Results *results,
                          size_t replica) {
    const Observer *observer = &self->observer;
    const int dimension = state->box.dimension;
    // Over an oscillation the shear stress has no mean: `oscillatory_stress` has its harmonics.
    const size_t first = drive_oscillates(observer->clock.drive) ? 1 : 0;
    for (size_t s = first; s < stress_count(dimension); s++) {
        TRY(observer_put_scalar(observer, stress_names[s], stress_unit(dimension), NULL, results,
                                replica, stage_mean(self, s)));
    }
    const Clock *clock = &observer->clock;
    const double rate = steady_rate(clock);
    if (rate == 0) return OK;
    TRY(observer_put_scalar(observer, "stress_strain", "", NULL, results, replica,
                            ((double)self->done - (double)self->first) *
                                (double)self->observer.period * advance_of(clock)));
    return observer_put_scalar(observer, "shear_viscosity", dimension == 2 ? "kT/D0" : "kT/(d D0)",
                               NULL, results, replica, stage_mean(self, 0) / rate);
}

static Status put_windows(const Stress *self, const State *state, double *values, double *axis,
                          Results *results, size_t replica) {
    const Clock *clock = &self->observer.clock;
    const double rate = steady_rate(clock);
    const size_t kinds = stress_count(state->box.dimension);
    for (size_t w = 0; w < self->windows; w++) {
        axis[w] = ((double)w + 0.5) * (double)self->observer.period * advance_of(clock);
        for (size_t s = 0; s < kinds; s++) {
            values[s * self->windows + w] =
                w < self->done ? self->stresses[w * STRESSES_MOST + s] : (double)NAN;
        }
    }
    ResultSeries shape = {
        .axes = 2,
        .axis = {{.name = "stress", .unit = "", .count = kinds, .labels = stress_names},
                 {.name = rate != 0 ? "strain" : "time",
                  .unit = rate != 0 ? "" : clock->unit,
                  .count = self->windows,
                  .values = axis}}};
    strcpy(shape.unit, stress_unit(state->box.dimension));
    return observer_put_series(&self->observer, "stress", &shape, results, replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Stress *self = (const Stress *)observer;
    double *values = NULL, *axis = NULL;
    Status status = put_scalars(self, state, results, replica);
    if (status == OK) status = NEW_ARRAY(values, self->windows * STRESSES_MOST);
    if (status == OK) status = NEW_ARRAY(axis, self->windows);
    if (status == OK) status = put_windows(self, state, values, axis, results, replica);
    memory_free(values);
    memory_free(axis);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    const int64_t windows = looks_count(clock, period_for(settings, clock));
    return sizeof(Stress) + (size_t)windows * STRESSES_MOST * sizeof(double);
}

const ObservableKind observable_stress = {
    .name = "stress",
    .about = "Shear stress, normal stress differences and pressure from the momentum that "
             "collisions exchange, over the stage and in windows of it.",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(StressSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .relative_error = relative_error,
    .free = discard,
    .memory = memory,
};
