// SPDX-License-Identifier: GPL-3.0-or-later
// Static structure factors S_ab(q) = <rho_a*(q) rho_b(q)>/N (Weysser, thesis, ch. 3), so that the
// total is their sum over all ordered pairs of species and S_ab -> x_a delta_ab for large q.
// Averaged over the vectors of the reciprocal lattice in shells of |q|; where a shell has more of
// them than wanted, an even choice over all directions. The total is given in stretches of the
// stage as well: its peak rises where particles order.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/put.h"
#include "observables/wave_vectors.h"

#include <math.h>

enum { STRETCHES = 10 };

typedef struct StructureSettings {
    double last, spacing;
    int64_t vectors, looks;
} StructureSettings;

static const Option rows[] = {
    {.name = "wave_numbers.last",
     .type = OPTION_REAL,
     .offset = offsetof(StructureSettings, last),
     .fallback = 20,
     .least = 0.01,
     .most = 1000,
     .unit = "1/d",
     .about = "Largest wave number."},
    {.name = "wave_numbers.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(StructureSettings, spacing),
     .fallback = 0.2,
     .least = 0.001,
     .most = 100,
     .unit = "1/d",
     .about = "Width of a shell of wave vectors that are averaged together."},
    {.name = "wave_numbers.vectors",
     .type = OPTION_INTEGER,
     .offset = offsetof(StructureSettings, vectors),
     .fallback = 30,
     .least = 0,
     .most = 1000000,
     .unit = "",
     .about = "Most wave vectors in a shell, q and -q counted once; 0 takes all, as one "
              "must in a glass, where no time averages what was left out."},
    LOOKS_OPTION(StructureSettings, looks, 60),
};

typedef struct StructureFactor {
    Observer observer;
    size_t species_count;
    WaveVectors vectors;
    WaveModes modes;
    double *now;      // the modes
    size_t stretches; // of the stage, as many as there are looks, and STRETCHES at most
    double *products; // [stretch][pair][shells], sums of Re rho_a* rho_b over vectors and looks
    int64_t seen[STRETCHES]; // looks of each
} StructureFactor;

// Sums of a stretch.
static size_t width_of(const StructureFactor *self) {
    return pair_count(self->species_count) * self->vectors.shells;
}

static size_t shell_count(const StructureSettings *settings) {
    return (size_t)ceil(settings->last / settings->spacing - 1e-9);
}

// Side by side from 0 to the last.
static Status shells_make(Shell **shells, const StructureSettings *settings) {
    const size_t count = shell_count(settings);
    TRY(NEW_ARRAY(*shells, count));
    for (size_t k = 0; k < count; k++) {
        (*shells)[k] = (Shell){.low = (double)k * settings->spacing,
                               .high = (double)(k + 1) * settings->spacing};
    }
    (*shells)[count - 1].high = settings->last;
    return OK;
}

static void discard(Observer *observer) {
    StructureFactor *self = (StructureFactor *)observer;
    wave_modes_clear(&self->modes);
    wave_vectors_clear(&self->vectors);
    memory_free(self->now);
    memory_free(self->products);
    memory_free(self);
}

static Status allocate(StructureFactor *self, const StructureSettings *settings,
                       const State *state) {
    Shell *shells = NULL;
    TRY(shells_make(&shells, settings));
    const Status status = wave_vectors_make(&self->vectors, &state->box, shells,
                                            shell_count(settings), settings->vectors);
    memory_free(shells);
    TRY(status);
    TRY(wave_modes_make(&self->modes, &self->vectors, state));
    TRY(NEW_ARRAY(self->now, self->modes.width));
    return NEW_ARRAY(self->products, STRETCHES * width_of(self));
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const StructureSettings *chosen = (const StructureSettings *)settings->bytes;
    StructureFactor *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_structure_factor, .clock = *clock};
    self->observer.period = looks_period(clock, chosen->looks);
    const int64_t looks = looks_count(clock, self->observer.period);
    self->stretches = looks < STRETCHES ? (size_t)looks : STRETCHES;
    self->species_count = state->system.species_count;
    return observer_begin(out, &self->observer, allocate(self, chosen, state));
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    const Box box = system_box(system);
    TRY(observer_check_rest("structure_factor", "planar_structure_factor", clock));
    const double least = wave_number_least(&box);
    TRY(wave_vectors_check("structure_factor", "wave_numbers.last", &box, settings->last));
    if (settings->last > least) return OK;
    return status_fail(BAD_DATA,
                       "structure_factor: wave_numbers.last = %g is not above 2 pi/L = %g of the "
                       "box, the smallest wave number that fits; make it larger",
                       settings->last, least);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    StructureFactor *self = (StructureFactor *)observer;
    const int64_t looks = looks_count(&self->observer.clock, self->observer.period);
    const int64_t stretch = (tick / self->observer.period - 1) * (int64_t)self->stretches / looks;
    wave_modes_find(&self->modes, state, self->now);
    wave_modes_add_products(&self->modes, &self->vectors, self->now, self->now,
                            self->products + (size_t)stretch * width_of(self));
    self->seen[stretch]++;
    return OK;
}

static const uint64_t STRUCTURE_TAG = 0x5354525543303032; // "STRUC002"

static void archive(Observer *observer, Archive *archive) {
    StructureFactor *self = (StructureFactor *)observer;
    archive_tag(archive, STRUCTURE_TAG);
    archive_i64(archive, self->seen, STRETCHES);
    archive_f64(archive, self->products, STRETCHES * width_of(self));
}

// Mean over the looks of the stretches [from, to) and the vectors of a shell; NaN without looks.
static double mean_product(const StructureFactor *self, size_t from, size_t to, size_t pair,
                           size_t shell) {
    double sum = 0, looks = 0;
    for (size_t k = from; k < to; k++) {
        sum += self->products[k * width_of(self) + pair * self->vectors.shells + shell];
        looks += (double)self->seen[k];
    }
    return sum / (looks * self->vectors.members[shell]);
}

// value[pair * stride] of one shell, the last pair their total, S_ab and S_ba each counted.
static void fill_pairs(const StructureFactor *self, size_t from, size_t to, size_t shell,
                       size_t particles, size_t stride, double *value) {
    double total = 0;
    size_t pair = 0;
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++, pair++) {
            const double partial = mean_product(self, from, to, pair, shell) / (double)particles;
            value[pair * stride] = partial;
            total += a == b ? partial : 2 * partial;
        }
    }
    value[pair * stride] = total;
}

// Keeps the shells that have vectors, `filled` of them: values[pair][shell] of the whole stage,
// totals[shell][stretch].
typedef struct Filled {
    size_t filled;
    double *wave_numbers, *values, *totals;
} Filled;

static void fill(const StructureFactor *self, size_t particles, Filled *out) {
    double pairs[PAIRS_MOST + 1];
    size_t at = 0;
    for (size_t k = 0; k < self->vectors.shells; k++) {
        if (!(self->vectors.members[k] > 0)) continue;
        fill_pairs(self, 0, self->stretches, k, particles, out->filled, out->values + at);
        for (size_t t = 0; t < self->stretches; t++) {
            fill_pairs(self, t, t + 1, k, particles, 1, pairs);
            out->totals[at * self->stretches + t] = pairs[pair_count(self->species_count)];
        }
        out->wave_numbers[at++] = self->vectors.wave_number[k];
    }
}

static Status put(const StructureFactor *self, const State *state, const Filled *filled,
                  Results *results, size_t replica) {
    Labels pairs;
    labels_of_pairs(&pairs, &state->system, "total");
    const Clock *clock = &self->observer.clock;
    const double looks = (double)looks_count(clock, self->observer.period);
    double times[STRETCHES];
    for (size_t t = 0; t < self->stretches; t++)
        times[t] = ceil((double)(t + 1) * looks / (double)self->stretches) *
                   (double)self->observer.period * clock->tick;
    const ResultAxis wave = {.name = "wave_number",
                             .unit = "1/d",
                             .count = filled->filled,
                             .values = filled->wave_numbers};
    const ResultSeries whole = {
        .axes = 2,
        .axis = {{.name = "pair", .unit = "", .count = pairs.count, .labels = pairs.names}, wave}};
    const ResultSeries stretches = {
        .axes = 2,
        .axis = {wave,
                 {.name = "time", .unit = clock->unit, .count = self->stretches, .values = times}}};
    TRY(observer_put_series(&self->observer, "structure_factor", &whole, results, replica,
                            filled->values));
    return observer_put_series(&self->observer, "structure_factor_stretches", &stretches, results,
                               replica, filled->totals);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const StructureFactor *self = (const StructureFactor *)observer;
    Filled out = {0};
    for (size_t k = 0; k < self->vectors.shells; k++) out.filled += self->vectors.members[k] > 0;
    const size_t labels = pair_count(self->species_count) + 1;
    Status status = NEW_ARRAY(out.values, labels * out.filled);
    if (status == OK) status = NEW_ARRAY(out.wave_numbers, out.filled);
    if (status == OK) status = NEW_ARRAY(out.totals, out.filled * self->stretches);
    if (status == OK) {
        fill(self, state->count, &out);
        status = put(self, state, &out, results, replica);
    }
    memory_free(out.values);
    memory_free(out.wave_numbers);
    memory_free(out.totals);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    const Box box = system_box(system);
    const size_t shells = shell_count(settings), species = system->species_count;
    const double vectors = wave_vectors_most(&box, settings->last, shells, settings->vectors);
    return sizeof(StructureFactor) +
           wave_vectors_memory(&box, settings->last, shells, settings->vectors) +
           (2 * species * (size_t)vectors + STRETCHES * pair_count(species) * shells) *
               sizeof(double);
}

static Status describe(const Settings *settings_, const System *system, Text *lines) {
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    const Box box = system_box(system);
    Shell *shells = NULL;
    TRY(shells_make(&shells, settings));
    wave_vectors_describe(&box, shells, shell_count(settings), settings->vectors,
                          "wave_numbers.vectors", lines);
    memory_free(shells);
    return OK;
}

const ObservableKind observable_structure_factor = {
    .name = "structure_factor",
    .about = "Partial and total static structure factors on the reciprocal lattice of the box.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(StructureSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
    .describe = describe,
};
