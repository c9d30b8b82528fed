// SPDX-License-Identifier: GPL-3.0-or-later
// One replica on its way through the stages: state, propagator, observers, and where it is. The
// ensemble drives it in slices and saves it between them; results do not depend on the slicing.
#pragma once

#include "packing/packing.h"
#include "protocol/plan.h"

#include <stdatomic.h>

typedef struct Replica Replica;

// Packs. The plan is borrowed. `stop`: see packing_create.
Status replica_create(Replica **out, const Plan *plan, size_t index, const atomic_int *stop);
// From what replica_save wrote.
Status replica_load(Replica **out, const Plan *plan, size_t index, Archive *archive);
void replica_free(Replica *replica);

bool replica_finished(const Replica *replica);

// Advances to the next observation, frame or slice end, whichever comes first, and lets look.
Status replica_advance(Replica *replica);

bool replica_can_save(const Replica *replica); // at the end of a step
void replica_save(Replica *replica, Archive *archive);

// A trajectory frame is due now; `taken` when it has been written.
bool replica_frame_due(const Replica *replica);
void replica_frame_taken(Replica *replica);
int64_t replica_frames_done(const Replica *replica); // taken so far, over all stages
int64_t plan_frames(const Plan *plan);               // of one replica, over all stages

// Where a stage's frames are in the trajectory of a replica.
typedef struct StageFrames {
    int64_t every; // ticks between frames; 0: the stage is not recorded
    int64_t start; // the frame at its start; -1 if there is none
    int64_t first; // the frame after `every` ticks
} StageFrames;

StageFrames plan_stage_frames(const Plan *plan, size_t stage);

const State *replica_state(const Replica *replica);
size_t replica_stage(const Replica *replica);
double replica_stage_time(const Replica *replica);    // in the stage's unit
double replica_recorded_time(const Replica *replica); // since recording began, stage times summed
double replica_progress(const Replica *replica);      // fraction of the estimated work, 0 to 1
Tally replica_tally(const Replica *replica);          // over all stages
double replica_cpu_seconds(const Replica *replica);   // packing apart, over all sessions
PackingReport replica_packing(const Replica *replica);
uint64_t replica_overlaps(const Replica *replica); // at observations, deeper than the limit
double replica_deepest_overlap(const Replica *replica);
double replica_orientation_drift(const Replica *replica); // largest | |u| - 1 | of body axes

// All observers' numbers, into this replica's slot.
Status replica_write(const Replica *replica, Results *results);
