// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers and plain words by counter, LANES at a time: Threefry2x32 (Salmon, Moraes, Dror
// and Shaw 2011) turns a particle's id into two 32-bit words, and Box and Muller (1958) turn these
// into two normal numbers. Compiled once per instruction set by a file that defines LANES (4, 8 or
// 16).
//
// Thirteen rounds instead of the customary twenty: the key is drawn afresh at every step by
// Philox4x64-10, so that this generator only has to make the particles of one step independent, and
// every bit of the counter reaches every bit of the words in nine.
//
// Only integer operations and + - * / sqrt, so that all builds give the same bits. In single
// precision: relative errors of 1e-7 in numbers drawn at random would need some 1e13 draws to be
// seen, and double has half the lanes.
#pragma once

#include "rng/normals.h"

#include <string.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define KERNEL static inline __attribute__((always_inline))

typedef uint32_t Words __attribute__((vector_size(4 * LANES)));
typedef int32_t Integers __attribute__((vector_size(4 * LANES)));
typedef float Reals __attribute__((vector_size(4 * LANES)));

KERNEL Reals real(Integers integers) {
    return __builtin_convertvector(integers, Reals);
}

KERNEL Reals square_root(Reals x) {
#if LANES == 16 && defined(__AVX512F__)
    return (Reals)_mm512_sqrt_ps((__m512)x);
#elif LANES == 8 && defined(__AVX__)
    return (Reals)_mm256_sqrt_ps((__m256)x);
#elif LANES == 4 && defined(__SSE2__)
    return (Reals)_mm_sqrt_ps((__m128)x);
#else
    for (int lane = 0; lane < LANES; lane++) x[lane] = __builtin_sqrtf(x[lane]);
    return x;
#endif
}

KERNEL void mix(Words *x, Words *y, int rotation) {
    *x += *y;
    *y = (*y << rotation) | (*y >> (32 - rotation));
    *y ^= *x;
}

KERNEL void mix_four(Words *x, Words *y, int a, int b, int c, int d) {
    mix(x, y, a);
    mix(x, y, b);
    mix(x, y, c);
    mix(x, y, d);
}

// A key word is added to each word before the first round and after every fourth.
KERNEL void threefry(const uint32_t key[2], Words *x, Words *y) {
    const uint32_t parity = 0x1BD11BDA ^ key[0] ^ key[1];
    *x += key[0], *y += key[1];
    mix_four(x, y, 13, 15, 26, 6);
    *x += key[1], *y += parity + 1;
    mix_four(x, y, 17, 29, 16, 24);
    *x += parity, *y += key[0] + 2;
    mix_four(x, y, 13, 15, 26, 6);
    *x += key[0], *y += key[1] + 3;
    mix(x, y, 17);
}

// sqrt(-2 ln u), u = (k + f)/2^31 with k the upper 31 bits of `word` and a fraction 0 < f < 1 from
// bits of `tail`: never 0, and up to 8.6. With 2^31 u = 2^e m, where 2^31 sqrt(1/2) <= m < 2^31
// sqrt(2), ln u = e ln 2 + 2 artanh((m - 2^31)/(m + 2^31)); for e = 0 the numerator is taken from
// 1 - u, known to full relative precision, so that small radii are as exact as large ones.
KERNEL Reals radius(Words word, Words tail) {
    const int32_t root_half = 0x4eb504f3; // bits of 2^31 sqrt(1/2)
    const Integers whole = (Integers)(word >> 1);
    const Reals one_and_fraction = (Reals)((tail & 0x7fffff) | 0x3f800001);
    const Reals u = real(whole) + (one_and_fraction - 1);                        // in 2^-31
    const Reals u_minus_one = real(whole - 0x7fffffff) + (one_and_fraction - 2); // in 2^-31

    const Integers above = (Integers)u - root_half;
    const Integers e = above >> 23;
    const Reals m = (Reals)((Integers)u - (above & ~0x7fffff)); // u 2^-e
    const Integers is_small = above >> 31;                      // all bits where u < sqrt(1/2)
    const Reals numerator =
        (Reals)(((Integers)(m - 0x1p31f) & is_small) | ((Integers)u_minus_one & ~is_small));
    const Reals s = numerator / (m + 0x1p31f);
    const Reals z = s * s;
    const Reals series = (-0.597439941f * z - 0.799550648f) * z - 1.33333553f;
    return square_root(real(e) * -1.38629436f + s * (z * series - 4));
}

// Cosine and sine of an angle uniform on the circle: 30 bits of `word` place it in (-pi/4, pi/4),
// one exchanges cosine and sine, one changes the sign of both.
KERNEL void direction(Words word, Reals *cosine, Reals *sine) {
    const Reals x = real((Integers)(word << 2 | 2)) * 3.65729518e-10f; // pi/4 2^-31
    const Reals z = x * x;
    const Reals s = ((-1.95172990e-4f * z + 8.33217815e-3f) * z - 0.166666549f) * (z * x) + x;
    const Reals c =
        ((2.44384516e-5f * z - 1.38873675e-3f) * z + 4.16666469e-2f) * (z * z) + (1 - 0.5f * z);
    const Words exchange = (Words)((Integers)(word << 1) >> 31);
    const Words difference = ((Words)c ^ (Words)s) & exchange;
    const Words sign = word & 0x80000000;
    *cosine = (Reals)((Words)c ^ difference ^ sign);
    *sine = (Reals)((Words)s ^ difference ^ sign);
}

// Sine of an angle uniform on the half circle, distributed as that of one on the circle.
KERNEL Reals sine_of_half_circle(Words word) {
    const Reals x = real((Integers)(word | 1)) * 7.31459036e-10f; // pi/2 2^-31
    const Reals z = x * x;
    return (((2.60893268e-06f * z - 0.000198111128f) * z + 0.00833308817f) * z - 0.166666605f) *
               (z * x) +
           x;
}

// The loops below are kept apart, over a chunk in the first-level cache, because each alone has
// more independent work in reach of the processor than all together: a fifth faster.
enum { CHUNK = 256 };
typedef struct Chunk {
    _Alignas(4 * LANES) uint32_t x[CHUNK], y[CHUNK]; // words of each particle
} Chunk;

#define LOAD(vector, array) memcpy(&(vector), (array), sizeof(vector))
#define STORE(vector, array) memcpy((array), &(vector), sizeof(vector))

KERNEL Words load_ids(const uint32_t *ids, size_t count) {
    Words x = {0};
    if (count >= LANES)
        LOAD(x, ids);
    else
        memcpy(&x, ids, count * sizeof *ids);
    return x;
}

KERNEL void store_normals(Reals normals, float *to, size_t count) {
    if (count >= LANES)
        STORE(normals, to);
    else
        memcpy(to, &normals, count * sizeof *to);
}

KERNEL void draw_words(Chunk *chunk, const uint32_t key[3], const uint32_t *ids, size_t count) {
    for (size_t i = 0; i < count; i += LANES) {
        Words x = load_ids(ids + i, count - i);
        Words y = x * 0 + key[2];
        threefry(key, &x, &y);
        STORE(x, chunk->x + i);
        STORE(y, chunk->y + i);
    }
}

// Lower bits of the angle's word also refine the radius, which shows in radii above 6.6 and below
// 3e-5 only.
KERNEL void transform_two(const Chunk *chunk, size_t count, float *first, float *second) {
    for (size_t i = 0; i < count; i += LANES) {
        Words x, y;
        Reals cosine, sine;
        LOAD(x, chunk->x + i);
        LOAD(y, chunk->y + i);
        const Reals r = radius(x, y);
        direction(y, &cosine, &sine);
        store_normals(cosine * r, first + i, count - i);
        store_normals(sine * r, second + i, count - i);
    }
}

KERNEL void transform_third(const Chunk *chunk, size_t count, float *third) {
    for (size_t i = 0; i < count; i += LANES) {
        Words x, y;
        LOAD(x, chunk->x + i);
        LOAD(y, chunk->y + i);
        store_normals(radius(x, y) * sine_of_half_circle(y), third + i, count - i);
    }
}

// `components` (2 or 3) numbers for each of `count` <= CHUNK particles, to normals[] + `at`.
KERNEL void fill(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                 float *const normals[3], size_t at) {
    Chunk chunk;
    draw_words(&chunk, key->plane, ids, count);
    transform_two(&chunk, count, normals[0] + at, normals[1] + at);
    if (components == 2) return;
    draw_words(&chunk, key->third, ids, count);
    transform_third(&chunk, count, normals[2] + at);
}

KERNEL size_t chunk_size(size_t count, size_t at) {
    return count - at < CHUNK ? count - at : CHUNK;
}

KERNEL void fill_normals(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                         double *const normals[3]) {
    float single[3][CHUNK];
    for (size_t at = 0; at < count; at += CHUNK) {
        const size_t size = chunk_size(count, at);
        fill(key, ids + at, size, components, (float *const[3]){single[0], single[1], single[2]},
             0);
        for (int a = 0; a < components; a++) {
            for (size_t i = 0; i < size; i++) normals[a][at + i] = (double)single[a][i];
        }
    }
}

// The same numbers as they are before they are widened.
KERNEL void fill_single(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                        float *const normals[3]) {
    for (size_t at = 0; at < count; at += CHUNK) {
        fill(key, ids + at, chunk_size(count, at), components, normals, at);
    }
}

// Two vectors of counters at a time: one alone would wait for its own rounds.
KERNEL void fill_words(const uint32_t key[3], size_t pairs, uint32_t *words) {
    Words counter;
    for (int lane = 0; lane < LANES; lane++) counter[lane] = (uint32_t)lane;
    for (size_t i = 0; i < pairs; i += 2 * LANES, counter += 2 * LANES) {
        Words x[2] = {counter, counter + LANES},
              y[2] = {counter * 0 + key[2], counter * 0 + key[2]};
        for (int k = 0; k < 2; k++) threefry(key, &x[k], &y[k]);
        for (size_t k = 0; k < 2; k++) {
            STORE(x[k], words + i + k * LANES);
            STORE(y[k], words + pairs + i + k * LANES);
        }
    }
}
