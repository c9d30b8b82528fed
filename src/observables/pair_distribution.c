// SPDX-License-Identifier: GPL-3.0-or-later
// Partial pair distribution functions g_ab(r): the density of b around a, over that of an ideal gas
// of the same N (pairs of different particles are counted, so that an ideal gas gives 1). Close to
// contact the same is histogrammed finely in the scaled distance r/d_ij, d_ij = (d_i + d_j)/2,
// where the pairs of a polydisperse species meet at 1: its value at contact gives the pressure by
// the virial theorem, independently of the collisions (Hansen & McDonald, Theory of Simple Liquids,
// ch. 2),
//   P V/(N kT) = 1 + sum over pairs ab of w_ab g_ab(1)   (w_ab: pair_sums.c).
// Bodies with an axis touch at many distances and soft ones at none: they have g(r) only, that of
// their centres.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"
#include "observables/pair_sums.h"
#include "observables/put.h"

#include <math.h>

typedef struct PairSettings {
    double last, spacing, contact_last, contact_spacing;
    int64_t looks, contact_looks;
} PairSettings;

static const Option rows[] = {
    {.name = "distances.last",
     .type = OPTION_REAL,
     .offset = offsetof(PairSettings, last),
     .least = 0,
     .most = 1e6,
     .unit = "d",
     .about = "Largest distance; 0 is 5 d, or half of the shortest edge if that is less."},
    {.name = "distances.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(PairSettings, spacing),
     .fallback = 0.02,
     .least = 1e-4,
     .most = 1,
     .unit = "d",
     .about = "Width of a bin of g(r)."},
    {.name = "contact.last",
     .type = OPTION_REAL,
     .offset = offsetof(PairSettings, contact_last),
     .fallback = 1.2,
     .least = 1.001,
     .most = 2,
     .unit = "",
     .about = "End of the fine histogram near contact, in units of the pair's contact distance."},
    {.name = "contact.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(PairSettings, contact_spacing),
     .fallback = 0.001,
     .least = 1e-5,
     .most = 0.1,
     .unit = "",
     .about = "Width of its bins, in the same units."},
    {.name = "contact.looks",
     .type = OPTION_INTEGER,
     .offset = offsetof(PairSettings, contact_looks),
     .fallback = 500,
     .least = 1,
     .most = 10000000,
     .unit = "",
     .about = "Configurations looked at near contact, which costs less and needs more of them."},
    {.name = "looks",
     .type = OPTION_INTEGER,
     .offset = offsetof(PairSettings, looks),
     .fallback = 100,
     .least = 1,
     .most = 10000000,
     .unit = "",
     .about = "Configurations looked at for g(r), evenly over the stage: at most this many."},
};

// Pairs of each two species, counted in bins of distance or of distance over contact distance.
typedef struct Histogram {
    NearPairs *pairs;
    int64_t period; // ticks between looks
    double spacing;
    size_t bins;
    uint64_t looks;
    uint64_t *counts; // [pair of species][bins]
} Histogram;

typedef struct PairDistribution {
    Observer observer;
    size_t species_count;
    Histogram far;  // over r, in d
    Histogram near; // over r/d_ij - 1; no bins where there is no contact distance
} PairDistribution;

static const double USUAL_RANGE = 5; // d: where g(r) of a fluid is close to 1

static double range_for(const PairSettings *settings, const Box *box) {
    return settings->last > 0 ? settings->last : fmin(USUAL_RANGE, box_shortest_edge(box) / 2);
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const PairSettings *settings = (const PairSettings *)settings_->bytes;
    const Box box = system_box(system);
    const double shortest = box_shortest_edge(&box);
    double widest = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        widest = fmax(widest, system->species[s].diameter);
    }
    if (settings->last > shortest / 2) {
        return status_fail(BAD_DATA,
                           "pair_distribution: distances.last = %g exceeds half of the box edge "
                           "%g, beyond which a particle meets its own images; make it shorter",
                           settings->last, shortest);
    }
    if (pair_sums_have_contact(system) && settings->contact_last * widest > shortest / 2) {
        return status_fail(BAD_DATA,
                           "pair_distribution: contact.last = %g diameters of %g exceed half of "
                           "the box edge %g; take more particles",
                           settings->contact_last, widest, shortest);
    }
    return OK;
}

// A pair of the widest particles has to be found as far out as the contact histogram goes.
static double contact_range(const State *state, const Histogram *near) {
    double widest = 0;
    for (size_t i = 0; i < state->count; i++) widest = fmax(widest, state->diameter[i]);
    return fmin(box_shortest_edge(&state->box) / 2,
                widest * (1 + (double)near->bins * near->spacing));
}

static Status make_histogram(Histogram *histogram, const State *state, double range) {
    TRY(NEW_ARRAY(histogram->counts, pair_count(state->system.species_count) * histogram->bins));
    return near_pairs_create(&histogram->pairs, &state->box, state->count, range);
}

static void free_histogram(Histogram *histogram) {
    memory_free(histogram->counts);
    near_pairs_free(histogram->pairs);
}

static void discard(Observer *observer) {
    PairDistribution *self = (PairDistribution *)observer;
    free_histogram(&self->far);
    free_histogram(&self->near);
    memory_free(self);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const PairSettings *settings = (const PairSettings *)settings_->bytes;
    const double last = range_for(settings, &state->box);
    PairDistribution *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_pair_distribution, .clock = *clock};
    self->species_count = state->system.species_count;
    self->far = (Histogram){.period = looks_period(clock, settings->looks),
                            .spacing = settings->spacing,
                            .bins = pair_sums_bins(last, settings->spacing)};
    if (pair_sums_have_contact(&state->system))
        self->near = (Histogram){
            .period = looks_period(clock, settings->contact_looks),
            .spacing = settings->contact_spacing,
            .bins = pair_sums_bins(settings->contact_last - 1, settings->contact_spacing)};
    Status status = make_histogram(&self->far, state, (double)self->far.bins * self->far.spacing);
    if (status == OK && self->near.bins > 0) {
        status = make_histogram(&self->near, state, contact_range(state, &self->near));
    }
    return observer_begin(out, &self->observer, status);
}

static int64_t next(const Observer *observer, int64_t after) {
    const PairDistribution *self = (const PairDistribution *)observer;
    const int64_t far = looks_after(&observer->clock, self->far.period, after);
    if (self->near.bins == 0) return far;
    const int64_t near = looks_after(&observer->clock, self->near.period, after);
    return far < near ? far : near;
}

// Counts all pairs in the range, by distance or, `scaled`, by the gap over the contact distance.
static inline __attribute__((always_inline)) void
count_pairs(Histogram *histogram, const State *state, size_t species_count, const bool scaled) {
    NearPairs *pairs = histogram->pairs;
    const double per_spacing = 1 / histogram->spacing, bins = (double)histogram->bins;
    near_pairs_sort(pairs, state);
    for (size_t slot = 0; slot < state->count; slot++) {
        const size_t found = near_pairs_row(pairs, slot), i = pairs->particle[slot];
        uint64_t *row[SPECIES_MOST]; // where the pairs of i with each species are counted
        for (size_t b = 0; b < species_count; b++) {
            const size_t pair = pair_index(state->species_of[i], b, species_count);
            row[b] = histogram->counts + pair * histogram->bins;
        }
        for (size_t k = 0; k < found; k++) {
            const size_t j = pairs->partner[k];
            const double contact = (state->diameter[i] + state->diameter[j]) / 2;
            const double r = pairs->distance[k];
            const double bin = (scaled ? fmax(r / contact - 1, 0) : r) * per_spacing;
            if (bin < bins) row[state->species_of[j]][(size_t)bin]++;
        }
    }
    histogram->looks++;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    PairDistribution *self = (PairDistribution *)observer;
    if (tick % self->far.period == 0) count_pairs(&self->far, state, self->species_count, false);
    if (self->near.bins > 0 && tick % self->near.period == 0)
        count_pairs(&self->near, state, self->species_count, true);
    return OK;
}

static const uint64_t PAIRS_TAG = 0x5041495253303031; // "PAIRS001"

static void archive(Observer *observer, Archive *archive) {
    PairDistribution *self = (PairDistribution *)observer;
    const size_t pairs = pair_count(self->species_count);
    archive_tag(archive, PAIRS_TAG);
    archive_u64(archive, &self->far.looks, 1);
    archive_u64(archive, self->far.counts, pairs * self->far.bins);
    archive_u64(archive, &self->near.looks, 1);
    archive_u64(archive, self->near.counts, pairs * self->near.bins);
}

// Counts over those of an ideal gas: values[pair][bin] from the volume of each shell (for a contact
// distance of 1 if `scaled`) and the sum over pairs of what multiplies it.
static void fill(const PairDistribution *self, const Histogram *histogram, const State *state,
                 bool scaled, double *values, double *centres) {
    const double spacing = histogram->spacing, first = scaled ? 1 : 0;
    const int dimension = state->box.dimension;
    size_t at = 0;
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++) {
            const PairSums sums = pair_sums_of(state, a, b);
            const double pairs = (scaled ? sums.contact : sums.number) / box_volume(&state->box);
            for (size_t k = 0; k < histogram->bins; k++, at++) {
                const double low = first + (double)k * spacing;
                const double high = first + (double)(k + 1) * spacing;
                const double shell = pair_sums_shell(dimension, low, high);
                values[at] =
                    (double)histogram->counts[at] / ((double)histogram->looks * pairs * shell);
            }
        }
    }
    for (size_t k = 0; k < histogram->bins; k++) {
        centres[k] = first + ((double)k + 0.5) * spacing;
    }
}

static Status put_distribution(const PairDistribution *self, const State *state,
                               const Labels *labels, double *values, double *centres,
                               Results *results, size_t replica) {
    fill(self, &self->far, state, false, values, centres);
    const ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {{.name = "pair", .unit = "", .count = labels->count, .labels = labels->names},
                 {.name = "distance", .unit = "d", .count = self->far.bins, .values = centres}}};
    return observer_put_series(&self->observer, "pair_distribution", &shape, results, replica,
                               values);
}

static Status put_contact(const PairDistribution *self, const State *state, const Labels *labels,
                          double *values, double *centres, Results *results, size_t replica) {
    fill(self, &self->near, state, true, values, centres);
    const ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {
            {.name = "pair", .unit = "", .count = labels->count, .labels = labels->names},
            {.name = "scaled_distance", .unit = "", .count = self->near.bins, .values = centres}}};
    return observer_put_series(&self->observer, "contact_distribution", &shape, results, replica,
                               values);
}

static Status put_weights(const PairDistribution *self, const State *state, const Labels *labels,
                          Results *results, size_t replica) {
    double weights[PAIRS_MOST];
    pair_sums_weights(state, weights);
    const ResultSeries shape = {
        .unit = "",
        .axes = 1,
        .axis = {{.name = "pair", .unit = "", .count = labels->count, .labels = labels->names}}};
    return observer_put_series(&self->observer, "contact_weight", &shape, results, replica,
                               weights);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const PairDistribution *self = (const PairDistribution *)observer;
    const size_t bins = self->far.bins > self->near.bins ? self->far.bins : self->near.bins;
    Labels labels;
    labels_of_pairs(&labels, &state->system, NULL);
    double *values = NULL, *centres = NULL;
    Status status = NEW_ARRAY(values, labels.count * bins);
    if (status == OK) status = NEW_ARRAY(centres, bins);
    if (status == OK) {
        status = put_distribution(self, state, &labels, values, centres, results, replica);
    }
    const bool contact = self->near.bins > 0;
    if (status == OK && contact) {
        status = put_contact(self, state, &labels, values, centres, results, replica);
    }
    if (status == OK && contact) status = put_weights(self, state, &labels, results, replica);
    memory_free(values);
    memory_free(centres);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const PairSettings *settings = (const PairSettings *)settings_->bytes;
    const Box box = system_box(system);
    const double range = range_for(settings, &box);
    const size_t bins = pair_sums_bins(range, settings->spacing) +
                        pair_sums_bins(settings->contact_last - 1, settings->contact_spacing);
    return sizeof(PairDistribution) + pair_count(system->species_count) * bins * sizeof(uint64_t) +
           2 * near_pairs_memory(system, range);
}

const ObservableKind observable_pair_distribution = {
    .name = "pair_distribution",
    .about = "Partial pair distribution functions g_ab(r), finely resolved near contact, where "
             "they give the pressure.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(PairSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
