// SPDX-License-Identifier: GPL-3.0-or-later
// The plain, slow twin of the chain of balls: every trial against all neighbours in linked cells,
// by the rules alone. It shares no code with dmc/balls*, and must give the same bits.
//
// Positions are 32-bit fractions of the box edge, so that the integer difference of two is the
// nearest image. Trial k draws words 4 (k mod 1024) ... + 3 of block k/1024: the displacement along
// x, y, z and the particle; the word k mod 4096 of block 2^63 + k/4096 is for Metropolis' choice of
// soft spheres. Energies are counted in whole units, so that no sum depends on its order.
#include "reference_chain.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { TRIALS_PER_BLOCK = RNG_BLOCK / 4 };
static const uint64_t METROPOLIS_BLOCKS = 1ull << 63;
static const double ENERGY_UNITS = 0x1p16; // per kT
static const double ENERGY_MOST = 0x1p23;  // of a pair, in units: 128 kT
static const double DEEPEST_NUDGED = 1e-6; // overlap that rounding of positions may explain
static const int NUDGES_MOST = 1000;       // sweeps over all particles

typedef struct Balls {
    Chain chain;
    ChainSettings settings;
    State *state;
    RngKey key;
    bool soft;
    int exponent;
    double scale;
    bool separate; // seen to be without overlaps at this scale
    uint64_t corrected;
    double unit[3];                 // length of a lattice step, in d
    float step[SPECIES_MOST][3];    // half-width of the displacement, in halves of lattice steps
    double normal[SPECIES_MOST][3]; // standard deviation, in lattice steps
    double *radius;                 // [count], in d
    uint32_t (*place)[3];           // [count]
    int32_t (*image)[3];            // [count]
    double reach;                   // beyond it no pair interacts, in d
    int64_t cells[3];
    int32_t *first, *next, *before, *cell_of; // doubly linked lists of the particles in each cell
    uint64_t block, metropolis_block;         // whose words these are
    uint32_t words[RNG_BLOCK], metropolis_words[RNG_BLOCK];
    uint32_t ids[TRIALS_PER_BLOCK];
    double normals[3][TRIALS_PER_BLOCK];
} Balls;

static Balls *balls_of(Chain *chain) {
    return (Balls *)chain;
}

// Neighbourhood.

static int64_t cell_index(const Balls *balls, const int64_t at[3]) {
    return (at[2] * balls->cells[1] + at[1]) * balls->cells[0] + at[0];
}

static void cell_at(const Balls *balls, const uint32_t place[3], int64_t at[3]) {
    for (int a = 0; a < 3; a++) {
        at[a] = (int64_t)((place[a] * (uint64_t)balls->cells[a]) >> 32);
    }
}

static void cell_enter(Balls *balls, size_t i) {
    int64_t at[3];
    cell_at(balls, balls->place[i], at);
    const int64_t cell = cell_index(balls, at);
    balls->cell_of[i] = (int32_t)cell;
    balls->before[i] = -1;
    balls->next[i] = balls->first[cell];
    if (balls->next[i] >= 0) balls->before[balls->next[i]] = (int32_t)i;
    balls->first[cell] = (int32_t)i;
}

static void cell_leave(Balls *balls, size_t i) {
    const int32_t before = balls->before[i], next = balls->next[i];
    if (before >= 0)
        balls->next[before] = next;
    else
        balls->first[balls->cell_of[i]] = next;
    if (next >= 0) balls->before[next] = before;
}

// Overlap, energy.

// Of two places, in d; integers, so that it is the same seen from both.
static void separation(const Balls *balls, const uint32_t a[3], const uint32_t b[3], double r[3]) {
    for (int k = 0; k < 3; k++) r[k] = (double)(int32_t)(a[k] - b[k]) * balls->unit[k];
}

static double distance2(const Balls *balls, const uint32_t a[3], const uint32_t b[3]) {
    double r[3];
    separation(balls, a, b, r);
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

static bool overlap(const Balls *balls, size_t i, const uint32_t place[3], size_t j) {
    const double contact = balls->radius[i] + balls->radius[j];
    return distance2(balls, place, balls->place[j]) < contact * contact;
}

// In units, rounded; in single precision.
static int32_t energy(const Balls *balls, size_t i, const uint32_t place[3], size_t j) {
    const float contact = (float)balls->radius[i] + (float)balls->radius[j];
    float r[3];
    for (int k = 0; k < 3; k++) {
        r[k] = (float)(int32_t)(place[k] - balls->place[j][k]) * (float)balls->unit[k];
    }
    const float y = contact * contact / (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    float power = balls->exponent & 1 ? sqrtf(y) : 1, square = y;
    for (int n = balls->exponent / 2; n > 0; n /= 2, square *= square) {
        if (n & 1) power *= square;
    }
    power *= (float)ENERGY_UNITS;
    return (int32_t)rintf(power < (float)ENERGY_MOST ? power : (float)ENERGY_MOST);
}

// Calls that a trial makes for all within reach of `place`: overlap with any, or the energy summed.
static int64_t interaction(const Balls *balls, size_t i, const uint32_t place[3]) {
    int64_t home[3], sum = 0;
    cell_at(balls, place, home);
    for (int64_t z = balls->cells[2] > 1 ? -1 : 0; z <= (balls->cells[2] > 1); z++) {
        for (int64_t y = balls->cells[1] > 1 ? -1 : 0; y <= (balls->cells[1] > 1); y++) {
            for (int64_t x = balls->cells[0] > 1 ? -1 : 0; x <= (balls->cells[0] > 1); x++) {
                const int64_t step[3] = {x, y, z};
                int64_t at[3];
                for (int a = 0; a < 3; a++) {
                    at[a] = (home[a] + step[a] + balls->cells[a]) % balls->cells[a];
                }
                int32_t j = balls->first[cell_index(balls, at)];
                for (; j >= 0; j = balls->next[j]) {
                    if ((size_t)j == i) continue;
                    if (balls->soft)
                        sum += energy(balls, i, place, (size_t)j);
                    else if (overlap(balls, i, place, (size_t)j))
                        return 1;
                }
            }
        }
    }
    return sum;
}

// Places at first.

static void take_in(Balls *balls) {
    const State *state = balls->state;
    for (size_t i = 0; i < state->count; i++) {
        balls->radius[i] = state->diameter[i] / 2;
        for (int a = 0; a < state->box.dimension; a++) {
            const double fraction = state->position[a][i] / state->box.edge[a];
            const int64_t place = (int64_t)rint(fraction * 0x1p32);
            balls->place[i][a] = (uint32_t)place;
            balls->image[i][a] = state->image[a][i] + (int32_t)(place >> 32);
        }
    }
}

static void choose_cells(Balls *balls) {
    const State *state = balls->state;
    const double room = box_volume(&state->box) / (double)state->count;
    double largest = 0;
    for (size_t i = 0; i < state->count; i++) largest = fmax(largest, state->diameter[i]);
    balls->reach = balls->soft ? largest * exp2(17.0 / balls->exponent) * 1.001 : largest;
    const double width =
        fmax(balls->reach, state->box.dimension == 2 ? sqrt(room) : cbrt(room)) * 1.0001;
    for (int a = 0; a < 3; a++) {
        const double fit = a < state->box.dimension ? state->box.edge[a] / width : 1;
        balls->cells[a] = fit < 3 ? 1 : (int64_t)fit;
    }
}

// Moves i a lattice step away from j along the axis on which they are farthest apart.
static void nudge(Balls *balls, size_t i, size_t j) {
    double r[3];
    separation(balls, balls->place[i], balls->place[j], r);
    int axis = 0;
    for (int a = 1; a < 3; a++) axis = fabs(r[a]) > fabs(r[axis]) ? a : axis;
    const int64_t unfolded =
        (int64_t)((uint64_t)(int64_t)balls->image[i][axis] << 32) + balls->place[i][axis];
    const int64_t to = unfolded + (r[axis] < 0 ? -1 : 1);
    cell_leave(balls, i);
    balls->place[i][axis] = (uint32_t)to;
    balls->image[i][axis] = (int32_t)(to >> 32);
    cell_enter(balls, i);
}

static int64_t overlapped(const Balls *balls, size_t i) {
    for (size_t j = 0; j < balls->state->count; j++) {
        if (j != i && overlap(balls, i, balls->place[i], j)) return (int64_t)j;
    }
    return -1;
}

// Rounding may have pushed pairs that touched into each other by a lattice step or two: apart
// again. Overlaps that rounding does not explain are refused.
static Status separate(Balls *balls) {
    if (balls->soft || balls->separate) return OK;
    bool moved = true;
    for (int sweep = 0; moved; sweep++) {
        moved = false;
        for (size_t i = 0; i < balls->state->count; i++) {
            if (!interaction(balls, i, balls->place[i])) continue;
            const size_t j = (size_t)overlapped(balls, i);
            const double depth = 1 - sqrt(distance2(balls, balls->place[i], balls->place[j])) /
                                         (balls->radius[i] + balls->radius[j]);
            if (depth > DEEPEST_NUDGED || sweep >= NUDGES_MOST) {
                return status_fail(UNHEALTHY,
                                   "particles %zu and %zu overlap by %.3g of their distance at "
                                   "contact: a Monte Carlo chain begins without overlaps",
                                   i, j, depth);
            }
            nudge(balls, i, j);
            balls->corrected += sweep == 0;
            moved = true;
        }
    }
    balls->separate = true;
    return OK;
}

// The seam, all but the check.

static void balls_free(Chain *chain) {
    Balls *balls = balls_of(chain);
    memory_free(balls->radius);
    memory_free(balls->place);
    memory_free(balls->image);
    memory_free(balls->first);
    memory_free(balls->next);
    memory_free(balls->before);
    memory_free(balls->cell_of);
    memory_free(balls);
}

static Status allocate(Balls *balls) {
    const size_t count = balls->state->count;
    const size_t cells = (size_t)(balls->cells[0] * balls->cells[1] * balls->cells[2]);
    TRY(NEW_ARRAY(balls->radius, count));
    TRY(NEW_ARRAY(balls->place, count));
    TRY(NEW_ARRAY(balls->image, count));
    TRY(NEW_ARRAY(balls->first, cells));
    TRY(NEW_ARRAY(balls->next, count));
    TRY(NEW_ARRAY(balls->before, count));
    TRY(NEW_ARRAY(balls->cell_of, count));
    for (size_t c = 0; c < cells; c++) balls->first[c] = -1;
    return OK;
}

static Status create(Chain **out, const ChainSettings *settings, State *state, RngKey key) {
    const Species *species = &state->system.species[0];
    Balls *balls = NULL;
    TRY(NEW(balls));
    *balls = (Balls){.chain = {&reference_chain},
                     .settings = *settings,
                     .state = state,
                     .key = key,
                     .soft = !shape_is_hard((ShapeKind)species->shape),
                     .exponent = (int)species->exponent,
                     .scale = 1,
                     .block = UINT64_MAX,
                     .metropolis_block = UINT64_MAX};
    for (int a = 0; a < state->box.dimension; a++) balls->unit[a] = state->box.edge[a] * 0x1p-32;
    for (uint32_t t = 0; t < TRIALS_PER_BLOCK; t++) balls->ids[t] = t;
    choose_cells(balls);
    const Status status = allocate(balls);
    if (status != OK) {
        balls_free(&balls->chain);
        return status;
    }
    take_in(balls);
    for (size_t i = 0; i < state->count; i++) cell_enter(balls, i);
    *out = &balls->chain;
    return OK;
}

static void set_amplitude(Chain *chain, size_t species, const Amplitude *amplitude) {
    Balls *balls = balls_of(chain);
    for (int a = 0; a < balls->state->box.dimension; a++) {
        const double fraction = amplitude->parallel / balls->state->box.edge[a];
        balls->step[species][a] = (float)(2 * fraction);
        balls->normal[species][a] = fraction * 0x1p32 / sqrt(3);
    }
}

static void draw(Balls *balls, uint64_t trial) {
    const uint64_t block = trial / TRIALS_PER_BLOCK, other = trial / RNG_BLOCK;
    if (block != balls->block) {
        rng_words(balls->key, balls->settings.stream, block, balls->words);
        if (balls->settings.gaussian) {
            rng_normals(
                balls->key, balls->settings.stream, block, balls->ids, TRIALS_PER_BLOCK, 3,
                (double *const[3]){balls->normals[0], balls->normals[1], balls->normals[2]});
        }
        balls->block = block;
    }
    if (balls->soft && other != balls->metropolis_block) {
        rng_words(balls->key, balls->settings.stream, METROPOLIS_BLOCKS + other,
                  balls->metropolis_words);
        balls->metropolis_block = other;
    }
}

static int32_t displacement(const Balls *balls, size_t species, size_t t, int axis) {
    if (balls->settings.gaussian) {
        return (int32_t)rint(balls->normals[axis][t] * balls->normal[species][axis]);
    }
    const int32_t odd = (int32_t)(balls->words[4 * t + (size_t)axis] | 1);
    return (int32_t)rintf((float)odd * balls->step[species][axis]);
}

// -ln u in units, u = (word + 1/2)/2^32 = m 2^(e - 32) with sqrt(1/2) <= m < sqrt 2, by
// ln m = 2 artanh((m - 1)/(m + 1)).
static int64_t energy_affordable(uint32_t word) {
    const double root_half = 0.70710678118654752440, ln_2 = 0.69314718055994530942;
    int e = 32;
    double m = ((double)word + 0.5) * 0x1p-32;
    for (; m < root_half; m *= 2) e++;
    const double s = (m - 1) / (m + 1), z = s * s;
    double series = 0;
    for (int k = 19; k >= 1; k -= 2) series = series * z + 2.0 / k;
    return (int64_t)floor(((e - 32) * ln_2 - s * series) * ENERGY_UNITS);
}

static bool accept(const Balls *balls, size_t i, const uint32_t to[3], uint64_t trial) {
    const int64_t after = interaction(balls, i, to);
    if (!balls->soft) return after == 0;
    const int64_t rise = after - interaction(balls, i, balls->place[i]);
    return rise <= energy_affordable(balls->metropolis_words[trial % RNG_BLOCK]);
}

static void one_trial(Balls *balls, uint64_t trial, MoveTally *moves) {
    draw(balls, trial);
    const size_t t = trial % TRIALS_PER_BLOCK;
    const size_t i = (size_t)((balls->words[4 * t + 3] * (uint64_t)balls->state->count) >> 32);
    const size_t species = balls->state->species_of[i];
    int64_t unfolded[3];
    double r[3];
    uint32_t to[3];
    for (int a = 0; a < 3; a++) {
        const int32_t step = displacement(balls, species, t, a);
        r[a] = step * balls->unit[a];
        unfolded[a] = balls->place[i][a] + (int64_t)step;
        to[a] = (uint32_t)unfolded[a];
    }
    moves[species].trials++;
    if (!accept(balls, i, to, trial)) return;
    moves[species].accepted++;
    moves[species].parallel += r[0] * r[0];
    moves[species].perpendicular += r[1] * r[1] + r[2] * r[2];
    cell_leave(balls, i);
    for (int a = 0; a < 3; a++) balls->image[i][a] += (int32_t)(unfolded[a] >> 32);
    memcpy(balls->place[i], to, sizeof to);
    cell_enter(balls, i);
}

static Status run(Chain *chain, int64_t trials, Tally *tally) {
    Balls *balls = balls_of(chain);
    TRY(separate(balls));
    tally->corrected += balls->corrected;
    balls->corrected = 0;
    for (int64_t k = 0; k < trials; k++) {
        one_trial(balls, (uint64_t)balls->state->step, tally->moves);
        balls->state->step++;
    }
    return OK;
}

static void publish(Chain *chain) {
    Balls *balls = balls_of(chain);
    State *state = balls->state;
    for (size_t i = 0; i < state->count; i++) {
        for (int a = 0; a < state->box.dimension; a++) {
            state->position[a][i] = balls->place[i][a] * balls->unit[a];
            state->image[a][i] = balls->image[i][a];
        }
    }
}

static bool rescale(Chain *chain, double scale) {
    Balls *balls = balls_of(chain);
    const double before = balls->scale;
    const size_t count = balls->state->count;
    for (size_t i = 0; i < count; i++) balls->radius[i] = balls->state->diameter[i] / 2 * scale;
    bool free = true;
    for (size_t i = 0; free && !balls->soft && i < count; i++) {
        free = !interaction(balls, i, balls->place[i]);
    }
    if (free) {
        balls->scale = scale;
        balls->separate = true;
        return true;
    }
    for (size_t i = 0; i < count; i++) balls->radius[i] = balls->state->diameter[i] / 2 * before;
    return false;
}

static size_t memory(const System *system) {
    return (size_t)system->particles * 64 + sizeof(Balls);
}

const ChainKind reference_chain = {
    .create = create,
    .set_amplitude = set_amplitude,
    .run = run,
    .publish = publish,
    .rescale = rescale,
    .free = balls_free,
    .memory = memory,
};
