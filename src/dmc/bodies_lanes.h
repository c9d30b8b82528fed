// SPDX-License-Identifier: GPL-3.0-or-later
// Several bodies at a time, in single precision: bounds only, nothing exact.
#pragma once

#include "dmc/bodies.h"

#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define WIDTH 16
#elif defined(__AVX2__)
#define WIDTH 8
#else
#define WIDTH 4
#endif

typedef float Floats __attribute__((vector_size(4 * WIDTH)));
typedef int32_t Ints __attribute__((vector_size(4 * WIDTH)));

KERNEL Floats floats_all(float x) {
    return x - (Floats){0};
}
KERNEL Ints ints_load(const void *from) {
    Ints ints;
    memcpy(&ints, from, sizeof ints);
    return ints;
}
KERNEL Floats floats_of(Ints ints) {
    return __builtin_convertvector(ints, Floats);
}

// A bit for each lane where a < b.
KERNEL unsigned floats_below(Floats a, Floats b) {
#if WIDTH == 16
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
#elif WIDTH == 8
    return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ));
#elif defined(__x86_64__)
    return (unsigned)_mm_movemask_ps(_mm_cmplt_ps((__m128)a, (__m128)b));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < WIDTH; lane++) bits |= (unsigned)(a[lane] < b[lane]) << lane;
    return bits;
#endif
}

KERNEL unsigned ints_equal(Ints a, Ints b) {
#if WIDTH == 16
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
#elif WIDTH == 8
    return (unsigned)_mm256_movemask_ps((__m256)(a == b));
#elif defined(__x86_64__)
    return (unsigned)_mm_movemask_ps((__m128)(a == b));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < WIDTH; lane++) bits |= (unsigned)(a[lane] == b[lane]) << lane;
    return bits;
#endif
}

KERNEL Floats floats_larger(Floats a, Floats b) {
#if WIDTH == 16
    return (Floats)_mm512_max_ps((__m512)a, (__m512)b);
#elif WIDTH == 8
    return (Floats)_mm256_max_ps((__m256)a, (__m256)b);
#elif defined(__x86_64__)
    return (Floats)_mm_max_ps((__m128)a, (__m128)b);
#else
    for (int lane = 0; lane < WIDTH; lane++) a[lane] = a[lane] > b[lane] ? a[lane] : b[lane];
    return a;
#endif
}

KERNEL Floats floats_smaller(Floats a, Floats b) {
    return -floats_larger(-a, -b);
}

KERNEL Floats floats_within(Floats x, Floats bound) {
#if WIDTH == 16
    return (Floats)_mm512_min_ps(_mm512_max_ps((__m512)x, (__m512)-bound), (__m512)bound);
#elif WIDTH == 8
    return (Floats)_mm256_min_ps(_mm256_max_ps((__m256)x, (__m256)-bound), (__m256)bound);
#elif defined(__x86_64__)
    return (Floats)_mm_min_ps(_mm_max_ps((__m128)x, (__m128)-bound), (__m128)bound);
#else
    return floats_smaller(floats_larger(x, -bound), bound);
#endif
}

// To a few parts in ten thousand.
KERNEL Floats floats_reciprocal(Floats x) {
#if WIDTH == 16
    return (Floats)_mm512_rcp14_ps((__m512)x);
#elif WIDTH == 8
    return (Floats)_mm256_rcp_ps((__m256)x);
#elif defined(__x86_64__)
    return (Floats)_mm_rcp_ps((__m128)x);
#else
    return 1 / x;
#endif
}

KERNEL Floats floats_sqrt(Floats x) {
#if WIDTH == 16
    return (Floats)_mm512_sqrt_ps((__m512)x);
#elif WIDTH == 8
    return (Floats)_mm256_sqrt_ps((__m256)x);
#elif defined(__x86_64__)
    return (Floats)_mm_sqrt_ps((__m128)x);
#else
    for (int lane = 0; lane < WIDTH; lane++) x[lane] = __builtin_sqrtf(x[lane]);
    return x;
#endif
}

KERNEL Floats floats_absolute(Floats x) {
    return (Floats)((Ints)x & 0x7fffffff);
}

// Writes those ids whose bits are set; room for WIDTH of them is needed.
KERNEL void ids_pack(uint32_t *to, unsigned bits, const uint32_t *from) {
#if WIDTH == 16
    const __m512i all = _mm512_loadu_si512(from);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32((__mmask16)bits, all));
#else
    for (; bits; bits &= bits - 1) *to++ = from[__builtin_ctz(bits)];
#endif
}

// Four numbers of each of WIDTH rows, `at` words from their beginning, as four vectors.
#if WIDTH == 16
KERNEL __m512i quads_load(const BodyRow *rows, const uint32_t *ids, size_t at) {
    __m512i quads = _mm512_castsi128_si512(_mm_load_si128((const __m128i *)&rows[ids[0]] + at));
    quads = _mm512_inserti32x4(quads, _mm_load_si128((const __m128i *)&rows[ids[4]] + at), 1);
    quads = _mm512_inserti32x4(quads, _mm_load_si128((const __m128i *)&rows[ids[8]] + at), 2);
    return _mm512_inserti32x4(quads, _mm_load_si128((const __m128i *)&rows[ids[12]] + at), 3);
}
#define UNPACK(type, end, a, b) (Ints) _mm512_unpack##end##_epi##type((__m512i)(a), (__m512i)(b))
#elif WIDTH == 8
KERNEL __m256i quads_load(const BodyRow *rows, const uint32_t *ids, size_t at) {
    const __m256i quads =
        _mm256_castsi128_si256(_mm_load_si128((const __m128i *)&rows[ids[0]] + at));
    return _mm256_inserti128_si256(quads, _mm_load_si128((const __m128i *)&rows[ids[4]] + at), 1);
}
#define UNPACK(type, end, a, b) (Ints) _mm256_unpack##end##_epi##type((__m256i)(a), (__m256i)(b))
#elif defined(__x86_64__)
KERNEL __m128i quads_load(const BodyRow *rows, const uint32_t *ids, size_t at) {
    return _mm_load_si128((const __m128i *)&rows[ids[0]] + at);
}
#define UNPACK(type, end, a, b) (Ints) _mm_unpack##end##_epi##type((__m128i)(a), (__m128i)(b))
#endif

KERNEL void rows_load_four(const BodyRow *rows, const uint32_t *ids, size_t at, Ints four[4]) {
#if defined(UNPACK)
    const Ints a = (Ints)quads_load(rows, ids, at), b = (Ints)quads_load(rows, ids + 1, at);
    const Ints c = (Ints)quads_load(rows, ids + 2, at), d = (Ints)quads_load(rows, ids + 3, at);
    const Ints ab_low = UNPACK(32, lo, a, b), ab_high = UNPACK(32, hi, a, b);
    const Ints cd_low = UNPACK(32, lo, c, d), cd_high = UNPACK(32, hi, c, d);
    four[0] = UNPACK(64, lo, ab_low, cd_low);
    four[1] = UNPACK(64, hi, ab_low, cd_low);
    four[2] = UNPACK(64, lo, ab_high, cd_high);
    four[3] = UNPACK(64, hi, ab_high, cd_high);
#else
    for (int lane = 0; lane < WIDTH; lane++) {
        int32_t words[4];
        memcpy(words, (const char *)&rows[ids[lane]] + 16 * at, sizeof words);
        for (int k = 0; k < 4; k++) four[k][lane] = words[k];
    }
#endif
}

// WIDTH rows side by side.
typedef struct Rows {
    Ints place[3];
    Floats axis[3], radius, core;
} Rows;

KERNEL Rows rows_load(const BodyRow *rows, const uint32_t *ids) {
    Ints low[4], high[4];
    rows_load_four(rows, ids, 0, low);
    rows_load_four(rows, ids, 1, high);
    return (Rows){.place = {low[0], low[1], low[2]},
                  .axis = {(Floats)low[3], (Floats)high[0], (Floats)high[1]},
                  .radius = (Floats)high[2],
                  .core = (Floats)high[3]};
}
