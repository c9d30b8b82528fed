// SPDX-License-Identifier: GPL-3.0-or-later
// What a Plan means: option tables, time axes, what cannot be, what it costs.
#include "protocol/plan.h"

#include "packing/packing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const Option stage_rows[] = {
    {"stage", OPTION_TEXT, offsetof(Stage, name), 0, 0, 0, "",
     "Name of the stage; it prefixes its results.", .required = 1},
    {"time", OPTION_REAL, offsetof(Stage, time), 0, 0, 1e12, "time unit of the method",
     "How long the stage lasts: d^2/D0 with event-driven and dynamic-monte-carlo, d sqrt(m/kT) "
     "with newtonian dynamics, cycles with monte-carlo. Give this or strain."},
    {"strain", OPTION_REAL, offsetof(Stage, strain), 0, 0, 1e9, "",
     "The strain at which a stage with a steady shear_rate ends, in place of a time."},
};
const OptionTable stage_options = {stage_rows, sizeof stage_rows / sizeof *stage_rows,
                                   sizeof(Stage)};

static const Option until_rows[] = {
    {"until.stress_error", OPTION_REAL, offsetof(Stage, stress_error), 0, 0, 1, "",
     "Standard error of the shear stress over its mean at which the stage ends: it observes "
     "stress, and its time or strain is the limit. Each replica ends by itself, at an error larger "
     "by the root of the number of replicas, as 16 stretches of its stress tell it and rather too "
     "late than too early; it looks from an averaged strain of 2 on, ever more rarely. The error "
     "over few replicas that results show is itself known badly: of four, to 40 %. 0: no such "
     "end."},
};
const OptionTable stage_until_options = {until_rows, sizeof until_rows / sizeof *until_rows,
                                         sizeof(Stage)};

static const Option ensemble_rows[] = {
    {"replicas", OPTION_INTEGER, offsetof(EnsemblePlan, replicas), 4, 1, 100000, "",
     "Independent samples; standard errors are taken over them."},
    {"seed", OPTION_INTEGER, offsetof(EnsemblePlan, seed), 1, 0, 9007199254740992.0, "",
     "Key of all random numbers: the same seed gives the same bits."},
};
const OptionTable ensemble_options = {ensemble_rows, sizeof ensemble_rows / sizeof *ensemble_rows,
                                      sizeof(EnsemblePlan)};

static const Option output_rows[] = {
    {"trajectory.every", OPTION_REAL, offsetof(OutputPlan, trajectory_every), 0, 0, 1e12,
     "time unit of the method", "Time between stored configurations; 0 stores none."},
    {"trajectory.stage", OPTION_TEXT, offsetof(OutputPlan, trajectory_stage), 0, 0, 0, "",
     "The stage to store configurations of, with that at its start; all stages if not given."},
    {"checkpoint_every", OPTION_DURATION, offsetof(OutputPlan, checkpoint_every), 600, 0.01, 1e7,
     "s", "Wall-clock time between checkpoints: what a crash can cost at most."},
};
const OptionTable output_options = {output_rows, sizeof output_rows / sizeof *output_rows,
                                    sizeof(OutputPlan)};

bool plan_is_theory(const Plan *plan) {
    return plan->theory.species_count > 0 || plan->itt.given || plan->schematic.given;
}

bool stage_is_recorded(const Plan *plan, size_t stage) {
    const char *recorded = plan->output.trajectory_stage;
    if (!(plan->output.trajectory_every > 0)) return false;
    return recorded[0] == '\0' || strcmp(recorded, plan->stages[stage].name) == 0;
}

double stage_time(const Stage *stage) {
    return stage->time > 0 ? stage->time : stage->strain / fabs(stage->drive.flow.rate);
}

static const double TICKS_MOST = 4e18; // an int64 count of ticks with room to add

Clock plan_clock(const Plan *plan, size_t stage) {
    const Stage *at = &plan->stages[stage];
    const PropagatorKind *kind = at->dynamics.kind;
    const double tick = kind->tick(&at->dynamics.settings, &plan->system);
    const int64_t per_step = kind->ticks_per_step(&at->dynamics.settings);
    const double steps = rint(stage_time(at) / (tick * (double)per_step));
    const bool goes_on = stage > 0 && drive_kinds(&at[-1].drive) & DRIVE_FLOW;
    ASSERT(steps * (double)per_step < TICKS_MOST);
    return (Clock){.tick = tick,
                   .flight_time = kind->flies ? kind->flight_time(&at->dynamics.settings) : NAN,
                   .ticks = per_step * (steps < 1 ? 1 : (int64_t)steps),
                   .ticks_per_step = per_step,
                   .unit = kind->time_unit,
                   .stage = at->name,
                   .flies = kind->flies,
                   .thermostatted = kind->thermostatted,
                   .drive = drive_kinds(&at->drive) ? &at->drive : NULL,
                   .before = goes_on ? &at[-1].drive.flow : NULL};
}

static Status check_shapes(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        const ShapeKind shape = (ShapeKind)system->species[s].shape;
        if (shape_dimension(shape) == (int)system->dimension) continue;
        return status_fail(BAD_DATA, "a %s lives in %d dimensions, the system has %d",
                           shape_names[shape], shape_dimension(shape), (int)system->dimension);
    }
    return OK;
}

static Status check_system(const System *system) {
    TRY(system_check_counts(system));
    TRY(check_shapes(system));
    if ((system->packing_fraction > 0) == (system->number_density > 0)) {
        return status_fail(BAD_DATA, "give packing_fraction or number_density, one of the two");
    }
    if (system->aspect.count != 0 && system->aspect.count != system->dimension) {
        return status_fail(BAD_DATA, "box.aspect has %d numbers, the box %d edges",
                           (int)system->aspect.count, (int)system->dimension);
    }
    return packing_check(system);
}

static Status check_end(const Stage *at) {
    if (at->time > 0 && at->strain > 0)
        return status_fail(BAD_DATA, "strain = %g: the stage has a time as well; one is enough",
                           at->strain);
    if (at->strain > 0 && at->drive.flow.rate == 0)
        return status_fail(BAD_DATA,
                           "strain = %g is where a stage with a steady shear_rate ends; give this "
                           "one a time",
                           at->strain);
    if (at->time > 0 || at->strain > 0) return OK;
    return status_fail(BAD_DATA, "time = %g must be above 0%s", at->time,
                       at->drive.flow.rate != 0 ? ", or a strain be given" : "");
}

static bool sheared_before(const Plan *plan, size_t stage) {
    for (size_t s = 0; s < stage; s++) {
        if (drive_kinds(&plan->stages[s].drive) & DRIVE_FLOW) return true;
    }
    return false;
}

Status stage_check_drive(const Plan *plan, size_t stage) {
    const Stage *at = &plan->stages[stage];
    const PropagatorKind *kind = at->dynamics.kind;
    TRY(drive_check(&at->drive));
    TRY(check_end(at));
    const unsigned wanted = drive_kinds(&at->drive);
    if (wanted & DRIVE_FLOW & ~kind->drives)
        return status_fail(BAD_DATA, "%s: the method %s has no shear; use event-driven",
                           flow_words((char[FLOW_WORDS_SIZE]){0}, &at->drive.flow), kind->name);
    if (wanted & DRIVE_PULL & ~kind->drives)
        return status_fail(
            BAD_DATA,
            "pull = {species: %s}: the method %s pulls no particle; use event-driven or "
            "dynamic-monte-carlo",
            at->drive.pull.species, kind->name);
    if (sheared_before(plan, stage) && !kind->leans)
        return status_fail(BAD_DATA,
                           "stage '%s' follows a sheared one, and the method %s cannot go on in a "
                           "sheared box; use event-driven or newtonian",
                           at->name, kind->name);
    if (!wanted || !kind->check_drive) return OK;
    return kind->check_drive(&at->dynamics.settings, &plan->system, &at->drive);
}

Status stage_check_until(const Plan *plan, size_t stage) {
    const Stage *at = &plan->stages[stage];
    if (at->stress_error == 0) return OK;
    bool told = false;
    for (size_t k = 0; k < at->observation_count; k++) {
        told |= at->observations[k].kind->relative_error != NULL;
    }
    if (!told)
        return status_fail(
            BAD_DATA,
            "until = {stress_error: %g}: the stage '%s' does not observe stress; add "
            "it",
            at->stress_error, at->name);
    if (at->drive.flow.rate == 0)
        return status_fail(
            BAD_DATA,
            "until = {stress_error: %g}: the stage '%s' has no steady shear_rate, and "
            "so no steady stress to wait for",
            at->stress_error, at->name);
    if (!stage_is_recorded(plan, stage)) return OK;
    return status_fail(BAD_DATA,
                       "until = {stress_error: %g}: how many configurations the stage '%s' stores "
                       "would not be known; set output: {trajectory: {stage: ...}} to another",
                       at->stress_error, at->name);
}

static Status check_stage(const Plan *plan, size_t stage) {
    const Stage *at = &plan->stages[stage];
    const PropagatorKind *kind = at->dynamics.kind;
    TRY(kind->check(&at->dynamics.settings, &plan->system));
    for (size_t other = 0; other < stage; other++) {
        if (strcmp(at->name, plan->stages[other].name) != 0) continue;
        return status_fail(BAD_DATA, "two stages are called '%s'", at->name);
    }
    TRY(stage_check_drive(plan, stage));
    TRY(stage_check_until(plan, stage));
    const double tick = kind->tick(&at->dynamics.settings, &plan->system), time = stage_time(at);
    if (!(time > 0 && time / tick < TICKS_MOST)) {
        return status_fail(BAD_DATA, "stage '%s': time = %g %s cannot be run in ticks of %g",
                           at->name, time, kind->time_unit, tick);
    }
    const Clock clock = plan_clock(plan, stage);
    for (size_t k = 0; k < at->observation_count; k++) {
        const ObservableKind *observable = at->observations[k].kind;
        if (!observable->check) continue;
        TRY(observable->check(&at->observations[k].settings, &plan->system, &clock));
    }
    return OK;
}

static Status check_output(const Plan *plan) {
    const char *recorded = plan->output.trajectory_stage;
    if (recorded[0] == '\0') return OK;
    for (size_t s = 0; s < plan->stage_count; s++) {
        if (strcmp(plan->stages[s].name, recorded) == 0) return OK;
    }
    return status_fail(BAD_DATA, "trajectory.stage: there is no stage '%s'", recorded);
}

Status plan_check(const Plan *plan) {
    if (plan->itt.given) return itt_check(&plan->itt);
    if (plan->schematic.given) return schematic_check(&plan->schematic);
    if (plan_is_theory(plan)) return theory_check(&plan->theory);
    TRY(check_system(&plan->system));
    TRY(check_output(plan));
    if (plan->stage_count < 1) return status_fail(BAD_DATA, "a protocol needs a stage");
    for (size_t s = 0; s < plan->stage_count; s++) TRY(check_stage(plan, s));
    return OK;
}

Status plan_check_input(const Plan *plan, uint32_t *checksum) {
    *checksum = 0;
    if (plan->itt.given) return itt_check_input(&plan->itt, checksum);
    return plan->theory.species_count > 0 ? theory_check_input(&plan->theory, checksum) : OK;
}

const TheoryInput *plan_input(const Plan *plan) {
    const TheoryInput *input = plan->itt.given ? &plan->itt.input : &plan->theory.input;
    return input->file[0] ? input : NULL;
}

static const char *checksum_words(char words[16], uint32_t checksum) {
    snprintf(words, 16, "%08x", (unsigned)checksum);
    return words;
}

Status plan_put_checksum(Results *results, uint32_t checksum) {
    if (checksum == 0) return OK;
    return results_put_fact(results, PLAN_CHECKSUM_FACT, checksum_words((char[16]){0}, checksum));
}

// Without one they are of nothing that was read, or of an earlier version: then nobody knows.
bool plan_has_checksum(const Results *results, uint32_t checksum) {
    const char *there = results_find_fact(results, PLAN_CHECKSUM_FACT);
    if (!there) return checksum == 0;
    return strcmp(there, checksum_words((char[16]){0}, checksum)) == 0;
}

size_t plan_slots(const Plan *plan) {
    const TheoryInput *input = plan_input(plan);
    if (plan_is_theory(plan)) return input ? (size_t)input->groups : 1;
    return (size_t)plan->ensemble.replicas;
}

size_t plan_memory(const Plan *plan) {
    if (plan->itt.given) return itt_memory(&plan->itt);
    if (plan->schematic.given) return schematic_memory(&plan->schematic);
    if (plan_is_theory(plan)) return theory_memory(&plan->theory);
    const size_t particles = (size_t)plan->system.particles;
    const size_t state =
        particles * (1 + 2 * sizeof(double) + 3 * (3 * sizeof(double) + sizeof(int32_t)));
    size_t propagator = 0, observers = 0;
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Stage *stage = &plan->stages[s];
        const size_t engine = stage->dynamics.kind->memory(&plan->system);
        if (engine > propagator) propagator = engine;
        const Clock clock = plan_clock(plan, s);
        for (size_t k = 0; k < stage->observation_count; k++) {
            const Observation *observation = &stage->observations[k];
            observers += observation->kind->memory(&observation->settings, &plan->system, &clock);
        }
    }
    return state + propagator + observers;
}

double plan_stage_seconds(const Plan *plan, size_t stage) {
    const Dynamics *dynamics = &plan->stages[stage].dynamics;
    return dynamics->kind->seconds_per_particle_tick(&dynamics->settings, &plan->system) *
           (double)plan->system.particles * (double)plan_clock(plan, stage).ticks;
}

// With all that is measured and without each group of it.
static double passes(const Plan *plan) {
    const size_t slots = plan_slots(plan);
    return slots > 1 ? (double)slots + 1 : 1;
}

double plan_seconds(const Plan *plan) {
    if (plan->itt.given) return passes(plan) * itt_seconds(&plan->itt);
    if (plan->schematic.given) return schematic_seconds(&plan->schematic);
    if (plan_is_theory(plan)) return passes(plan) * theory_seconds(&plan->theory);
    double seconds = 0;
    for (size_t s = 0; s < plan->stage_count; s++) seconds += plan_stage_seconds(plan, s);
    return seconds;
}
