// SPDX-License-Identifier: GPL-3.0-or-later
// Histogram of velocity components, each scaled by the thermal velocity of its own mass: Maxwell's
// exp(-u^2/2)/sqrt(2 pi) for every species, whatever the dynamics; and the kinetic temperature.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/put.h"

#include <math.h>
#include <stdio.h>

typedef struct VelocitySettings {
    double last, spacing;
    int64_t looks;
} VelocitySettings;

static const Option rows[] = {
    {.name = "velocities.last",
     .type = OPTION_REAL,
     .offset = offsetof(VelocitySettings, last),
     .fallback = 5,
     .least = 0.1,
     .most = 40,
     .unit = "sqrt(kT/m)",
     .about = "Largest velocity component of the histogram; m is the particle's own mass."},
    {.name = "velocities.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(VelocitySettings, spacing),
     .fallback = 0.1,
     .least = 0.001,
     .most = 1,
     .unit = "sqrt(kT/m)",
     .about = "Width of a bin of the histogram."},
    LOOKS_OPTION(VelocitySettings, looks, 200),
};

typedef struct Velocities {
    Observer observer;
    double spacing;
    size_t half; // bins on each side of zero
    size_t species_count;
    uint64_t *counts;               // [species][2 half]
    uint64_t samples[SPECIES_MOST]; // components seen, those beyond the histogram included
    double squares[SPECIES_MOST];   // their summed squares, in kT/m
} Velocities;

static size_t half_for(const VelocitySettings *settings) {
    return (size_t)ceil(settings->last / settings->spacing - 1e-9);
}

static void discard(Observer *observer) {
    memory_free(((Velocities *)observer)->counts);
    memory_free(observer);
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)system;
    if (clock->flies) return OK;
    return status_fail(
        BAD_DATA, "velocity_distribution: there are no velocities in Monte Carlo; leave it out");
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const VelocitySettings *settings = (const VelocitySettings *)settings_->bytes;
    Velocities *velocities = NULL;
    TRY(NEW(velocities));
    velocities->observer = (Observer){.kind = &observable_velocity_distribution, .clock = *clock};
    velocities->spacing = settings->spacing;
    velocities->half = half_for(settings);
    velocities->observer.period = looks_period(clock, settings->looks);
    velocities->species_count = state->system.species_count;
    return observer_begin(
        out, &velocities->observer,
        NEW_ARRAY(velocities->counts, velocities->species_count * 2 * velocities->half));
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    Velocities *velocities = (Velocities *)observer;
    const double half = (double)velocities->half;
    for (size_t i = 0; i < state->count; i++) {
        const size_t species = state->species_of[i];
        uint64_t *counts = velocities->counts + species * 2 * velocities->half;
        for (int a = 0; a < state->box.dimension; a++) {
            const double u = state_peculiar_velocity(state, a, i) * sqrt(state->mass[i]);
            const double bin = floor(u / velocities->spacing) + half;
            if (bin >= 0 && bin < 2 * half) counts[(size_t)bin]++;
            velocities->samples[species]++;
            velocities->squares[species] += u * u;
        }
    }
    return OK;
}

static const uint64_t VELOCITIES_TAG = 0x56454c4f43303031; // "VELOC001"

static void archive(Observer *observer, Archive *archive) {
    Velocities *velocities = (Velocities *)observer;
    archive_tag(archive, VELOCITIES_TAG);
    archive_u64(archive, velocities->counts, velocities->species_count * 2 * velocities->half);
    archive_u64(archive, velocities->samples, SPECIES_MOST);
    archive_f64(archive, velocities->squares, SPECIES_MOST);
}

static Status put_temperature(const Velocities *velocities, const Labels *species, Results *results,
                              size_t replica) {
    double squares = 0, samples = 0;
    for (size_t s = 0; s < species->count; s++) {
        const bool all = s == velocities->species_count;
        if (!all) squares += velocities->squares[s];
        if (!all) samples += (double)velocities->samples[s];
        char quantity[RESULT_NAME];
        const bool alone = all || velocities->species_count == 1;
        snprintf(quantity, sizeof quantity, "kinetic_temperature%s%s", alone ? "" : "_",
                 alone ? "" : species->names[s]);
        const double value =
            alone ? squares / samples : velocities->squares[s] / (double)velocities->samples[s];
        TRY(observer_put_scalar(&velocities->observer, quantity, "kT", NULL, results, replica,
                                value));
    }
    return OK;
}

static void fill(const Velocities *velocities, size_t labels, double *values, double *centres) {
    const size_t bins = 2 * velocities->half;
    for (size_t k = 0; k < bins; k++) {
        centres[k] = ((double)k + 0.5 - (double)velocities->half) * velocities->spacing;
        double all_counts = 0, all_samples = 0;
        for (size_t s = 0; s < velocities->species_count; s++) {
            const double counts = (double)velocities->counts[s * bins + k];
            const double samples = (double)velocities->samples[s];
            values[s * bins + k] = counts / (samples * velocities->spacing);
            all_counts += counts;
            all_samples += samples;
        }
        values[(labels - 1) * bins + k] = all_counts / (all_samples * velocities->spacing);
    }
}

static Status put(const Velocities *velocities, const Labels *species, double *values,
                  double *centres, Results *results, size_t replica) {
    fill(velocities, species->count, values, centres);
    const ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = species->count, .labels = species->names},
                 {.name = "velocity",
                  .unit = "sqrt(kT/m)",
                  .count = 2 * velocities->half,
                  .values = centres}}};
    TRY(observer_put_series(&velocities->observer, "velocity_distribution", &shape, results,
                            replica, values));
    return put_temperature(velocities, species, results, replica);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Velocities *velocities = (const Velocities *)observer;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *centres = NULL;
    Status status = NEW_ARRAY(values, species.count * 2 * velocities->half);
    if (status == OK) status = NEW_ARRAY(centres, 2 * velocities->half);
    if (status == OK) status = put(velocities, &species, values, centres, results, replica);
    memory_free(values);
    memory_free(centres);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)clock;
    const size_t half = half_for((const VelocitySettings *)settings->bytes);
    return sizeof(Velocities) + system->species_count * 2 * half * sizeof(uint64_t);
}

const ObservableKind observable_velocity_distribution = {
    .name = "velocity_distribution",
    .about = "Histogram of velocity components per species against Maxwell's, and the kinetic "
             "temperature.",
    .of_motion = true,
    .options = {rows, sizeof rows / sizeof *rows, sizeof(VelocitySettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
