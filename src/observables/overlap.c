// SPDX-License-Identifier: GPL-3.0-or-later
// Overlap Q(t): the fraction of the particles of a species that are within `distance` of where they
// were a time t before, as a mean over time origins, and the mean of its square. From both analysis
// has the four-point susceptibility chi_4 = N (<Q^2> - <Q>^2) (Lacevic et al., J. Chem. Phys. 119,
// 7372, 2003; the self part), with the mean over origins and replicas, at fixed numbers of
// particles.
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/motion.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"

typedef struct OverlapSettings {
    double distance;
    LagSettings lags;
    int64_t frame;
} OverlapSettings;

static const Option rows[] = {
    {.name = "distance",
     .type = OPTION_REAL,
     .offset = offsetof(OverlapSettings, distance),
     .fallback = 0.3,
     .least = 1e-6,
     .most = 1e6,
     .unit = "d",
     .about = "A particle within it of where it was overlaps with itself."},
    LAG_OPTIONS_OF(OverlapSettings, lags, 10, 32),
    WAITING_OPTIONS(OverlapSettings, lags),
    FRAME_OPTION(OverlapSettings, frame),
};

enum { POWERS = 2 };
static const uint64_t OVERLAP_TAG = 0x4f5645524c303031; // "OVERL001"

typedef struct Overlap {
    Motion motion; // rows are [label][Q, Q^2]
    double distance;
    size_t labels; // species, and all of them if there are several
} Overlap;

static const OverlapSettings *settings_in(const Settings *settings) {
    return (const OverlapSettings *)settings->bytes;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    TRY(tracer_check_stays("overlap", clock));
    TRY(frame_check("overlap", settings_in(settings)->frame, 0, clock));
    return lags_check("overlap", &settings_in(settings)->lags, clock);
}

static size_t labels_of(size_t species_count) {
    return species_count + (species_count > 1);
}

static void add_overlap(double *sums, double inside, double particles) {
    const double overlap = inside / particles;
    sums[0] += overlap;
    sums[1] += overlap * overlap;
}

static void add_row(Motion *motion, double *sums) {
    const Overlap *self = (const Overlap *)motion;
    const Displacements *moves = &motion->moves;
    const double within = self->distance * self->distance;
    double all_inside = 0, all = 0;
    displacements_squares(moves, motion->scratch);
    for (size_t s = 0; s < moves->species_count; s++, sums += POWERS) {
        const double *squares = motion->scratch + moves->begin[s];
        size_t inside = 0;
        for (size_t i = 0; i < moves->population[s]; i++) inside += squares[i] < within;
        add_overlap(sums, (double)inside, (double)moves->population[s]);
        all_inside += (double)inside;
        all += (double)moves->population[s];
    }
    if (self->labels > moves->species_count) add_overlap(sums, all_inside, all);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const OverlapSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    Overlap *self = NULL;
    TRY(NEW(self));
    self->distance = settings->distance;
    self->labels = labels_of(state->system.species_count);
    self->motion = (Motion){.observer = {.kind = &observable_overlap, .clock = *clock},
                            .tag = OVERLAP_TAG,
                            .moves = {.frame = settings->frame},
                            .row_size = self->labels * POWERS,
                            .add_row = add_row};
    return motion_begin(out, &self->motion, state, &lags);
}

// values[label][row]; NaN where nothing was seen.
static void fill(const Overlap *self, size_t power, double *values) {
    const size_t row_count = lags_rows(&self->motion.moves.history.lags);
    for (size_t l = 0; l < self->labels; l++) {
        for (size_t row = 0; row < row_count; row++) {
            *values++ = self->motion.sums[(row * self->labels + l) * POWERS + power] /
                        (double)self->motion.moves.history.seen[row];
        }
    }
}

static Status put(const Overlap *self, const Labels *species, double *values, double *times,
                  Results *results, size_t replica) {
    static const char *const names[][POWERS] = {{"overlap", "overlap_square"},
                                                {"overlap_centred", "overlap_square_centred"}};
    const bool centred = self->motion.moves.frame == FRAME_CENTRE_OF_MASS;
    for (size_t power = 0; power < POWERS; power++) {
        ResultSeries shape = {.unit = "",
                              .axes = 1,
                              .axis = {{.name = "species",
                                        .unit = "",
                                        .count = species->count,
                                        .labels = species->names}}};
        shape.axes += lags_axes(&self->motion.moves.history.lags, &self->motion.observer.clock,
                                times, shape.axis + shape.axes);
        fill(self, power, values);
        TRY(observer_put_series(&self->motion.observer, names[centred][power], &shape, results,
                                replica, values));
    }
    return OK;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Overlap *self = (const Overlap *)observer;
    const Lags *lags = &self->motion.moves.history.lags;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, self->labels * lags_rows(lags));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags));
    if (status == OK) status = put(self, &species, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(&settings_in(settings)->lags, clock);
    return sizeof(Overlap) +
           motion_memory(system, &lags, labels_of(system->species_count) * POWERS);
}

const ObservableKind observable_overlap = {
    .name = "overlap",
    .about = "Overlap of the configuration with itself a time later, and the four-point "
             "susceptibility, its fluctuation: how many particles move together.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(OverlapSettings)},
    .check = check,
    .create = create,
    .next = motion_next,
    .see = motion_see,
    .archive = motion_archive,
    .write = write,
    .free = motion_free,
    .memory = memory,
};
