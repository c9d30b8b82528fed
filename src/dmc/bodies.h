// SPDX-License-Identifier: GPL-3.0-or-later
// The inside of the chain of bodies, for bodies*.c, its tests and benches only.
//
// Places are fractions of the box: the lower 32 bits of a 64-bit integer, whose upper bits count
// the images. The difference of two lower halves, taken as a signed integer, is the nearest image,
// and nothing is ever wrapped.
//
// Every body has a list of those that it may touch, made when it was last "anchored". A body's core
// is what its skin is laid around: the segment of a spherocylinder, the disc of a platelet, the
// centre of a sphere. Where no point of a body's core is farther than `rest` from where it was in
// the anchored pose, and none of a trial's farther than `leash`, two bodies can only touch if their
// anchored cores are nearer than contact + skin, skin = rest + leash: those are on each other's
// lists. Rotation counts by how far it moves the rim, so that a rod's list has the ten that it may
// touch, not the hundred whose centres are near. A body that comes to lie beyond its rest is
// anchored anew; a trial beyond the leash is judged by all whose anchored centres are near, found
// in cells, and so are all trials where no list pays or fits into the box (skin 0).
//
// Lists, cells and single precision decide only who is looked at: what comes out depends on poses
// alone.
#pragma once

#include "dmc/chain.h"

#include "shapes/overlap.h"

#define KERNEL static inline __attribute__((always_inline))

enum { LIST_BLOCK = 16 }; // room on lists is in multiples of the widest vector

// Where a body is, exactly.
typedef struct Pose {
    int64_t place[3]; // unfolded, in edge/2^32
    double axis[3];   // of length 1; z for bodies without
} Pose;

// The same for bounds, as vectors take it.
typedef struct BodyRow {
    _Alignas(32) int32_t place[3];
    float axis[3];
    float radius; // of the cap, the sphere or the disc
    float core;   // half the length of the segment; among platelets: 1 for a disc, 0 for a sphere
} BodyRow;

// Anchored places by cells that are wider than reach + skin, or one cell where the box is narrow.
typedef struct BodyCells {
    uint32_t number[3];
    size_t total, room;  // cells; bodies that fit into each
    uint32_t *held;      // [total]
    int32_t *place[3];   // [total][room]
    uint32_t *id;        // [total][room]
    uint32_t *cell, *at; // [count] of each body
} BodyCells;

typedef struct BodyLists {
    double length;       // typical, of the trials that they are made for, in d
    double scale;        // of the sizes that they serve, or smaller ones
    float swell;         // that scale against the one now, and a margin
    float skin, rest;    // in d; 0: no lists, all are looked for in cells
    float leash;         // of a trial: skin - rest; below 0: no lists
    size_t room;         // ids that fit on each list
    uint32_t *held;      // [count]
    uint32_t *near;      // [count][room]
    BodyRow *anchor;     // [count]
    uint32_t *candidate; // [count + LIST_BLOCK]
    BodyCells cells;
} BodyLists;

typedef struct Draws Draws; // bodies_move.h
typedef struct Bodies Bodies;

// One per instruction set and kind of mixture, the same source compiled for each.
typedef struct BodiesKernel {
    void (*draw)(Draws *draws, const ChainSettings *settings, size_t count, const uint32_t *words,
                 double *const normals[3]);
    // Trials `from` to `to` of the block; returns how many were made: fewer if lists are stale.
    size_t (*try_moves)(Bodies *bodies, const Draws *draws, size_t from, size_t to, Tally *tally);
    // Trial k of the block, of body i whatever was drawn; whether it was accepted.
    bool (*try_body)(Bodies *bodies, const Draws *draws, size_t k, size_t i, Tally *tally);
    void (*anchor)(Bodies *bodies, size_t i); // where it is, and lists it anew
    bool (*overlaps)(Bodies *bodies, size_t i);
} BodiesKernel;

struct Bodies {
    Chain chain; // first
    ChainSettings settings;
    RngKey key;
    State *state;
    const BodiesKernel *kernel;
    size_t count;
    bool flat;             // platelets, and spheres with them; else spherocylinders with spheres
    double scale;          // of the sizes, against those of the State
    double unit[3];        // of places: edge/2^32, in d
    double units_per_d[3]; // 1/unit
    Amplitude amplitude[SPECIES_MOST];
    Pose *pose;     // [count]
    Body *body;     // [count] with their sizes at this scale
    BodyRow *row;   // [count]
    double longest; // reach of any
    BodyLists lists;
    bool stale; // lists do not serve: one is too short, or they are for other steps
    Draws *draws;
    int64_t drawn; // block; -1: none
    bool pulled;   // a particle is, whose trials are those of `pull` (bodies_pull.c)
    ChainPull pull;
};

// Becomes: extern const BodiesKernel bodies_kernels_portable[2][2], ...
#define BODIES_KERNELS(path) extern const BodiesKernel bodies_kernels_##path[2][2]; // [flat][mixed]
BODIES_KERNELS(portable)
BODIES_KERNELS(avx2)
BODIES_KERNELS(avx512)
#undef BODIES_KERNELS

// Pairs are looked at from the lower id, so that rounding cannot make a pair overlap that the
// partner's trial found apart.
static inline bool bodies_pair_overlaps(const Bodies *bodies, size_t i, const Pose *of_i,
                                        size_t j) {
    const Pose *of_j = &bodies->pose[j];
    const bool forward = i < j;
    double r[3];
    for (int a = 0; a < 3; a++) {
        const uint32_t apart = (uint32_t)of_j->place[a] - (uint32_t)of_i->place[a];
        r[a] = (forward ? 1 : -1) * (double)(int32_t)apart * bodies->unit[a];
    }
    const Body *body = bodies->body;
    return forward ? overlap_of(&body[i], of_i->axis, &body[j], of_j->axis, r)
                   : overlap_of(&body[j], of_j->axis, &body[i], of_i->axis, r);
}

// The pulled particle's trial before number `trial` of the chain.
void bodies_pull_trial(Bodies *bodies, int64_t trial, MoveTally *moves);
BodyRow bodies_row(const Bodies *bodies, size_t i); // where it is

Status bodies_lists_create(Bodies *bodies);
void bodies_lists_free(Bodies *bodies);
// Widths of the lists for the amplitudes in force, and whether they suit them still
// (bodies_skin.c).
void bodies_choose_skin(Bodies *bodies, double scale);
bool bodies_skin_suits(const Bodies *bodies);

// Anchors all bodies where they are, with more room as long as lists are outgrown. `scale` as in
// BodyLists.
Status bodies_lists_build(Bodies *bodies, double scale);
