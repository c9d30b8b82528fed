// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers by counter, 8 particles at a time.
#define LANES 8
#include "rng/normals_kernel.h"

void normals_fill_avx2(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                       double *const normals[3]) {
    fill_normals(key, ids, count, components, normals);
}

void normals_fill_single_avx2(const NormalsKey *key, const uint32_t *ids, size_t count,
                              int components, float *const normals[3]) {
    fill_single(key, ids, count, components, normals);
}

void rng_fill_words_avx2(const uint32_t key[3], size_t pairs, uint32_t *words) {
    fill_words(key, pairs, words);
}
