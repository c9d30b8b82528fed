// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers by counter, LANES particles at a time: Threefry2x32-20 (Salmon, Moraes, Dror and
// Shaw 2011) turns (particle, step) into two 32-bit words, and Box and Muller turn these into two
// normal numbers. Compiled once per instruction set by a file that defines LANES (4, 8 or 16).
//
// Only integer operations and + - * / sqrt, so that all builds give the same bits. In single
// precision: the words have 32 bits, and relative errors of some 1e-7 in numbers drawn at random
// would need 1e13 draws to be seen, while double would cost half as much again.
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

// Twenty rounds; a key word is added before the first and after every fourth.
KERNEL void threefry(const uint32_t key[2], Words *x, Words *y) {
    const uint32_t parity = 0x1BD11BDA ^ key[0] ^ key[1];
    *x += key[0], *y += key[1];
    mix_four(x, y, 13, 15, 26, 6);
    *x += key[1], *y += parity + 1;
    mix_four(x, y, 17, 29, 16, 24);
    *x += parity, *y += key[0] + 2;
    mix_four(x, y, 13, 15, 26, 6);
    *x += key[0], *y += key[1] + 3;
    mix_four(x, y, 17, 29, 16, 24);
    *x += key[1], *y += parity + 4;
    mix_four(x, y, 13, 15, 26, 6);
    *x += parity, *y += key[0] + 5;
}

// sqrt(-2 ln u), u = (k + f)/2^31 with k from the upper 31 bits of `word` and the fraction f from
// 16 bits of `tail`: the radius reaches 8.1 and is never 0. ln u = e ln 2 + 2 artanh((m-1)/(m+1))
// with u = 2^e m and m in [sqrt(1/2), sqrt(2)); for u > sqrt(1/2) m - 1 is taken from 1 - u, which
// is known to full relative precision, so that small radii are as exact as large ones.
KERNEL Reals radius(Words word, Words tail) {
    const int32_t root_half = 0x3f3504f3; // bits of sqrt(1/2)
    const int32_t one = 31;               // exponent of u = 1 in units of 2^-31
    const Integers whole = (Integers)(word >> 1);
    const Reals fraction = real((Integers)(tail & 0xffff)) * 0x1p-16f + 0x1p-17f;
    const Reals from_zero = real(whole) + fraction;                   // 2^31 u
    const Reals from_one = real(0x7fffffff - whole) + (1 - fraction); // 2^31 (1 - u)

    const Integers bits = (Integers)from_zero;
    const Integers exponent = (bits - root_half) >> 23;
    const Reals mantissa = (Reals)(bits - (exponent << 23));
    const Integers is_small = (exponent - one) >> 31; // all bits where u < sqrt(1/2)
    const Reals excess = (Reals)(((Integers)(mantissa - 1) & is_small) |
                                 ((Integers)(from_one * -0x1p-31f) & ~is_small)); // m - 1

    const Reals s = excess / (excess + 2);
    const Reals z = s * s;
    const Reals series = (0.298719970f * z + 0.399775324f) * z + 0.666667764f;
    const Reals log_mantissa = s * (z * series + 2);
    return square_root(-2 * (real(exponent - one) * 0.693147181f + log_mantissa));
}

// cos and sin of an angle uniform on the circle: 30 bits of `word` place it in (-pi/4, pi/4), one
// exchanges cos and sin, the last changes the sign of both.
KERNEL void direction(Words word, Reals *cosine, Reals *sine) {
    const Reals x = real((Integers)(word << 2 | 2)) * 3.65727646e-10f; // pi/4 2^-31
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

// Two normal numbers from two words. The lowest bits of the angle also extend the radius, which
// the radius shows only beyond 6.6 and the angle only below 1e-4.
KERNEL void normal_pair(Words x, Words y, Reals *first, Reals *second) {
    Reals cosine, sine;
    direction(y, &cosine, &sine);
    const Reals r = radius(x, y);
    *first = r * cosine;
    *second = r * sine;
}

KERNEL void put(Reals from, double *to, size_t count) {
    float lanes[LANES];
    memcpy(lanes, &from, sizeof lanes);
    for (size_t i = 0; i < count; i++) to[i] = (double)lanes[i];
}

// `count` <= LANES numbers per component.
KERNEL void fill_block(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                       double *const normals[3], size_t at) {
    Words id = {0};
    memcpy(&id, ids + at, count * sizeof *ids);
    Reals first, second;
    Words x = id, y = id * 0 + key->step;
    threefry(key->plane, &x, &y);
    normal_pair(x, y, &first, &second);
    put(first, normals[0] + at, count);
    put(second, normals[1] + at, count);
    if (components < 3) return;
    x = id, y = id * 0 + key->step;
    threefry(key->third, &x, &y);
    normal_pair(x, y, &first, &second);
    put(first, normals[2] + at, count);
}

KERNEL void fill(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                 double *const normals[3]) {
    const size_t whole = count - count % LANES;
    for (size_t at = 0; at < whole; at += LANES) {
        fill_block(key, ids, LANES, components, normals, at);
    }
    if (whole < count) fill_block(key, ids, count - whole, components, normals, whole);
}

// Constant arguments fold into two loops.
KERNEL void fill_normals(const NormalsKey *key, const uint32_t *ids, size_t count, int components,
                         double *const normals[3]) {
    if (components == 2) {
        fill(key, ids, count, 2, normals);
    } else {
        fill(key, ids, count, 3, normals);
    }
}
