// SPDX-License-Identifier: GPL-3.0-or-later
// How Monte Carlo went: acceptance, what a cycle was worth, and how the clocks that one might have
// taken differ (Jabbari-Farouji and Trizac, J. Chem. Phys. 137, 054107, 2012). A free body diffuses
// in a trial as in the time parallel^2/(6 D_par), the clock "VA" has it slowed by the acceptance,
// "VD" by what is left of squared displacements.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/put.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct AcceptanceSettings {
    int64_t blocks;
} AcceptanceSettings;

static const Option rows[] = {
    {.name = "blocks",
     .type = OPTION_INTEGER,
     .offset = offsetof(AcceptanceSettings, blocks),
     .fallback = 50,
     .least = 2,
     .most = 10000,
     .unit = "",
     .about = "Blocks of the stage for which acceptance and clock are given: at most this many."},
};

typedef struct Acceptance {
    Observer observer;
    int64_t seen;                 // ticks
    size_t blocks;                // that the stage has
    MoveTally half[SPECIES_MOST]; // in the first half of the stage
    MoveTally all[SPECIES_MOST];
    double *trials, *accepted; // [blocks][SPECIES_MOST]
} Acceptance;

static int64_t period_for(const Settings *settings, const Clock *clock) {
    return looks_period(clock, ((const AcceptanceSettings *)settings->bytes)->blocks);
}

static size_t blocks_for(const Settings *settings, const Clock *clock) {
    return (size_t)looks_count(clock, period_for(settings, clock));
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)system;
    if (!clock->flies) return OK;
    return status_fail(BAD_DATA, "acceptance: this method makes no trials; leave it out");
}

static void discard(Observer *observer) {
    Acceptance *acceptance = (Acceptance *)observer;
    memory_free(acceptance->trials);
    memory_free(acceptance->accepted);
    memory_free(acceptance);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    (void)state;
    Acceptance *acceptance = NULL;
    TRY(NEW(acceptance));
    acceptance->observer = (Observer){.kind = &observable_acceptance, .clock = *clock};
    acceptance->observer.period = period_for(settings, clock);
    acceptance->blocks = blocks_for(settings, clock);
    Status status = NEW_ARRAY(acceptance->trials, acceptance->blocks * SPECIES_MOST);
    if (status == OK) status = NEW_ARRAY(acceptance->accepted, acceptance->blocks * SPECIES_MOST);
    return observer_begin(out, &acceptance->observer, status);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Acceptance *acceptance = (Acceptance *)observer;
    const size_t block = (size_t)(tick / acceptance->observer.period - 1);
    for (size_t s = 0; s < state->system.species_count; s++) {
        const MoveTally *now = &tally->moves[s], *before = &acceptance->all[s];
        acceptance->trials[block * SPECIES_MOST + s] = (double)(now->trials - before->trials);
        acceptance->accepted[block * SPECIES_MOST + s] = (double)(now->accepted - before->accepted);
        acceptance->all[s] = *now;
        if (2 * tick <= acceptance->observer.clock.ticks) acceptance->half[s] = *now;
    }
    acceptance->seen = tick;
    return OK;
}

static const uint64_t ACCEPTANCE_TAG = 0x4143434550303032; // "ACCEP002"

static void archive(Observer *observer, Archive *archive) {
    Acceptance *acceptance = (Acceptance *)observer;
    archive_tag(archive, ACCEPTANCE_TAG);
    archive_i64(archive, &acceptance->seen, 1);
    for (size_t s = 0; s < SPECIES_MOST; s++) {
        tally_archive_moves(&acceptance->half[s], archive);
        tally_archive_moves(&acceptance->all[s], archive);
    }
    archive_f64(archive, acceptance->trials, acceptance->blocks * SPECIES_MOST);
    archive_f64(archive, acceptance->accepted, acceptance->blocks * SPECIES_MOST);
}

static double accepted(const MoveTally *moves) {
    return (double)moves->accepted / (double)moves->trials;
}

// A cycle by the clock VA, in d^2/D0; <parallel^2> of a free trial is parallel^2/3 = 2 D_par t.
static double accepted_cycle(const System *system, size_t species, const MoveTally *moves) {
    const double diffusion = species_diffusion(&system->species[species]).parallel;
    return accepted(moves) * moves->free.parallel / (double)moves->trials / (2 * diffusion) *
           system_reference_diffusion(system);
}

typedef struct Slot {
    const Acceptance *acceptance;
    const State *state;
    Results *results;
    size_t replica;
} Slot;

// NAME, or NAME_SPECIES where there are several.
static Status put(const Slot *slot, const char *name, size_t species, double value) {
    const System *system = &slot->state->system;
    char full[RESULT_TEXT];
    const bool several = system->species_count > 1;
    snprintf(full, sizeof full, "%s%s%s", name, several ? "_" : "",
             several ? system->species[species].name : "");
    return observer_put_scalar(&slot->acceptance->observer, full, "", NULL, slot->results,
                               slot->replica, value);
}

static Status put_ratios(const Slot *slot, size_t species) {
    const MoveTally *moves = &slot->acceptance->all[species];
    const double share = accepted(moves);
    const struct {
        const char *name;
        double squares, free;
    } motions[] = {
        {"matching_parallel", moves->parallel, moves->free.parallel},
        {"matching_perpendicular", moves->perpendicular, moves->free.perpendicular},
        {"matching_rotational", moves->rotational, moves->free.rotational},
    };
    const System *system = &slot->state->system;
    if (!shape_is_oriented((ShapeKind)system->species[species].shape))
        return put(slot, "matching", species,
                   (moves->parallel + moves->perpendicular) /
                       (share * (moves->free.parallel + moves->free.perpendicular)));
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++) {
        TRY(put(slot, motions[i].name, species, motions[i].squares / (share * motions[i].free)));
    }
    return OK;
}

static Status put_species(const Slot *slot, size_t species) {
    const MoveTally *moves = &slot->acceptance->all[species],
                    *half = &slot->acceptance->half[species];
    TRY(put(slot, "acceptance", species, accepted(moves)));
    const double later =
        (double)(moves->accepted - half->accepted) / (double)(moves->trials - half->trials);
    if (half->trials > 0 && moves->trials > half->trials)
        TRY(put(slot, "acceptance_drift", species, later / accepted(half) - 1));
    return put_ratios(slot, species);
}

// Stages in cycles have no clock.
static bool has_clock(const Acceptance *acceptance) {
    return strcmp(acceptance->observer.clock.unit, "cycles") != 0;
}

static double trials(const Slot *slot) {
    double sum = 0;
    for (size_t s = 0; s < slot->state->system.species_count; s++) {
        sum += (double)slot->acceptance->all[s].trials;
    }
    return sum;
}

static Status put_clock(const Slot *slot) {
    const Acceptance *acceptance = slot->acceptance;
    const System *system = &slot->state->system;
    const double time = (double)acceptance->seen * acceptance->observer.clock.tick;
    const double cycle = time * (double)slot->state->count / trials(slot);
    TRY(observer_put_scalar(&acceptance->observer, "cycle_time", "d^2/D0", NULL, slot->results,
                            slot->replica, cycle));
    for (size_t s = 0; s < system->species_count; s++) {
        TRY(put(slot, "clock_over_acceptance_clock", s,
                cycle / accepted_cycle(system, s, &acceptance->all[s])));
    }
    return OK;
}

// Accepted trials of a species in each block, over the trials.
static Status put_acceptances(const Slot *slot, const double *times, double *values) {
    const Acceptance *acceptance = slot->acceptance;
    const Clock *clock = &acceptance->observer.clock;
    const System *system = &slot->state->system;
    Labels labels;
    labels_of_species(&labels, system);
    for (size_t s = 0; s < system->species_count; s++) {
        for (size_t b = 0; b < acceptance->blocks; b++) {
            const size_t place = b * SPECIES_MOST + s;
            values[s * acceptance->blocks + b] =
                acceptance->accepted[place] / acceptance->trials[place];
        }
    }
    const ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {
            {.name = "species", .unit = "", .count = system->species_count, .labels = labels.names},
            {.name = "time", .unit = clock->unit, .count = acceptance->blocks, .values = times}}};
    return observer_put_series(&acceptance->observer, "acceptance", &shape, slot->results,
                               slot->replica, values);
}

// What a cycle was worth in each block.
static Status put_cycles(const Slot *slot, const double *times, double *values) {
    const Acceptance *acceptance = slot->acceptance;
    const Clock *clock = &acceptance->observer.clock;
    for (size_t b = 0; b < acceptance->blocks; b++) {
        double sum = 0;
        for (size_t s = 0; s < slot->state->system.species_count; s++) {
            sum += acceptance->trials[b * SPECIES_MOST + s];
        }
        values[b] =
            (double)acceptance->observer.period * clock->tick * (double)slot->state->count / sum;
    }
    ResultSeries shape = {
        .axes = 1,
        .axis = {
            {.name = "time", .unit = clock->unit, .count = acceptance->blocks, .values = times}}};
    snprintf(shape.unit, sizeof shape.unit, "%s", clock->unit);
    return observer_put_series(&acceptance->observer, "cycle_time", &shape, slot->results,
                               slot->replica, values);
}

static Status put_blocks(const Slot *slot) {
    const Acceptance *acceptance = slot->acceptance;
    const double length = (double)acceptance->observer.period * acceptance->observer.clock.tick;
    double *times = NULL, *values = NULL;
    Status status = NEW_ARRAY(times, acceptance->blocks);
    if (status == OK) status = NEW_ARRAY(values, acceptance->blocks * SPECIES_MOST);
    if (status == OK) {
        for (size_t b = 0; b < acceptance->blocks; b++) times[b] = ((double)b + 0.5) * length;
        status = put_acceptances(slot, times, values);
        if (status == OK && has_clock(acceptance)) status = put_cycles(slot, times, values);
    }
    memory_free(times);
    memory_free(values);
    return status;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Slot slot = {(const Acceptance *)observer, state, results, replica};
    for (size_t s = 0; s < state->system.species_count; s++) {
        if (slot.acceptance->all[s].trials > 0) TRY(put_species(&slot, s));
    }
    if (has_clock(slot.acceptance)) TRY(put_clock(&slot));
    return put_blocks(&slot);
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    return sizeof(Acceptance) + 2 * blocks_for(settings, clock) * SPECIES_MOST * sizeof(double);
}

const ObservableKind observable_acceptance = {
    .name = "acceptance",
    .about = "Acceptance of Monte Carlo, the time that a cycle was worth, and how other clocks "
             "would differ.",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(AcceptanceSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
