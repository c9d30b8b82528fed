// SPDX-License-Identifier: GPL-3.0-or-later
// Mean velocity along the flow against the place across it: under steady shear v_x = shear_rate y,
// a straight line. That it is one within its errors is the health of the flow: no bands, no slip.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/put.h"

#include <math.h>

typedef struct ProfileSettings {
    int64_t bins, looks;
} ProfileSettings;

static const Option rows[] = {
    {.name = "bins",
     .type = OPTION_INTEGER,
     .offset = offsetof(ProfileSettings, bins),
     .fallback = 20,
     .least = 2,
     .most = 10000,
     .unit = "",
     .about = "Layers of equal height that the box is cut into."},
    LOOKS_OPTION(ProfileSettings, looks, 1000),
};

typedef struct Profile {
    Observer observer;
    size_t bins;
    double *sums;         // [bins], of velocities less those of the flow, in sqrt(kT/m)
    uint64_t *counts;     // [bins]
    double tilt, squares; // sums of the same times height above the middle, and of its square
    double shear_rate;    // in sqrt(kT/m)/d
} Profile;

static const ProfileSettings *settings_in(const Settings *settings) {
    return (const ProfileSettings *)settings->bytes;
}

static bool is_steady(const Clock *clock) {
    return clock->drive && clock->drive->flow.rate != 0;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)system;
    if (is_steady(clock)) return OK;
    return status_fail(BAD_DATA,
                       "velocity_profile: the stage '%s' has no steady flow; give it a shear_rate",
                       clock->stage);
}

static void discard(Observer *observer) {
    memory_free(((Profile *)observer)->sums);
    memory_free(((Profile *)observer)->counts);
    memory_free(observer);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    (void)state;
    Profile *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_velocity_profile, .clock = *clock};
    self->bins = (size_t)settings_in(settings)->bins;
    self->observer.period = looks_period(clock, settings_in(settings)->looks);
    if (is_steady(clock))
        self->shear_rate = clock->drive->flow.rate * clock->tick / clock->flight_time;
    Status status = NEW_ARRAY(self->sums, self->bins);
    if (status == OK) status = NEW_ARRAY(self->counts, self->bins);
    return observer_begin(out, &self->observer, status);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    Profile *self = (Profile *)observer;
    const double height = state->box.edge[1];
    for (size_t i = 0; i < state->count; i++) {
        const double y = state->position[1][i];
        const double velocity = state->velocity[0][i] - self->shear_rate * y;
        const size_t bin = (size_t)(y / height * (double)self->bins);
        self->sums[bin < self->bins ? bin : self->bins - 1] += velocity;
        self->counts[bin < self->bins ? bin : self->bins - 1]++;
        self->tilt += velocity * (y - height / 2);
        self->squares += (y - height / 2) * (y - height / 2);
    }
    return OK;
}

static const uint64_t PROFILE_TAG = 0x50524f4649303031; // "PROFI001"

static void archive(Observer *observer, Archive *archive) {
    Profile *self = (Profile *)observer;
    archive_tag(archive, PROFILE_TAG);
    archive_f64(archive, self->sums, self->bins);
    archive_u64(archive, self->counts, self->bins);
    archive_f64(archive, &self->tilt, 1);
    archive_f64(archive, &self->squares, 1);
}

static Status put(const Profile *self, const State *state, double *velocity, double *flow,
                  double *heights, Results *results, size_t replica) {
    const Clock *clock = &self->observer.clock;
    const double unit = clock->flight_time / clock->tick; // of sqrt(kT/m), in D0/d
    for (size_t k = 0; k < self->bins; k++) {
        heights[k] = ((double)k + 0.5) * state->box.edge[1] / (double)self->bins;
        flow[k] = unit * self->shear_rate * heights[k];
        velocity[k] = flow[k] + unit * self->sums[k] / (double)self->counts[k];
    }
    const ResultSeries shape = {
        .unit = "D0/d",
        .axes = 1,
        .axis = {{.name = "height", .unit = "d", .count = self->bins, .values = heights}}};
    TRY(observer_put_series(&self->observer, "velocity_profile", &shape, results, replica,
                            velocity));
    TRY(observer_put_series(&self->observer, "flow_profile", &shape, results, replica, flow));
    return observer_put_scalar(&self->observer, "velocity_slope", "", NULL, results, replica,
                               1 + self->tilt / (self->shear_rate * self->squares));
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Profile *self = (const Profile *)observer;
    double *values = NULL;
    TRY(NEW_ARRAY(values, 3 * self->bins));
    const Status status =
        put(self, state, values, values + self->bins, values + 2 * self->bins, results, replica);
    memory_free(values);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    (void)clock;
    return sizeof(Profile) +
           (size_t)settings_in(settings)->bins * (sizeof(double) + sizeof(uint64_t));
}

const ObservableKind observable_velocity_profile = {
    .name = "velocity_profile",
    .about =
        "Mean velocity along the flow in layers across it: a straight line under steady shear.",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(ProfileSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
