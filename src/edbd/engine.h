// SPDX-License-Identifier: GPL-3.0-or-later
// The inside of the engine, for the files of this folder only.
//
// Particles lie in memory in the order of their cells; `id` tells who is where ("slot"). All that
// depends on this order (lists, buckets, event numbers) is machinery: what comes out depends on
// positions, velocities and ids alone.
#pragma once

#include "edbd/edbd.h"

enum {
    ROW_2D = 4,     // of the sketch: x y, now and then
    ROW_3D = 8,     // x y z 0, likewise
    BLOCK = 16,     // slots and the half list are padded to a multiple of this,
    HALF_BLOCK = 8, // the neighbours of each particle to one of this
    BITS = 64,      // of buckets in a word
};
static const uint32_t NO_EVENT = UINT32_MAX;

// What bends a window: nothing, diameters that grow, images across y that are displaced or move.
enum { AT_REST, GROWING, SHEARED };

// A predicted collision. It is void as soon as either partner has collided since: stamps count the
// collisions of each particle in this window and only grow, so their sum tells.
typedef struct Event {
    double time;
    uint32_t first, second; // slots
    uint32_t stamps;
    uint32_t next; // in its bucket
} Event;

// Some neighbours of a particle, in one line of the cache.
typedef struct Neighbours {
    uint32_t row[HALF_BLOCK];   // where their sketches begin
    float contact2[HALF_BLOCK]; // squares of the contact distances at scale 1
} Neighbours;

// Pairs nearer than contact + skin when the list was made, seen both ways: a flat half list for
// the prediction at the start of a window, and all neighbours of each particle for predictions
// after a collision. For short windows the half list is pruned, every now and then, to pairs
// nearer than contact + inner skin.
typedef struct NeighbourList {
    double skin, inner_skin;   // in d; inner_skin = skin: not pruned
    double scale, inner_scale; // of the diameters when it was made, when it was pruned
    double strain;             // since it was pruned, before this window
    double strain_before;      // between making and pruning
    double spent;              // largest displacement between making and pruning, in d, flow apart
    double farthest2;          // square of the largest distance from an anchor since it was pruned
    int64_t age;               // windows since it was made
    double *anchor[3];         // [slots] where each was when it was pruned,
    double *origin[3];         // [slots] and when it was made

    size_t pairs; // padded to whole blocks with a pair that never meets
    size_t pair_capacity;
    uint32_t *first, *second; // [pairs] where their sketches begin, in the order of `first`
    uint32_t *pair_start;     // [slots + 1] first pair of each
    float *pair_contact2;     // [pairs] square of the contact distance at scale 1
    // Room for those that may meet: [pairs] of a window, and [2 pairs] of the first after
    // collisions.
    uint32_t *hit_first, *hit_second;

    bool pruned;
    size_t near; // the half list that is used, borrowed: the pruned one or all of it
    uint32_t *near_first, *near_second;
    float *near_contact2;
    uint32_t *pruned_first, *pruned_second; // [pairs]
    float *pruned_contact2;                 // [pairs]

    uint32_t *start; // [slots + 1] in multiples of HALF_BLOCK; after the last come nobodies
    size_t block_capacity;
    Neighbours *blocks; // [start[slots] / HALF_BLOCK + 1]
} NeighbourList;

// Of the particles, one array for each axis.
typedef struct Motion {
    double *place[3], *velocity[3]; // [slots]
} Motion;

// What a window must not pass over: the state at the last moment known to be right.
typedef struct Snapshot {
    int32_t *image[3];
    Box box;
    int64_t step, window, left;
    double scale;
    Tally tally;
    size_t recorded; // collisions in the log
    int64_t windows; // done since
} Snapshot;

typedef struct EngineKernel EngineKernel;

// One piece of memory for all arrays whose sizes do not change: large enough for huge pages where
// each of them is not. Measured first: without a base.
typedef struct Room {
    char *base;
    size_t used; // bytes
} Room;

// `pointer` becomes an array of zeros in the room.
#define TAKE_ARRAY(room, pointer, count)                                                           \
    ((pointer) = engine_room_take((room), (count) * sizeof *(pointer)))
void *engine_room_take(Room *room, size_t bytes);

// Consecutive slots.
typedef struct Span {
    uint32_t from, to;
} Span;

struct Engine {
    EngineSettings settings;
    State *state;
    RngKey key;
    const EngineKernel *kernel;

    Room room; // for the arrays here and of the list that are not said to grow

    int dimension;
    size_t row;   // of the sketch: ROW_2D or ROW_3D
    size_t count; // of particles; the slots from `count` on hold nobody, at rest in the origin
    size_t slots; // a multiple of BLOCK above `count`
    double edge[3];
    double scale, growth;  // of the diameters: now, and its rate
    int sheared;           // images across y are displaced, or moving
    double offset;         // of those above, at the start of the window, and
    int32_t turns;         // edges that it is short of the whole displacement: those of the box
    double rate;           // of the shear in this window, in sqrt(kT/m)/d,
    double next_rate;      // and of that in the next one
    double image_velocity; // of those above, rate edge[1]
    EngineFlow flow;
    EnginePull pull;      // period 0: of nobody
    size_t pulled;        // slot, unless the order has changed since
    int64_t window, left; // windows done in this step; still to do in this call

    Motion now;         // virtual origins and velocities
    Motion spare;       // those of the snapshot, and where a new order is made
    float *sketch;      // [slots][row] (edbd/sketch.h)
    double place_error; // most that a distance errs between places in single precision,
    float sketch_error; // and the product of two distances
    uint32_t *id;       // [slots] of each
    uint32_t *spare_id;
    double *radius;      // [slots]
    double *mass;        // [slots]
    float *normals[3];   // [slots]
    float *column[4];    // [slots + BLOCK] scratch while listing: places and radii,
    float *lined[4];     // [slots + 2 BLOCK] and those of the candidates of a cell,
    uint32_t *lined_row; // [slots + 2 BLOCK] with where their sketches begin
    double *thermal;     // [slots] 1/sqrt(mass)
    uint32_t *stamp;     // [slots] collisions of each in this window
    double largest;      // diameter
    double fastest;      // thermal velocity, and that of the flow across a diameter
    double margin;       // the list is rebuilt when this is left of its reach, in d

    NeighbourList list;
    uint32_t *cell_of;    // [count]
    uint32_t *cell_start; // [cells_most + 1]
    size_t cells_most;

    Event *events; // [event_capacity]
    uint32_t event_capacity, events_used;
    uint32_t *bucket;   // [buckets] first event of each slice of the window that has any
    uint64_t *occupied; // [buckets / BITS] which have
    uint32_t buckets;   // a power of two
    double buckets_per_time, half_per_window; // 1/(2 window)

    int64_t careful; // windows still to be done with a new list each
    int redraw;      // the window that is opened begins with velocities from `normals`
    int fetches;  // 1: more particles than the cache has room for; what is needed is fetched ahead
    int outgrown; // the events did not fit
    int hung;     // a particle collided more often than anything physical

    Tally tally;
    Snapshot snapshot;
    CollisionLog *log;
};

// One kernel per instruction set, the same source compiled for each.
struct EngineKernel {
    void (*run_window)(Engine *engine);            // predict, collide, move, fold
    void (*run_growing)(Engine *engine);           // the same with growing diameters
    void (*run_sheared)(Engine *engine);           // the same in a box that is sheared, or was
    void (*open_window)(Engine *engine);           // what comes after the move: velocities, sketch
    void (*sketch)(Engine *engine, uint32_t slot); // of one whose velocity was changed since
    void (*pair_cell)(Engine *engine, size_t cell, const Span *spans, int count);
    void (*prune)(Engine *engine); // the half list to the near pairs
};

// Becomes: extern const EngineKernel engine_kernel_2d_portable, ...
#define ENGINE_KERNELS(path)                                                                       \
    extern const EngineKernel engine_kernel_2d_##path, engine_kernel_3d_##path;
ENGINE_KERNELS(portable)
ENGINE_KERNELS(avx2)
ENGINE_KERNELS(avx512)
#undef ENGINE_KERNELS

void list_take_room(Engine *engine);
void list_free(Engine *engine);
// Sorts the particles by cell and finds all pairs nearer than contact + skin.
Status list_build(Engine *engine);
// Looks again which pairs are near; no particle may have left the reach of the list.
void list_prune(Engine *engine);
// How far a particle may be from its anchor before a pair could be missed, in d.
double list_reach(const Engine *engine);       // of the pruned list
double list_outer_reach(const Engine *engine); // of the list itself
