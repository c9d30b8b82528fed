// SPDX-License-Identifier: GPL-3.0-or-later
// The cold path: Philox4x64-10 of Random123 (Salmon, Moraes, Dror and Shaw 2011), key (seed,
// replica), counter (block, particle, step, stream). It also gives the hot path its keys.
#include "rng/rng.h"

#include "base/status.h"
#include "rng/normals.h"

#include <Random123/philox.h>
#include <stdatomic.h>
#include <string.h>

static const uint64_t NO_PARTICLE = UINT64_MAX; // the counter of a key for the hot path
enum { KEY_OF_NORMALS, KEY_OF_WORDS };          // its block

static uint32_t lower(uint64_t word) {
    return (uint32_t)word;
}
static uint32_t upper(uint64_t word) {
    return (uint32_t)(word >> 32);
}

static void philox(RngKey key, const uint64_t counter[4], uint64_t block[4]) {
    const philox4x64_ctr_t in = {{counter[0], counter[1], counter[2], counter[3]}};
    const philox4x64_key_t words = {{key.seed, key.replica}};
    const philox4x64_ctr_t out = philox4x64(in, words);
    memcpy(block, out.v, sizeof out.v);
}

Rng rng_open(RngKey key, RngStream stream, uint64_t step, uint64_t particle) {
    return (Rng){.key = key, .counter = {0, particle, step, stream}, .used = 4};
}

uint64_t rng_bits(Rng *rng) {
    if (rng->used == 4) {
        philox(rng->key, rng->counter, rng->block);
        rng->counter[0]++;
        rng->used = 0;
    }
    return rng->block[rng->used++];
}

double rng_uniform(Rng *rng) {
    return (double)(rng_bits(rng) >> 11) * 0x1p-53;
}

uint64_t rng_below(Rng *rng, uint64_t bound) {
    ASSERT(bound > 0);
    const uint64_t surplus =
        -bound % bound; // 2^64 mod bound: values that would come once too often
    uint64_t bits = rng_bits(rng);
    while (bits < surplus) bits = rng_bits(rng);
    return bits % bound;
}

double rng_normal(Rng *rng) {
    const uint64_t bits = rng_bits(rng);
    return normals_one(upper(bits), lower(bits));
}

static NormalsKey normals_key(RngKey key, RngStream stream, uint64_t step) {
    uint64_t block[4];
    philox(key, (const uint64_t[4]){KEY_OF_NORMALS, NO_PARTICLE, step, stream}, block);
    return (NormalsKey){.plane = {lower(block[0]), upper(block[0]), lower(block[2])},
                        .third = {lower(block[1]), upper(block[1]), upper(block[2])}};
}

void rng_normals_with(CpuPath path, RngKey key, RngStream stream, uint64_t step,
                      const uint32_t *ids, size_t count, int components, double *const normals[3]) {
    static NormalsFill *const fills[CPU_PATHS] = {normals_fill_portable, normals_fill_avx2,
                                                  normals_fill_avx512};
    ASSERT(components == 2 || components == 3);
    const NormalsKey words = normals_key(key, stream, step);
    fills[path](&words, ids, count, components, normals);
}

void rng_normals_single_with(CpuPath path, RngKey key, RngStream stream, uint64_t step,
                             const uint32_t *ids, size_t count, int components,
                             float *const normals[3]) {
    static NormalsFillSingle *const fills[CPU_PATHS] = {
        normals_fill_single_portable, normals_fill_single_avx2, normals_fill_single_avx512};
    ASSERT(components == 2 || components == 3);
    const NormalsKey words = normals_key(key, stream, step);
    fills[path](&words, ids, count, components, normals);
}

// Asked of the processor once: that takes as long as a hundred normal numbers.
static CpuPath chosen_path(void) {
    static atomic_int chosen = -1;
    int path = atomic_load_explicit(&chosen, memory_order_relaxed);
    if (path < 0) {
        path = (int)cpu_path();
        atomic_store_explicit(&chosen, path, memory_order_relaxed);
    }
    return (CpuPath)path;
}

void rng_normals(RngKey key, RngStream stream, uint64_t step, const uint32_t *ids, size_t count,
                 int components, double *const normals[3]) {
    rng_normals_with(chosen_path(), key, stream, step, ids, count, components, normals);
}

void rng_normals_single(RngKey key, RngStream stream, uint64_t step, const uint32_t *ids,
                        size_t count, int components, float *const normals[3]) {
    rng_normals_single_with(chosen_path(), key, stream, step, ids, count, components, normals);
}

void rng_words_with(CpuPath path, RngKey key, RngStream stream, uint64_t block,
                    uint32_t words[RNG_BLOCK]) {
    static WordsFill *const fills[CPU_PATHS] = {rng_fill_words_portable, rng_fill_words_avx2,
                                                rng_fill_words_avx512};
    uint64_t drawn[4];
    philox(key, (const uint64_t[4]){KEY_OF_WORDS, NO_PARTICLE, block, stream}, drawn);
    const uint32_t three[3] = {lower(drawn[0]), upper(drawn[0]), lower(drawn[1])};
    fills[path](three, RNG_BLOCK / 2, words);
}

void rng_words(RngKey key, RngStream stream, uint64_t block, uint32_t words[RNG_BLOCK]) {
    rng_words_with(chosen_path(), key, stream, block, words);
}
