// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of discs, spheres and soft spheres: what it can move, how it takes in a State and gives
// it back. The trials are in balls_kernel.h, the lists in balls_list.c.
#include "dmc/balls.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static const uint64_t METROPOLIS_BLOCKS = 1ull << 63;
static const double DEEPEST_NUDGED = 1e-6; // overlap that rounding of positions may explain
static const int NUDGES_MOST = 1000;       // sweeps over all particles
static const int64_t EDGE = 1ll << 32;     // of the box, in lattice steps
static const double EXPONENT_LEAST = 4, EXPONENT_MOST = 1000;
static const double PARTICLES_MOST = 1 << 28;
static const double SPREAD_REACH = 4; // standard deviations of diameters that must fit

static Balls *balls_of(Chain *chain) {
    return (Balls *)chain;
}

// Contact times this is beyond where the energy of a pair rounds to nothing.
static double reach_of(bool soft, double exponent) {
    return soft ? exp2(17 / exponent) * 1.0001 : 1;
}

static Status check_species(const System *system, const Species *species) {
    const Species *first = &system->species[0];
    const bool soft = !shape_is_hard((ShapeKind)species->shape);
    if (shape_is_oriented((ShapeKind)species->shape) ||
        shape_dimension((ShapeKind)species->shape) != system->dimension) {
        return status_fail(
            BAD_DATA, "species '%s': a %s lives in %d dimensions, the system has %lld",
            species->name, shape_names[species->shape], shape_dimension((ShapeKind)species->shape),
            (long long)system->dimension);
    }
    if (species->shape != first->shape) {
        return status_fail(
            BAD_DATA, "species '%s' is a %s and '%s' a %s; hard and soft ones do not mix",
            first->name, shape_names[first->shape], species->name, shape_names[species->shape]);
    }
    if (!soft) return OK;
    if (!(species->exponent >= EXPONENT_LEAST && species->exponent <= EXPONENT_MOST) ||
        species->exponent != rint(species->exponent)) {
        return status_fail(BAD_DATA,
                           "species '%s': exponent = %g must be a whole number from %g to %g",
                           species->name, species->exponent, EXPONENT_LEAST, EXPONENT_MOST);
    }
    if (species->exponent == first->exponent) return OK;
    return status_fail(BAD_DATA,
                       "species '%s' and '%s' have the exponents %g and %g; soft spheres of one "
                       "system have one exponent",
                       first->name, species->name, first->exponent, species->exponent);
}

static Status check(const System *system) {
    const Box box = system_box(system);
    double largest = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        TRY(check_species(system, species));
        const double spread =
            species->spread == SPREAD_NONE ? 0 : SPREAD_REACH * species->spread_width;
        largest = fmax(largest, species->diameter * (1 + spread));
    }
    const bool soft = !shape_is_hard((ShapeKind)system->species[0].shape);
    const double reach = largest * reach_of(soft, system->species[0].exponent);
    for (int a = 0; a < box.dimension; a++) {
        if (box.edge[a] > 2 * reach) continue;
        return status_fail(BAD_DATA,
                           "the box is %.4g d long along %c, and particles interact up to %.4g d, "
                           "more than half of it; take more particles",
                           box.edge[a], "xyz"[a], reach);
    }
    if ((double)system->particles <= PARTICLES_MOST) return OK;
    return status_fail(BAD_DATA, "particles = %lld is more than the Monte Carlo chain's %.0f",
                       (long long)system->particles, PARTICLES_MOST);
}

// Making and freeing.

static void balls_free(Chain *chain) {
    Balls *balls = balls_of(chain);
    memory_free(balls->ball);
    memory_free(balls->radius);
    memory_free(balls->radius_single);
    memory_free(balls->coarse);
    memory_free(balls->list);
    memory_free(balls->seat);
    memory_free(balls->seated);
    memory_free(balls->seat_row);
    memory_free(balls->found);
    memory_free(balls->entered);
    memory_free(balls->ids);
    for (int a = 0; a < 3; a++) memory_free(balls->normals[a]);
    memory_free(balls);
}

static Status allocate(Balls *balls) {
    const size_t count = balls->count;
    TRY(NEW_ARRAY(balls->ball, count));
    TRY(NEW_ARRAY(balls->radius, count));
    TRY(NEW_ARRAY(balls->coarse, 2 * count));
    TRY(NEW_ARRAY(balls->found, count + NEIGHBOURS_AT_A_TIME));
    TRY(NEW_ARRAY(balls->entered, count + NEIGHBOURS_AT_A_TIME));
    TRY(NEW_ARRAY(balls->radius_single, 2 * count));
    if (!balls->settings.gaussian) return OK;
    TRY(NEW_ARRAY(balls->ids, TRIALS_PER_BLOCK));
    for (uint32_t t = 0; t < TRIALS_PER_BLOCK; t++) balls->ids[t] = t;
    for (int a = 0; a < 3; a++) TRY(NEW_ARRAY(balls->normals[a], TRIALS_PER_BLOCK));
    return OK;
}

static void take_in(Balls *balls) {
    const State *state = balls->state;
    for (size_t i = 0; i < balls->count; i++) {
        Ball *ball = &balls->ball[i];
        ball->species = state->species_of[i];
        for (int a = 0; a < balls->dimension; a++) {
            const double fraction = state->position[a][i] / state->box.edge[a];
            ball->place[a] = state->image[a][i] * EDGE + (int64_t)rint(fraction * 0x1p32);
        }
    }
}

static bool edges_are_equal(const State *state) {
    for (int a = 1; a < state->box.dimension; a++) {
        if (state->box.edge[a] != state->box.edge[0]) return false;
    }
    return true;
}

// How far coarse distances may be off, in coarse steps: a place is off by half a step, so each
// coordinate of a difference by one; scaled ones by 1.75, as the products by coarse_scale are
// rounded, and the sum of two radii by 1.25.
static const double UNSCALED_OFF = 1.7320509, SCALED_OFF = 3.0310890, RADII_OFF = 1.25;
static const double RADIUS_SCALE = 24576.0 / 32768;

// The error of n ln r, down to where energies are flat, and that of single precision.
static void set_energy_off(Balls *balls, double per_d) {
    const double off = balls->unscaled ? UNSCALED_OFF : SCALED_OFF;
    const double flat = balls->smallest * per_d * exp2(-7.0 / balls->exponent) - 2 * off;
    balls->faint = (float)exp2(-36.0 / balls->exponent);
    balls->coarse_steps2 = (float)(per_d * per_d);
    balls->energy_off = flat > 0 ? balls->exponent * (off / flat + 1e-6) + 1e-5 : INFINITY;
}

static void set_coarse_bounds(Balls *balls) {
    const double *edge = balls->state->box.edge;
    const double longest = box_longest_edge(&balls->state->box);
    const double per_d = (balls->unscaled ? 0x1p16 : COARSE_PER_EDGE) / longest;
    const double contact = balls->largest * per_d;
    const double below = contact + UNSCALED_OFF, sure = fmax(contact - UNSCALED_OFF, 0);
    balls->below = (uint32_t)(below * below) + 2;
    balls->sure = (uint32_t)(sure * sure);
    if (balls->soft) set_energy_off(balls, per_d);
    const double off = SCALED_OFF + RADII_OFF;
    balls->doubt = (int32_t)(2 * off * contact + off * off) + 2;
    for (int a = 0; a < balls->dimension; a++) {
        balls->coarse_scale[a] = (int16_t)rint(COARSE_PER_EDGE / 2 * edge[a] / longest);
    }
    for (size_t i = 0; i < balls->count; i++) {
        const double radius = balls->radius[i] * per_d / RADIUS_SCALE;
        const int32_t coarse = balls->unscaled || balls->soft ? 0 : (int32_t)rint(radius);
        Ball *ball = &balls->ball[i];
        uint32_t place[3];
        balls_fractions(ball->place, place);
        ball->place[3] = (int64_t)coarse << 16;
        balls->coarse[i] = balls_coarse(place) | (uint64_t)(uint16_t)-coarse << 48;
    }
}

// Sizes, and all that is made of sizes and places.
static Status set_scale(Balls *balls, double scale) {
    const State *state = balls->state;
    balls->scale = scale;
    balls->largest = 0;
    balls->smallest = INFINITY;
    for (size_t i = 0; i < balls->count; i++) {
        balls->radius[i] = state->diameter[i] / 2 * scale;
        balls->radius_single[i] = (float)balls->radius[i];
        balls->largest = fmax(balls->largest, 2 * balls->radius[i]);
        balls->smallest = fmin(balls->smallest, 2 * balls->radius[i]);
    }
    balls->one_size = balls->smallest == balls->largest;
    balls->unscaled = edges_are_equal(state) && (balls->soft || balls->one_size);
    set_coarse_bounds(balls);
    return balls_list(balls);
}

static const BallsKernel *kernel_for(CpuPath path) {
    static const BallsKernel *const kernels[CPU_PATHS] = {&balls_kernel_portable,
                                                          &balls_kernel_avx2, &balls_kernel_avx512};
    return kernels[path];
}

Status balls_create_with(CpuPath path, Chain **out, const ChainSettings *settings, State *state,
                         RngKey key) {
    const Species *species = &state->system.species[0];
    Balls *balls = NULL;
    TRY(NEW(balls));
    *balls = (Balls){.chain = {&chain_of_balls},
                     .settings = *settings,
                     .state = state,
                     .key = key,
                     .path = path,
                     .kernel = kernel_for(path),
                     .dimension = state->box.dimension,
                     .count = state->count,
                     .soft = !shape_is_hard((ShapeKind)species->shape),
                     .exponent = (int)species->exponent,
                     .block = UINT64_MAX};
    balls->reach = reach_of(balls->soft, species->exponent);
    for (int a = 0; a < balls->dimension; a++) {
        balls->unit[a] = state->box.edge[a] * 0x1p-32;
        balls->unit_single[a] = (float)balls->unit[a];
    }
    Status status = allocate(balls);
    if (status == OK) {
        take_in(balls);
        status = set_scale(balls, 1);
    }
    if (status != OK) {
        balls_free(&balls->chain);
        return status;
    }
    *out = &balls->chain;
    return OK;
}

static Status create(Chain **out, const ChainSettings *settings, State *state, RngKey key) {
    return balls_create_with(cpu_path(), out, settings, state, key);
}

static void set_amplitude(Chain *chain, size_t species, const Amplitude *amplitude) {
    Balls *balls = balls_of(chain);
    if (amplitude->parallel == balls->longest_of[species]) return;
    for (int a = 0; a < balls->dimension; a++) {
        const double fraction = amplitude->parallel / balls->state->box.edge[a];
        balls->step[species][a] = (float)(2 * fraction);
        balls->normal[species][a] = fraction * 0x1p32 / sqrt(3);
    }
    balls->longest_of[species] = amplitude->parallel;
    balls->longest = 0;
    for (size_t s = 0; s < SPECIES_MOST; s++) {
        balls->longest = fmax(balls->longest, balls->longest_of[s]);
    }
    balls->block = UINT64_MAX;
    balls->listed = false;
}

// Overlaps.

// The place of i moves a lattice step away from j along the axis on which they are farthest apart.
static void nudge(Balls *balls, uint32_t i, uint32_t j) {
    int64_t *place = balls->ball[i].place;
    double r[3];
    int axis = 0;
    for (int a = 0; a < 3; a++) {
        r[a] = (double)(int32_t)(place[a] - balls->ball[j].place[a]) * balls->unit[a];
        axis = fabs(r[a]) > fabs(r[axis]) ? a : axis;
    }
    place[axis] += r[axis] < 0 ? -1 : 1;
}

static double distance2_of(const Balls *balls, uint32_t i, uint32_t j) {
    uint32_t a[3], b[3];
    balls_fractions(balls->ball[i].place, a);
    balls_fractions(balls->ball[j].place, b);
    return balls_distance2(balls, a, b);
}

static int64_t overlapped(const Balls *balls, uint32_t i) {
    const uint32_t *list = balls->list + i * balls->room;
    uint32_t place[3];
    balls_fractions(balls->ball[i].place, place);
    for (uint32_t n = 1; n < balls->ball[i].entries; n++) {
        if (balls_overlap(balls, i, place, list[n])) return list[n];
    }
    return -1;
}

static Status refuse(const Balls *balls, uint32_t i, uint32_t j) {
    const double r2 = distance2_of(balls, i, j);
    return status_fail(UNHEALTHY,
                       "particles %u and %u overlap by %.3g of their distance at contact; a Monte "
                       "Carlo chain begins without overlaps",
                       i, j, 1 - sqrt(r2) / (balls->radius[i] + balls->radius[j]));
}

// Rounding may have pushed pairs that touched into each other by a lattice step or two: apart
// again, and counted. Overlaps that rounding does not explain are refused.
static Status separate(Balls *balls) {
    bool moved = !balls->soft && !balls->separate, nudged = moved;
    for (int sweep = 0; moved; sweep++) {
        moved = false;
        for (uint32_t i = 0; i < balls->count; i++) {
            const int64_t j = overlapped(balls, i);
            if (j < 0) continue;
            const double contact = balls->radius[i] + balls->radius[j];
            const double least = (1 - DEEPEST_NUDGED) * contact;
            if (distance2_of(balls, i, (uint32_t)j) < least * least || sweep >= NUDGES_MOST) {
                return refuse(balls, i, (uint32_t)j);
            }
            nudge(balls, i, (uint32_t)j);
            balls->corrected += sweep == 0;
            moved = true;
        }
    }
    balls->separate = true;
    if (nudged) set_coarse_bounds(balls);
    return OK;
}

static bool rescale(Chain *chain, double scale) {
    Balls *balls = balls_of(chain);
    const double before = balls->scale;
    bool free = set_scale(balls, scale) == OK;
    for (uint32_t i = 0; free && !balls->soft && i < balls->count; i++) {
        free = overlapped(balls, i) < 0;
    }
    balls->separate |= free;
    if (!free) balls->listed = set_scale(balls, before) == OK;
    return free;
}

// Trials.

static void draw(Balls *balls, uint64_t block) {
    uint32_t words[RNG_BLOCK], metropolis[RNG_BLOCK];
    const uint64_t parts = RNG_BLOCK / TRIALS_PER_BLOCK;
    const RngStream stream = balls->settings.stream;
    rng_words_with(balls->path, balls->key, stream, block, words);
    if (balls->soft) {
        rng_words_with(balls->path, balls->key, stream, METROPOLIS_BLOCKS + block / parts,
                       metropolis);
    }
    if (balls->settings.gaussian) {
        rng_normals_with(balls->path, balls->key, stream, block, balls->ids, TRIALS_PER_BLOCK, 3,
                         balls->normals);
    }
    balls->kernel->draw(balls, words, metropolis + block % parts * TRIALS_PER_BLOCK);
    balls->block = block;
}

static Status run(Chain *chain, int64_t trials, Tally *tally) {
    Balls *balls = balls_of(chain);
    int64_t *step = &balls->state->step;
    if (!balls->listed) TRY(balls_list(balls));
    TRY(separate(balls));
    for (const int64_t end = *step + trials; *step < end;) {
        const uint64_t block = (uint64_t)*step / TRIALS_PER_BLOCK;
        const size_t from = (size_t)*step % TRIALS_PER_BLOCK;
        const int64_t most = TRIALS_PER_BLOCK - (int64_t)from;
        const size_t count = (size_t)(end - *step < most ? end - *step : most);
        if (block != balls->block) draw(balls, block);
        const ChainPull *pull = balls->pulled ? &balls->pull : NULL;
        if (pull_is_due(pull, *step, balls->count) &&
            !balls_pull_trial(balls, *step, tally->moves)) {
            return NO_MEMORY;
        }
        const size_t calm =
            pull_calm(pull, *step, balls->count, balls->who + from, UINT32_MAX, count);
        if (!balls->kernel->run(balls, from, from + calm, tally->moves)) return NO_MEMORY;
        *step += (int64_t)(calm > 0 ? calm : 1);
    }
    tally->rebuilds += balls->rebuilds;
    tally->corrected += balls->corrected;
    balls->rebuilds = balls->corrected = 0;
    return OK;
}

static void pull(Chain *chain, const ChainPull *given) {
    Balls *balls = balls_of(chain);
    balls->pulled = given != NULL;
    if (given) balls->pull = *given;
}

static void publish(Chain *chain) {
    const Balls *balls = balls_of(chain);
    State *state = balls->state;
    for (size_t i = 0; i < balls->count; i++) {
        for (int a = 0; a < balls->dimension; a++) {
            const int64_t place = balls->ball[i].place[a];
            state->position[a][i] = (uint32_t)place * balls->unit[a];
            state->image[a][i] = (int32_t)(place >> 32);
        }
    }
}

static size_t memory(const System *system) {
    const size_t lists = NEIGHBOURS_PER_ROOM * sizeof(uint32_t);
    return (size_t)system->particles * (sizeof(Ball) + lists + 64) + sizeof(Balls);
}

const ChainKind chain_of_balls = {
    .check = check,
    .create = create,
    .set_amplitude = set_amplitude,
    .pull = pull,
    .run = run,
    .publish = publish,
    .rescale = rescale,
    .squeeze = rescale,
    .free = balls_free,
    .memory = memory,
};
