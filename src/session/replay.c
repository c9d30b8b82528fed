// SPDX-License-Identifier: GPL-3.0-or-later
// Stored configurations shown to observers, as if time went on.
#include "analysis/analysis.h"
#include "base/memory.h"
#include "base/text.h"
#include "config/config.h"
#include "protocol/replica.h"
#include "session/provenance.h"
#include "session/session.h"
#include "store/trajectory.h"

#include <stdio.h>
#include <string.h>

// One stage of one replica.
typedef struct Replay {
    const Stage *stage;
    StageFrames frames;
    Clock clock;
    TrajectoryFile *file;
    const char *path;
    State *state;
    Observer *observers[OBSERVATIONS_MOST];
} Replay;

static bool observes_configurations(const Stage *stage) {
    for (size_t k = 0; k < stage->observation_count; k++) {
        if (!stage->observations[k].kind->of_motion) return true;
    }
    return false;
}

static bool is_replayed(const Plan *plan, size_t stage) {
    return plan_stage_frames(plan, stage).every > 0 &&
           observes_configurations(&plan->stages[stage]);
}

// The clock of the stage, with a step from one frame to the next.
static Clock clock_of_frames(const Plan *plan, size_t stage) {
    Clock clock = plan_clock(plan, stage);
    clock.ticks_per_step = plan_stage_frames(plan, stage).every;
    clock.whole_steps = true;
    return clock;
}

static Status check_stage(const Plan *plan, size_t index) {
    const Stage *stage = &plan->stages[index];
    const Clock clock = clock_of_frames(plan, index);
    for (size_t k = 0; k < stage->observation_count; k++) {
        const Observation *observation = &stage->observations[k];
        if (observation->kind->of_motion || !observation->kind->check) continue;
        TRY(observation->kind->check(&observation->settings, &plan->system, &clock));
    }
    return OK;
}

static Status make_observers(Replay *replay) {
    for (size_t k = 0; k < replay->stage->observation_count; k++) {
        const Observation *observation = &replay->stage->observations[k];
        if (observation->kind->of_motion) continue;
        TRY(observation->kind->create(&replay->observers[k], &observation->settings, replay->state,
                                      &replay->clock));
    }
    return OK;
}

static void free_observers(Replay *replay) {
    for (size_t k = 0; k < OBSERVATIONS_MOST; k++) {
        if (replay->observers[k]) replay->observers[k]->kind->free(replay->observers[k]);
    }
}

static int64_t next_tick(const Replay *replay, int64_t after) {
    int64_t next = INT64_MAX;
    for (size_t k = 0; k < replay->stage->observation_count; k++) {
        const Observer *observer = replay->observers[k];
        if (!observer) continue;
        const int64_t wish = observer->kind->next(observer, after);
        if (wish < next) next = wish;
    }
    return next;
}

static Status load_frame(Replay *replay, int64_t tick) {
    const StageFrames *frames = &replay->frames;
    ASSERT(tick % frames->every == 0);
    const int64_t index = tick ? frames->first + tick / frames->every - 1 : frames->start;
    const TrajectoryContents contents = trajectory_file_contents(replay->file);
    if (index < 0) {
        return status_fail(BAD_DATA,
                           "'%s' has no configuration at the very start of the stage '%s', which "
                           "an observable needs; a run with trajectory.stage: %s stores it",
                           replay->path, replay->stage->name, replay->stage->name);
    }
    TrajectoryFrame frame;
    bool there = false;
    if (index < contents.frames) TRY(trajectory_file_frame(replay->file, index, &frame, &there));
    if (!there) {
        return status_fail(BAD_DATA,
                           "'%s' has no whole frame %lld of the stage '%s': it was damaged since, "
                           "or the run was stopped, and the same 'perrin run' goes on with it",
                           replay->path, (long long)index, replay->stage->name);
    }
    Box box = replay->state->box;
    box_lean(&box, frame.edges[1][0], frame.strain);
    state_place(replay->state, &box, frame.position, frame.image, frame.orientation);
    return OK;
}

static Status show(Replay *replay, int64_t before, int64_t tick) {
    static const Tally nothing = {0};
    for (size_t k = 0; k < replay->stage->observation_count; k++) {
        Observer *observer = replay->observers[k];
        if (!observer || observer->kind->next(observer, before) != tick) continue;
        TRY(observer->kind->see(observer, tick, replay->state, &nothing));
    }
    return OK;
}

// Observers are made for the box in which the stage began, which a flow before it may have left
// leaning; at rest it still does in the first frame.
static Status begin(Replay *replay) {
    if (replay->frames.start >= 0)
        TRY(load_frame(replay, 0));
    else if (!replay->clock.drive)
        TRY(load_frame(replay, replay->frames.every));
    return make_observers(replay);
}

static Status go_through(Replay *replay, Results *results, size_t replica) {
    TRY(begin(replay));
    int64_t before = -1, tick;
    while ((tick = next_tick(replay, before)) != INT64_MAX) {
        TRY(load_frame(replay, tick));
        TRY(show(replay, before, tick));
        before = tick;
    }
    for (size_t k = 0; k < replay->stage->observation_count; k++) {
        const Observer *observer = replay->observers[k];
        if (observer) TRY(observer->kind->write(observer, replay->state, results, replica));
    }
    return OK;
}

// Sizes may be spread, and are drawn when a replica is packed: they are the file's.
static Status take_particles(State **out, const Plan *plan, const TrajectoryContents *contents,
                             const char *path) {
    if (contents->particles != (size_t)plan->system.particles ||
        contents->dimension != (int)plan->system.dimension) {
        return status_fail(BAD_DATA, "'%s' is of another system than the plan beside it", path);
    }
    TRY(state_create(out, &plan->system));
    memcpy((*out)->diameter, contents->diameter, contents->particles * sizeof(double));
    return OK;
}

static Status replay_stages(const Plan *plan, TrajectoryFile *file, const char *path,
                            Results *results, size_t replica) {
    const TrajectoryContents contents = trajectory_file_contents(file);
    for (size_t s = 0; s < plan->stage_count; s++) {
        if (!is_replayed(plan, s)) continue;
        Replay replay = {.stage = &plan->stages[s],
                         .frames = plan_stage_frames(plan, s),
                         .clock = clock_of_frames(plan, s),
                         .file = file,
                         .path = path};
        Status status = take_particles(&replay.state, plan, &contents, path);
        if (status == OK) status = go_through(&replay, results, replica);
        free_observers(&replay);
        state_free(replay.state);
        TRY(status);
    }
    return OK;
}

static Status replay_replica(const Plan *plan, const char *directory, Results *results,
                             size_t replica) {
    Text path = {0};
    TrajectoryFile *file = NULL;
    text_add(&path, "%s/trajectory/replica-%04zu.h5", directory, replica);
    Status status = text_status(&path);
    if (status == OK) status = trajectory_file_open(&file, text_words(&path));
    if (status == OK) status = replay_stages(plan, file, text_words(&path), results, replica);
    trajectory_file_close(file);
    text_free(&path);
    return status;
}

static Status check_plan(const Plan *plan) {
    size_t replayed = 0;
    for (size_t s = 0; s < plan->stage_count; s++) {
        if (!is_replayed(plan, s)) continue;
        TRY(check_stage(plan, s));
        replayed++;
    }
    if (replayed > 0) return OK;
    return status_fail(BAD_DATA,
                       "there is nothing to analyse: no stage that observes configurations "
                       "has a trajectory");
}

static Status fill(const Plan *plan, const char *directory, Results *results) {
    char *text = NULL;
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(replay_replica(plan, directory, results, r));
    }
    TRY(config_write(plan, &text));
    const Status status = provenance_put(results, plan, text, 0);
    memory_free(text);
    TRY(status);
    TRY(results_put_fact(results, "analysed", directory));
    TRY(analysis_derive(results, &plan->system));
    TRY(analysis_centre(results, plan));
    TRY(analysis_equation(results, plan));
    return analysis_judge(results, plan);
}

Status session_analyse(Results **out, const Plan *plan, const char *directory) {
    Results *results = NULL;
    TRY(check_plan(plan));
    TRY(results_create(&results, (size_t)plan->ensemble.replicas));
    const Status status = fill(plan, directory, results);
    if (status != OK) {
        results_free(results);
        return status;
    }
    *out = results;
    return OK;
}
