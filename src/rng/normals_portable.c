// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers by counter, 4 particles at a time.
#define LANES 4
#include "rng/normals_kernel.h"

void normals_fill_portable(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                           double *const normals[3]) {
    fill_normals(key, ids, count, components, normals);
}

void normals_fill_single_portable(const NormalsKey *key, const uint32_t *ids, size_t count,
                                  int components, float *const normals[3]) {
    fill_single(key, ids, count, components, normals);
}

void rng_fill_words_portable(const uint32_t key[3], size_t pairs, uint32_t *words) {
    fill_words(key, pairs, words);
}

double normals_one(uint32_t radius_word, uint32_t angle_word) {
    const Words angle = {angle_word};
    const Reals normal = radius((Words){radius_word}, angle) * sine_of_half_circle(angle);
    return (double)normal[0];
}

void normals_pair(uint32_t radius_word, uint32_t angle_word, double pair[2]) {
    const Words angle = {angle_word};
    Reals cosine, sine;
    direction(angle, &cosine, &sine);
    const Reals r = radius((Words){radius_word}, angle);
    pair[0] = (double)(r * cosine)[0];
    pair[1] = (double)(r * sine)[0];
}

void normals_words(const uint32_t key[2], uint32_t words[2]) {
    Words x = {words[0]}, y = {words[1]};
    threefry(key, &x, &y);
    words[0] = x[0];
    words[1] = y[0];
}
