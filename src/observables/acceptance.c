// SPDX-License-Identifier: GPL-3.0-or-later
// How Monte Carlo went: acceptance, what a cycle was worth, and how the clocks that one might have
// taken differ (Jabbari-Farouji and Trizac, J. Chem. Phys. 137, 054107, 2012). A free body diffuses
// in a trial as in the time parallel^2/(6 D_par), the clock "VA" has it slowed by the acceptance,
// "VD" by what is left of squared displacements.
#include "base/memory.h"
#include "observables/looks.h"
#include "observables/put.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct Acceptance {
    Observer observer;
    int64_t period;               // ticks to the middle, and from there to the end
    int64_t seen;                 // ticks
    MoveTally half[SPECIES_MOST]; // in the first half of the stage
    MoveTally all[SPECIES_MOST];
} Acceptance;

static int64_t period_for(const Clock *clock) {
    return looks_period(clock, 2);
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)system;
    if (!clock->flies) return OK;
    return status_fail(BAD_DATA, "acceptance: this method makes no trials; leave it out");
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    (void)settings;
    (void)state;
    Acceptance *acceptance = NULL;
    TRY(NEW(acceptance));
    acceptance->observer = (Observer){.kind = &observable_acceptance, .clock = *clock};
    acceptance->period = period_for(clock);
    *out = &acceptance->observer;
    return OK;
}

static int64_t next(const Observer *observer, int64_t after) {
    return looks_next(&observer->clock, ((const Acceptance *)observer)->period, after);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    Acceptance *acceptance = (Acceptance *)observer;
    const size_t size = state->system.species_count * sizeof(MoveTally);
    memcpy(acceptance->all, tally->moves, size);
    if (acceptance->seen == 0) memcpy(acceptance->half, tally->moves, size);
    acceptance->seen = tick;
    return OK;
}

static const uint64_t ACCEPTANCE_TAG = 0x4143434550303031; // "ACCEP001"

static void archive(Observer *observer, Archive *archive) {
    Acceptance *acceptance = (Acceptance *)observer;
    archive_tag(archive, ACCEPTANCE_TAG);
    archive_i64(archive, &acceptance->seen, 1);
    for (size_t s = 0; s < SPECIES_MOST; s++) {
        tally_archive_moves(&acceptance->half[s], archive);
        tally_archive_moves(&acceptance->all[s], archive);
    }
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
static Status put(const Slot *slot, const char *name, size_t species, const char *unit,
                  const char *about, double value) {
    const System *system = &slot->state->system;
    char full[RESULT_TEXT];
    const bool several = system->species_count > 1;
    snprintf(full, sizeof full, "%s%s%s", name, several ? "_" : "",
             several ? system->species[species].name : "");
    return observer_put_scalar(&slot->acceptance->observer, full, unit, about, slot->results,
                               slot->replica, value);
}

static Status put_ratios(const Slot *slot, size_t species) {
    const MoveTally *moves = &slot->acceptance->all[species];
    const double share = accepted(moves);
    const struct {
        const char *name, *about;
        double squares, free;
    } rows[] = {
        {"matching_parallel",
         "Squared displacement per attempt along the body axis over acceptance times the free one: "
         "clock VD over VA.",
         moves->parallel, moves->free.parallel},
        {"matching_perpendicular", "The same across the body axis.", moves->perpendicular,
         moves->free.perpendicular},
        {"matching_rotational", "The same of rotations.", moves->rotational,
         moves->free.rotational},
    };
    const System *system = &slot->state->system;
    if (!shape_is_oriented((ShapeKind)system->species[species].shape))
        return put(slot, "matching", species, "",
                   "Squared displacement per attempt over acceptance times the free one: clock VD "
                   "over VA.",
                   (moves->parallel + moves->perpendicular) /
                       (share * (moves->free.parallel + moves->free.perpendicular)));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        TRY(put(slot, rows[i].name, species, "", rows[i].about,
                rows[i].squares / (share * rows[i].free)));
    }
    return OK;
}

static Status put_species(const Slot *slot, size_t species) {
    const MoveTally *moves = &slot->acceptance->all[species],
                    *half = &slot->acceptance->half[species];
    TRY(put(slot, "acceptance", species, "", "Fraction of the trials that were accepted.",
            accepted(moves)));
    const double later =
        (double)(moves->accepted - half->accepted) / (double)(moves->trials - half->trials);
    if (moves->trials > half->trials)
        TRY(put(slot, "acceptance_drift", species, "",
                "Acceptance in the second half of the stage over that in the first, minus 1: not 0 "
                "within its error, the stage began before equilibrium.",
                later / accepted(half) - 1));
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
    TRY(observer_put_scalar(&acceptance->observer, "cycle_time", "d^2/D0",
                            "Time that a cycle, as many trials as particles, was worth.",
                            slot->results, slot->replica, cycle));
    for (size_t s = 0; s < system->species_count; s++) {
        TRY(put(slot, "clock_over_acceptance_clock", s, "",
                "Time of a cycle over what the clock VA makes of the acceptance of the species; of "
                "several species with the clock VA, how far each is off the common one.",
                cycle / accepted_cycle(system, s, &acceptance->all[s])));
    }
    return OK;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Slot slot = {(const Acceptance *)observer, state, results, replica};
    for (size_t s = 0; s < state->system.species_count; s++) {
        if (slot.acceptance->all[s].trials > 0) TRY(put_species(&slot, s));
    }
    return has_clock(slot.acceptance) ? put_clock(&slot) : OK;
}

static void discard(Observer *observer) {
    memory_free(observer);
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)system;
    (void)clock;
    return sizeof(Acceptance);
}

const ObservableKind observable_acceptance = {
    .name = "acceptance",
    .about = "Acceptance of Monte Carlo, the time that a cycle was worth, and how other clocks "
             "would differ.",
    .options = {NULL, 0, 0},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
