// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers by counter, 4 particles at a time.
#define LANES 4
#include "rng/normals_kernel.h"

void normals_fill_portable(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                           double *const normals[3]) {
    fill_normals(key, ids, count, components, normals);
}

double normals_one(uint32_t radius_word, uint32_t angle_word) {
    Reals first, second;
    normal_pair((Words){radius_word}, (Words){angle_word}, &first, &second);
    return (double)first[0];
}

void normals_words(const uint32_t key[2], uint32_t id, uint32_t step, uint32_t words[2]) {
    Words x = {id}, y = {step};
    threefry(key, &x, &y);
    words[0] = x[0];
    words[1] = y[0];
}
