// SPDX-License-Identifier: GPL-3.0-or-later
// Inside the ensemble: one replica from its checkpoint or its packing to its end, and what the
// threads share.
#pragma once

#include "ensemble/ensemble.h"
#include "protocol/plan.h"
#include "store/store.h"

#include <pthread.h>
#include <stdatomic.h>

typedef struct UnitHealth {
    Tally tally;
    uint64_t overlaps; // seen at output, deeper than the limit
    double deepest_overlap;
    double orientation_drift; // largest | |u| - 1 | of body axes
} UnitHealth;

// What others see of a replica; under the mutex.
typedef struct Unit {
    bool running, finished;
    double fraction, fraction_at_start; // of its work
    double particle_steps;              // done in this process
    double cpu_seconds;                 // when finished: over all sessions, packing apart
    double packing_seconds;
    const char *stage; // of the plan
    double stage_time;
    const char *stage_unit;
    UnitHealth health; // when finished
} Unit;

typedef struct EnsembleShared {
    const Plan *plan;
    Store *store;
    atomic_int stop;
    atomic_uint checkpoint_requests;
    pthread_mutex_t mutex; // of what follows
    Unit *units;           // [replicas]
    Results *results;
    Status failure;
    char sentence[1024];
} EnsembleShared;

void slots_take(EnsembleSlots *slots); // waits for one
void slots_give(EnsembleSlots *slots);

Status unit_run(EnsembleShared *shared, size_t replica);

// Health counters, with the limit of each.
Status unit_health_put(Results *results, const UnitHealth *health);
