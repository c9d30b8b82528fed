// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers as a pure function of (seed, replica, stream, counter): nothing to save, nothing
// that depends on threads, and the same bits on every instruction set.
#pragma once

#include "base/cpu.h"

#include <stddef.h>
#include <stdint.h>

// Becomes: enum { STREAM_PACKING, STREAM_DIAMETERS, ... }
typedef enum RngStream {
#define STREAM(ID, name, about) STREAM_##ID,
#include "rng/streams.def"
#undef STREAM
    STREAMS
} RngStream;

typedef struct RngKey {
    uint64_t seed;
    uint64_t replica;
} RngKey;

// A reader of one stream from its beginning: for the cold paths. Random123's Philox4x64-10.
typedef struct Rng {
    RngKey key;
    uint64_t counter[4];
    uint64_t block[4];
    int used;
} Rng;

Rng rng_open(RngKey key, RngStream stream, uint64_t step, uint64_t particle);
uint64_t rng_bits(Rng *rng);
double rng_uniform(Rng *rng);                 // in [0, 1), 53 bits
uint64_t rng_below(Rng *rng, uint64_t bound); // unbiased, in [0, bound)
double rng_normal(Rng *rng);                  // mean 0, variance 1

// For the hot path: `components` (2 or 3) independent standard normal numbers for each of `count`
// particles at one step; component a of particle ids[i] goes to normals[a][i], a pure function of
// (key, stream, step, ids[i], a). `count` may be any number. Vectorised Threefry2x32, keyed at each
// step by Philox, with polynomials of our own, dispatched by cpu_path. Single precision, tails to
// 8.6.
void rng_normals(RngKey key, RngStream stream, uint64_t step, const uint32_t *ids, size_t count,
                 int components, double *const normals[3]);

// The same numbers on a given instruction set, which the processor must have: for tests, benches.
void rng_normals_with(CpuPath path, RngKey key, RngStream stream, uint64_t step,
                      const uint32_t *ids, size_t count, int components, double *const normals[3]);

// The same numbers as they are before they are widened.
void rng_normals_single(RngKey key, RngStream stream, uint64_t step, const uint32_t *ids,
                        size_t count, int components, float *const normals[3]);
void rng_normals_single_with(CpuPath path, RngKey key, RngStream stream, uint64_t step,
                             const uint32_t *ids, size_t count, int components,
                             float *const normals[3]);

// For the hot path: raw words, RNG_BLOCK of them in each numbered block; word i of a block is a
// pure function of (key, stream, block, i). Vectorised Threefry2x32, keyed at each block by Philox.
enum { RNG_BLOCK = 4096 };
void rng_words(RngKey key, RngStream stream, uint64_t block, uint32_t words[RNG_BLOCK]);
void rng_words_with(CpuPath path, RngKey key, RngStream stream, uint64_t block,
                    uint32_t words[RNG_BLOCK]);
