// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacement <(x(t) - x(0))^2> per species and direction, averaged over particles
// and time origins (lags.h says which). Coordinates are unfolded. The drift of the centre of mass
// is left in: a thermostat that redraws velocities conserves no momentum, so the centre of N
// particles diffuses with D0/N, as that of N Brownian particles does.
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/lags.h"
#include "observables/put.h"

#include <math.h>

typedef struct MsdSettings {
    double first, last;
    int64_t per_decade, origins;
} MsdSettings;

static const Option rows[] = {
    {.name = "times.first",
     .type = OPTION_REAL,
     .offset = offsetof(MsdSettings, first),
     .least = 0,
     .most = 1e12,
     .unit = "time unit of the stage",
     .about = "Shortest lag; 0 is one tick of the clock, a fraction of a thermostat interval."},
    {.name = "times.last",
     .type = OPTION_REAL,
     .offset = offsetof(MsdSettings, last),
     .least = 0,
     .most = 1e12,
     .unit = "time unit of the stage",
     .about = "Longest lag; 0 is a third of the stage."},
    {.name = "times.per_decade",
     .type = OPTION_INTEGER,
     .offset = offsetof(MsdSettings, per_decade),
     .fallback = 10,
     .least = 1,
     .most = 50,
     .unit = "",
     .about = "Lags per factor of ten in time, as near to even spacing as whole ticks allow."},
    {.name = "origins",
     .type = OPTION_INTEGER,
     .offset = offsetof(MsdSettings, origins),
     .fallback = 64,
     .least = 1,
     .most = 4096,
     .unit = "",
     .about = "Time origins within the longest lag: as many configurations are kept in memory."},
};

typedef struct Msd {
    Observer observer;
    Lags lags;
    size_t particles, species_count;
    int dimension;
    size_t population[SPECIES_MOST];
    double *ring;    // [slots][dimension][particles]: unfolded coordinates at the origins
    double *now;     // [dimension][particles]
    double *squares; // [lag][species][dimension]: summed over particles and origins
    int64_t *seen;   // [lag]: origins
} Msd;

static Lags lags_for(const Settings *settings, const Clock *clock) {
    const MsdSettings *msd = (const MsdSettings *)settings->bytes;
    return lags_of(clock, msd->first, msd->last, msd->per_decade, msd->origins);
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    const MsdSettings *msd = (const MsdSettings *)settings->bytes;
    const double time = clock->tick * (double)clock->ticks;
    if (msd->last > time * (1 + 1e-9)) {
        return status_fail(BAD_DATA,
                           "mean_squared_displacement: times.last = %g is longer than the stage "
                           "'%s' of %g %s; make the stage longer or the lag shorter",
                           msd->last, clock->stage, time, clock->unit);
    }
    if (msd->first > (msd->last > 0 ? msd->last : time / 3)) {
        return status_fail(BAD_DATA,
                           "mean_squared_displacement: times.first = %g is beyond the longest lag "
                           "of %g %s; make it shorter",
                           msd->first, msd->last > 0 ? msd->last : time / 3, clock->unit);
    }
    if (lags_for(settings, clock).count == LAGS_MOST) {
        return status_fail(BAD_DATA,
                           "mean_squared_displacement: more than %d lags; make times.per_decade "
                           "smaller or the range of times shorter",
                           LAGS_MOST - 1);
    }
    return OK;
}

static size_t frame_size(const Msd *msd) {
    return (size_t)msd->dimension * msd->particles;
}

static Status allocate(Msd *msd) {
    const size_t sums = msd->species_count * (size_t)msd->dimension;
    TRY(NEW_ARRAY(msd->ring, msd->lags.slots * frame_size(msd)));
    TRY(NEW_ARRAY(msd->now, frame_size(msd)));
    TRY(NEW_ARRAY(msd->squares, msd->lags.count * sums));
    TRY(NEW_ARRAY(msd->seen, msd->lags.count));
    return OK;
}

static void discard(Observer *observer) {
    Msd *msd = (Msd *)observer;
    memory_free(msd->ring);
    memory_free(msd->now);
    memory_free(msd->squares);
    memory_free(msd->seen);
    memory_free(msd);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Msd *msd = NULL;
    TRY(NEW(msd));
    msd->observer = (Observer){.kind = &observable_mean_squared_displacement, .clock = *clock};
    msd->lags = lags_for(settings, clock);
    msd->particles = state->count;
    msd->species_count = state->system.species_count;
    msd->dimension = state->box.dimension;
    system_counts(&state->system, msd->population);
    const Status status = allocate(msd);
    if (status != OK) {
        discard(&msd->observer);
        return status;
    }
    *out = &msd->observer;
    return OK;
}

static int64_t next(const Observer *observer, int64_t after) {
    return lags_next(&((const Msd *)observer)->lags, &observer->clock, after);
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

static void add_displacements(Msd *msd, size_t lag, const double *then) {
    double *squares = msd->squares + lag * msd->species_count * (size_t)msd->dimension;
    size_t begin = 0;
    for (size_t s = 0; s < msd->species_count; s++) {
        for (int a = 0; a < msd->dimension; a++) {
            const size_t at = (size_t)a * msd->particles + begin;
            *squares++ += sum_of_squares(then + at, msd->now + at, msd->population[s]);
        }
        begin += msd->population[s];
    }
    msd->seen[lag]++;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Msd *msd = (Msd *)observer;
    for (int a = 0; a < msd->dimension; a++) {
        double *now = msd->now + (size_t)a * msd->particles;
        for (size_t i = 0; i < msd->particles; i++) now[i] = state_unfolded(state, a, i);
    }
    for (size_t k = 0; k < msd->lags.count; k++) {
        if (!lags_ends(&msd->lags, tick, k)) continue;
        add_displacements(msd, k, msd->ring + lags_slot(&msd->lags, tick, k) * frame_size(msd));
    }
    if (!lags_is_origin(&msd->lags, tick)) return OK;
    const size_t slot = (size_t)(tick / msd->lags.spacing) % msd->lags.slots;
    double *origin = msd->ring + slot * frame_size(msd);
    for (size_t i = 0; i < frame_size(msd); i++) origin[i] = msd->now[i];
    return OK;
}

static const uint64_t MSD_TAG = 0x4d53443030303031; // "MSD00001"

static void archive(Observer *observer, Archive *archive) {
    Msd *msd = (Msd *)observer;
    archive_tag(archive, MSD_TAG);
    archive_f64(archive, msd->ring, msd->lags.slots * frame_size(msd));
    archive_f64(archive, msd->squares,
                msd->lags.count * msd->species_count * (size_t)msd->dimension);
    archive_i64(archive, msd->seen, msd->lags.count);
}

// <dx^2> along `axis` of a species, or of all particles for species = species_count.
static double mean_square(const Msd *msd, size_t lag, size_t species, int axis) {
    const size_t begin = species < msd->species_count ? species : 0;
    const size_t end = species < msd->species_count ? species + 1 : msd->species_count;
    double sum = 0, samples = 0;
    for (size_t s = begin; s < end; s++) {
        sum += msd->squares[(lag * msd->species_count + s) * (size_t)msd->dimension + (size_t)axis];
        samples += (double)msd->seen[lag] * (double)msd->population[s];
    }
    return sum / samples; // NaN where nothing was seen
}

// values[species][direction][lag], the last direction being the sum over the others.
static void fill(const Msd *msd, size_t species_labels, double *values) {
    const size_t lags = msd->lags.count;
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
    for (size_t k = 0; k < msd->lags.count; k++) {
        times[k] = (double)msd->lags.ticks[k] * msd->observer.clock.tick;
    }
    fill(msd, species->count, values);
    const ResultSeries shape = {
        .unit = "d^2",
        .about = "Mean squared displacement <(r(t) - r(0))^2> over particles and time origins; "
                 "finite size: the centre of mass is left to diffuse.",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = species->count, .labels = species->names},
                 {.name = "direction",
                  .unit = "",
                  .count = (size_t)msd->dimension + 1,
                  .labels = directions[msd->dimension - 2]},
                 {.name = "time",
                  .unit = msd->observer.clock.unit,
                  .count = msd->lags.count,
                  .values = times}}};
    return observer_put_series(&msd->observer, "mean_squared_displacement", &shape, results,
                               replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Msd *msd = (const Msd *)observer;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *times = NULL;
    Status status =
        NEW_ARRAY(values, species.count * ((size_t)msd->dimension + 1) * msd->lags.count);
    if (status == OK) status = NEW_ARRAY(times, msd->lags.count);
    if (status == OK) status = put(msd, &species, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_for(settings, clock);
    const size_t frame = (size_t)(system->dimension * system->particles) * sizeof(double);
    return sizeof(Msd) + (lags.slots + 1) * frame;
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
