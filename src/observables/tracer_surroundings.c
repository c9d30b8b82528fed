// SPDX-License-Identifier: GPL-3.0-or-later
// The bath round a pulled tracer (Garcia Daza, Puertas, Cuetos and Patti: [GD], their figures of
// density and orientation): density over its mean and E2 = <(3 (u.F)^2 - 1)/2> of body axes against
// the force, in rings about its axis; the density in touch with the tracer in front and behind; the
// length of the wake. Only while the force is on, after the tracer has become steady, and before it
// comes into what it has swept itself.
#include "base/constants.h"
#include "base/memory.h"
#include "numerics/vector.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"
#include "propagator/tracer.h"

#include <math.h>

typedef struct RingSettings {
    int64_t looks;
    double reach, spacing, begin, distance;
} RingSettings;

static const Option rows[] = {
    LOOKS_OPTION(RingSettings, looks, 1000),
    {.name = "reach",
     .type = OPTION_REAL,
     .offset = offsetof(RingSettings, reach),
     .fallback = 3,
     .least = 0.5,
     .most = 100,
     .unit = "d",
     .about = "Largest distance from the tracer, along the force and across."},
    {.name = "spacing",
     .type = OPTION_REAL,
     .offset = offsetof(RingSettings, spacing),
     .fallback = 0.2,
     .least = 0.01,
     .most = 10,
     .unit = "d",
     .about = "Width of the rings, along the force and across."},
    {.name = "begin",
     .type = OPTION_REAL,
     .offset = offsetof(RingSettings, begin),
     .fallback = 0.1,
     .least = 0,
     .most = 1e9,
     .unit = "d^2/D0",
     .about = "Time after the force has come on from which the tracer is looked at."},
    {.name = "distance",
     .type = OPTION_REAL,
     .offset = offsetof(RingSettings, distance),
     .fallback = TRACER_DISTANCE,
     .least = 0.05,
     .most = 100,
     .unit = "",
     .about = "It is looked at until it has gone this share of the edge along the force."},
};

enum { ENDS = 2 };                     // in front, behind
static const double TOUCH = 0.05;      // thickness of the shell of contact, in d
static const double CONE = 0.86602540; // cosine of its half-angle, 30 degrees, about the force

typedef struct Rings {
    Observer observer;
    RingSettings settings;
    size_t particle, along, across; // numbers of rings
    int axis;
    int64_t period, on, begin; // ticks
    double origin, furthest;   // along the force, unfolded: of this trajectory; where it ends, in d
    uint64_t running;          // 0 or 1
    uint64_t looks;
    double touching[ENDS]; // particles in the shells, over all looks
    double *count;         // [along][across] particles seen
    double *order;         // [along][across] sum of E2
} Rings;

static const RingSettings *settings_of(const Settings *settings) {
    return (const RingSettings *)settings->bytes;
}

static size_t rings_across(const RingSettings *settings) {
    return (size_t)ceil(settings->reach / settings->spacing - 1e-9);
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    const RingSettings *set = settings_of(settings);
    const Box box = system_box(system);
    if (!clock->drive || !(drive_kinds(clock->drive) & DRIVE_PULL))
        return status_fail(
            BAD_DATA, "tracer_surroundings: no force is on a tracer in this stage; give it one, "
                      "as in pull: {species: tracer, peclet: 1}, or leave this out");
    if (system->dimension != 3)
        return status_fail(BAD_DATA,
                           "tracer_surroundings: rings are of three dimensions, the system "
                           "has two; leave it out");
    TRY(tracer_check_frames(clock));
    const double shortest = box_shortest_edge(&box);
    const double reach = (double)rings_across(set) * set->spacing;
    if (reach > shortest / 2)
        return status_fail(
            BAD_DATA,
            "tracer_surroundings: reach = %g d is more than half of the shortest edge "
            "of the box, %g d; make it shorter",
            set->reach, shortest);
    int64_t period, on;
    drive_pull_ticks(&clock->drive->pull, clock->tick, clock->ticks_per_step, &period, &on);
    const double time = clock->tick * (double)(on < clock->ticks ? on : clock->ticks);
    if (set->begin < time) return OK;
    return status_fail(BAD_DATA,
                       "tracer_surroundings: begin = %g is after the force goes off again, at %g; "
                       "make it earlier",
                       set->begin, time);
}

static void discard(Observer *observer) {
    Rings *rings = (Rings *)observer;
    memory_free(rings->count);
    memory_free(rings->order);
    memory_free(rings);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const Pull *pull = &clock->drive->pull;
    Rings *rings = NULL;
    TRY(NEW(rings));
    rings->observer = (Observer){.kind = &observable_tracer_surroundings, .clock = *clock};
    rings->settings = *settings_of(settings);
    rings->particle = tracer_particle(pull, &state->system);
    rings->axis = (int)pull->axis;
    rings->across = rings_across(&rings->settings);
    rings->along = 2 * rings->across;
    rings->observer.period = looks_period(clock, rings->settings.looks);
    drive_pull_ticks(pull, clock->tick, clock->ticks_per_step, &rings->period, &rings->on);
    rings->begin = (int64_t)ceil(rings->settings.begin / clock->tick);
    rings->furthest = rings->settings.distance * state->box.edge[pull->axis];
    Status status = NEW_ARRAY(rings->count, rings->along * rings->across);
    if (status == OK) status = NEW_ARRAY(rings->order, rings->along * rings->across);
    return observer_begin(out, &rings->observer, status);
}

// Looks, and beginnings of trajectories.
static int64_t next(const Observer *observer, int64_t after) {
    const Rings *rings = (const Rings *)observer;
    const int64_t look = looks_next(observer, after), ticks = observer->clock.ticks;
    if (after < 0) return 0;
    const int64_t left = rings->period - after % rings->period;
    return left <= ticks - after && after + left < look ? after + left : look;
}

static void add(Rings *rings, double x, double rho, double order) {
    const double width = rings->settings.spacing, reach = (double)rings->across * width;
    if (!(fabs(x) < reach && rho < reach)) return;
    const size_t i = (size_t)((x + reach) / width), j = (size_t)(rho / width);
    if (i >= rings->along || j >= rings->across) return; // rounding
    rings->count[i * rings->across + j]++;
    rings->order[i * rings->across + j] += order;
}

// From the tracer to the nearest point of a sphere's or a rod's axis, which `r` leads to the middle
// of.
static void nearest_of_axis(const State *state, size_t i, const double r[3], double nearest[3]) {
    const double half = state->system.species[state->species_of[i]].length / 2;
    double along = 0;
    for (int a = 0; a < 3 && half > 0; a++) along -= r[a] * state->orientation[a][i];
    along = fmin(fmax(along, -half), half);
    for (int a = 0; a < 3; a++)
        nearest[a] = half > 0 ? r[a] + along * state->orientation[a][i] : r[a];
}

static void see_touching(Rings *rings, const State *state, size_t i, const double r[3]) {
    const double contact = (state->diameter[i] + state->diameter[rings->particle]) / 2;
    double nearest[3];
    nearest_of_axis(state, i, r, nearest);
    const double gap = sqrt(vector_dot(nearest, nearest)), x = nearest[rings->axis];
    if (gap < contact + TOUCH && fabs(x) > CONE * gap) rings->touching[x < 0]++;
}

static void see_particle(Rings *rings, const State *state, size_t i) {
    double r[3], rho2 = 0;
    for (int a = 0; a < 3; a++) {
        r[a] = state->position[a][i] - state->position[a][rings->particle];
    }
    box_nearest_image(&state->box, r);
    for (int a = 0; a < 3; a++) rho2 += a == rings->axis ? 0 : r[a] * r[a];
    const double x = r[rings->axis], rho = sqrt(rho2);
    const double u = state->oriented ? state->orientation[rings->axis][i] : 0;
    add(rings, x, rho, (3 * u * u - 1) / 2);
    see_touching(rings, state, i, r);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Rings *rings = (Rings *)observer;
    const int64_t phase = tick % rings->period;
    const double place = state_unfolded(state, rings->axis, rings->particle);
    if (phase == 0) rings->origin = place, rings->running = 1;
    if (place - rings->origin >= rings->furthest) rings->running = 0;
    if (tick == 0 || tick % rings->observer.period != 0 || !rings->running) return OK;
    if (phase < rings->begin || phase > rings->on) return OK;
    rings->looks++;
    for (size_t i = 0; i < state->count; i++) {
        if (i != rings->particle) see_particle(rings, state, i);
    }
    return OK;
}

static const uint64_t RINGS_TAG = 0x52494e4753303032; // "RINGS002"

static void archive(Observer *observer, Archive *archive) {
    Rings *rings = (Rings *)observer;
    archive_tag(archive, RINGS_TAG);
    archive_u64(archive, &rings->looks, 1);
    archive_u64(archive, &rings->running, 1);
    archive_f64(archive, &rings->origin, 1);
    archive_f64(archive, rings->touching, ENDS);
    archive_f64(archive, rings->count, rings->along * rings->across);
    archive_f64(archive, rings->order, rings->along * rings->across);
}

// Particles that a volume of 1 would have had over all looks, were they evenly spread.
static double evenly(const Rings *rings, const State *state) {
    return (double)rings->looks * (double)(state->count - 1) / box_volume(&state->box);
}

static double ring_volume(const Rings *rings, size_t j) {
    const double width = rings->settings.spacing;
    return PI * width * width * width * (double)(2 * j + 1);
}

static Status put_maps(const Rings *rings, const State *state, double *values, Results *results,
                       size_t replica) {
    const size_t cells = rings->along * rings->across;
    const double width = rings->settings.spacing;
    double *along = values + cells, *across = along + rings->along;
    for (size_t i = 0; i < rings->along; i++)
        along[i] = ((double)i + 0.5 - (double)rings->across) * width;
    for (size_t j = 0; j < rings->across; j++) across[j] = ((double)j + 0.5) * width;
    for (size_t c = 0; c < cells; c++) {
        values[c] =
            rings->count[c] / (ring_volume(rings, c % rings->across) * evenly(rings, state));
    }
    ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {{.name = "along", .unit = "d", .count = rings->along, .values = along},
                 {.name = "across", .unit = "d", .count = rings->across, .values = across}}};
    TRY(observer_put_series(&rings->observer, "tracer_surroundings", &shape, results, replica,
                            values));
    if (!state->oriented) return OK;
    for (size_t c = 0; c < cells; c++) values[c] = rings->order[c] / rings->count[c];
    return observer_put_series(&rings->observer, "tracer_orientations", &shape, results, replica,
                               values);
}

// Where the middle of a sphere or of a rod that points anywhere is if it touches the tracer on one
// side: a share of the shell round the volume that it excludes to it.
static double touching_volume(const Species *species, double tracer) {
    const double contact = (tracer + species->diameter) / 2, outer = contact + TOUCH;
    const double caps = 4 * PI / 3 * (outer * outer * outer - contact * contact * contact);
    const double sides = PI * species->length * (outer * outer - contact * contact);
    return (caps + sides) * (1 - CONE) / 2;
}

static double evenly_touching(const Rings *rings, const State *state) {
    const uint8_t own = state->species_of[rings->particle];
    size_t counts[SPECIES_MOST];
    double sum = 0;
    system_counts(&state->system, counts);
    for (size_t s = 0; s < state->system.species_count; s++) {
        if (s == own) continue;
        sum += (double)counts[s] *
               touching_volume(&state->system.species[s], state->diameter[rings->particle]);
    }
    return sum * (double)rings->looks / box_volume(&state->box);
}

static Status put_contact(const Rings *rings, const State *state, Results *results,
                          size_t replica) {
    const double even = evenly_touching(rings, state);
    TRY(observer_put_scalar(&rings->observer, "contact_density_front", "", NULL, results, replica,
                            rings->touching[0] / even));
    return observer_put_scalar(&rings->observer, "contact_density_behind", "", NULL, results,
                               replica, rings->touching[1] / even);
}

// In a cylinder of about the tracer's radius behind it, from contact on.
static Status put_wake(const Rings *rings, const State *state, Results *results, size_t replica) {
    const double width = rings->settings.spacing;
    const double radius = state->diameter[rings->particle] / 2;
    const size_t core = (size_t)fmax(1, rint(radius / width));
    const double contact = radius + state->system.species[0].diameter / 2;
    double missing = 0;
    for (size_t i = 0; i < rings->across; i++) {
        const double behind = ((double)(rings->across - i) - 0.5) * width;
        double count = 0, volume = 0;
        for (size_t j = 0; j < core && j < rings->across; j++) {
            count += rings->count[i * rings->across + j];
            volume += ring_volume(rings, j);
        }
        if (behind > contact) missing += width * (1 - count / (volume * evenly(rings, state)));
    }
    return observer_put_scalar(&rings->observer, "wake_length", "d", NULL, results, replica,
                               missing);
}

// Discs have another nearest point.
static bool has_contact(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        if (system->species[s].shape == SHAPE_PLATELET) return false;
    }
    return true;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Rings *rings = (const Rings *)observer;
    double *values = NULL;
    TRY(NEW_ARRAY(values, rings->along * rings->across + rings->along + rings->across));
    Status status = put_maps(rings, state, values, results, replica);
    if (status == OK && has_contact(&state->system))
        status = put_contact(rings, state, results, replica);
    if (status == OK) status = put_wake(rings, state, results, replica);
    memory_free(values);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    (void)clock;
    const size_t across = rings_across(settings_of(settings));
    return sizeof(Rings) + 4 * across * across * sizeof(double);
}

const ObservableKind observable_tracer_surroundings = {
    .name = "tracer_surroundings",
    .about = "Density and orientation of the bath in rings round a pulled tracer, contact in front "
             "and behind, length of the wake.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(RingSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
