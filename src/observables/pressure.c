// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure and collision rate from the collisions themselves: the virial theorem with the momentum
// that hard cores exchange, Z = P V/(N kT) = 1 + sum r.dp/(dim N kT t) over the collisions in t.
// The clock counts real flight time, d sqrt(m/kT), whatever the stage's unit. In Newtonian stages
// kT is the temperature that the velocities have.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/put.h"
#include "observables/temperature.h"

#include <math.h>
#include <string.h>

typedef struct PressureSettings {
    int64_t blocks;
} PressureSettings;

static const Option rows[] = {
    {.name = "blocks",
     .type = OPTION_INTEGER,
     .offset = offsetof(PressureSettings, blocks),
     .fallback = 20,
     .least = 1,
     .most = 100000,
     .unit = "",
     .about = "Blocks of the stage that are averaged apart, to see a drift."},
};

// What the propagator had counted when a block ended.
typedef struct Pressure {
    Observer observer;
    size_t blocks, done;
    double *collisions; // [blocks + 1], from tick 0
    double *virial;     // [blocks + 1], trace of the exchange
    double temperature; // summed over blocks, in kT
} Pressure;

static void discard(Observer *observer) {
    Pressure *pressure = (Pressure *)observer;
    memory_free(pressure->collisions);
    memory_free(pressure->virial);
    memory_free(pressure);
}

static int64_t period_for(const Settings *settings, const Clock *clock) {
    return looks_period(clock, ((const PressureSettings *)settings->bytes)->blocks);
}

// What measures it without collisions.
static const char *other_way(const System *system) {
    if (!shape_is_hard((ShapeKind)system->species[0].shape)) return "energy";
    return system->dimension == 2 ? "pair_distribution" : "virtual_compression";
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    if (clock->flies) return OK;
    return status_fail(BAD_DATA,
                       "pressure: Monte Carlo counts no collisions, from which it is measured; %s "
                       "gives it from configurations",
                       other_way(system));
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    (void)state;
    Pressure *pressure = NULL;
    TRY(NEW(pressure));
    pressure->observer = (Observer){.kind = &observable_pressure, .clock = *clock};
    pressure->observer.period = period_for(settings, clock);
    pressure->blocks = (size_t)looks_count(clock, pressure->observer.period);
    Status status = NEW_ARRAY(pressure->collisions, pressure->blocks + 1);
    if (status == OK) status = NEW_ARRAY(pressure->virial, pressure->blocks + 1);
    return observer_begin(out, &pressure->observer, status);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Pressure *pressure = (Pressure *)observer;
    const size_t block = pressure->done = (size_t)(tick / pressure->observer.period);
    ASSERT(block <= pressure->blocks);
    pressure->collisions[block] = (double)tally->collisions;
    for (int a = 0; a < state->box.dimension; a++) {
        pressure->virial[block] += tally->exchange[a][a];
    }
    pressure->temperature += observer->clock.thermostatted ? 1 : temperature_relative(state);
    return OK;
}

static const uint64_t PRESSURE_TAG = 0x5052455353303031; // "PRESS001"

static void archive(Observer *observer, Archive *archive) {
    Pressure *pressure = (Pressure *)observer;
    uint64_t done = pressure->done;
    archive_tag(archive, PRESSURE_TAG);
    archive_u64(archive, &done, 1);
    archive_require(archive, done <= pressure->blocks, "it has a pressure block too many");
    archive_f64(archive, pressure->collisions, pressure->blocks + 1);
    archive_f64(archive, pressure->virial, pressure->blocks + 1);
    archive_f64(archive, &pressure->temperature, 1);
    if (archive_status(archive, false) == OK) pressure->done = (size_t)done;
}

// Over blocks [begin, end): their flight time, temperature and compressibility factor.
static double flight(const Pressure *pressure, size_t begin, size_t end) {
    return (double)(end - begin) * (double)pressure->observer.period *
           pressure->observer.clock.flight_time;
}

static double temperature(const Pressure *pressure) {
    return pressure->temperature / (double)pressure->done;
}

static double compressibility(const Pressure *pressure, const State *state, size_t begin,
                              size_t end) {
    const double virial = pressure->virial[end] - pressure->virial[begin];
    const double freedoms = (double)state->box.dimension * (double)state->count;
    return 1 + virial / (freedoms * temperature(pressure) * flight(pressure, begin, end));
}

static Status put_scalars(const Pressure *pressure, const State *state, Results *results,
                          size_t replica) {
    const Observer *observer = &pressure->observer;
    const Clock *clock = &observer->clock;
    const double count = (double)state->count, density = count / box_volume(&state->box);
    const double z = compressibility(pressure, state, 0, pressure->done);
    const double partners = 2 * pressure->collisions[pressure->done] / count;
    const double time = flight(pressure, 0, pressure->done);
    const double step = (double)clock->ticks_per_step * clock->flight_time;
    TRY(observer_put_scalar(observer, "compressibility_factor", "", NULL, results, replica, z));
    TRY(observer_put_scalar(observer, "pressure", state->box.dimension == 2 ? "kT/d^2" : "kT/d^3",
                            NULL, results, replica, density * z));
    TRY(observer_put_scalar(observer, "collision_rate", "sqrt(kT/m)/d", NULL, results, replica,
                            partners / (time * sqrt(temperature(pressure)))));
    return observer_put_scalar(observer, "collisions_per_step", "", NULL, results, replica,
                               partners * step / time);
}

static Status put_blocks(const Pressure *pressure, const State *state, double *values,
                         double *times, Results *results, size_t replica) {
    const Clock *clock = &pressure->observer.clock;
    const double density = (double)state->count / box_volume(&state->box);
    for (size_t b = 0; b < pressure->blocks; b++) {
        times[b] = ((double)b + 0.5) * (double)pressure->observer.period * clock->tick;
        values[b] =
            b < pressure->done ? density * compressibility(pressure, state, b, b + 1) : (double)NAN;
    }
    ResultSeries shape = {
        .axes = 1,
        .axis = {
            {.name = "time", .unit = clock->unit, .count = pressure->blocks, .values = times}}};
    strcpy(shape.unit, state->box.dimension == 2 ? "kT/d^2" : "kT/d^3");
    return observer_put_series(&pressure->observer, "pressure", &shape, results, replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Pressure *pressure = (const Pressure *)observer;
    double *values = NULL, *times = NULL;
    Status status = put_scalars(pressure, state, results, replica);
    if (status == OK) status = NEW_ARRAY(values, pressure->blocks);
    if (status == OK) status = NEW_ARRAY(times, pressure->blocks);
    if (status == OK) status = put_blocks(pressure, state, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    const int64_t blocks = looks_count(clock, period_for(settings, clock));
    return sizeof(Pressure) + 2 * (size_t)(blocks + 1) * sizeof(double);
}

const ObservableKind observable_pressure = {
    .name = "pressure",
    .about = "Pressure, compressibility factor and collision rate from the momentum that "
             "collisions exchange.",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(PressureSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
