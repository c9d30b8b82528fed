// SPDX-License-Identifier: GPL-3.0-or-later
// Self part of the van Hove function, G_a^s(r,t): the probability density of a particle of species
// a to be at distance r, in any direction, from where it was a time t before. Its integral over
// space is 1, less what moved beyond the last distance.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/motion.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"

#include <math.h>
#include <stdio.h>

typedef struct VanHoveSettings {
    double last, spacing;
    LagSettings lags;
} VanHoveSettings;

static const double BINS_MOST = 1e6;

static const Option rows[] = {
    {.name = "distances.last",
     .type = OPTION_REAL,
     .offset = offsetof(VanHoveSettings, last),
     .fallback = 3,
     .least = 0.001,
     .most = 1e6,
     .unit = "d",
     .about = "Largest distance."},
    {.name = "distances.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(VanHoveSettings, spacing),
     .fallback = 0.02,
     .least = 1e-6,
     .most = 1000,
     .unit = "d",
     .about = "Width of a bin of distances."},
    LAG_OPTIONS_OF(VanHoveSettings, lags, 1, 32),
    WAITING_OPTIONS(VanHoveSettings, lags),
};

static const uint64_t VAN_HOVE_TAG = 0x56414e484f303031; // "VANHO001"

typedef struct VanHove {
    Motion motion; // rows are [species][bin], of counts
    double spacing;
    size_t bins;
} VanHove;

static const VanHoveSettings *settings_in(const Settings *settings) {
    return (const VanHoveSettings *)settings->bytes;
}

static size_t bins_of(const VanHoveSettings *settings) {
    return (size_t)ceil(settings->last / settings->spacing - 1e-9);
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    (void)system;
    const VanHoveSettings *settings = settings_in(settings_);
    if (!(settings->last / settings->spacing <= BINS_MOST)) {
        return status_fail(BAD_DATA,
                           "van_hove: more than %g bins of distances; make distances.spacing = %g "
                           "larger",
                           BINS_MOST, settings->spacing);
    }
    TRY(tracer_check_stays("van_hove", clock));
    return lags_check("van_hove", &settings->lags, clock);
}

static void add_row(Motion *motion, double *counts) {
    const VanHove *self = (const VanHove *)motion;
    const Displacements *moves = &motion->moves;
    displacements_squares(moves, motion->scratch);
    for (size_t s = 0; s < moves->species_count; s++, counts += self->bins) {
        const double *squares = motion->scratch + moves->begin[s];
        for (size_t i = 0; i < moves->population[s]; i++) {
            const double bin = sqrt(squares[i]) / self->spacing;
            if (bin < (double)self->bins) counts[(size_t)bin]++;
        }
    }
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const VanHoveSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    VanHove *self = NULL;
    TRY(NEW(self));
    self->spacing = settings->spacing;
    self->bins = bins_of(settings);
    self->motion = (Motion){.observer = {.kind = &observable_van_hove, .clock = *clock},
                            .tag = VAN_HOVE_TAG,
                            .row_size = state->system.species_count * self->bins,
                            .add_row = add_row};
    return motion_begin(out, &self->motion, state, &lags);
}

// Of the ring or shell that a bin is.
static double bin_volume(const VanHove *self, size_t bin) {
    const double inner = (double)bin * self->spacing, outer = inner + self->spacing;
    if (self->motion.moves.dimension == 2) return PI * (outer * outer - inner * inner);
    return 4 * PI / 3 * (outer * outer * outer - inner * inner * inner);
}

// values[species][row][bin]; the last species all of them, if there are several.
static void fill(const VanHove *self, size_t labels, double *values) {
    const size_t species_count = self->motion.moves.species_count;
    const size_t row_count = lags_rows(&self->motion.moves.history.lags);
    for (size_t s = 0; s < labels; s++) {
        const size_t first = s < species_count ? s : 0;
        const size_t last = s < species_count ? s + 1 : species_count;
        for (size_t row = 0; row < row_count; row++) {
            const double samples = displacements_samples(&self->motion.moves, row, first, last);
            const double *counts = self->motion.sums + row * self->motion.row_size;
            for (size_t bin = 0; bin < self->bins; bin++) {
                double count = 0;
                for (size_t i = first; i < last; i++) count += counts[i * self->bins + bin];
                *values++ = count / (samples * bin_volume(self, bin));
            }
        }
    }
}

static Status put(const VanHove *self, const Labels *species, double *values, double *times,
                  double *distances, Results *results, size_t replica) {
    for (size_t bin = 0; bin < self->bins; bin++)
        distances[bin] = ((double)bin + 0.5) * self->spacing;
    ResultSeries shape = {
        .axes = 1,
        .axis = {
            {.name = "species", .unit = "", .count = species->count, .labels = species->names}}};
    snprintf(shape.unit, sizeof shape.unit, "d^-%d", self->motion.moves.dimension);
    shape.axes += lags_axes(&self->motion.moves.history.lags, &self->motion.observer.clock, times,
                            shape.axis + shape.axes);
    shape.axis[shape.axes++] =
        (ResultAxis){.name = "distance", .unit = "d", .count = self->bins, .values = distances};
    fill(self, species->count, values);
    return observer_put_series(&self->motion.observer, "van_hove", &shape, results, replica,
                               values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const VanHove *self = (const VanHove *)observer;
    const Lags *lags = &self->motion.moves.history.lags;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *times = NULL, *distances = NULL;
    Status status = NEW_ARRAY(values, species.count * lags_rows(lags) * self->bins);
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags));
    if (status == OK) status = NEW_ARRAY(distances, self->bins);
    if (status == OK) status = put(self, &species, values, times, distances, results, replica);
    memory_free(values);
    memory_free(times);
    memory_free(distances);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    const VanHoveSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    return sizeof(VanHove) +
           motion_memory(system, &lags, system->species_count * bins_of(settings));
}

const ObservableKind observable_van_hove = {
    .name = "van_hove",
    .about = "Self part of the van Hove function of each species at logarithmic lags: how the "
             "lengths of displacements are distributed.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(VanHoveSettings)},
    .check = check,
    .create = create,
    .next = motion_next,
    .see = motion_see,
    .archive = motion_archive,
    .write = write,
    .free = motion_free,
    .memory = memory,
};
