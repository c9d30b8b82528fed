// SPDX-License-Identifier: GPL-3.0-or-later
// Replicas over threads.
#include "ensemble/ensemble.h"

#include "base/memory.h"
#include "base/plain_locale.h"
#include "base/seconds.h"
#include "ensemble/unit.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

struct Ensemble {
    EnsembleShared shared;
    EnsembleSlots *slots;
    size_t threads, started;
    pthread_t *thread;
    atomic_size_t next_replica;
    atomic_size_t threads_left;
    double start; // monotonic seconds
};

static Status allocate(Ensemble *ensemble, const Plan *plan) {
    EnsembleShared *shared = &ensemble->shared;
    const size_t replicas = (size_t)plan->ensemble.replicas;
    const size_t slots = ensemble_slots_count(ensemble->slots);
    ensemble->threads = slots < replicas ? slots : replicas;
    TRY(NEW_ARRAY(ensemble->thread, ensemble->threads));
    TRY(NEW_ARRAY(shared->units, replicas));
    return results_create(&shared->results, plan_slots(plan));
}

Status ensemble_create(Ensemble **out, const Plan *plan, Store *store, EnsembleSlots *slots) {
    Ensemble *ensemble = NULL;
    TRY(NEW(ensemble));
    pthread_mutex_init(&ensemble->shared.mutex, NULL);
    ensemble->shared.plan = plan;
    ensemble->shared.store = store;
    ensemble->slots = slots;
    const Status status = allocate(ensemble, plan);
    if (status != OK) {
        ensemble_free(ensemble);
        return status;
    }
    *out = ensemble;
    return OK;
}

void ensemble_free(Ensemble *ensemble) {
    if (!ensemble) return;
    ASSERT(ensemble->started == 0);
    results_free(ensemble->shared.results);
    memory_free(ensemble->shared.units);
    memory_free(ensemble->thread);
    pthread_mutex_destroy(&ensemble->shared.mutex);
    memory_free(ensemble);
}

size_t ensemble_threads(const Ensemble *ensemble) {
    return ensemble->threads;
}

// The first failure is kept, with its sentence, and stops the others after a checkpoint. That some
// replica was interrupted is no failure of its own.
static void keep_failure(EnsembleShared *shared, Status status) {
    pthread_mutex_lock(&shared->mutex);
    const bool first = shared->failure == OK || shared->failure == INTERRUPTED;
    if (first && (status != INTERRUPTED || shared->failure == OK)) {
        shared->failure = status;
        snprintf(shared->sentence, sizeof shared->sentence, "%s", status_sentence());
    }
    pthread_mutex_unlock(&shared->mutex);
    atomic_store(&shared->stop, 1);
}

// The next replica; false when there is none or all are to stop.
static bool work_on_one(Ensemble *ensemble) {
    EnsembleShared *shared = &ensemble->shared;
    if (atomic_load(&shared->stop)) return false;
    const size_t replica = atomic_fetch_add(&ensemble->next_replica, 1);
    if (replica >= (size_t)shared->plan->ensemble.replicas) return false;
    const Status status = unit_run(shared, replica);
    if (status != OK) keep_failure(shared, status);
    return true;
}

static void *work(void *argument) {
    Ensemble *ensemble = argument;
    IN_PLAIN_LOCALE;
    for (bool more = true; more;) {
        slots_take(ensemble->slots);
        more = work_on_one(ensemble);
        slots_give(ensemble->slots);
    }
    atomic_fetch_sub(&ensemble->threads_left, 1);
    return NULL;
}

Status ensemble_start(Ensemble *ensemble) {
    ensemble->start = seconds_now();
    atomic_store(&ensemble->threads_left, ensemble->threads);
    for (; ensemble->started < ensemble->threads; ensemble->started++) {
        pthread_t *thread = &ensemble->thread[ensemble->started];
        const int reason = pthread_create(thread, NULL, work, ensemble);
        if (reason == 0) continue;
        const Status status = status_fail(NO_MEMORY, "cannot start a thread: %s", strerror(reason));
        atomic_fetch_sub(&ensemble->threads_left, ensemble->threads - ensemble->started);
        keep_failure(&ensemble->shared, status);
        return OK; // told by ensemble_finish, after the threads that did start
    }
    return OK;
}

bool ensemble_running(const Ensemble *ensemble) {
    return atomic_load(&ensemble->threads_left) > 0;
}

void ensemble_stop(Ensemble *ensemble) {
    atomic_store(&ensemble->shared.stop, 1);
}

void ensemble_request_checkpoint(Ensemble *ensemble) {
    atomic_fetch_add(&ensemble->shared.checkpoint_requests, 1);
}

static void count_unit(EnsembleProgress *progress, const Unit *unit, double *least) {
    progress->finished += unit->finished;
    progress->running += unit->running;
    if (!unit->running || unit->fraction >= *least) return;
    *least = unit->fraction;
    progress->stage = unit->stage;
    progress->stage_time = unit->stage_time;
    progress->stage_unit = unit->stage_unit;
}

EnsembleProgress ensemble_progress(const Ensemble *ensemble) {
    const EnsembleShared *shared = &ensemble->shared;
    const size_t replicas = (size_t)shared->plan->ensemble.replicas;
    EnsembleProgress progress = {
        .seconds = seconds_now() - ensemble->start, .replicas = replicas, .stage = ""};
    double done = 0, done_now = 0, least = 2, ticks = 0;
    pthread_mutex_t *mutex = (pthread_mutex_t *)&shared->mutex; // a look changes nothing
    pthread_mutex_lock(mutex);
    for (size_t r = 0; r < replicas; r++) {
        const Unit *unit = &shared->units[r];
        count_unit(&progress, unit, &least);
        done += unit->fraction;
        done_now += unit->fraction - unit->fraction_at_start;
        ticks += unit->particle_steps;
    }
    pthread_mutex_unlock(mutex);
    progress.fraction = done / (double)replicas;
    progress.rate = ticks / progress.seconds;
    progress.seconds_left =
        done_now > 0 ? progress.seconds * ((double)replicas - done) / done_now : NAN;
    return progress;
}

// Counters of all replicas, in the order of replicas.
static Status put_health(const EnsembleShared *shared) {
    Results *results = shared->results;
    UnitHealth sum = {.deepest_overlap = 0};
    for (size_t r = 0; r < results->replicas; r++) {
        const UnitHealth *health = &shared->units[r].health;
        tally_add(&sum.tally, &health->tally);
        sum.overlaps += health->overlaps;
        sum.deepest_overlap = fmax(sum.deepest_overlap, health->deepest_overlap);
        sum.orientation_drift = fmax(sum.orientation_drift, health->orientation_drift);
    }
    return unit_health_put(results, &sum);
}

static Status put_speed(const EnsembleShared *shared) {
    double seconds = 0, steps = 0, packing = 0;
    for (size_t r = 0; r < (size_t)shared->plan->ensemble.replicas; r++) {
        seconds += shared->units[r].cpu_seconds;
        steps += tally_particle_steps(&shared->units[r].health.tally,
                                      (double)shared->plan->system.particles);
        packing += shared->units[r].packing_seconds;
    }
    char text[64];
    snprintf(text, sizeof text, "%.3f", seconds);
    TRY(results_put_fact(shared->results, "cpu_seconds", text));
    if (plan_is_theory(shared->plan)) return OK;
    snprintf(text, sizeof text, "%.3f", packing);
    TRY(results_put_fact(shared->results, "packing_seconds", text));
    snprintf(text, sizeof text, "%.2f", steps > 0 ? 1e9 * seconds / steps : 0.0);
    return results_put_fact(shared->results, "ns_per_particle_tick", text);
}

Status ensemble_finish(Ensemble *ensemble, Results **out) {
    EnsembleShared *shared = &ensemble->shared;
    for (; ensemble->started > 0; ensemble->started--) {
        pthread_join(ensemble->thread[ensemble->started - 1], NULL);
    }
    const size_t replicas = (size_t)shared->plan->ensemble.replicas;
    for (size_t r = 0; shared->failure == OK && r < replicas; r++) {
        if (!shared->units[r].finished) {
            shared->failure = status_fail(INTERRUPTED, "stopped before replica %zu was done", r);
            snprintf(shared->sentence, sizeof shared->sentence, "%s", status_sentence());
        }
    }
    if (shared->failure != OK) return status_fail(shared->failure, "%s", shared->sentence);
    if (!plan_is_theory(shared->plan)) TRY(put_health(shared));
    TRY(put_speed(shared));
    *out = shared->results;
    shared->results = NULL;
    return OK;
}
