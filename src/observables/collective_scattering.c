// SPDX-License-Identifier: GPL-3.0-or-later
// Collective intermediate scattering functions F_ab(q,t) = <rho_a*(q,0) rho_b(q,t)>/N of every pair
// of species (Weysser, thesis, ch. 3), over the vectors of the reciprocal lattice in a shell around
// each wave number and many time origins. The two ways round, a before b and b before a, are the
// same in equilibrium and averaged. The first lag is 0, where F_ab is the structure factor S_ab.
// Beside each lag stands S_ab over the very configurations at its two ends: the difference to F_ab
// is then <|rho(t) - rho(0)|^2>/(2N), which knows the little that has changed as well as the much.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/frame.h"
#include "observables/history.h"
#include "observables/labels.h"
#include "observables/put.h"
#include "observables/wave_vectors.h"

#include <math.h>
#include <string.h>

typedef struct CollectiveSettings {
    OptionReals wave_numbers;
    double width;
    int64_t vectors;
    int64_t frame;
    LagSettings lags;
} CollectiveSettings;

static const Option rows[] = {
    WAVE_NUMBER_OPTION(CollectiveSettings, wave_numbers),
    {.name = "shell.width",
     .type = OPTION_REAL,
     .offset = offsetof(CollectiveSettings, width),
     .fallback = 0.2,
     .least = 0.001,
     .most = 100,
     .unit = "1/d",
     .about = "Wave vectors are taken within half of it from each wave number."},
    {.name = "shell.vectors",
     .type = OPTION_INTEGER,
     .offset = offsetof(CollectiveSettings, vectors),
     .fallback = 30,
     .least = 0,
     .most = 100000,
     .unit = "",
     .about = "Most wave vectors in a shell, q and -q counted once; 0 takes all, as one "
              "must in a glass, where no time averages what was left out."},
    FRAME_OPTION(CollectiveSettings, frame),
    LAG_OPTIONS_OF(CollectiveSettings, lags, 10, 16), // a look costs some intervals of the engine
    WAITING_OPTIONS(CollectiveSettings, lags),
};

typedef struct Collective {
    Observer observer;
    int64_t frame;
    size_t pairs;
    WaveVectors vectors;
    WaveModes modes;
    History history;  // of modes, then of their products with each other, [pair][shell]
    double *now;      // the same
    int64_t *begun;   // [waiting time, or one]: origins seen
    double *at_begin; // [waiting time, or one][pair][shell]: products at the origins
    double *products; // [row of lags][pair][shell]: of the modes at an origin and after the lag
    double *ends;     // [row of lags][pair][shell]: means of the products at both ends
} Collective;

static const CollectiveSettings *settings_in(const Settings *settings) {
    return (const CollectiveSettings *)settings->bytes;
}

// One around each wave number; their number.
static size_t shells_of(const CollectiveSettings *settings, const System *system,
                        Shell shells[OPTION_LIST_SIZE]) {
    const OptionReals q = wave_numbers_chosen(&settings->wave_numbers, system);
    for (int64_t k = 0; k < q.count; k++) {
        shells[k] = (Shell){.low = q.values[k] - settings->width / 2,
                            .high = q.values[k] + settings->width / 2};
    }
    return (size_t)q.count;
}

static Status check_members(const CollectiveSettings *settings, const System *system,
                            const Shell *shells, size_t count) {
    const OptionReals q = wave_numbers_chosen(&settings->wave_numbers, system);
    const Box box = system_box(system);
    WaveVectors vectors;
    Status status = wave_vectors_make(&vectors, &box, shells, count, 1);
    for (size_t k = 0; k < count && status == OK; k++) {
        if (vectors.members[k] > 0) continue;
        status = status_fail(BAD_DATA,
                             "collective_scattering: no wave vector of the box has a length within "
                             "%g of %g; make shell.width larger",
                             settings->width / 2, q.values[k]);
    }
    wave_vectors_clear(&vectors);
    return status;
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    const CollectiveSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    Shell shells[OPTION_LIST_SIZE];
    TRY(observer_check_rest("collective_scattering", "advected_scattering", clock));
    TRY(wave_numbers_check("collective_scattering", &settings->wave_numbers, system));
    TRY(frame_check("collective_scattering", settings->frame, 0, clock));
    const size_t count = shells_of(settings, system, shells);
    for (size_t k = 1; k < count; k++) {
        if (shells[k].low >= shells[k - 1].high) continue;
        return status_fail(BAD_DATA,
                           "collective_scattering: the shells around two wave numbers %g apart "
                           "overlap; make shell.width = %g smaller",
                           shells[k].low - shells[k - 1].low, settings->width);
    }
    TRY(wave_vectors_check("collective_scattering", "a wave number", &box, shells[count - 1].high));
    TRY(check_members(settings, system, shells, count));
    return lags_check("collective_scattering", &settings->lags, clock);
}

static size_t groups_of(const Lags *lags) {
    return lags->waits > 0 ? lags->waits : 1;
}

// Sums of one row.
static size_t row_size(const Collective *self) {
    return self->pairs * self->vectors.shells;
}

static Status allocate(Collective *self, const CollectiveSettings *settings, const State *state,
                       const Lags *lags) {
    Shell shells[OPTION_LIST_SIZE];
    const size_t count = shells_of(settings, &state->system, shells);
    self->pairs = pair_count(state->system.species_count);
    TRY(wave_vectors_make(&self->vectors, &state->box, shells, count, settings->vectors));
    TRY(wave_modes_make(&self->modes, &self->vectors, state));
    TRY(history_make(&self->history, lags, self->modes.width + row_size(self)));
    TRY(NEW_ARRAY(self->now, self->history.width));
    TRY(NEW_ARRAY(self->begun, groups_of(lags)));
    TRY(NEW_ARRAY(self->at_begin, groups_of(lags) * row_size(self)));
    TRY(NEW_ARRAY(self->products, lags_rows(lags) * row_size(self)));
    return NEW_ARRAY(self->ends, lags_rows(lags) * row_size(self));
}

static void discard(Observer *observer) {
    Collective *self = (Collective *)observer;
    history_clear(&self->history);
    wave_modes_clear(&self->modes);
    wave_vectors_clear(&self->vectors);
    memory_free(self->now);
    memory_free(self->begun);
    memory_free(self->at_begin);
    memory_free(self->products);
    memory_free(self->ends);
    memory_free(self);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const CollectiveSettings *settings = settings_in(settings_);
    Collective *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_collective_scattering, .clock = *clock};
    self->frame = settings->frame;
    const Lags lags = lags_chosen(&settings->lags, clock);
    return observer_begin(out, &self->observer, allocate(self, settings, state, &lags));
}

static int64_t next(const Observer *observer, int64_t after) {
    const Collective *self = (const Collective *)observer;
    return lags_next(&self->history.lags, &observer->clock, after);
}

static void add_products(const Collective *self, const double *then, double *sums) {
    wave_modes_add_products(&self->modes, &self->vectors, then, self->now, sums);
}

static void add_row(Collective *self, size_t row, const double *then) {
    const double *one = then + self->modes.width, *other = self->now + self->modes.width;
    double *ends = self->ends + row * row_size(self);
    add_products(self, then, self->products + row * row_size(self));
    for (size_t i = 0; i < row_size(self); i++) ends[i] += 0.5 * one[i] + 0.5 * other[i];
}

static void look(Collective *self, const State *state) {
    double *products = self->now + self->modes.width;
    wave_modes_find(&self->modes, state, self->now);
    if (self->frame == FRAME_CENTRE_OF_MASS) {
        double centre[3];
        frame_centre(self->frame, state, centre);
        wave_modes_shift(&self->modes, &state->box, centre, self->now);
    }
    memset(products, 0, row_size(self) * sizeof *products);
    add_products(self, self->now, products);
}

static void begin(Collective *self, int64_t tick) {
    const Lags *lags = &self->history.lags;
    const int64_t slot = lags_slot(lags, tick);
    if (slot == LAGS_NO_ORIGIN) return;
    const size_t group = lags->waits > 0 ? (size_t)slot : 0;
    const double *products = self->now + self->modes.width;
    double *sums = self->at_begin + group * row_size(self);
    for (size_t i = 0; i < row_size(self); i++) sums[i] += products[i];
    self->begun[group]++;
    history_keep(&self->history, tick, self->now);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Collective *self = (Collective *)observer;
    look(self, state);
    for (size_t k = 0; k < self->history.lags.count; k++) {
        size_t row = 0;
        const double *then = history_begun(&self->history, tick, k, &row);
        if (then) add_row(self, row, then);
    }
    begin(self, tick);
    return OK;
}

static const uint64_t COLLECTIVE_TAG = 0x434f4c4c45303031; // "COLLE001"

static void archive(Observer *observer, Archive *archive) {
    Collective *self = (Collective *)observer;
    const Lags *lags = &self->history.lags;
    archive_tag(archive, COLLECTIVE_TAG);
    history_archive(&self->history, archive);
    archive_i64(archive, self->begun, groups_of(lags));
    archive_f64(archive, self->at_begin, groups_of(lags) * row_size(self));
    archive_f64(archive, self->products, lags_rows(lags) * row_size(self));
    archive_f64(archive, self->ends, lags_rows(lags) * row_size(self));
}

// Sums of a waiting time and of time 0 or lag number `time` - 1, and from how many origins: of the
// functions, or of the structure factors at the ends.
static const double *sums_at(const Collective *self, bool at_ends, size_t group, size_t time,
                             double *origins) {
    if (time == 0) {
        *origins = (double)self->begun[group];
        return self->at_begin + group * row_size(self);
    }
    const size_t row = group * self->history.lags.count + time - 1;
    *origins = (double)self->history.seen[row];
    return (at_ends ? self->ends : self->products) + row * row_size(self);
}

// value[pair * stride], of one shell and time; the last pair their total, F_ab and F_ba each
// counted.
static void fill_pairs(const Collective *self, const double *sums, double samples, size_t stride,
                       double *value) {
    double total = 0;
    size_t pair = 0;
    for (size_t a = 0; a < self->modes.species_count; a++) {
        for (size_t b = a; b < self->modes.species_count; b++, pair++) {
            const double partial = sums[pair * self->vectors.shells] / samples;
            value[pair * stride] = partial;
            total += a == b ? partial : 2 * partial;
        }
    }
    value[pair * stride] = total;
}

// values[pair][shell][waiting time][time].
static void fill(const Collective *self, bool at_ends, size_t particles, double *values) {
    const size_t times = self->history.lags.count + 1, groups = groups_of(&self->history.lags);
    const size_t stride = self->vectors.shells * groups * times;
    for (size_t group = 0; group < groups; group++) {
        for (size_t time = 0; time < times; time++) {
            double origins = 0;
            const double *sums = sums_at(self, at_ends, group, time, &origins);
            for (size_t k = 0; k < self->vectors.shells; k++) {
                const double samples = origins * self->vectors.members[k] * (double)particles;
                fill_pairs(self, sums + k, samples, stride,
                           values + (k * groups + group) * times + time);
            }
        }
    }
}

// The axes of lags.h, with a time of 0 in front of the lags; `times` has room for one more.
static size_t time_axes(const Collective *self, double *times, ResultAxis *axes) {
    const Lags *lags = &self->history.lags;
    const size_t count = lags_axes(lags, &self->observer.clock, times, axes);
    double *first = times + lags->waits;
    memmove(first + 1, first, lags->count * sizeof *first);
    *first = 0;
    axes[count - 1].count++;
    return count;
}

static Status put(const Collective *self, const State *state, const Labels *pairs, double *times,
                  double *values, Results *results, size_t replica) {
    static const char *const names[][2] = {
        {"collective_scattering", "collective_scattering_ends"},
        {"collective_scattering_about_centre", "collective_scattering_about_centre_ends"}};
    ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {{.name = "pair", .unit = "", .count = pairs->count, .labels = pairs->names},
                 {.name = "wave_number",
                  .unit = "1/d",
                  .count = self->vectors.shells,
                  .values = self->vectors.wave_number}}};
    shape.axes += time_axes(self, times, shape.axis + shape.axes);
    for (size_t k = 0; k < 2; k++) {
        fill(self, k == 1, state->count, values);
        TRY(observer_put_series(&self->observer, names[self->frame][k], &shape, results, replica,
                                values));
    }
    return OK;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Collective *self = (const Collective *)observer;
    const Lags *lags = &self->history.lags;
    Labels pairs;
    labels_of_pairs(&pairs, &state->system, "total");
    double *values = NULL, *times = NULL;
    Status status =
        NEW_ARRAY(values, pairs.count * self->vectors.shells * groups_of(lags) * (lags->count + 1));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags) + 1);
    if (status == OK) status = put(self, state, &pairs, times, values, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    const CollectiveSettings *settings = settings_in(settings_);
    Shell shells[OPTION_LIST_SIZE];
    const size_t count = shells_of(settings, system, shells);
    const Box box = system_box(system);
    const Lags lags = lags_chosen(&settings->lags, clock);
    const double last = shells[count - 1].high;
    const double vectors = wave_vectors_most(&box, last, count, settings->vectors);
    const size_t sums = pair_count(system->species_count) * count;
    const size_t frame = 2 * system->species_count * (size_t)vectors + sums;
    return sizeof(Collective) + wave_vectors_memory(&box, last, count, settings->vectors) +
           history_memory(&lags, frame) +
           (frame + (groups_of(&lags) + 2 * lags_rows(&lags)) * sums) * sizeof(double);
}

static Status describe(const Settings *settings_, const System *system, Text *lines) {
    const CollectiveSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    Shell shells[OPTION_LIST_SIZE];
    const size_t count = shells_of(settings, system, shells);
    wave_vectors_describe(&box, shells, count, settings->vectors, "shell.vectors", lines);
    return OK;
}

const ObservableKind observable_collective_scattering = {
    .name = "collective_scattering",
    .about = "Partial collective intermediate scattering functions at logarithmic lags: how fast "
             "the arrangement of the particles forgets itself, at each wave number.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(CollectiveSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
    .describe = describe,
};
