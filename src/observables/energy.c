// SPDX-License-Identifier: GPL-3.0-or-later
// Energy and pressure of soft spheres, from configurations: u(r) = kT (d_ij/r)^n for every pair,
// d_ij = (d_i + d_j)/2, and the virial -r u'(r) = n u, so that
//   P V/(N kT) = 1 + n <U>/(3 N).
// Pairs are left out where u < 2^-21 kT, as the Markov chain leaves them out, and beyond half of
// the box. The engine's own sums are not used.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"
#include "observables/put.h"

#include <math.h>

typedef struct EnergySettings {
    int64_t looks;
} EnergySettings;

static const Option rows[] = {
    LOOKS_OPTION(EnergySettings, looks, 200),
};

static const double NEGLIGIBLE_BITS = 21; // an energy of 2^-21 kT is none

typedef struct Energy {
    Observer observer;
    size_t looks, done;
    int exponent;
    NearPairs *pairs;
    double *values; // [looks], per particle, in kT
} Energy;

static int64_t period_for(const Settings *settings, const Clock *clock) {
    return looks_period(clock, ((const EnergySettings *)settings->bytes)->looks);
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)clock;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        if (shape_is_hard((ShapeKind)species->shape)) {
            return status_fail(BAD_DATA,
                               "energy: species '%s' is hard and has none, whatever its "
                               "configuration; leave it out",
                               species->name);
        }
        if (species->exponent != rint(species->exponent) ||
            species->exponent != system->species[0].exponent) {
            return status_fail(BAD_DATA,
                               "energy: the exponent of species '%s' is %g; give all species one "
                               "whole number",
                               species->name, species->exponent);
        }
    }
    return OK;
}

// Where the energy becomes negligible; not beyond half of the shortest edge.
static double reach(const Box *box, double widest, double exponent) {
    return fmin(widest * exp2(NEGLIGIBLE_BITS / exponent), box_shortest_edge(box) / 2);
}

static void discard(Observer *observer) {
    Energy *energy = (Energy *)observer;
    near_pairs_free(energy->pairs);
    memory_free(energy->values);
    memory_free(energy);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    double widest = 0;
    for (size_t i = 0; i < state->count; i++) widest = fmax(widest, state->diameter[i]);
    Energy *energy = NULL;
    TRY(NEW(energy));
    energy->observer = (Observer){.kind = &observable_energy, .clock = *clock};
    energy->observer.period = period_for(settings, clock);
    energy->looks = (size_t)looks_count(clock, energy->observer.period);
    energy->exponent = (int)state->system.species[0].exponent;
    Status status = NEW_ARRAY(energy->values, energy->looks);
    if (status == OK) {
        status = near_pairs_create(&energy->pairs, &state->box, state->count,
                                   reach(&state->box, widest, energy->exponent));
    }
    return observer_begin(out, &energy->observer, status);
}

// x^n by squaring: the same bits everywhere, which pow() has not.
static double power(double x, int n) {
    double product = 1;
    for (double square = x; n > 0; n /= 2, square *= square) {
        if (n & 1) product *= square;
    }
    return product;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Energy *energy = (Energy *)observer;
    const NearPairs *pairs = energy->pairs;
    double sum = 0;
    near_pairs_sort(energy->pairs, state);
    for (size_t slot = 0; slot < state->count; slot++) {
        const size_t found = near_pairs_row(energy->pairs, slot), i = pairs->particle[slot];
        for (size_t k = 0; k < found; k++) {
            const double contact = (state->diameter[i] + state->diameter[pairs->partner[k]]) / 2;
            sum += power(contact / pairs->distance[k], energy->exponent);
        }
    }
    energy->done = (size_t)(tick / energy->observer.period);
    ASSERT(energy->done <= energy->looks);
    energy->values[energy->done - 1] = sum / (double)state->count;
    return OK;
}

static const uint64_t ENERGY_TAG = 0x454e455247303031; // "ENERG001"

static void archive(Observer *observer, Archive *archive) {
    Energy *energy = (Energy *)observer;
    uint64_t done = energy->done;
    archive_tag(archive, ENERGY_TAG);
    archive_u64(archive, &done, 1);
    archive_require(archive, done <= energy->looks, "it has an energy too many");
    archive_f64(archive, energy->values, energy->looks);
    if (archive_status(archive, false) == OK) energy->done = (size_t)done;
}

static Status put_scalars(const Energy *energy, const State *state, Results *results,
                          size_t replica) {
    const Observer *observer = &energy->observer;
    double sum = 0;
    for (size_t k = 0; k < energy->done; k++) sum += energy->values[k];
    const double mean = sum / (double)energy->done;
    const double z = 1 + energy->exponent * mean / state->box.dimension;
    TRY(observer_put_scalar(observer, "energy", "kT", NULL, results, replica, mean));
    TRY(observer_put_scalar(observer, "compressibility_factor_virial", "", NULL, results, replica,
                            z));
    return observer_put_scalar(observer, "pressure_virial", "kT/d^3", NULL, results, replica,
                               z * (double)state->count / box_volume(&state->box));
}

static Status put_looks(const Energy *energy, double *times, Results *results, size_t replica) {
    const Clock *clock = &energy->observer.clock;
    for (size_t k = 0; k < energy->looks; k++) {
        times[k] = (double)(k + 1) * (double)energy->observer.period * clock->tick;
    }
    const ResultSeries shape = {
        .unit = "kT",
        .axes = 1,
        .axis = {{.name = "time", .unit = clock->unit, .count = energy->looks, .values = times}}};
    return observer_put_series(&energy->observer, "energy", &shape, results, replica,
                               energy->values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Energy *energy = (const Energy *)observer;
    double *times = NULL;
    TRY(NEW_ARRAY(times, energy->looks));
    Status status = put_scalars(energy, state, results, replica);
    if (status == OK) status = put_looks(energy, times, results, replica);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Box box = system_box(system);
    double widest = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        widest = fmax(widest, system->species[s].diameter);
    }
    return sizeof(Energy) +
           (size_t)looks_count(clock, period_for(settings, clock)) * sizeof(double) +
           near_pairs_memory(system, reach(&box, widest, system->species[0].exponent));
}

const ObservableKind observable_energy = {
    .name = "energy",
    .about = "Energy of soft spheres per particle, and the pressure from its virial.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(EnergySettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
