// SPDX-License-Identifier: GPL-3.0-or-later
// Second and fourth moments of the displacements of each species, <r^2> and <r^4>, from which
// analysis has the non-Gaussian parameter alpha_2 = dim <r^4>/((dim + 2) <r^2>^2) - 1 (Rahman,
// Phys. Rev. 136, A405, 1964): a ratio of means, which is not the mean of the replicas' ratios.
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/motion.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"

#include <stdio.h>

typedef struct MomentSettings {
    LagSettings lags;
} MomentSettings;

static const Option rows[] = {LAG_OPTIONS_OF(MomentSettings, lags, 10, 32),
                              WAITING_OPTIONS(MomentSettings, lags)};

enum { MOMENTS = 2 };                                   // of each species: second, fourth
static const uint64_t MOMENTS_TAG = 0x4d4f4d454e303031; // "MOMEN001"

static const LagSettings *lag_settings(const Settings *settings) {
    return &((const MomentSettings *)settings->bytes)->lags;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    TRY(tracer_check_stays("non_gaussian_parameter", clock));
    return lags_check("non_gaussian_parameter", lag_settings(settings), clock);
}

// The lanes that no particle has moved add nothing.
static void add_row(Motion *self, double *sums) {
    displacements_squares(&self->moves, self->scratch);
    for (size_t s = 0; s < self->moves.species_count; s++) {
        Lanes second = {0}, fourth = {0};
        for (size_t i = self->moves.begin[s]; i < self->moves.begin[s + 1]; i += LANES) {
            const Lanes square = *(const Lanes *)(self->scratch + i);
            second += square;
            fourth += square * square;
        }
        sums[MOMENTS * s] += lanes_sum(&second);
        sums[MOMENTS * s + 1] += lanes_sum(&fourth);
    }
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    Motion *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_non_gaussian_parameter, .clock = *clock};
    self->tag = MOMENTS_TAG;
    self->row_size = state->system.species_count * MOMENTS;
    self->add_row = add_row;
    return motion_begin(out, self, state, &lags);
}

// values[species][row]; the last species all of them, if there are several. NaN where nothing was
// seen.
static void fill(const Motion *self, size_t labels, size_t moment, double *values) {
    const size_t species_count = self->moves.species_count;
    const size_t row_count = lags_rows(&self->moves.history.lags);
    for (size_t s = 0; s < labels; s++) {
        const size_t first = s < species_count ? s : 0;
        const size_t last = s < species_count ? s + 1 : species_count;
        for (size_t row = 0; row < row_count; row++) {
            double sum = 0;
            for (size_t i = first; i < last; i++)
                sum += self->sums[(row * species_count + i) * MOMENTS + moment];
            *values++ = sum / displacements_samples(&self->moves, row, first, last);
        }
    }
}

static Status put(const Motion *self, const Labels *species, double *values, double *times,
                  Results *results, size_t replica) {
    static const char *const names[] = {"squared_displacement", "quartic_displacement"};
    static const char *const units[] = {"d^2", "d^4"};
    for (size_t moment = 0; moment < MOMENTS; moment++) {
        ResultSeries shape = {.axes = 1, .axis = {{.name = "species", .unit = ""}}};
        snprintf(shape.unit, sizeof shape.unit, "%s", units[moment]);
        shape.axis[0].count = species->count;
        shape.axis[0].labels = species->names;
        shape.axes += lags_axes(&self->moves.history.lags, &self->observer.clock, times,
                                shape.axis + shape.axes);
        fill(self, species->count, moment, values);
        TRY(observer_put_series(&self->observer, names[moment], &shape, results, replica, values));
    }
    return OK;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Motion *self = (const Motion *)observer;
    const Lags *lags = &self->moves.history.lags;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, species.count * lags_rows(lags));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags));
    if (status == OK) status = put(self, &species, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    return sizeof(Motion) + motion_memory(system, &lags, system->species_count * MOMENTS);
}

const ObservableKind observable_non_gaussian_parameter = {
    .name = "non_gaussian_parameter",
    .about =
        "How far the displacements of each species are from Gaussian: zero for free diffusion, "
        "large where some particles are caged and some escape.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(MomentSettings)},
    .check = check,
    .create = create,
    .next = motion_next,
    .see = motion_see,
    .archive = motion_archive,
    .write = write,
    .free = motion_free,
    .memory = memory,
};
