// SPDX-License-Identifier: GPL-3.0-or-later
// Replicas over threads: takes each from its checkpoint or from packing to its end, keeps
// trajectories and checkpoints, and collects the results. The only place that knows threads; what
// comes out does not depend on how many there are.
#pragma once

#include "protocol/plan.h"
#include "store/store.h"

typedef struct Ensemble Ensemble;

// Processors that several ensembles share: each of their threads works only while it holds one.
typedef struct EnsembleSlots EnsembleSlots;

Status ensemble_slots_create(EnsembleSlots **out, int threads); // 0: as many as processors
int ensemble_slots_free_now(EnsembleSlots *slots);              // that no thread holds
size_t ensemble_slots_count(const EnsembleSlots *slots);
void ensemble_slots_free(EnsembleSlots *slots);

// Plan, store and slots are borrowed until ensemble_free.
Status ensemble_create(Ensemble **out, const Plan *plan, Store *store, EnsembleSlots *slots);
size_t ensemble_threads(const Ensemble *ensemble); // that it uses
Status ensemble_start(Ensemble *ensemble);

bool ensemble_running(const Ensemble *ensemble);

// Both return at once: the threads act at the end of their slice, a twentieth of a second.
void ensemble_stop(Ensemble *ensemble);               // checkpoint, then stop
void ensemble_request_checkpoint(Ensemble *ensemble); // checkpoint, then go on

typedef struct EnsembleProgress {
    double fraction;     // of the work, 0 to 1
    double seconds;      // wall time since the start
    double seconds_left; // estimated; NaN at first
    double rate;         // particle steps (trials, in Monte Carlo) per wall second, all threads
    size_t replicas, running, finished;
    const char *stage; // of the replica that is furthest behind among those running
    double stage_time; // in stage_unit
    const char *stage_unit;
} EnsembleProgress;

EnsembleProgress ensemble_progress(const Ensemble *ensemble);

// Waits for the threads. OK: results are complete and yours. INTERRUPTED: stopped on request, all
// is in checkpoints. Otherwise the first failure.
Status ensemble_finish(Ensemble *ensemble, Results **out);
void ensemble_free(Ensemble *ensemble);
