// SPDX-License-Identifier: GPL-3.0-or-later
// Static structure factors S_ab(q) = <rho_a*(q) rho_b(q)>/N (Weysser, thesis, ch. 3), so that the
// total is their sum over all ordered pairs of species and S_ab -> x_a delta_ab for large q.
// Averaged over the vectors of the reciprocal lattice in shells of |q|; where a shell has more of
// them than wanted, an even choice over all directions.
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/put.h"
#include "observables/wave_vectors.h"

#include <math.h>

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
     .about = "Most wave vectors in a shell, q and -q counted once; 0 takes all."},
    {.name = "looks",
     .type = OPTION_INTEGER,
     .offset = offsetof(StructureSettings, looks),
     .fallback = 60,
     .least = 1,
     .most = 10000000,
     .unit = "",
     .about = "Configurations looked at, evenly over the stage: at most this many."},
};

typedef struct StructureFactor {
    Observer observer;
    int64_t period;
    size_t species_count;
    uint64_t looks;
    WaveVectors vectors;
    WaveModes modes;
    double *now;      // the modes
    double *products; // [pair][shells], sums of Re rho_a* rho_b over vectors and looks
} StructureFactor;

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
    return NEW_ARRAY(self->products, pair_count(self->species_count) * self->vectors.shells);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const StructureSettings *chosen = (const StructureSettings *)settings->bytes;
    StructureFactor *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_structure_factor, .clock = *clock};
    self->period = looks_period(clock, chosen->looks);
    self->species_count = state->system.species_count;
    const Status status = allocate(self, chosen, state);
    if (status != OK) {
        discard(&self->observer);
        return status;
    }
    *out = &self->observer;
    return OK;
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    const Box box = system_box(system);
    TRY(wave_vectors_check_rest("structure_factor", "planar_structure_factor", clock));
    const double least = wave_number_least(&box);
    TRY(wave_vectors_check("structure_factor", "wave_numbers.last", &box, settings->last));
    if (settings->last > least) return OK;
    return status_fail(BAD_DATA,
                       "structure_factor: wave_numbers.last = %g is not above 2 pi/L = %g of the "
                       "box, the smallest wave number that fits; make it larger",
                       settings->last, least);
}

static int64_t next(const Observer *observer, int64_t after) {
    return looks_next(&observer->clock, ((const StructureFactor *)observer)->period, after);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    StructureFactor *self = (StructureFactor *)observer;
    wave_modes_find(&self->modes, state, self->now);
    wave_modes_add_products(&self->modes, &self->vectors, self->now, self->now, self->products);
    self->looks++;
    return OK;
}

static const uint64_t STRUCTURE_TAG = 0x5354525543303031; // "STRUC001"

static void archive(Observer *observer, Archive *archive) {
    StructureFactor *self = (StructureFactor *)observer;
    archive_tag(archive, STRUCTURE_TAG);
    archive_u64(archive, &self->looks, 1);
    archive_f64(archive, self->products, pair_count(self->species_count) * self->vectors.shells);
}

// Keeps the shells that have vectors; gives their number.
static size_t fill(const StructureFactor *self, size_t particles, size_t labels, double *values,
                   double *wave_numbers) {
    size_t filled = 0;
    for (size_t k = 0; k < self->vectors.shells; k++) filled += self->vectors.members[k] > 0;
    size_t at = 0;
    for (size_t k = 0; k < self->vectors.shells; k++) {
        if (!(self->vectors.members[k] > 0)) continue;
        const double samples = self->vectors.members[k] * (double)self->looks * (double)particles;
        double total = 0;
        size_t pair = 0;
        for (size_t a = 0; a < self->species_count; a++) {
            for (size_t b = a; b < self->species_count; b++, pair++) {
                const double partial = self->products[pair * self->vectors.shells + k] / samples;
                values[pair * filled + at] = partial;
                total += a == b ? partial : 2 * partial; // S_ab and S_ba
            }
        }
        values[(labels - 1) * filled + at] = total;
        wave_numbers[at++] = self->vectors.wave_number[k];
    }
    return filled;
}

static Status put(const StructureFactor *self, const State *state, const Labels *pairs,
                  double *values, double *wave_numbers, Results *results, size_t replica) {
    const size_t filled = fill(self, state->count, pairs->count, values, wave_numbers);
    const ResultSeries shape = {
        .unit = "",
        .about = "Partial structure factors S_ab(q) = <rho_a* rho_b>/N; total: their sum over all "
                 "ordered pairs.",
        .axes = 2,
        .axis = {{.name = "pair", .unit = "", .count = pairs->count, .labels = pairs->names},
                 {.name = "wave_number", .unit = "1/d", .count = filled, .values = wave_numbers}}};
    return observer_put_series(&self->observer, "structure_factor", &shape, results, replica,
                               values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const StructureFactor *self = (const StructureFactor *)observer;
    Labels pairs;
    labels_of_pairs(&pairs, &state->system, "total");
    double *values = NULL, *wave_numbers = NULL;
    Status status = NEW_ARRAY(values, pairs.count * self->vectors.shells);
    if (status == OK) status = NEW_ARRAY(wave_numbers, self->vectors.shells);
    if (status == OK) status = put(self, state, &pairs, values, wave_numbers, results, replica);
    memory_free(values);
    memory_free(wave_numbers);
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
           (2 * species * (size_t)vectors + pair_count(species) * shells) * sizeof(double);
}

const ObservableKind observable_structure_factor = {
    .name = "structure_factor",
    .about = "Partial and total static structure factors on the reciprocal lattice of the box.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(StructureSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
