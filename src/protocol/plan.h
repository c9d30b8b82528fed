// SPDX-License-Identifier: GPL-3.0-or-later
// What is to be done, as a plain value with all defaults filled: what the run file becomes, and
// what every output carries.
#pragma once

#include "observables/observables.h"
#include "propagator/propagator.h"
#include "schematic/schematic.h"
#include "state/system.h"
#include "itt/itt.h"
#include "theory/theory.h"

enum { STAGES_MOST = 16, OBSERVATIONS_MOST = 32, TITLE_SIZE = OPTION_TEXT_SIZE };

typedef struct Observation {
    const ObservableKind *kind;
    Settings settings;
} Observation;

typedef struct Stage {
    char name[OPTION_TEXT_SIZE];
    double time;         // in the method's time_unit; 0: as long as the strain takes
    double strain;       // at which it ends, if that is given in place of a time
    double stress_error; // relative, at which it ends before; 0: not
    Drive drive;
    Dynamics dynamics;
    size_t observation_count;
    Observation observations[OBSERVATIONS_MOST];
} Stage;

typedef struct EnsemblePlan {
    int64_t replicas;
    int64_t seed;
} EnsemblePlan;

typedef struct OutputPlan {
    double trajectory_every;                 // in the stage's time unit; 0: no trajectory
    char trajectory_stage[OPTION_TEXT_SIZE]; // the only stage to record; "": all
    double checkpoint_every;                 // wall-clock seconds
} OutputPlan;

typedef struct Plan {
    char title[TITLE_SIZE];
    System system;
    Dynamics dynamics; // of stages that do not override it
    size_t stage_count;
    Stage stages[STAGES_MOST];
    EnsemblePlan ensemble;
    OutputPlan output;
    TheoryPlan theory; // with species: a run of the theory, of which all but the title is empty
    IttPlan itt;       // given: likewise, of the theory under shear
    SchematicPlan schematic; // given: likewise, of a schematic model
} Plan;

extern const OptionTable stage_options;       // of one entry of `protocol:`, beside drive_options
extern const OptionTable stage_until_options; // of a Stage: how it may end before
extern const OptionTable ensemble_options;
extern const OptionTable output_options;

bool plan_is_theory(const Plan *plan); // of one of the theories: there are no particles

// BAD_DATA with a sentence if a stage cannot be driven like this, or has no end.
Status stage_check_drive(const Plan *plan, size_t stage);
// Likewise, if it cannot end by what is measured.
Status stage_check_until(const Plan *plan, size_t stage);
bool stage_is_recorded(const Plan *plan, size_t stage); // in the trajectory
double stage_time(const Stage *stage); // how long it lasts, in the method's time_unit

// The time axis of a stage: its time rounded to a whole number of steps, at least one.
Clock plan_clock(const Plan *plan, size_t stage);

// BAD_DATA with a sentence if something cannot be: method against shape, density, observations.
Status plan_check(const Plan *plan);
// Likewise, if a file that is read is not there or does not fit. `checksum` tells its numbers apart
// from others; 0: nothing is read.
Status plan_check_input(const Plan *plan, uint32_t *checksum);
const TheoryInput *plan_input(const Plan *plan); // NULL: nothing is read
// Results carry that of the numbers that they come from as a fact, in eight hexadecimal digits.
Status plan_put_checksum(Results *results, uint32_t checksum);
bool plan_has_checksum(const Results *results, uint32_t checksum);
#define PLAN_CHECKSUM_FACT "structure_checksum"
size_t plan_slots(const Plan *plan); // of its Results: replicas, or groups of those that it reads

size_t plan_memory(const Plan *plan);                      // bytes of one replica
double plan_seconds(const Plan *plan);                     // rough CPU seconds of one replica
double plan_stage_seconds(const Plan *plan, size_t stage); // of that, in one stage of a simulation
