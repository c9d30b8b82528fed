// SPDX-License-Identifier: GPL-3.0-or-later
// One replica on its way through the stages of its plan.
#include "protocol/replica.h"

#include "base/memory.h"
#include "packing/packing.h"

#include <math.h>
#include <string.h>
#include <time.h>

static const double OVERLAP_LIMIT = 1e-12; // depth, relative to contact, that counts as unhealthy
static const double SLICE_SECONDS = 0.05;  // signals are noticed between slices
static const int64_t HEALTH_STEPS = 2000;  // most steps between overlap checks

struct Replica {
    const Plan *plan;
    RngKey key;
    State *state;
    Propagator *propagator; // NULL between stages
    Clock clock;            // of the stage
    size_t stage;           // plan->stage_count when finished
    Box boxes[STAGES_MOST]; // in which each stage began: observers are made for it
    int64_t tick;           // in the stage
    Tally tally;            // of the stage
    Tally finished;         // of the stages before
    int64_t frames_due, frames_taken;
    uint64_t overlaps;
    double deepest_overlap;
    double orientation_drift;
    PackingReport packing;
    double cpu_seconds; // spent on advancing and observing, over all sessions
    Observer *observers[STAGES_MOST][OBSERVATIONS_MOST]; // made when their stage begins
};

static Status check_health(Replica *replica) {
    double deepest = 0;
    uint64_t pairs = 0;
    TRY(state_validate(replica->state));
    TRY(state_deepest_overlap(replica->state, OVERLAP_LIMIT, &deepest, &pairs));
    replica->overlaps += pairs;
    replica->deepest_overlap = fmax(replica->deepest_overlap, deepest);
    replica->orientation_drift =
        fmax(replica->orientation_drift, state_orientation_drift(replica->state));
    return OK;
}

static Status make_observers(Replica *replica, size_t stage) {
    const Stage *plan = &replica->plan->stages[stage];
    const Clock clock = plan_clock(replica->plan, stage);
    const Box now = replica->state->box; // when loaded, it may have been sheared since
    replica->state->box = replica->boxes[stage];
    for (size_t k = 0; k < plan->observation_count; k++) {
        const Observation *observation = &plan->observations[k];
        TRY(observation->kind->create(&replica->observers[stage][k], &observation->settings,
                                      replica->state, &clock));
    }
    replica->state->box = now;
    return OK;
}

static Status show_observers(Replica *replica, int64_t before) {
    const size_t count = replica->plan->stages[replica->stage].observation_count;
    for (size_t k = 0; k < count; k++) {
        Observer *observer = replica->observers[replica->stage][k];
        if (observer->kind->next(observer, before) != replica->tick) continue;
        TRY(observer->kind->see(observer, replica->tick, replica->state, &replica->tally));
    }
    return OK;
}

// The first stage recorded also gives the configuration at its start.
static bool records_its_start(const Plan *plan, size_t stage) {
    if (!stage_is_recorded(plan, stage)) return false;
    return stage == 0 || !stage_is_recorded(plan, stage - 1);
}

// Ticks between frames: whole steps, so that a frame is a State that determines the future. 0 where
// there are none.
static int64_t frame_ticks(const Plan *plan, size_t stage) {
    if (!stage_is_recorded(plan, stage)) return 0;
    const Clock clock = plan_clock(plan, stage);
    const double step = clock.tick * (double)clock.ticks_per_step;
    const double steps = rint(plan->output.trajectory_every / step);
    if (steps * (double)clock.ticks_per_step >= (double)clock.ticks) return clock.ticks;
    return (steps < 1 ? 1 : (int64_t)steps) * clock.ticks_per_step;
}

static int64_t stage_frames(const Plan *plan, size_t stage) {
    const int64_t every = frame_ticks(plan, stage);
    if (!every) return 0;
    return plan_clock(plan, stage).ticks / every + records_its_start(plan, stage);
}

int64_t plan_frames(const Plan *plan) {
    int64_t frames = 0;
    for (size_t s = 0; s < plan->stage_count; s++) frames += stage_frames(plan, s);
    return frames;
}

// Where the stage before ends with a frame, this one begins with it: unless its method moves the
// particles before its time begins.
static bool goes_on_from_a_frame(const Plan *plan, size_t stage) {
    if (plan->stages[stage].dynamics.kind->prepare) return false;
    return plan_clock(plan, stage - 1).ticks % frame_ticks(plan, stage - 1) == 0;
}

StageFrames plan_stage_frames(const Plan *plan, size_t stage) {
    StageFrames frames = {.every = frame_ticks(plan, stage), .start = -1};
    if (!frames.every) return frames;
    for (size_t s = 0; s < stage; s++) frames.first += stage_frames(plan, s);
    if (records_its_start(plan, stage))
        frames.start = frames.first++;
    else if (goes_on_from_a_frame(plan, stage))
        frames.start = frames.first - 1;
    return frames;
}

static Status make_propagator(Replica *replica) {
    const Stage *stage = &replica->plan->stages[replica->stage];
    const PropagatorKind *kind = stage->dynamics.kind;
    replica->clock = plan_clock(replica->plan, replica->stage);
    TRY(kind->create(&replica->propagator, &stage->dynamics.settings, replica->state,
                     replica->key));
    if (!replica->clock.drive) return OK;
    return kind->drive(replica->propagator, replica->clock.drive,
                       replica->tick / replica->clock.ticks_per_step);
}

static Status begin_stage(Replica *replica) {
    TRY(make_propagator(replica));
    Propagator *propagator = replica->propagator;
    if (propagator->kind->prepare) TRY(propagator->kind->prepare(propagator));
    replica->boxes[replica->stage] = replica->state->box;
    TRY(make_observers(replica, replica->stage));
    replica->frames_due += records_its_start(replica->plan, replica->stage);
    return show_observers(replica, -1);
}

static void end_stage(Replica *replica) {
    replica->propagator->kind->free(replica->propagator);
    replica->propagator = NULL;
    tally_add(&replica->finished, &replica->tally);
    replica->tally = (Tally){0};
    replica->tick = 0;
    replica->stage++;
}

static Status allocate(Replica **out, const Plan *plan, size_t index) {
    Replica *replica = NULL;
    TRY(NEW(replica));
    replica->plan = plan;
    replica->key = (RngKey){.seed = (uint64_t)plan->ensemble.seed, .replica = index};
    *out = replica;
    return OK;
}

Status replica_create(Replica **out, const Plan *plan, size_t index, const atomic_int *stop) {
    Replica *replica = NULL;
    TRY(allocate(&replica, plan, index));
    Status status =
        packing_create(&replica->state, &plan->system, replica->key, stop, &replica->packing);
    if (status == OK) status = check_health(replica);
    if (status == OK) status = begin_stage(replica);
    if (status != OK) {
        replica_free(replica);
        return status;
    }
    *out = replica;
    return OK;
}

void replica_free(Replica *replica) {
    if (!replica) return;
    for (size_t s = 0; s < STAGES_MOST; s++) {
        for (size_t k = 0; k < OBSERVATIONS_MOST; k++) {
            Observer *observer = replica->observers[s][k];
            if (observer) observer->kind->free(observer);
        }
    }
    if (replica->propagator) replica->propagator->kind->free(replica->propagator);
    state_free(replica->state);
    memory_free(replica);
}

bool replica_finished(const Replica *replica) {
    return replica->stage == replica->plan->stage_count;
}

static int64_t next_observation(const Replica *replica) {
    int64_t next = INT64_MAX;
    for (size_t k = 0; k < replica->plan->stages[replica->stage].observation_count; k++) {
        const Observer *observer = replica->observers[replica->stage][k];
        const int64_t wish = observer->kind->next(observer, replica->tick);
        if (wish < next) next = wish;
    }
    return next;
}

static int64_t slice_ticks(const Replica *replica) {
    const Dynamics *dynamics = &replica->plan->stages[replica->stage].dynamics;
    const double tick_seconds =
        dynamics->kind->seconds_per_particle_tick(&dynamics->settings, &replica->plan->system) *
        (double)replica->state->count;
    const int64_t per_step = replica->clock.ticks_per_step;
    const double steps = floor(SLICE_SECONDS / (tick_seconds * (double)per_step));
    return per_step * (steps < 1 ? 1 : steps > 1e9 ? 1000000000 : (int64_t)steps);
}

// The next multiple of `period` after `tick`.
static int64_t next_multiple(int64_t tick, int64_t period) {
    return tick - tick % period + period;
}

static int64_t least(int64_t a, int64_t b) {
    return a < b ? a : b;
}

static int64_t next_stop(const Replica *replica) {
    const Clock *clock = &replica->clock;
    const int64_t frames = frame_ticks(replica->plan, replica->stage);
    int64_t stop = clock->ticks;
    stop = least(stop, next_observation(replica));
    stop = least(stop, next_multiple(replica->tick, slice_ticks(replica)));
    stop = least(stop, next_multiple(replica->tick, HEALTH_STEPS * clock->ticks_per_step));
    if (frames) stop = least(stop, next_multiple(replica->tick, frames));
    return stop;
}

// The stress is known well enough: this replica's share of what all are to know together.
static bool knows_enough(const Replica *replica, int64_t before) {
    const Stage *stage = &replica->plan->stages[replica->stage];
    if (stage->stress_error == 0) return false;
    const double share = stage->stress_error * sqrt((double)replica->plan->ensemble.replicas);
    for (size_t k = 0; k < stage->observation_count; k++) {
        const Observer *observer = replica->observers[replica->stage][k];
        if (!observer->kind->relative_error) continue;
        if (observer->kind->next(observer, before) != replica->tick) continue; // nothing new
        if (observer->kind->relative_error(observer) <= share) return true;
    }
    return false;
}

static Status advance(Replica *replica) {
    if (!replica->propagator) return begin_stage(replica);
    const int64_t before = replica->tick, after = next_stop(replica);
    const int64_t frames = frame_ticks(replica->plan, replica->stage);
    TRY(replica->propagator->kind->advance(replica->propagator, after - before, &replica->tally));
    replica->tick = after;
    TRY(show_observers(replica, before));
    const bool frame = frames && after % frames == 0;
    const bool ends = after == replica->clock.ticks || knows_enough(replica, before);
    const bool due = after % (HEALTH_STEPS * replica->clock.ticks_per_step) == 0;
    if (frame) replica->frames_due++;
    if (frame || ends || due) TRY(check_health(replica));
    if (ends) end_stage(replica);
    return OK;
}

static double thread_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

Status replica_advance(Replica *replica) {
    const double start = thread_seconds();
    const Status status = advance(replica);
    replica->cpu_seconds += thread_seconds() - start;
    return status;
}

// Between two stages nothing but the state is alive; inside one, only a step's end determines the
// future.
bool replica_can_save(const Replica *replica) {
    return !replica->propagator || replica->tick % replica->clock.ticks_per_step == 0;
}

static const uint64_t REPLICA_TAG = 0x5245504c30303033; // "REPL0003"

static void archive_observers(Replica *replica, Archive *archive, size_t stages) {
    for (size_t s = 0; s < stages; s++) {
        const size_t count = replica->plan->stages[s].observation_count;
        for (size_t k = 0; k < count; k++) {
            Observer *observer = replica->observers[s][k];
            observer->kind->archive(observer, archive);
        }
    }
}

// And the boxes in which the stages so far began.
static void archive_state(Replica *replica, Archive *archive, size_t stages) {
    state_archive(replica->state, archive);
    for (size_t s = 0; s < stages; s++) box_archive(&replica->boxes[s], archive);
}

static void archive_propagator(Replica *replica, Archive *archive) {
    Propagator *propagator = replica->propagator;
    if (propagator && propagator->kind->archive) propagator->kind->archive(propagator, archive);
}

static void archive_place(Replica *replica, Archive *archive, uint64_t *stage, uint64_t *begun) {
    archive_tag(archive, REPLICA_TAG);
    archive_u64(archive, stage, 1);
    archive_u64(archive, begun, 1);
    archive_i64(archive, &replica->tick, 1);
    archive_i64(archive, &replica->frames_due, 1);
    archive_i64(archive, &replica->frames_taken, 1);
    archive_u64(archive, &replica->overlaps, 1);
    archive_f64(archive, &replica->deepest_overlap, 1);
    archive_f64(archive, &replica->orientation_drift, 1);
    archive_f64(archive, &replica->packing.seconds, 1);
    archive_f64(archive, &replica->cpu_seconds, 1);
    archive_i64(archive, &replica->packing.windows, 1);
    archive_f64(archive, &replica->packing.lattice_scale, 1);
    tally_archive(&replica->tally, archive);
    tally_archive(&replica->finished, archive);
    archive_require(archive, *stage <= replica->plan->stage_count, "it has a stage too many");
    archive_require(archive, *begun == 0 || (*begun == 1 && *stage < replica->plan->stage_count),
                    "it is inside a stage that does not exist");
    archive_require(archive, *begun == 1 || replica->tick == 0,
                    "it has a tick outside of any stage");
    archive_require(archive,
                    replica->frames_taken >= 0 && replica->frames_taken <= replica->frames_due &&
                        replica->frames_due <= plan_frames(replica->plan),
                    "its frame counts cannot be");
}

void replica_save(Replica *replica, Archive *archive) {
    ASSERT(replica_can_save(replica));
    uint64_t stage = replica->stage, begun = replica->propagator != NULL;
    archive_place(replica, archive, &stage, &begun);
    archive_state(replica, archive, replica->stage + begun);
    archive_observers(replica, archive, replica->stage + begun);
    archive_propagator(replica, archive);
}

static Status load(Replica *replica, Archive *archive) {
    uint64_t stage = 0, begun = 0;
    archive_place(replica, archive, &stage, &begun);
    TRY(archive_status(archive, false)); // from here on the stage is one of the plan
    TRY(state_create(&replica->state, &replica->plan->system));
    for (size_t s = 0; s < STAGES_MOST; s++) replica->boxes[s] = replica->state->box;
    archive_state(replica, archive, (size_t)(stage + begun));
    TRY(archive_status(archive, false));
    replica->stage = (size_t)stage;
    for (size_t s = 0; s < stage + begun; s++) TRY(make_observers(replica, s));
    archive_observers(replica, archive, (size_t)(stage + begun));
    TRY(archive_status(archive, !begun));
    if (!begun) return OK;
    const Clock clock = plan_clock(replica->plan, replica->stage);
    if (replica->tick < 0 || replica->tick >= clock.ticks ||
        replica->tick % clock.ticks_per_step != 0) {
        return status_fail(BAD_DATA, "stored state cannot be used: it is at tick %lld of %lld",
                           (long long)replica->tick, (long long)clock.ticks);
    }
    TRY(make_propagator(replica));
    archive_propagator(replica, archive);
    return archive_status(archive, true);
}

Status replica_load(Replica **out, const Plan *plan, size_t index, Archive *archive) {
    Replica *replica = NULL;
    TRY(allocate(&replica, plan, index));
    const Status status = load(replica, archive);
    if (status != OK) {
        replica_free(replica);
        return status;
    }
    *out = replica;
    return OK;
}

bool replica_frame_due(const Replica *replica) {
    return replica->frames_due > replica->frames_taken;
}

void replica_frame_taken(Replica *replica) {
    ASSERT(replica_frame_due(replica));
    replica->frames_taken++;
}

int64_t replica_frames_done(const Replica *replica) {
    return replica->frames_taken;
}

const State *replica_state(const Replica *replica) {
    return replica->state;
}

size_t replica_stage(const Replica *replica) {
    return replica->stage;
}

double replica_stage_time(const Replica *replica) {
    return replica->propagator ? replica->clock.tick * (double)replica->tick : 0;
}

double replica_recorded_time(const Replica *replica) {
    const Plan *plan = replica->plan;
    const bool inside = replica->propagator && stage_is_recorded(plan, replica->stage);
    double time = inside ? replica_stage_time(replica) : 0;
    for (size_t s = 0; s < replica->stage; s++) {
        if (!stage_is_recorded(plan, s)) continue;
        const Clock clock = plan_clock(replica->plan, s);
        time += clock.tick * (double)clock.ticks;
    }
    return time;
}

static double stage_work(const Plan *plan, size_t stage, int64_t ticks) {
    const Dynamics *dynamics = &plan->stages[stage].dynamics;
    return (double)ticks *
           dynamics->kind->seconds_per_particle_tick(&dynamics->settings, &plan->system);
}

double replica_progress(const Replica *replica) {
    double done = 0, all = 0;
    for (size_t s = 0; s < replica->plan->stage_count; s++) {
        const int64_t ticks = plan_clock(replica->plan, s).ticks;
        all += stage_work(replica->plan, s, ticks);
        if (s < replica->stage) done += stage_work(replica->plan, s, ticks);
        if (s == replica->stage) done += stage_work(replica->plan, s, replica->tick);
    }
    return done / all;
}

Tally replica_tally(const Replica *replica) {
    Tally sum = replica->finished;
    tally_add(&sum, &replica->tally);
    return sum;
}

double replica_cpu_seconds(const Replica *replica) {
    return replica->cpu_seconds;
}

PackingReport replica_packing(const Replica *replica) {
    return replica->packing;
}

uint64_t replica_overlaps(const Replica *replica) {
    return replica->overlaps;
}

double replica_deepest_overlap(const Replica *replica) {
    return replica->deepest_overlap;
}

double replica_orientation_drift(const Replica *replica) {
    return replica->orientation_drift;
}

Status replica_write(const Replica *replica, Results *results) {
    for (size_t s = 0; s < replica->plan->stage_count; s++) {
        for (size_t k = 0; k < replica->plan->stages[s].observation_count; k++) {
            const Observer *observer = replica->observers[s][k];
            TRY(observer->kind->write(observer, replica->state, results,
                                      (size_t)replica->key.replica));
        }
    }
    return OK;
}
