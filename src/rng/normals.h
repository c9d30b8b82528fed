// SPDX-License-Identifier: GPL-3.0-or-later
// Private to rng/: the three builds of the normal numbers of normals_kernel.h.
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct NormalsKey {
    uint32_t plane[2]; // key of the generator for components 0 and 1
    uint32_t third[2]; // and for component 2
    uint32_t step;     // lower half of the step number; the upper half is in the keys
} NormalsKey;

typedef void NormalsFill(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                         double *const normals[3]);
NormalsFill normals_fill_portable, normals_fill_avx2, normals_fill_avx512;

// One normal number from two words, by the same formulas, and the words of (id, step).
double normals_one(uint32_t radius_word, uint32_t angle_word);
void normals_words(const uint32_t key[2], uint32_t id, uint32_t step, uint32_t words[2]);
