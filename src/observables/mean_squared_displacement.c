// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacement <(x(t) - x(0))^2> per species and direction, averaged over particles
// and time origins (lags.h says which). Coordinates are unfolded. Seen from the box the drift of
// the centre of mass is left in: a thermostat that redraws velocities conserves no momentum, so the
// centre of N particles diffuses with D0/N, as that of N Brownian particles does.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/frame.h"
#include "observables/history.h"
#include "observables/labels.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"

#include <math.h>
#include <string.h>

typedef struct MsdSettings {
    LagSettings lags;
    int64_t frame;
} MsdSettings;

static const Option rows[] = {LAG_OPTIONS(MsdSettings, lags),
                              WAITING_TIMES_OPTION(MsdSettings, lags),
                              FRAME_OPTION(MsdSettings, frame)};

typedef struct Msd {
    Observer observer;
    History history; // of unfolded coordinates, [dimension][particles]
    size_t particles, species_count;
    int dimension;
    int64_t frame;
    size_t population[SPECIES_MOST];
    double *now;     // [dimension][particles]
    double *squares; // [row of lags][species][dimension]: summed over particles and origins
} Msd;

static const MsdSettings *settings_in(const Settings *settings) {
    return (const MsdSettings *)settings->bytes;
}

static const LagSettings *lag_settings(const Settings *settings) {
    return &settings_in(settings)->lags;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    TRY(observer_check_rest("mean_squared_displacement", "non_affine_displacement", clock));
    TRY(tracer_check_stays("mean_squared_displacement", clock));
    TRY(frame_check("mean_squared_displacement", settings_in(settings)->frame, 0, clock));
    return lags_check("mean_squared_displacement", lag_settings(settings), clock);
}

static size_t frame_size(const Msd *msd) {
    return (size_t)msd->dimension * msd->particles;
}

static size_t square_count(const Msd *msd) {
    return lags_rows(&msd->history.lags) * msd->species_count * (size_t)msd->dimension;
}

static Status allocate(Msd *msd, const Lags *lags) {
    TRY(history_make(&msd->history, lags, frame_size(msd)));
    TRY(NEW_ARRAY(msd->now, frame_size(msd)));
    return NEW_ARRAY(msd->squares, square_count(msd));
}

static void discard(Observer *observer) {
    Msd *msd = (Msd *)observer;
    history_clear(&msd->history);
    memory_free(msd->now);
    memory_free(msd->squares);
    memory_free(msd);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Msd *msd = NULL;
    TRY(NEW(msd));
    msd->observer = (Observer){.kind = &observable_mean_squared_displacement, .clock = *clock};
    msd->particles = state->count;
    msd->species_count = state->system.species_count;
    msd->dimension = state->box.dimension;
    msd->frame = settings_in(settings)->frame;
    system_counts(&state->system, msd->population);
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    return observer_begin(out, &msd->observer, allocate(msd, &lags));
}

static int64_t next(const Observer *observer, int64_t after) {
    return lags_next(&((const Msd *)observer)->history.lags, &observer->clock, after);
}

// Four partial sums in a fixed order: a vector unit can run them, and every compiler agrees.
static double sum_of_squares(const double *from, const double *to, size_t count) {
    double sum[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        for (size_t k = 0; k < 4; k++)
            sum[k] += (to[i + k] - from[i + k]) * (to[i + k] - from[i + k]);
    }
    for (; i < count; i++) sum[0] += (to[i] - from[i]) * (to[i] - from[i]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static void add_displacements(Msd *msd, size_t row, const double *then) {
    double *squares = msd->squares + row * msd->species_count * (size_t)msd->dimension;
    size_t begin = 0;
    for (size_t s = 0; s < msd->species_count; s++) {
        for (int a = 0; a < msd->dimension; a++) {
            const size_t at = (size_t)a * msd->particles + begin;
            *squares++ += sum_of_squares(then + at, msd->now + at, msd->population[s]);
        }
        begin += msd->population[s];
    }
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Msd *msd = (Msd *)observer;
    double centre[3];
    frame_centre(msd->frame, state, centre);
    for (int a = 0; a < msd->dimension; a++) {
        double *now = msd->now + (size_t)a * msd->particles;
        frame_unfold(state, a, centre[a], 0, msd->particles, now);
    }
    for (size_t k = 0; k < msd->history.lags.count; k++) {
        size_t row = 0;
        const double *then = history_begun(&msd->history, tick, k, &row);
        if (then) add_displacements(msd, row, then);
    }
    history_keep(&msd->history, tick, msd->now);
    return OK;
}

static const uint64_t MSD_TAG = 0x4d53443030303032; // "MSD00002"

static void archive(Observer *observer, Archive *archive) {
    Msd *msd = (Msd *)observer;
    archive_tag(archive, MSD_TAG);
    history_archive(&msd->history, archive);
    archive_f64(archive, msd->squares, square_count(msd));
}

// <dx^2> along `axis` of a species, or of all particles for species = species_count.
static double mean_square(const Msd *msd, size_t row, size_t species, int axis) {
    const size_t begin = species < msd->species_count ? species : 0;
    const size_t end = species < msd->species_count ? species + 1 : msd->species_count;
    double sum = 0, samples = 0;
    for (size_t s = begin; s < end; s++) {
        sum += msd->squares[(row * msd->species_count + s) * (size_t)msd->dimension + (size_t)axis];
        samples += (double)msd->history.seen[row] * (double)msd->population[s];
    }
    return sum / samples; // NaN where nothing was seen
}

// values[species][direction][row], the last direction being the sum over the others.
static void fill(const Msd *msd, size_t species_labels, double *values) {
    const size_t lags = lags_rows(&msd->history.lags);
    for (size_t s = 0; s < species_labels; s++) {
        for (size_t k = 0; k < lags; k++) {
            double total = 0;
            for (int a = 0; a < msd->dimension; a++) {
                const double square = mean_square(msd, k, s, a);
                values[(size_t)a * lags + k] = square;
                total += square;
            }
            values[(size_t)msd->dimension * lags + k] = total;
        }
        values += ((size_t)msd->dimension + 1) * lags;
    }
}

static Status put(const Msd *msd, const Labels *species, double *values, double *times,
                  Results *results, size_t replica) {
    static const char *const directions[2][4] = {{"x", "y", "total"}, {"x", "y", "z", "total"}};
    fill(msd, species->count, values);
    ResultSeries shape = {
        .unit = "d^2",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = species->count, .labels = species->names},
                 {.name = "direction",
                  .unit = "",
                  .count = (size_t)msd->dimension + 1,
                  .labels = directions[msd->dimension - 2]}}};
    shape.axes += lags_axes(&msd->history.lags, &msd->observer.clock, times, shape.axis + 2);
    const char *name = msd->frame == FRAME_CENTRE_OF_MASS ? "mean_squared_displacement_centred"
                                                          : "mean_squared_displacement";
    return observer_put_series(&msd->observer, name, &shape, results, replica, values);
}

// Of Monte Carlo, which goes by the diffusion tensors: orientations average them.
static Status put_free_diffusion(const Msd *msd, const State *state, const Labels *species,
                                 Results *results, size_t replica) {
    const System *system = &state->system;
    double values[SPECIES_MOST + 1] = {0};
    for (size_t s = 0; s < msd->species_count; s++) {
        const Diffusion free = species_diffusion(&system->species[s]);
        values[s] = diffusion_mean(&free, msd->dimension) / system_reference_diffusion(system);
        if (species->count > msd->species_count) {
            values[msd->species_count] +=
                values[s] * (double)msd->population[s] / (double)msd->particles;
        }
    }
    const ResultSeries shape = {
        .unit = "D0",
        .axes = 1,
        .axis = {
            {.name = "species", .unit = "", .count = species->count, .labels = species->names}}};
    return observer_put_series(&msd->observer, "free_diffusion", &shape, results, replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Msd *msd = (const Msd *)observer;
    Labels species;
    labels_of_species(&species, &state->system);
    const Lags *lags = &msd->history.lags;
    double *values = NULL, *times = NULL;
    Status status =
        NEW_ARRAY(values, species.count * ((size_t)msd->dimension + 1) * lags_rows(lags));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags));
    if (status == OK) status = put(msd, &species, values, times, results, replica);
    if (status == OK) status = observer_put_force(observer, &state->system, results, replica);
    const bool tensors = !observer->clock.flies && strcmp(observer->clock.unit, "d^2/D0") == 0;
    if (status == OK && tensors) {
        status = put_free_diffusion(msd, state, &species, results, replica);
    }
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    const size_t frame = (size_t)(system->dimension * system->particles);
    return sizeof(Msd) + history_memory(&lags, frame) + frame * sizeof(double);
}

const ObservableKind observable_mean_squared_displacement = {
    .name = "mean_squared_displacement",
    .about = "Mean squared displacement per species and direction at logarithmic lags, from the "
             "ballistic flight inside a thermostat interval to long-time diffusion.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(MsdSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
