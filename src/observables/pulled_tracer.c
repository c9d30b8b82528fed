// SPDX-License-Identifier: GPL-3.0-or-later
// How a pulled tracer goes: its displacement along and across the force against the time since the
// force came on, and the distance and time of its steady part, of which the friction is made
// (Garcia Daza, Puertas, Cuetos and Patti: [GD]). A trajectory ends with its time, or where the
// tracer has gone 3/4 of the edge of the box, before it comes into its own wake.
//
// Trajectories that end by distance are short where the tracer was fast: a mean over velocities
// would be too large. Distance over time, each summed over all trajectories, is not. Squares and
// products of the two tell the error over trajectories that follow each other in one bath.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"
#include "propagator/tracer.h"

#include <math.h>
#include <string.h>

typedef struct TracerSettings {
    int64_t looks;
    double distance;
} TracerSettings;

static const Option rows[] = {
    {.name = "looks",
     .type = OPTION_INTEGER,
     .offset = offsetof(TracerSettings, looks),
     .fallback = 100,
     .least = 10,
     .most = 100000,
     .unit = "",
     .about = "Looks at the tracer in a trajectory, evenly spaced: at most this many."},
    {.name = "distance",
     .type = OPTION_REAL,
     .offset = offsetof(TracerSettings, distance),
     .fallback = TRACER_DISTANCE,
     .least = 0.05,
     .most = 100,
     .unit = "",
     .about =
         "A trajectory ends where the tracer has gone this share of the edge along the force."},
};

enum { BEGINS = 5, SQUARES = 2 };
// Sums over trajectories: distance, time, their squares and product, and how many there are.
typedef enum Sum { DISTANCE, TIME, DISTANCE_2, PRODUCT, TIME_2, TRAJECTORIES, SUMS } Sum;
// From when on the tracer is taken to be steady, in parts of the time that it needs at least: all
// are given, to see from where the velocity does not change.
static const double BEGIN[BEGINS] = {0, 0.05, 0.1, 0.2, 0.4};

typedef struct Looking {
    int64_t period, spacing; // ticks: of a trajectory, between looks
    size_t looks;            // after that at the start
    double whole;            // looks that a tracer needs at least: without a bath, or all
} Looking;

typedef struct Tracer {
    Observer observer;
    size_t particle;
    int axis, dimension;
    Looking looking;
    double furthest;         // where it ends, in d
    uint64_t running;        // 0 or 1
    double origin[3], last;  // unfolded; displacement along at the last look
    double *count;           // [looks] trajectories seen so far
    double *along;           // [looks] sum of displacements
    double *squares;         // [looks][SQUARES] sums of squares along, and across per direction
    double *quartics;        // [looks][SQUARES] sums of the squares of these
    double going[2][BEGINS]; // distance and time of the steady parts of the trajectory
    double passage[SUMS][BEGINS]; // sums over those that have ended
    TracerSettling settling;      // of its Monte Carlo step, before the stage
} Tracer;

static const TracerSettings *settings_of(const Settings *settings) {
    return (const TracerSettings *)settings->bytes;
}

static double free_velocity(const Clock *clock, const System *system) {
    const Pull *pull = &clock->drive->pull;
    const Species *species = &system->species[tracer_species(pull, system)];
    return tracer_free_diffusion(pull, system, clock->thermostatted) *
           drive_pull_force(pull, species->diameter);
}

// Looks are to be as fine as the fastest trajectories want it, and some slower ones last.
static Looking looking_for(const Settings *settings, const System *system, const Clock *clock) {
    static const int64_t SLOWER = 5;
    const Pull *pull = &clock->drive->pull;
    const Box box = system_box(system);
    const int64_t most = settings_of(settings)->looks, step = clock->ticks_per_step;
    int64_t on;
    Looking looking;
    drive_pull_ticks(pull, clock->tick, step, &looking.period, &on);
    if (looking.period > clock->ticks) looking.period = on = clock->ticks + step; // one trajectory
    const int64_t last = on < looking.period ? on : looking.period - step;
    const double way = settings_of(settings)->distance * box.edge[pull->axis];
    const double fastest = fmin((double)last, way / free_velocity(clock, system) / clock->tick);
    const double span = fmin((double)last, (double)SLOWER * fastest) / (double)most;
    looking.spacing = (int64_t)fmax(1, ceil(span / (double)step)) * step;
    const int64_t looks = last / looking.spacing, room = 2 * SLOWER * most;
    looking.looks = (size_t)(looks < room ? looks : room);
    looking.whole = fastest / (double)looking.spacing;
    return looking;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    if (!clock->drive || !(drive_kinds(clock->drive) & DRIVE_PULL))
        return status_fail(
            BAD_DATA, "pulled_tracer: no force is on a tracer in this stage; give it one, as in "
                      "pull: {species: tracer, peclet: 1}, or leave this out");
    TRY(tracer_check_frames(clock));
    const Looking looking = looking_for(settings, system, clock);
    if (looking.whole >= 10) return OK;
    return status_fail(
        BAD_DATA,
        "pulled_tracer: a trajectory may be over in %.2g looks, too few to follow the "
        "tracer; %s",
        looking.whole,
        clock->whole_steps ? "run again with a smaller trajectory.every"
                           : "make the period longer, looks more or the step smaller");
}

static void discard(Observer *observer) {
    Tracer *tracer = (Tracer *)observer;
    memory_free(tracer->count);
    memory_free(tracer->along);
    memory_free(tracer->squares);
    memory_free(tracer->quartics);
    memory_free(tracer);
}

static Status allocate(Tracer *tracer) {
    TRY(NEW_ARRAY(tracer->count, tracer->looking.looks));
    TRY(NEW_ARRAY(tracer->along, tracer->looking.looks));
    TRY(NEW_ARRAY(tracer->squares, tracer->looking.looks * SQUARES));
    return NEW_ARRAY(tracer->quartics, tracer->looking.looks * SQUARES);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const Pull *pull = &clock->drive->pull;
    Tracer *tracer = NULL;
    TRY(NEW(tracer));
    tracer->observer = (Observer){.kind = &observable_pulled_tracer, .clock = *clock};
    tracer->particle = tracer_particle(pull, &state->system);
    tracer->axis = (int)pull->axis;
    tracer->dimension = state->box.dimension;
    tracer->furthest = settings_of(settings)->distance * state->box.edge[pull->axis];
    tracer->looking = looking_for(settings, &state->system, clock);
    return observer_begin(out, &tracer->observer, allocate(tracer));
}

static int64_t next(const Observer *observer, int64_t after) {
    const Tracer *tracer = (const Tracer *)observer;
    if (after < 0) return 0;
    const int64_t start = after - after % tracer->looking.period,
                  look = (after - start) / tracer->looking.spacing;
    const int64_t tick = (size_t)look < tracer->looking.looks
                             ? start + (look + 1) * tracer->looking.spacing
                             : start + tracer->looking.period;
    return tick <= observer->clock.ticks ? tick : INT64_MAX;
}

// Adds the trajectory that goes on to these sums.
static void add_passage(const Tracer *tracer, double passage[SUMS][BEGINS]) {
    for (size_t b = 0; b < BEGINS; b++) {
        const double distance = tracer->going[DISTANCE][b], time = tracer->going[TIME][b];
        passage[DISTANCE][b] += distance;
        passage[TIME][b] += time;
        passage[DISTANCE_2][b] += distance * distance;
        passage[PRODUCT][b] += distance * time;
        passage[TIME_2][b] += time * time;
        passage[TRAJECTORIES][b] += time > 0;
    }
}

static void begin(Tracer *tracer, const State *state) {
    add_passage(tracer, tracer->passage);
    memset(tracer->going, 0, sizeof tracer->going);
    for (int a = 0; a < tracer->dimension; a++) {
        tracer->origin[a] = state_unfolded(state, a, tracer->particle);
    }
    tracer->last = 0;
    tracer->running = 1;
}

static void add(Tracer *tracer, size_t look, double along, double across2) {
    tracer->count[look]++;
    tracer->along[look] += along;
    const double squares[SQUARES] = {along * along, across2 / (tracer->dimension - 1)};
    for (size_t d = 0; d < SQUARES; d++) {
        tracer->squares[look * SQUARES + d] += squares[d];
        tracer->quartics[look * SQUARES + d] += squares[d] * squares[d];
    }
    for (size_t b = 0; b < BEGINS; b++) {
        if ((double)look < BEGIN[b] * tracer->looking.whole) continue;
        tracer->going[DISTANCE][b] += along - tracer->last;
        tracer->going[TIME][b] += (double)tracer->looking.spacing * tracer->observer.clock.tick;
    }
    tracer->last = along;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Tracer *tracer = (Tracer *)observer;
    if (tally->settling && tracer->settling.rounds == 0) tracer->settling = *tally->settling;
    const int64_t phase = tick % tracer->looking.period;
    if (phase == 0) begin(tracer, state);
    if (phase == 0 || !tracer->running) return OK;
    double along = 0, across2 = 0;
    for (int a = 0; a < tracer->dimension; a++) {
        const double r = state_unfolded(state, a, tracer->particle) - tracer->origin[a];
        if (a == tracer->axis)
            along = r;
        else
            across2 += r * r;
    }
    add(tracer, (size_t)(phase / tracer->looking.spacing) - 1, along, across2);
    tracer->running = along < tracer->furthest;
    return OK;
}

static const uint64_t TRACER_TAG = 0x5452414345523033; // "TRACER03"

static void archive(Observer *observer, Archive *archive) {
    Tracer *tracer = (Tracer *)observer;
    archive_tag(archive, TRACER_TAG);
    archive_u64(archive, &tracer->running, 1);
    archive_f64(archive, tracer->origin, 3);
    archive_f64(archive, &tracer->last, 1);
    archive_f64(archive, tracer->count, tracer->looking.looks);
    archive_f64(archive, tracer->along, tracer->looking.looks);
    archive_f64(archive, tracer->squares, tracer->looking.looks * SQUARES);
    archive_f64(archive, tracer->quartics, tracer->looking.looks * SQUARES);
    archive_f64(archive, tracer->going[0], (size_t)2 * BEGINS);
    archive_f64(archive, tracer->passage[0], (size_t)SUMS * BEGINS);
    tally_archive_settling(&tracer->settling, archive);
}

// Mean of `count` numbers, or its standard error, from their sum and that of their squares; NaN
// where there are too few.
static double mean(double sum, double count) {
    return sum / count;
}

static double standard_error(double sum, double squares, double count) {
    const double variance = squares / count - sum * sum / (count * count);
    return count > 1 ? sqrt(fmax(variance, 0) / (count - 1)) : NAN;
}

static ResultAxis time_axis(const Tracer *tracer, double *times) {
    const Clock *clock = &tracer->observer.clock;
    for (size_t k = 0; k < tracer->looking.looks; k++)
        times[k] = (double)(k + 1) * (double)tracer->looking.spacing * clock->tick;
    return (ResultAxis){
        .name = "time", .unit = clock->unit, .count = tracer->looking.looks, .values = times};
}

// Trajectories in one bath: what a single replica tells of its errors is over these.
static bool has_own_errors(const Tracer *tracer, const Results *results) {
    return results->replicas == 1 && tracer->looking.period <= tracer->observer.clock.ticks;
}

static Status put_displacement(const Tracer *tracer, double *values, Results *results,
                               size_t replica) {
    const size_t looks = tracer->looking.looks;
    const ResultSeries shape = {
        .unit = "d", .axes = 1, .axis = {time_axis(tracer, values + SQUARES * looks)}};
    for (size_t k = 0; k < looks; k++) values[k] = mean(tracer->along[k], tracer->count[k]);
    TRY(observer_put_series(&tracer->observer, "tracer_displacement", &shape, results, replica,
                            values));
    if (!has_own_errors(tracer, results)) return OK;
    for (size_t k = 0; k < looks; k++) {
        values[k] =
            standard_error(tracer->along[k], tracer->squares[k * SQUARES], tracer->count[k]);
    }
    return observer_put_series(&tracer->observer, "tracer_displacement_error", &shape, results,
                               replica, values);
}

static Status put_squares(const Tracer *tracer, double *values, Results *results, size_t replica) {
    static const char *const directions[SQUARES] = {"along", "across"};
    const size_t looks = tracer->looking.looks;
    const ResultSeries shape = {
        .unit = "d^2",
        .axes = 2,
        .axis = {{.name = "direction", .unit = "", .count = SQUARES, .labels = directions},
                 time_axis(tracer, values + SQUARES * looks)}};
    for (size_t i = 0; i < SQUARES * looks; i++) {
        const size_t k = i % looks, sum = k * SQUARES + i / looks;
        values[i] = mean(tracer->squares[sum], tracer->count[k]);
    }
    TRY(observer_put_series(&tracer->observer, "tracer_square_displacement", &shape, results,
                            replica, values));
    if (!has_own_errors(tracer, results)) return OK;
    for (size_t i = 0; i < SQUARES * looks; i++) {
        const size_t k = i % looks, sum = k * SQUARES + i / looks;
        values[i] = standard_error(tracer->squares[sum], tracer->quartics[sum], tracer->count[k]);
    }
    return observer_put_series(&tracer->observer, "tracer_square_displacement_error", &shape,
                               results, replica, values);
}

static Status put_passage(const Tracer *tracer, const System *system, Results *results,
                          size_t replica) {
    static const char *const quantities[SUMS] = {"distance", "time",        "distance_square",
                                                 "product",  "time_square", "trajectories"};
    const Clock *clock = &tracer->observer.clock;
    const Pull *pull = &clock->drive->pull;
    const ResultSeries shape = {
        .unit = "d; d^2/D0",
        .axes = 2,
        .axis = {{.name = "quantity", .unit = "", .count = SUMS, .labels = quantities},
                 {.name = "begin", .unit = "", .count = BEGINS, .values = BEGIN}}};
    double passage[SUMS][BEGINS]; // that which goes on is one, too
    memcpy(passage, tracer->passage, sizeof passage);
    add_passage(tracer, passage);
    TRY(observer_put_scalar(&tracer->observer, "tracer_trajectories", "", NULL, results, replica,
                            tracer->count[0]));
    TRY(observer_put_scalar(&tracer->observer, "tracer_free_diffusion", "D0", NULL, results,
                            replica, tracer_free_diffusion(pull, system, clock->thermostatted)));
    TRY(observer_put_scalar(&tracer->observer, "tracer_free_velocity", "D0/d", NULL, results,
                            replica, free_velocity(clock, system)));
    return observer_put_series(&tracer->observer, "tracer_passage", &shape, results, replica,
                               passage[0]);
}

// How its step came to be that whose time is the bath's ([GD], their Fig. 2).
static Status put_settling(const Tracer *tracer, Results *results, size_t replica) {
    const TracerSettling *settling = &tracer->settling;
    double cycles[SETTLING_MOST];
    if (settling->rounds == 0) return OK; // of a method that has no such step
    for (size_t k = 0; k < settling->rounds; k++) cycles[k] = (double)(k + 1) * settling->cycles;
    ResultSeries shape = {
        .unit = "d",
        .axes = 1,
        .axis = {{.name = "cycles", .unit = "", .count = settling->rounds, .values = cycles}}};
    TRY(observer_put_series(&tracer->observer, "tracer_step", &shape, results, replica,
                            settling->step));
    shape.unit[0] = '\0';
    return observer_put_series(&tracer->observer, "tracer_pace", &shape, results, replica,
                               settling->pace);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Tracer *tracer = (const Tracer *)observer;
    double *values = NULL;
    TRY(NEW_ARRAY(values, (SQUARES + 1) * tracer->looking.looks));
    Status status = put_displacement(tracer, values, results, replica);
    if (status == OK) status = put_squares(tracer, values, results, replica);
    if (status == OK) status = put_passage(tracer, &state->system, results, replica);
    if (status == OK) status = put_settling(tracer, results, replica);
    memory_free(values);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    return sizeof(Tracer) +
           (2 + 2 * SQUARES) * sizeof(double) * looking_for(settings, system, clock).looks;
}

const ObservableKind observable_pulled_tracer = {
    .name = "pulled_tracer",
    .about = "Displacement, velocity and effective friction of a tracer that a constant force "
             "pulls.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(TracerSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
