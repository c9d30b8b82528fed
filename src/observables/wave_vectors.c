// SPDX-License-Identifier: GPL-3.0-or-later
// Two walks over the half lattice: one to count, one to choose.
#include "observables/wave_vectors.h"

#include "base/constants.h"
#include "base/memory.h"
#include "numerics/turn.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double WALK_MOST = 1e9; // some ten seconds of walking for each replica

// A walk over the lattice within `last`, in the order that DensityModes wants.
typedef struct Walk {
    Box box;
    double last;
    int32_t most[3];
} Walk;

static Walk walk_over(const Box *box, double last) {
    Walk walk = {.box = *box, .last = last};
    for (int a = 0; a < box->dimension; a++) {
        const double tilt = a == 1 ? fabs(box->offset) / box->edge[0] * walk.most[0] : 0;
        walk.most[a] = (int32_t)floor(last * box->edge[a] / (2 * PI) + tilt);
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
    double q[3];
    wave_vector_of(&walk->box, vector, q);
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
}

// One of each q, -q; not the origin.
static bool in_half(const LatticeVector *v) {
    if (v->n[0] != 0) return v->n[0] > 0;
    return v->n[1] != 0 ? v->n[1] > 0 : v->n[2] > 0;
}

// The shell with q in it, or `count` if there is none.
static size_t shell_of(const Shell *shells, size_t count, double q) {
    size_t begin = 0, end = count; // the first shell with high > q
    while (begin < end) {
        const size_t middle = begin + (end - begin) / 2;
        if (shells[middle].high > q)
            end = middle;
        else
            begin = middle + 1;
    }
    return begin < count && shells[begin].low <= q ? begin : count;
}

static void count_members(const Walk *walk, const Shell *shells, size_t count, double *available) {
    LatticeVector vector = walk_first(walk);
    do {
        if (!in_half(&vector)) continue;
        const size_t shell = shell_of(shells, count, length_of(walk, &vector));
        if (shell < count) available[shell]++;
    } while (walk_next(walk, &vector));
}

static double chosen_of(int64_t most, double available) {
    return most > 0 ? fmin(available, (double)most) : available;
}

// Number k of n in a shell is taken when floor(k most/n) moves on. `seen` counts.
static bool is_chosen(int64_t most, double available, double *seen) {
    const double share = chosen_of(most, available) / available;
    const double before = floor(*seen * share + 1e-9);
    return floor(++*seen * share + 1e-9) > before;
}

static void choose(WaveVectors *vectors, const Walk *walk, const Shell *shells, int64_t most,
                   const double *available, double *seen) {
    LatticeVector vector = walk_first(walk);
    do {
        if (!in_half(&vector)) continue;
        const double q = length_of(walk, &vector);
        const size_t shell = shell_of(shells, vectors->shells, q);
        if (shell == vectors->shells) continue;
        if (!is_chosen(most, available[shell], &seen[shell])) continue;
        vectors->vector[vectors->count] = vector;
        vectors->shell[vectors->count++] = (uint32_t)shell;
        vectors->wave_number[shell] += q;
        vectors->members[shell]++;
    } while (walk_next(walk, &vector));
    for (size_t k = 0; k < vectors->shells; k++) {
        if (vectors->members[k] > 0) vectors->wave_number[k] /= vectors->members[k];
    }
}

static Status fill(WaveVectors *vectors, const Box *box, const Shell *shells, int64_t most,
                   double *available, double *seen) {
    const Walk walk = walk_over(box, shells[vectors->shells - 1].high);
    count_members(&walk, shells, vectors->shells, available);
    double wanted = 0;
    for (size_t k = 0; k < vectors->shells; k++) wanted += chosen_of(most, available[k]);
    TRY(NEW_ARRAY(vectors->vector, (size_t)wanted));
    TRY(NEW_ARRAY(vectors->shell, (size_t)wanted));
    choose(vectors, &walk, shells, most, available, seen);
    ASSERT((double)vectors->count <= wanted);
    return OK;
}

Status wave_vectors_make(WaveVectors *vectors, const Box *box, const Shell *shells, size_t count,
                         int64_t most) {
    double *available = NULL, *seen = NULL;
    *vectors = (WaveVectors){.shells = count};
    Status status = NEW_ARRAY(vectors->wave_number, count);
    if (status == OK) status = NEW_ARRAY(vectors->members, count);
    if (status == OK) status = NEW_ARRAY(available, count);
    if (status == OK) status = NEW_ARRAY(seen, count);
    if (status == OK) status = fill(vectors, box, shells, most, available, seen);
    memory_free(available);
    memory_free(seen);
    return status;
}

void wave_vectors_clear(WaveVectors *vectors) {
    memory_free(vectors->vector);
    memory_free(vectors->shell);
    memory_free(vectors->wave_number);
    memory_free(vectors->members);
}

// From the volume of the ball |q| < last in units of the reciprocal cell, halved.
static double vectors_within(const Box *box, double last) {
    const double ball = box->dimension == 2 ? PI * last * last : 4 * PI / 3 * last * last * last;
    return ball * box_volume(box) / (2 * pow(2 * PI, box->dimension));
}

double wave_vectors_most(const Box *box, double last, size_t shells, int64_t most) {
    const double all = vectors_within(box, last);
    return most > 0 ? fmin(all, (double)shells * (double)most) : all;
}

size_t wave_vectors_memory(const Box *box, double last, size_t shells, int64_t most) {
    const Walk walk = walk_over(box, last);
    return density_modes_memory(walk.most, box->dimension) +
           (size_t)wave_vectors_most(box, last, shells, most) *
               (sizeof(LatticeVector) + sizeof(uint32_t)) +
           2 * shells * sizeof(double);
}

double wave_number_least(const Box *box) {
    return 2 * PI / box_longest_edge(box);
}

OptionReals wave_numbers_chosen(const OptionReals *given, const System *system) {
    if (given->count > 0) return *given;
    const double distance = pow(system_number_density(system), -1.0 / (double)system->dimension);
    return (OptionReals){.count = 1, .values = {2 * PI / distance}};
}

Status wave_numbers_check(const char *observable, const OptionReals *given, const System *system) {
    const Box box = system_box(system);
    const double least = wave_number_least(&box);
    for (int64_t k = 0; k < given->count; k++) {
        const double q = given->values[k];
        if (!(q >= least * (1 - 1e-9))) {
            return status_fail(BAD_DATA,
                               "%s: a wave number of %g is below 2 pi/L = %g of the box, the "
                               "smallest that fits; make it larger",
                               observable, q, least);
        }
        if (k > 0 && !(q > given->values[k - 1])) {
            return status_fail(BAD_DATA, "%s: wave_numbers must ascend, but %g follows %g",
                               observable, q, given->values[k - 1]);
        }
    }
    return OK;
}

Status wave_vectors_check(const char *observable, const char *option, const Box *box, double last) {
    if (walk_length(box, last) <= WALK_MOST) return OK;
    return status_fail(BAD_DATA,
                       "%s: %s = %g takes in %.3g wave vectors of the box, more than %g; make it "
                       "smaller",
                       observable, option, last, walk_length(box, last), WALK_MOST);
}

// An even choice is as good as all where the modes of a run forget each other; in a glass they do
// not, and each vector counts once.
void wave_vectors_describe(const Box *box, const Shell *shells, size_t count, int64_t most,
                           const char *option, Text *lines) {
    double fullest = 0;
    for (size_t k = 0; k < count; k++)
        fullest =
            fmax(fullest, vectors_within(box, shells[k].high) - vectors_within(box, shells[k].low));
    if (most == 0 || fullest <= (double)most) return;
    text_add(lines,
             "%lld of up to about %.3g wave vectors in a shell: enough for a fluid; in a glass "
             "each counts once, take all (%s: 0)\n",
             (long long)most, fullest, option);
}

Status wave_modes_make(WaveModes *modes, const WaveVectors *vectors, const State *state) {
    modes->species_count = state->system.species_count;
    modes->width = 2 * modes->species_count * vectors->count;
    return density_modes_create(&modes->density, state->box.dimension, vectors->vector,
                                vectors->count);
}

void wave_modes_clear(WaveModes *modes) {
    density_modes_free(modes->density);
}

void wave_modes_find(const WaveModes *modes, const State *state, double *values) {
    size_t counts[SPECIES_MOST], begin = 0;
    const size_t vectors = modes->density->count;
    system_counts(&state->system, counts);
    memset(values, 0, modes->width * sizeof *values);
    for (size_t s = 0; s < modes->species_count; s++) {
        double *real = values + 2 * s * vectors;
        density_modes_add(modes->density, &state->box, state->position, begin, begin + counts[s],
                          real, real + vectors);
        begin += counts[s];
    }
}

// What fraction of a turn q.centre is, of LANES vectors from `first` on; of those past the end, 0.
static void turns_at(const DensityModes *density, const Box *box, const double centre[3],
                     size_t first, Lanes *turns) {
    *turns = (Lanes){0};
    for (size_t k = 0; k < LANES && first + k < density->count; k++) {
        double q[3];
        wave_vector_of(box, &density->vectors[first + k], q);
        (*turns)[k] = (q[0] * centre[0] + q[1] * centre[1] + q[2] * centre[2]) / (2 * PI);
    }
}

void wave_modes_shift(const WaveModes *modes, const Box *box, const double centre[3],
                      double *values) {
    const size_t count = modes->density->count;
    for (size_t first = 0; first < count; first += LANES) {
        Lanes turns, cosine, sine;
        turns_at(modes->density, box, centre, first, &turns);
        turn_cosine_sine(&turns, &cosine, &sine);
        for (size_t s = 0; s < modes->species_count; s++) {
            double *real = values + 2 * s * count + first, *imaginary = real + count;
            for (size_t k = 0; k < LANES && first + k < count; k++) {
                const double x = real[k], y = imaginary[k];
                real[k] = x * cosine[k] + y * sine[k];
                imaginary[k] = y * cosine[k] - x * sine[k];
            }
        }
    }
}

// Of one species and another; [vector] are the real parts, [count + vector] the imaginary.
static void add_products(const WaveVectors *vectors, const double *a, const double *b,
                         double weight, double *sums) {
    const size_t count = vectors->count;
    for (size_t v = 0; v < count; v++) {
        sums[vectors->shell[v]] += weight * (a[v] * b[v] + a[count + v] * b[count + v]);
    }
}

void wave_modes_add_products(const WaveModes *modes, const WaveVectors *vectors, const double *one,
                             const double *other, double *sums) {
    const size_t stride = 2 * vectors->count;
    for (size_t a = 0; a < modes->species_count; a++) {
        for (size_t b = a; b < modes->species_count; b++, sums += vectors->shells) {
            const bool twice = a != b && one != other;
            add_products(vectors, one + a * stride, other + b * stride, twice ? 0.5 : 1, sums);
            if (twice) add_products(vectors, one + b * stride, other + a * stride, 0.5, sums);
        }
    }
}
