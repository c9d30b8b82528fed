// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure of hard bodies of any shape, from configurations alone: how many pairs would meet if
// the suspension were compressed a little, directions kept. Places divided by s > 1 are those in
// the volume V/s^3, and with n(s) the mean number of pairs that then overlap,
//   P V/(N kT) = 1 + (1/N) dn/d(s^3) at s = 1
// (Eppenga & Frenkel, Mol. Phys. 52, 1303, 1984; de Miguel & Jackson, J. Chem. Phys. 125, 164109,
// 2006). Convex bodies that overlap at one s do so at every larger one, and none part: each pair is
// counted once, in the bin of s where it meets, and the histogram is extrapolated to 1 like a
// contact value. Of spheres it is one: s is the distance over that of contact.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"
#include "observables/put.h"
#include "shapes/overlap.h"

#include <math.h>

typedef struct CompressionSettings {
    double last, spacing;
    int64_t looks;
} CompressionSettings;

static const Option rows[] = {
    {.name = "scales.last",
     .type = OPTION_REAL,
     .offset = offsetof(CompressionSettings, last),
     .fallback = 1.1,
     .least = 1.001,
     .most = 2,
     .unit = "",
     .about = "Strongest compression looked at: what distances are divided by."},
    {.name = "scales.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(CompressionSettings, spacing),
     .fallback = 0.001,
     .least = 1e-5,
     .most = 0.1,
     .unit = "",
     .about = "Width of a bin of it."},
    LOOKS_OPTION(CompressionSettings, looks, 500),
};

typedef struct Compression {
    Observer observer;
    double spacing;
    size_t bins;
    NearPairs *pairs;
    uint64_t looks;
    uint64_t *counts; // [bins]
} Compression;

static const CompressionSettings *own(const Settings *settings) {
    return (const CompressionSettings *)settings->bytes;
}

static size_t bins_for(const CompressionSettings *settings) {
    const double bins = floor((settings->last - 1) / settings->spacing + 1e-9);
    return bins < 1 ? 1 : (size_t)bins;
}

static double widest_reach(const System *system) {
    double reach = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Body body = species_body(&system->species[s]);
        reach = fmax(reach, shape_reach(&body));
    }
    return reach;
}

static double range_for(const CompressionSettings *settings, double reach) {
    return reach * (1 + (double)bins_for(settings) * settings->spacing);
}

static Status check_shapes(const System *system) {
    for (size_t a = 0; a < system->species_count; a++) {
        for (size_t b = a; b < system->species_count; b++) {
            const Species *first = &system->species[a], *second = &system->species[b];
            if (overlap_is_known((ShapeKind)first->shape, (ShapeKind)second->shape)) continue;
            return status_fail(BAD_DATA,
                               "virtual_compression: '%s' and '%s' are not hard bodies in space "
                               "that can overlap; leave it out",
                               first->name, second->name);
        }
    }
    return OK;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)clock;
    TRY(check_shapes(system));
    const Box box = system_box(system);
    const double range = range_for(own(settings), widest_reach(system));
    const double shortest = box_shortest_edge(&box);
    if (range <= shortest / 2) return OK;
    return status_fail(
        BAD_DATA,
        "virtual_compression: bodies that meet at scales.last may be %g apart, which "
        "exceeds half of the box edge %g; make it smaller or take more particles",
        range, shortest);
}

static void discard(Observer *observer) {
    Compression *self = (Compression *)observer;
    near_pairs_free(self->pairs);
    memory_free(self->counts);
    memory_free(self);
}

// Of the bodies as they are, spread included.
static double widest_here(const State *state) {
    double reach = 0;
    for (size_t i = 0; i < state->count; i++) {
        const Species *species = &state->system.species[state->species_of[i]];
        reach = fmax(reach, state->diameter[i] + species->length);
    }
    return reach;
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Compression *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_virtual_compression, .clock = *clock};
    self->observer.period = looks_period(clock, own(settings)->looks);
    self->spacing = own(settings)->spacing;
    self->bins = bins_for(own(settings));
    const double range =
        fmin(range_for(own(settings), widest_here(state)), box_shortest_edge(&state->box) / 2);
    Status status = NEW_ARRAY(self->counts, self->bins);
    if (status == OK) status = near_pairs_create(&self->pairs, &state->box, state->count, range);
    return observer_begin(out, &self->observer, status);
}

typedef struct Posed {
    Body body;
    double axis[3];
} Posed;

static Posed pose(const State *state, size_t i) {
    Posed posed = {.body = species_body(&state->system.species[state->species_of[i]]),
                   .axis = {0, 0, 1}};
    posed.body.diameter = state->diameter[i];
    if (!state->oriented) return posed;
    for (int a = 0; a < 3; a++) posed.axis[a] = state->orientation[a][i];
    return posed;
}

static bool overlap_at(const Posed *first, const Posed *second, const double r[3], double scale) {
    const double nearer[3] = {r[0] / scale, r[1] / scale, r[2] / scale};
    return overlap_of(&first->body, first->axis, &second->body, second->axis, nearer);
}

// The bin in which they meet, by bisection; `bins` if they do not.
static size_t meeting_bin(const Compression *self, const Posed *first, const Posed *second,
                          const double r[3]) {
    if (!overlap_at(first, second, r, 1 + (double)self->bins * self->spacing)) return self->bins;
    size_t apart = 0, together = self->bins; // edges of bins
    while (together - apart > 1) {
        const size_t middle = (apart + together) / 2;
        if (overlap_at(first, second, r, 1 + (double)middle * self->spacing))
            together = middle;
        else
            apart = middle;
    }
    return apart;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    Compression *self = (Compression *)observer;
    NearPairs *pairs = self->pairs;
    near_pairs_sort(pairs, state);
    for (size_t slot = 0; slot < state->count; slot++) {
        const size_t found = near_pairs_row(pairs, slot), i = pairs->particle[slot];
        const Posed first = pose(state, i);
        for (size_t k = 0; k < found; k++) {
            const size_t j = pairs->partner[k];
            const Posed second = pose(state, j);
            double r[3];
            for (int a = 0; a < 3; a++) r[a] = state->position[a][j] - state->position[a][i];
            box_nearest_image(&state->box, r);
            const size_t bin = meeting_bin(self, &first, &second, r);
            if (bin < self->bins) self->counts[bin]++;
        }
    }
    self->looks++;
    return OK;
}

static const uint64_t COMPRESSION_TAG = 0x434f4d5052303031; // "COMPR001"

static void archive(Observer *observer, Archive *archive) {
    Compression *self = (Compression *)observer;
    archive_tag(archive, COMPRESSION_TAG);
    archive_u64(archive, &self->looks, 1);
    archive_u64(archive, self->counts, self->bins);
}

static double cubed(double x) {
    return x * x * x;
}

static void fill(const Compression *self, double particles, double *values, double *centres) {
    for (size_t k = 0; k < self->bins; k++) {
        const double low = 1 + (double)k * self->spacing, high = low + self->spacing;
        values[k] = (double)self->counts[k] /
                    ((double)self->looks * particles * (cubed(high) - cubed(low)));
        centres[k] = (low + high) / 2;
    }
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Compression *self = (const Compression *)observer;
    double *values = NULL, *centres = NULL;
    Status status = NEW_ARRAY(values, self->bins);
    if (status == OK) status = NEW_ARRAY(centres, self->bins);
    if (status == OK) {
        fill(self, (double)state->count, values, centres);
        const ResultSeries shape = {
            .unit = "",
            .axes = 1,
            .axis = {{.name = "scale", .unit = "", .count = self->bins, .values = centres}}};
        status =
            observer_put_series(observer, "virtual_compression", &shape, results, replica, values);
    }
    memory_free(values);
    memory_free(centres);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)clock;
    return sizeof(Compression) + bins_for(own(settings)) * sizeof(uint64_t) +
           near_pairs_memory(system, range_for(own(settings), widest_reach(system)));
}

const ObservableKind observable_virtual_compression = {
    .name = "virtual_compression",
    .about = "Pressure of hard bodies of any shape, from how many pairs would meet in a small "
             "compression.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(CompressionSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
