// SPDX-License-Identifier: GPL-3.0-or-later
// Shear stress over the cycle of an oscillating strain g0 sin(w t) (Weysser, thesis, ch. 6.2),
// folded over whole cycles after the first ones, and its harmonics
//   sigma(t) = g0 sum over n of G'_n sin(n w t) + G''_n cos(n w t),
// projected out of every window of collisions by itself: a window of length h sees a harmonic
// weakened by sin(n w h/2)/(n w h/2), which is divided out.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/put.h"
#include "observables/stresses.h"

#include <math.h>
#include <string.h>

typedef struct OscillatorySettings {
    int64_t phases, skipped;
} OscillatorySettings;

static const Option rows[] = {
    {.name = "phases",
     .type = OPTION_INTEGER,
     .offset = offsetof(OscillatorySettings, phases),
     .fallback = 64,
     .least = 16,
     .most = 10000,
     .unit = "",
     .about = "Parts of the cycle in which the stress is averaged."},
    {.name = "cycles_skipped",
     .type = OPTION_INTEGER,
     .offset = offsetof(OscillatorySettings, skipped),
     .fallback = 1,
     .least = 0,
     .most = 1000000,
     .unit = "",
     .about =
         "Cycles at the start of the stage that are left out, until the response has settled."},
};

enum { HARMONICS = 5 };

typedef struct Oscillatory {
    Observer observer;
    double cycle;       // in ticks
    int64_t period;     // ticks of a window: at least one to a phase where steps allow
    int64_t begin, end; // ticks, whole cycles apart
    size_t phases;
    double before;              // exchanged when the window began
    double *sums;               // [phases], of stresses of windows by the phase of their middles
    uint64_t *counts;           // [phases]
    double waves[2][HARMONICS]; // sums of stress times sine, cosine
    uint64_t windows;
} Oscillatory;

static const OscillatorySettings *settings_in(const Settings *settings) {
    return (const OscillatorySettings *)settings->bytes;
}

static double amplitude_of(const Clock *clock) {
    return clock->drive ? clock->drive->flow.oscillation.amplitude : 0;
}

static double cycle_of(const Clock *clock) { // in ticks
    return 2 * PI / (clock->drive->flow.oscillation.frequency * clock->tick);
}

static double whole_cycles(const Clock *clock) {
    return floor((double)clock->ticks / cycle_of(clock) * (1 + 1e-9));
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    if (!(amplitude_of(clock) > 0)) {
        return status_fail(BAD_DATA,
                           "oscillatory_stress: the stage '%s' does not oscillate; give it "
                           "oscillate: {amplitude: ..., frequency: ...}, or observe stress",
                           clock->stage);
    }
    const double cycles = whole_cycles(clock), skipped = (double)settings_in(settings)->skipped;
    if (cycles <= skipped) {
        return status_fail(
            BAD_DATA,
            "oscillatory_stress: the stage '%s' has %g whole cycles and the first %g "
            "are skipped; make it longer",
            clock->stage, cycles, skipped);
    }
    if (cycle_of(clock) >= 16 * (double)clock->ticks_per_step) return OK;
    return status_fail(
        BAD_DATA,
        "oscillatory_stress: a cycle of %.3g steps is too short to resolve; make the "
        "thermostat interval shorter",
        cycle_of(clock) / (double)clock->ticks_per_step);
}

static void discard(Observer *observer) {
    Oscillatory *self = (Oscillatory *)observer;
    memory_free(self->sums);
    memory_free(self->counts);
    memory_free(self);
}

// Windows of whole steps, as many as fill whole cycles best; no more phases than a cycle has steps.
static void divide(Oscillatory *self, const Clock *clock, int64_t skipped) {
    const double per_step = (double)clock->ticks_per_step;
    self->cycle = cycle_of(clock);
    const double steps = self->cycle / per_step;
    if (steps < (double)self->phases) self->phases = (size_t)steps;
    self->period = clock->ticks_per_step * (int64_t)floor(steps / (double)self->phases);
    const double period = (double)self->period;
    self->begin = (int64_t)ceil((double)skipped * self->cycle / period) * self->period;
    const double windows = rint((whole_cycles(clock) - (double)skipped) * self->cycle / period);
    self->end = self->begin + (int64_t)windows * self->period;
    while (self->end > clock->ticks) self->end -= self->period;
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    (void)state;
    Oscillatory *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_oscillatory_stress, .clock = *clock};
    self->phases = (size_t)settings_in(settings)->phases;
    if (amplitude_of(clock) > 0) divide(self, clock, settings_in(settings)->skipped);
    Status status = NEW_ARRAY(self->sums, self->phases);
    if (status == OK) status = NEW_ARRAY(self->counts, self->phases);
    return observer_begin(out, &self->observer, status);
}

static int64_t next(const Observer *observer, int64_t after) {
    const Oscillatory *self = (const Oscillatory *)observer;
    if (self->period == 0) return INT64_MAX;
    const int64_t tick =
        after < self->begin ? self->begin : after - after % self->period + self->period;
    return tick <= self->end ? tick : INT64_MAX;
}

static void add_window(Oscillatory *self, double turns, double stress) {
    const double phase = turns - floor(turns);
    const size_t at = (size_t)(phase * (double)self->phases);
    self->sums[at < self->phases ? at : 0] += stress;
    self->counts[at < self->phases ? at : 0]++;
    for (int n = 0; n < HARMONICS; n++) {
        self->waves[0][n] += stress * sin(2 * PI * (n + 1) * phase);
        self->waves[1][n] += stress * cos(2 * PI * (n + 1) * phase);
    }
    self->windows++;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Oscillatory *self = (Oscillatory *)observer;
    const double flight = (double)self->period * observer->clock.flight_time;
    const double stress =
        -(tally->exchange[0][1] - self->before) / (box_volume(&state->box) * flight);
    const double middle = ((double)tick - (double)self->period / 2) / self->cycle;
    if (tick > self->begin) add_window(self, middle, stress);
    self->before = tally->exchange[0][1];
    return OK;
}

static const uint64_t OSCILLATORY_TAG = 0x4f5343494c303031; // "OSCIL001"

static void archive(Observer *observer, Archive *archive) {
    Oscillatory *self = (Oscillatory *)observer;
    archive_tag(archive, OSCILLATORY_TAG);
    archive_f64(archive, &self->before, 1);
    archive_f64(archive, self->sums, self->phases);
    archive_u64(archive, self->counts, self->phases);
    archive_f64(archive, &self->waves[0][0], 2 * HARMONICS);
    archive_u64(archive, &self->windows, 1);
}

static Status put_cycle(const Oscillatory *self, const State *state, double *values, double *strain,
                        Results *results, size_t replica) {
    const double amplitude = amplitude_of(&self->observer.clock);
    double *phase = strain + self->phases + 1;
    for (size_t k = 0; k < self->phases; k++) {
        phase[k] = ((double)k + 0.5) / (double)self->phases;
        strain[k] = amplitude * sin(2 * PI * phase[k]);
        values[k] = self->sums[k] / (double)self->counts[k];
    }
    ResultSeries shape = {
        .axes = 1, .axis = {{.name = "phase", .unit = "", .count = self->phases, .values = phase}}};
    strcpy(shape.unit, stress_unit(state->box.dimension));
    TRY(observer_put_series(&self->observer, "stress_cycle", &shape, results, replica, values));
    // A closed curve: parts of the cycle in their order, the first again at the end.
    strain[self->phases] = strain[0];
    values[self->phases] = values[0];
    shape.axis[0] = (ResultAxis){
        .name = "cycle_strain", .unit = "", .count = self->phases + 1, .values = strain};
    return observer_put_series(&self->observer, "lissajous", &shape, results, replica, values);
}

static Status put_harmonics(const Oscillatory *self, const State *state, Results *results,
                            size_t replica) {
    static const char *const parts[] = {"elastic", "viscous"};
    const double orders[HARMONICS] = {1, 2, 3, 4, 5};
    double moduli[2][HARMONICS];
    for (int n = 0; n < HARMONICS; n++) {
        const double half = PI * orders[n] * (double)self->period / self->cycle;
        const double factor =
            2 * half / (sin(half) * (double)self->windows * amplitude_of(&self->observer.clock));
        for (int part = 0; part < 2; part++) moduli[part][n] = factor * self->waves[part][n];
    }
    ResultSeries shape = {
        .axes = 2,
        .axis = {{.name = "part", .unit = "", .count = 2, .labels = parts},
                 {.name = "harmonic", .unit = "", .count = HARMONICS, .values = orders}}};
    const char *unit = stress_unit(state->box.dimension);
    strcpy(shape.unit, unit);
    TRY(observer_put_scalar(&self->observer, "storage_modulus", unit, NULL, results, replica,
                            moduli[0][0]));
    TRY(observer_put_scalar(&self->observer, "loss_modulus", unit, NULL, results, replica,
                            moduli[1][0]));
    return observer_put_series(&self->observer, "stress_harmonics", &shape, results, replica,
                               moduli[0]);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Oscillatory *self = (const Oscillatory *)observer;
    double *values = NULL, *axes = NULL;
    Status status = NEW_ARRAY(values, self->phases + 1);
    if (status == OK) status = NEW_ARRAY(axes, 2 * self->phases + 1);
    if (status == OK) status = put_cycle(self, state, values, axes, results, replica);
    if (status == OK) status = put_harmonics(self, state, results, replica);
    memory_free(values);
    memory_free(axes);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    (void)clock;
    return sizeof(Oscillatory) +
           (size_t)settings_in(settings)->phases * (sizeof(double) + sizeof(uint64_t));
}

const ObservableKind observable_oscillatory_stress = {
    .name = "oscillatory_stress",
    .about = "Shear stress over the cycle of an oscillating strain, its harmonics and the moduli.",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(OscillatorySettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
