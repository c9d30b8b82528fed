// SPDX-License-Identifier: GPL-3.0-or-later
// One replica from its checkpoint or its packing to its end.
#include "ensemble/unit.h"

#include "base/patience.h"
#include "base/seconds.h"
#include "protocol/calculation.h"
#include "protocol/replica.h"
#include "store/checkpoint.h"
#include "store/trajectory.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

typedef struct Run {
    EnsembleShared *shared;
    size_t index;
    Replica *replica;
    Trajectory *trajectory; // NULL without one
    double last_checkpoint; // wall seconds
    unsigned requests_seen;
} Run;

// CPU time of this thread.
static double thread_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static Status open_replica(Run *run) {
    const Plan *plan = run->shared->plan;
    void *bytes = NULL;
    size_t size = 0;
    TRY(checkpoint_read(run->shared->store, run->index, &bytes, &size));
    if (!bytes) return replica_create(&run->replica, plan, run->index, &run->shared->stop);
    Archive archive = archive_reader(bytes, size);
    Status status = replica_load(&run->replica, plan, run->index, &archive);
    free(bytes);
    if (status != OK) {
        status = status_fail(status, "checkpoint of replica %zu in %s: %s", run->index,
                             store_directory(run->shared->store), status_sentence());
    }
    return status;
}

static Status open_trajectory(Run *run) {
    const int64_t frames = plan_frames(run->shared->plan);
    if (frames == 0) return OK;
    return trajectory_open(&run->trajectory, run->shared->store, run->index,
                           replica_state(run->replica), frames, replica_frames_done(run->replica));
}

static Status write_frames(Run *run) {
    if (!run->trajectory || !replica_frame_due(run->replica)) return OK;
    const State *state = replica_state(run->replica);
    const double time = replica_recorded_time(run->replica);
    TRY(trajectory_write(run->trajectory, state, state->step, time));
    replica_frame_taken(run->replica);
    return OK;
}

// What the checkpoint relies on, the trajectory, is made durable first.
static Status write_checkpoint(Run *run) {
    if (run->trajectory) TRY(trajectory_sync(run->trajectory));
    Archive archive = archive_writer();
    replica_save(run->replica, &archive);
    Status status = archive_status(&archive, true);
    if (status == OK) {
        status = checkpoint_write(run->shared->store, run->index, archive.bytes, archive.size);
    }
    archive_free(&archive);
    run->last_checkpoint = seconds_now();
    run->requests_seen = atomic_load(&run->shared->checkpoint_requests);
    return status;
}

static bool checkpoint_due(const Run *run) {
    if (atomic_load(&run->shared->checkpoint_requests) != run->requests_seen) return true;
    const double since = seconds_now() - run->last_checkpoint;
    return since >= run->shared->plan->output.checkpoint_every;
}

static void tell_packing(Run *run) {
    Unit *unit = &run->shared->units[run->index];
    pthread_mutex_lock(&run->shared->mutex);
    unit->running = true;
    unit->stage = "packing";
    unit->stage_unit = "";
    pthread_mutex_unlock(&run->shared->mutex);
}

static void tell_start(Run *run) {
    Unit *unit = &run->shared->units[run->index];
    pthread_mutex_lock(&run->shared->mutex);
    unit->fraction = unit->fraction_at_start = replica_progress(run->replica);
    unit->packing_seconds = replica_packing(run->replica).seconds;
    pthread_mutex_unlock(&run->shared->mutex);
}

static void tell_progress(Run *run, double particle_steps) {
    const Plan *plan = run->shared->plan;
    const size_t stage = replica_stage(run->replica);
    Unit *unit = &run->shared->units[run->index];
    pthread_mutex_lock(&run->shared->mutex);
    unit->fraction = replica_progress(run->replica);
    unit->particle_steps += particle_steps;
    if (stage < plan->stage_count) {
        unit->stage = plan->stages[stage].name;
        unit->stage_time = replica_stage_time(run->replica);
        unit->stage_unit = plan->stages[stage].dynamics.kind->time_unit;
    }
    pthread_mutex_unlock(&run->shared->mutex);
}

static double particle_steps(const Run *run) {
    const Tally tally = replica_tally(run->replica);
    return tally_particle_steps(&tally, (double)run->shared->plan->system.particles);
}

static Status advance(Run *run) {
    const double before = particle_steps(run);
    TRY(replica_advance(run->replica));
    tell_progress(run, particle_steps(run) - before);
    return OK;
}

static Status run_through(Run *run) {
    run->last_checkpoint = seconds_now();
    run->requests_seen = atomic_load(&run->shared->checkpoint_requests);
    while (true) {
        TRY(write_frames(run));
        if (replica_finished(run->replica)) return OK;
        if (replica_can_save(run->replica)) {
            if (atomic_load(&run->shared->stop)) {
                TRY(write_checkpoint(run));
                return status_fail(INTERRUPTED, "replica %zu stopped at a checkpoint", run->index);
            }
            if (checkpoint_due(run)) TRY(write_checkpoint(run));
        }
        TRY(advance(run));
    }
}

static Status collect(Run *run) {
    EnsembleShared *shared = run->shared;
    Unit *unit = &shared->units[run->index];
    pthread_mutex_lock(&shared->mutex);
    const Status status = replica_write(run->replica, shared->results);
    unit->health = (UnitHealth){.tally = replica_tally(run->replica),
                                .overlaps = replica_overlaps(run->replica),
                                .deepest_overlap = replica_deepest_overlap(run->replica),
                                .orientation_drift = replica_orientation_drift(run->replica)};
    unit->cpu_seconds = replica_cpu_seconds(run->replica);
    unit->finished = status == OK;
    unit->fraction = 1;
    pthread_mutex_unlock(&shared->mutex);
    return status;
}

static Status run_unit(Run *run) {
    tell_packing(run);
    TRY(open_replica(run));
    TRY(open_trajectory(run));
    tell_start(run);
    const bool was_finished = replica_finished(run->replica);
    TRY(run_through(run));
    if (!was_finished) TRY(write_checkpoint(run));
    return collect(run);
}

typedef struct Theorist {
    EnsembleShared *shared;
    Calculation *calculation;
    double last_checkpoint; // wall seconds
    unsigned requests_seen;
    double seconds_before; // CPU time of the sessions before
} Theorist;

static void tell_calculation(const Theorist *theorist, bool running) {
    const Calculation *calculation = theorist->calculation;
    EnsembleShared *shared = theorist->shared;
    Unit *unit = &shared->units[0];
    pthread_mutex_lock(&shared->mutex);
    unit->running = running;
    unit->fraction = calculation_progress(calculation);
    unit->stage = calculation_doing(calculation);
    unit->stage_time = calculation_time(calculation);
    unit->stage_unit = unit->stage_time > 0 ? "d^2/D0" : NULL;
    unit->finished = calculation_finished(calculation);
    unit->cpu_seconds = theorist->seconds_before + thread_seconds();
    pthread_mutex_unlock(&shared->mutex);
}

static Status save_calculation(Theorist *theorist) {
    EnsembleShared *shared = theorist->shared;
    double seconds = theorist->seconds_before + thread_seconds();
    uint64_t checksum = calculation_checksum(theorist->calculation);
    Archive archive = archive_writer();
    archive_f64(&archive, &seconds, 1);
    archive_u64(&archive, &checksum, 1);
    calculation_save(theorist->calculation, &archive);
    Status status = archive_status(&archive, true);
    if (status == OK) status = checkpoint_write(shared->store, 0, archive.bytes, archive.size);
    archive_free(&archive);
    theorist->last_checkpoint = seconds_now();
    theorist->requests_seen = atomic_load(&shared->checkpoint_requests);
    return status;
}

static Status tell_where(const Theorist *theorist) {
    EnsembleShared *shared = theorist->shared;
    pthread_mutex_lock(&shared->mutex);
    shared->units[0].fraction_at_start = calculation_progress(theorist->calculation);
    pthread_mutex_unlock(&shared->mutex);
    return store_log(shared->store, "the theory goes on at t = %.4g d^2/D0",
                     calculation_time(theorist->calculation));
}

// `fits`: of the same numbers as were read now.
static Status load_archive(Theorist *theorist, Archive *archive, bool *fits) {
    uint64_t checksum;
    double seconds;
    archive_f64(archive, &seconds, 1);
    archive_u64(archive, &checksum, 1);
    TRY(archive_status(archive, false));
    *fits = checksum == calculation_checksum(theorist->calculation);
    if (!*fits) return OK;
    theorist->seconds_before = seconds;
    TRY(calculation_load(theorist->calculation, theorist->shared->results, archive));
    return archive_status(archive, true);
}

static Status load_calculation(Theorist *theorist) {
    EnsembleShared *shared = theorist->shared;
    void *bytes = NULL;
    size_t size = 0;
    bool fits = true;
    TRY(checkpoint_read(shared->store, 0, &bytes, &size));
    if (!bytes) return OK;
    Archive archive = archive_reader(bytes, size);
    const Status status = load_archive(theorist, &archive, &fits);
    free(bytes);
    if (status == OK && fits) return tell_where(theorist);
    if (status == OK)
        return store_log(shared->store, "the checkpoint is of another structure than is read now: "
                                        "the theory begins anew");
    return status_fail(status, "checkpoint of the theory in %s: %s", store_directory(shared->store),
                       status_sentence());
}

static Status stop_calculation(Theorist *theorist) {
    if (!calculation_can_save(theorist->calculation))
        return status_fail(INTERRUPTED,
                           "no checkpoint is kept of this part of the theory, which begins anew");
    TRY(save_calculation(theorist));
    return status_fail(INTERRUPTED, "the theory stopped at a checkpoint");
}

static bool calculation_save_due(const Theorist *theorist) {
    const EnsembleShared *shared = theorist->shared;
    if (!calculation_can_save(theorist->calculation)) return false;
    if (atomic_load(&shared->checkpoint_requests) != theorist->requests_seen) return true;
    const double since = seconds_now() - theorist->last_checkpoint;
    return since >= shared->plan->output.checkpoint_every;
}

// The one unit of a run of the theory, which alone puts results in.
static Status run_calculation(Theorist *theorist) {
    EnsembleShared *shared = theorist->shared;
    TRY(load_calculation(theorist));
    tell_calculation(theorist, true);
    while (!calculation_finished(theorist->calculation)) {
        if (atomic_load(&shared->stop)) return stop_calculation(theorist);
        if (calculation_save_due(theorist)) TRY(save_calculation(theorist));
        const Status status = calculation_advance(theorist->calculation, shared->results);
        if (status == INTERRUPTED) return stop_calculation(theorist);
        TRY(status);
        tell_calculation(theorist, true);
    }
    return OK;
}

static Status work_out(EnsembleShared *shared) {
    Theorist theorist = {.shared = shared,
                         .last_checkpoint = seconds_now(),
                         .requests_seen = atomic_load(&shared->checkpoint_requests)};
    TRY(calculation_create(&theorist.calculation, shared->plan));
    Status status = plan_put_checksum(shared->results, calculation_checksum(theorist.calculation));
    if (status == OK) status = run_calculation(&theorist);
    tell_calculation(&theorist, false);
    calculation_free(theorist.calculation);
    return status;
}

// Some steps take minutes: they are left within.
static Status unit_calculation(EnsembleShared *shared) {
    patience_set(&shared->stop);
    const Status status = work_out(shared);
    patience_set(NULL);
    return status;
}

Status unit_run(EnsembleShared *shared, size_t replica) {
    if (plan_is_theory(shared->plan)) return unit_calculation(shared);
    Run run = {.shared = shared, .index = replica};
    Status status = run_unit(&run);
    // A trajectory that cannot be closed may have lost frames: that is a failure like another.
    const Status closed = trajectory_close(run.trajectory);
    if (status == OK) status = closed;
    replica_free(run.replica);
    pthread_mutex_lock(&shared->mutex);
    shared->units[replica].running = false;
    pthread_mutex_unlock(&shared->mutex);
    return status;
}

Status unit_health_put(Results *results, const UnitHealth *health) {
    const Tally *tally = &health->tally;
    const double trials = (double)tally_trials(tally);
    double accepted = 0;
    for (size_t s = 0; s < SPECIES_MOST; s++) accepted += (double)tally->moves[s].accepted;
    const struct {
        const char *name, *about;
        double value, limit;
    } rows[] = {
        {"overlaps", "pairs found overlapping at output, deeper than 1e-12 of contact",
         (double)health->overlaps, 0},
        {"deepest_overlap", "deepest overlap at output, relative to contact",
         health->deepest_overlap, 1e-12},
        {"orientation_drift", "largest deviation of the length of a body axis from 1",
         health->orientation_drift, 1e-9},
        {"deepest_contact", "deepest overlap of a colliding pair, relative to contact",
         tally->deepest_contact, 1e-9},
        {"corrected_contacts", "pairs found overlapping and approaching, collided at once",
         (double)tally->corrected, NAN},
        {"collisions", "pair collisions, each counted once", (double)tally->collisions, NAN},
        {"windows", "event windows run", (double)tally->windows, NAN},
        {"stale_events", "predicted collisions voided by an earlier one", (double)tally->stale,
         NAN},
        {"list_rebuilds", "rebuilds of the neighbour list", (double)tally->rebuilds, NAN},
        {"replays", "windows replayed since a particle outran the list", (double)tally->replays,
         NAN},
        {"trials", "trial moves of Monte Carlo", trials, NAN},
        {"rejected_fraction", "fraction of the trial moves that were rejected",
         trials > 0 ? 1 - accepted / trials : 0, NAN},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        TRY(results_put_health(results, rows[i].name, rows[i].about, rows[i].limit, rows[i].value));
    }
    return OK;
}
