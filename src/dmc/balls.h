// SPDX-License-Identifier: GPL-3.0-or-later
// The inside of the chain of balls, for the files balls*.c only.
//
// What is exact, and alone decides: positions are 32-bit fractions of the box edge, so that the
// integer difference of two is the nearest image and nothing is ever wrapped; two hard balls
// overlap if their distance in double precision, from those integers, is below contact; energies of
// soft ones are rounded to whole units and summed as integers, in any order. What is machinery:
// lists, cells and the coarse copies of positions, 16 bits a coordinate, with which sixteen
// neighbours are judged at a time; what they cannot judge is judged exactly.
//
// Trial k draws words 4 (k mod 1024) ... + 3 of block k/1024: the displacement along x, y, z and
// the particle; soft ones word k mod 4096 of block 2^63 + k/4096, for Metropolis' choice.
#pragma once

#include "dmc/chain.h"

enum {
    TRIALS_PER_BLOCK = RNG_BLOCK / 4,
    NEIGHBOURS_AT_A_TIME = 16,
    NEIGHBOURS_PER_ROOM = 32, // two cache lines
};
static const double ENERGY_UNITS = 0x1p16; // per kT
static const double ENERGY_MOST = 0x1p23;  // of a pair, in units: 128 kT

// One cache line.
typedef struct Ball {
    int64_t place[4];   // fractions of the edges, and above them whole edges; radius of `coarse`
    uint32_t anchor[3]; // fractions when its list was made
    uint32_t entries;   // of its list
    uint32_t species;
    uint32_t cell, seat; // of the anchor
    uint32_t unused;
} Ball;

typedef struct Balls Balls;

// One kernel per instruction set, the same source compiled for each.
typedef struct BallsKernel {
    // Words into particles, moves and energies; then the trials [from, to) of the block. `run`
    // returns false when there was no memory for a list.
    void (*draw)(Balls *balls, const uint32_t *words, const uint32_t *metropolis);
    bool (*run)(Balls *balls, size_t from, size_t to, MoveTally *moves);
    // Of `count` ids those whose coarse anchors, in `rows`, are within `far` of `own`; and those,
    // whose anchors are looked up, beyond.
    size_t (*near)(const Balls *balls, uint64_t own, const uint64_t *rows, const uint32_t *ids,
                   size_t count, uint32_t *near);
    size_t (*beyond)(const Balls *balls, uint64_t own, const uint32_t *ids, size_t count,
                     uint32_t *beyond);
} BallsKernel;
extern const BallsKernel balls_kernel_portable, balls_kernel_avx2, balls_kernel_avx512;

struct Balls {
    Chain chain;
    ChainSettings settings;
    State *state;
    RngKey key;
    CpuPath path;
    const BallsKernel *kernel;
    int dimension;
    size_t count;
    bool soft;
    bool one_size;  // equal diameters
    bool unscaled;  // coarse distances are compared as they are: equal edges, and diameters if hard
    int exponent;   // of soft spheres
    double scale;   // of the diameters
    double unit[4]; // length of a lattice step, in d; 0
    float unit_single[4];
    float step[SPECIES_MOST][4];    // half-width of the displacement, in halves of lattice steps
    double normal[SPECIES_MOST][3]; // its standard deviation, in lattice steps
    double longest_of[SPECIES_MOST], longest; // half-widths of the species, and the largest, in d

    Ball *ball;               // [count]
    double *radius;           // [count], in d
    double smallest, largest; // diameters at this scale
    uint64_t *coarse;     // [count] upper halves of the places, and minus the radius, 16 bits each;
                          // [count] those of the anchors, and plus the radius
    uint32_t below, sure; // unscaled: square of a coarse distance from which on nothing overlaps;
                          // below which all does
    int32_t doubt;        // else: bound of the error of (distance^2 - contact^2)
    float faint;          // soft ones: (contact/distance)^2 of energies that round to nothing
    float coarse_steps2;  // soft ones: (coarse steps per d)^2
    double energy_off; // bound of the error of (contact/distance)^n relative to it, where that is
                       // from coarse distances and not flat; but for that of the inverse
    uint32_t leashed;  // square of a coarse distance from the anchor that lists surely cover
    int16_t coarse_scale[3];
    float *radius_single; // [count] of soft ones; [count] of their anchors, 0

    bool listed;    // lists and cells are those of this skin and scale
    bool separate;  // seen to be without overlaps at this scale
    double reach;   // contact times this: the range of the interaction
    double skin;    // in d
    double leash2;  // (skin/2)^2, of how far from its anchor a particle may come, in d^2
    size_t room;    // of each list, a multiple of NEIGHBOURS_PER_ROOM
    uint32_t *list; // [count][room]: the anchor of i, which is count + i, neighbours, others
    int64_t cells[3];
    size_t cells_most, seats;  // of the arrays below; seats a multiple of NEIGHBOURS_AT_A_TIME
    uint32_t *seated;          // [cells_most] particles in each cell
    uint32_t *seat;            // [cells_most][seats] who they are
    uint64_t *seat_row;        // [cells_most][seats] their coarse anchors
    uint32_t far;              // square of a coarse distance of anchors beyond the range of lists
    uint32_t *found, *entered; // [count + NEIGHBOURS_AT_A_TIME] room for a search

    uint64_t block;                                 // whose trials are drawn; UINT64_MAX: none
    uint32_t who[TRIALS_PER_BLOCK + 8];             // particle
    _Alignas(64) int32_t move[TRIALS_PER_BLOCK][4]; // in lattice steps; 0
    int32_t affordable[TRIALS_PER_BLOCK];           // -ln of a uniform number, in energy units
    double *normals[3];                             // [TRIALS_PER_BLOCK]
    uint32_t *ids;                                  // 0, 1, ...
    uint64_t rebuilds, corrected;

    bool pulled; // a particle is, whose trials are those of `pull` (balls_pull.c)
    ChainPull pull;
};

// The chain on a given instruction set, which the processor must have: for tests, benches.
Status balls_create_with(CpuPath path, Chain **out, const ChainSettings *settings, State *state,
                         RngKey key);

// All lists anew. Chooses the skin.
Status balls_list(Balls *balls);
// The list of one particle, and its place in those of others; false: no memory.
bool balls_refresh(Balls *balls, uint32_t i);
// Does anything overlap a particle at `place`? By cells, whatever the distance.
bool balls_overlap_anywhere(const Balls *balls, uint32_t i, const uint32_t place[3]);
int64_t balls_energy_anywhere(const Balls *balls, uint32_t i, const uint32_t place[3]);

// The pulled particle's trial before number `trial` of the chain; false: no memory.
bool balls_pull_trial(Balls *balls, int64_t trial, MoveTally *moves);

// Scaled coarse steps per longest edge: squares of any distance fit 31 bits.
#define COARSE_PER_EDGE (0.75 * 0x1p16)

static inline uint64_t balls_coarse(const uint32_t place[3]) {
    uint64_t coarse = 0;
    for (int a = 0; a < 3; a++) {
        coarse |= (uint64_t)(uint16_t)((place[a] + 0x8000) >> 16) << (16 * a);
    }
    return coarse;
}

static inline uint64_t balls_coarse_scales(const Balls *balls) {
    const int16_t *f = balls->coarse_scale;
    return (uint64_t)(uint16_t)f[0] | (uint64_t)(uint16_t)f[1] << 16 |
           (uint64_t)(uint16_t)f[2] << 32;
}

// Fractions of the edges.
static inline void balls_fractions(const int64_t place[3], uint32_t fractions[3]) {
    for (int a = 0; a < 3; a++) fractions[a] = (uint32_t)place[a];
}

static inline double balls_distance2(const Balls *balls, const uint32_t a[3], const uint32_t b[3]) {
    double r[3];
    for (int k = 0; k < 3; k++) r[k] = (double)(int32_t)(a[k] - b[k]) * balls->unit[k];
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

// The rule.
static inline bool balls_overlap(const Balls *balls, uint32_t i, const uint32_t place[3],
                                 uint32_t j) {
    const double contact = balls->radius[i] + balls->radius[j];
    uint32_t other[3];
    balls_fractions(balls->ball[j].place, other);
    return balls_distance2(balls, place, other) < contact * contact;
}

static inline float balls_distance2_single(const Balls *balls, const uint32_t place[3],
                                           uint32_t j) {
    float r[3];
    for (int k = 0; k < 3; k++) {
        const uint32_t other = (uint32_t)balls->ball[j].place[k];
        r[k] = (float)(int32_t)(place[k] - other) * balls->unit_single[k];
    }
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

// The rule, in single precision: (d/r)^n in units, rounded; the same from both.
static inline int32_t balls_energy(const Balls *balls, uint32_t i, const uint32_t place[3],
                                   uint32_t j) {
    const float contact = balls->radius_single[i] + balls->radius_single[j];
    const float y = contact * contact / balls_distance2_single(balls, place, j);
    float power = balls->exponent & 1 ? __builtin_sqrtf(y) : 1, square = y;
    for (int n = balls->exponent / 2; n > 0; n /= 2, square *= square) {
        if (n & 1) power *= square;
    }
    power *= (float)ENERGY_UNITS;
    return (int32_t)__builtin_rintf(power < (float)ENERGY_MOST ? power : (float)ENERGY_MOST);
}

// Is this farther from the particle's anchor than its list allows?
static inline bool balls_leaves_anchor(const Balls *balls, uint32_t i, const uint32_t place[3]) {
    return balls_distance2(balls, place, balls->ball[i].anchor) > balls->leash2;
}
