// SPDX-License-Identifier: GPL-3.0-or-later
// Static structure factors S_ab(q) = <rho_a*(q) rho_b(q)>/N (Weysser, thesis, ch. 3), so that the
// total is their sum over all ordered pairs of species and S_ab -> x_a delta_ab for large q.
// Averaged over the vectors of the reciprocal lattice in shells of |q|; where a shell has more of
// them than wanted, an even choice over all directions.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/density_modes.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/put.h"

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
    size_t species_count, shells, vectors;
    uint64_t looks;
    LatticeVector *vector;    // [vectors], the half with q_x > 0, or q_x = 0 and q_y > 0, ...
    uint32_t *shell;          // [vectors]
    double *wave_number;      // [shells], mean |q|
    double *members;          // [shells], vectors in it
    double *real, *imaginary; // [species][vectors]
    double *products;         // [pair][shells], sums of Re rho_a* rho_b over vectors and looks
    DensityModes *modes;
} StructureFactor;

static const double WALK_MOST = 1e9; // some ten seconds of walking for each replica

// A walk over the half lattice within `last`, in the order that DensityModes wants.
typedef struct Walk {
    Box box;
    double last;
    int32_t most[3];
} Walk;

static Walk walk_over(const Box *box, double last) {
    Walk walk = {.box = *box, .last = last};
    for (int a = 0; a < box->dimension; a++) {
        walk.most[a] = (int32_t)floor(last * box->edge[a] / (2 * PI));
    }
    return walk;
}

// Steps of the walk, before they are known to be countable.
static double walk_length(const Box *box, double last) {
    double length = 0.5;
    for (int a = 0; a < box->dimension; a++) length *= 2 * last * box->edge[a] / (2 * PI) + 1;
    return length;
}

static LatticeVector walk_first(const Walk *walk) {
    return (LatticeVector){.n = {0, -walk->most[1], -walk->most[2]}};
}

static bool walk_next(const Walk *walk, LatticeVector *vector) {
    for (int a = 2; a > 0; a--) {
        if (++vector->n[a] <= walk->most[a]) return true;
        vector->n[a] = -walk->most[a];
    }
    return ++vector->n[0] <= walk->most[0];
}

static double length_of(const Walk *walk, const LatticeVector *vector) {
    double square = 0;
    for (int a = 0; a < walk->box.dimension; a++) {
        const double q = 2 * PI * vector->n[a] / walk->box.edge[a];
        square += q * q;
    }
    return sqrt(square);
}

// One of each q, -q; not the origin.
static bool in_half(const LatticeVector *v) {
    if (v->n[0] != 0) return v->n[0] > 0;
    return v->n[1] != 0 ? v->n[1] > 0 : v->n[2] > 0;
}

static bool wanted(const Walk *walk, const LatticeVector *vector) {
    return in_half(vector) && length_of(walk, vector) < walk->last;
}

static size_t shells_for(const StructureSettings *settings) {
    return (size_t)ceil(settings->last / settings->spacing - 1e-9);
}

static size_t shell_of(const StructureSettings *settings, double q) {
    const size_t shell = (size_t)(q / settings->spacing), last = shells_for(settings) - 1;
    return shell < last ? shell : last; // the quotient may round up to the end
}

static void count_members(const StructureSettings *settings, const Walk *walk, double *members) {
    LatticeVector vector = walk_first(walk);
    do {
        if (wanted(walk, &vector)) {
            members[shell_of(settings, length_of(walk, &vector))]++;
        }
    } while (walk_next(walk, &vector));
}

static double chosen_of(const StructureSettings *settings, double members) {
    return settings->vectors > 0 ? fmin(members, (double)settings->vectors) : members;
}

// Every vector of a shell with few of them, an even choice of one with many: number k of n is
// taken when floor(k most/n) moves on. `seen` counts, `available` is the total in each shell.
static void choose(StructureFactor *self, const StructureSettings *settings, const Walk *walk,
                   const double *available, double *seen) {
    LatticeVector vector = walk_first(walk);
    do {
        if (!wanted(walk, &vector)) continue;
        const double q = length_of(walk, &vector);
        const size_t shell = shell_of(settings, q);
        const double share = chosen_of(settings, available[shell]) / available[shell];
        const bool take =
            floor((seen[shell] + 1) * share + 1e-9) > floor(seen[shell] * share + 1e-9);
        seen[shell]++;
        if (!take) continue;
        self->vector[self->vectors] = vector;
        self->shell[self->vectors++] = (uint32_t)shell;
        self->wave_number[shell] += q;
        self->members[shell]++;
    } while (walk_next(walk, &vector));
    for (size_t k = 0; k < self->shells; k++) {
        if (self->members[k] > 0) self->wave_number[k] /= self->members[k];
    }
}

static Status allocate(StructureFactor *self, size_t most_vectors) {
    TRY(NEW_ARRAY(self->vector, most_vectors));
    TRY(NEW_ARRAY(self->shell, most_vectors));
    TRY(NEW_ARRAY(self->wave_number, self->shells));
    TRY(NEW_ARRAY(self->members, self->shells));
    TRY(NEW_ARRAY(self->real, self->species_count * most_vectors));
    TRY(NEW_ARRAY(self->imaginary, self->species_count * most_vectors));
    return NEW_ARRAY(self->products, pair_count(self->species_count) * self->shells);
}

static Status choose_vectors(StructureFactor *self, const StructureSettings *settings,
                             const Box *box, double *available, double *seen) {
    const Walk walk = walk_over(box, settings->last);
    count_members(settings, &walk, available);
    double most_vectors = 0;
    for (size_t k = 0; k < self->shells; k++) most_vectors += chosen_of(settings, available[k]);
    TRY(allocate(self, (size_t)most_vectors));
    choose(self, settings, &walk, available, seen);
    ASSERT((double)self->vectors <= most_vectors);
    return density_modes_create(&self->modes, box->dimension, self->vector, self->vectors);
}

static void discard(Observer *observer) {
    StructureFactor *self = (StructureFactor *)observer;
    memory_free(self->vector);
    memory_free(self->shell);
    memory_free(self->wave_number);
    memory_free(self->members);
    memory_free(self->real);
    memory_free(self->imaginary);
    memory_free(self->products);
    density_modes_free(self->modes);
    memory_free(self);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    StructureFactor *self = NULL;
    double *available = NULL, *seen = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_structure_factor, .clock = *clock};
    self->period = looks_period(clock, settings->looks);
    self->species_count = state->system.species_count;
    self->shells = shells_for(settings);
    Status status = NEW_ARRAY(available, self->shells);
    if (status == OK) status = NEW_ARRAY(seen, self->shells);
    if (status == OK) status = choose_vectors(self, settings, &state->box, available, seen);
    memory_free(available);
    memory_free(seen);
    if (status != OK) {
        discard(&self->observer);
        return status;
    }
    *out = &self->observer;
    return OK;
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    const Box box = system_box(system);
    double longest = box.edge[0];
    for (int a = 1; a < box.dimension; a++) longest = fmax(longest, box.edge[a]);
    if (!(walk_length(&box, settings->last) <= WALK_MOST)) {
        return status_fail(BAD_DATA,
                           "structure_factor: wave_numbers.last = %g takes in %.3g wave vectors of "
                           "the box, more than %g; make it smaller",
                           settings->last, walk_length(&box, settings->last), WALK_MOST);
    }
    if (settings->last > 2 * PI / longest) return OK;
    return status_fail(BAD_DATA,
                       "structure_factor: wave_numbers.last = %g is not above 2 pi/L = %g of the "
                       "box, the smallest wave number that fits; make it larger",
                       settings->last, 2 * PI / longest);
}

static int64_t next(const Observer *observer, int64_t after) {
    return looks_next(&observer->clock, ((const StructureFactor *)observer)->period, after);
}

static void find_modes(StructureFactor *self, const State *state) {
    size_t counts[SPECIES_MOST], begin = 0;
    system_counts(&state->system, counts);
    for (size_t s = 0; s < self->species_count; s++) {
        double *real = self->real + s * self->vectors;
        double *imaginary = self->imaginary + s * self->vectors;
        for (size_t v = 0; v < self->vectors; v++) real[v] = imaginary[v] = 0;
        density_modes_add(self->modes, &state->box, state->position, begin, begin + counts[s], real,
                          imaginary);
        begin += counts[s];
    }
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    StructureFactor *self = (StructureFactor *)observer;
    find_modes(self, state);
    double *products = self->products;
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++, products += self->shells) {
            const double *a_real = self->real + a * self->vectors;
            const double *b_real = self->real + b * self->vectors;
            const double *a_imaginary = self->imaginary + a * self->vectors;
            const double *b_imaginary = self->imaginary + b * self->vectors;
            for (size_t v = 0; v < self->vectors; v++) {
                products[self->shell[v]] += a_real[v] * b_real[v] + a_imaginary[v] * b_imaginary[v];
            }
        }
    }
    self->looks++;
    return OK;
}

static const uint64_t STRUCTURE_TAG = 0x5354525543303031; // "STRUC001"

static void archive(Observer *observer, Archive *archive) {
    StructureFactor *self = (StructureFactor *)observer;
    archive_tag(archive, STRUCTURE_TAG);
    archive_u64(archive, &self->looks, 1);
    archive_f64(archive, self->products, pair_count(self->species_count) * self->shells);
}

// Keeps the shells that have vectors; gives their number.
static size_t fill(const StructureFactor *self, size_t particles, size_t labels, double *values,
                   double *wave_numbers) {
    size_t filled = 0;
    for (size_t k = 0; k < self->shells; k++) filled += self->members[k] > 0;
    size_t at = 0;
    for (size_t k = 0; k < self->shells; k++) {
        if (!(self->members[k] > 0)) continue;
        const double samples = self->members[k] * (double)self->looks * (double)particles;
        double total = 0;
        size_t pair = 0;
        for (size_t a = 0; a < self->species_count; a++) {
            for (size_t b = a; b < self->species_count; b++, pair++) {
                const double partial = self->products[pair * self->shells + k] / samples;
                values[pair * filled + at] = partial;
                total += a == b ? partial : 2 * partial; // S_ab and S_ba
            }
        }
        values[(labels - 1) * filled + at] = total;
        wave_numbers[at++] = self->wave_number[k];
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
    Status status = NEW_ARRAY(values, pairs.count * self->shells);
    if (status == OK) status = NEW_ARRAY(wave_numbers, self->shells);
    if (status == OK) status = put(self, state, &pairs, values, wave_numbers, results, replica);
    memory_free(values);
    memory_free(wave_numbers);
    return status;
}

// From the volume of the ball |q| < last in units of the reciprocal cell, halved.
static double vectors_within(const Box *box, double last) {
    const double ball = box->dimension == 2 ? PI * last * last : 4 * PI / 3 * last * last * last;
    return ball * box_volume(box) / (2 * pow(2 * PI, box->dimension));
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const StructureSettings *settings = (const StructureSettings *)settings_->bytes;
    const Box box = system_box(system);
    const Walk walk = walk_over(&box, settings->last);
    const size_t shells = shells_for(settings), species = system->species_count;
    double vectors = vectors_within(&box, settings->last);
    if (settings->vectors > 0) {
        vectors = fmin(vectors, (double)shells * (double)settings->vectors);
    }
    return sizeof(StructureFactor) + density_modes_memory(walk.most, box.dimension) +
           (size_t)vectors *
               (sizeof(LatticeVector) + sizeof(uint32_t) + 2 * species * sizeof(double)) +
           (2 + pair_count(species)) * shells * sizeof(double);
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
