// SPDX-License-Identifier: GPL-3.0-or-later
// Private to rng/: the three builds of the normal numbers and words of normals_kernel.h.
#pragma once

#include <stddef.h>
#include <stdint.h>

// Of one step. Each block of Threefry2x32 has a key of two words; the third word is the half of
// its counter that is not the particle's id.
typedef struct NormalsKey {
    uint32_t plane[3]; // for components 0 and 1
    uint32_t third[3]; // for component 2
} NormalsKey;

typedef void NormalsFill(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                         double *const normals[3]);
NormalsFill normals_fill_portable, normals_fill_avx2, normals_fill_avx512;

typedef void NormalsFillSingle(const NormalsKey *key, const uint32_t *ids, size_t count,
                               int components, float *const normals[3]);
NormalsFillSingle normals_fill_single_portable, normals_fill_single_avx2,
    normals_fill_single_avx512;

// Words of the counters 0, 1, ... `pairs` - 1, a multiple of 16: the first of each, then the
// second.
typedef void WordsFill(const uint32_t key[3], size_t pairs, uint32_t *words);
WordsFill rng_fill_words_portable, rng_fill_words_avx2, rng_fill_words_avx512;

// For the cold path and the tests, one lane of the portable build.
double normals_one(uint32_t radius_word, uint32_t angle_word);
void normals_pair(uint32_t radius_word, uint32_t angle_word, double pair[2]);
void normals_words(const uint32_t key[2], uint32_t words[2]); // Threefry2x32-13 of `words`
