// SPDX-License-Identifier: GPL-3.0-or-later
// Coarse places of neighbours, a register of them at a time, with AVX2 and AVX-512.
#pragma once

#include "dmc/balls.h"

#if defined(__AVX2__)

#include <immintrin.h>

#define KERNEL static inline __attribute__((always_inline))

// A row has four words: coarse x, y, z and minus a radius. Lanes are numbers of 32 bits, one for
// each row; they come in another order than the rows, but the first comes first.
#if defined(__AVX512F__)

enum { LANES = 16 };
typedef __m512i Whole;
typedef __m512 Real;

KERNEL Whole all(int32_t x) {
    return _mm512_set1_epi32(x);
}

KERNEL Real all_real(float x) {
    return _mm512_set1_ps(x);
}

// `others`, but for the first lane.
KERNEL Whole first_and(int32_t first, Whole others) {
    return _mm512_mask_set1_epi32(others, 1, first);
}

KERNEL Whole all_rows(uint64_t row) {
    return _mm512_set1_epi64((int64_t)row);
}

KERNEL Whole all_rows_low(__m128i row) {
    return _mm512_broadcastq_epi64(row);
}

KERNEL Whole half_of_rows(const uint64_t *table, const uint32_t *ids) {
    return _mm512_i32gather_epi64(_mm256_load_si256((const __m256i *)ids), (const void *)table, 8);
}

// One bit for each of as many ids as there are lanes.
KERNEL unsigned ids_equal(const uint32_t *ids, uint32_t i) {
    return _mm512_cmpeq_epi32_mask(_mm512_load_si512(ids), _mm512_set1_epi32((int)i));
}

// The row of i, where it is among the ids, anew.
KERNEL Whole half_with(Whole half, const uint32_t *ids, uint32_t i, Whole row) {
    const __m256i eight = _mm256_load_si256((const __m256i *)ids);
    return _mm512_mask_mov_epi64(half, _mm256_cmpeq_epi32_mask(eight, _mm256_set1_epi32((int)i)),
                                 row);
}

KERNEL Whole words_less(Whole a, Whole b) {
    return _mm512_sub_epi16(a, b);
}

KERNEL Whole words_scaled(Whole words, Whole scale) {
    return _mm512_mulhrs_epi16(words, scale);
}

// x x' + y y'; z z' + w w' of each row.
KERNEL Whole products(Whole a, Whole b) {
    return _mm512_madd_epi16(a, b);
}

KERNEL Whole first_of_pairs(Whole low, Whole high) {
    return (Whole)_mm512_shuffle_ps((Real)low, (Real)high, 0x88);
}

KERNEL Whole second_of_pairs(Whole low, Whole high) {
    return (Whole)_mm512_shuffle_ps((Real)low, (Real)high, 0xdd);
}

KERNEL Whole sums(Whole a, Whole b) {
    return _mm512_add_epi32(a, b);
}

KERNEL Whole upper_words(Whole a) {
    return _mm512_srai_epi32(a, 16);
}

// Without a sign, up to 2^31; or else as much or more.
KERNEL Real reals(Whole a) {
    return _mm512_cvtepu32_ps(a);
}

KERNEL Real least(Real a, Real b) {
    return _mm512_min_ps(a, b);
}

KERNEL Real roots(Real a) {
    return _mm512_sqrt_ps(a);
}

static const float INVERSE_OFF = 0x1p-14f; // error relative to it

KERNEL Real inverse(Real a) {
    return _mm512_rcp14_ps(a);
}

// Lane by lane, which entry of as many.
KERNEL Whole lane_order(void) {
    return _mm512_setr_epi32(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
}

// What a table has of each.
KERNEL Real reals_of(const float *table, const uint32_t *ids) {
    const Whole in_order = _mm512_permutexvar_epi32(lane_order(), _mm512_loadu_si512(ids));
    return _mm512_i32gather_ps(in_order, table, 4);
}

// Adds the lanes of entries n, n + 1, ..., but of neighbours only: not of the first, and before
// `entries`.
KERNEL Real plus_neighbours(Real sum, Real a, uint32_t n, uint32_t entries) {
    const Whole behind = _mm512_add_epi32(lane_order(), all((int32_t)n - 1));
    return _mm512_mask_add_ps(sum, _mm512_cmplt_epu32_mask(behind, all((int32_t)entries - 1)), sum,
                              a);
}

KERNEL void two_sums(Real a, Real b, float sum[2]) {
    const __m512 eights =
        _mm512_add_ps(_mm512_shuffle_f32x4(a, b, 0x44), _mm512_shuffle_f32x4(a, b, 0xee));
    const __m256 fours =
        _mm256_add_ps(_mm512_castps512_ps256(_mm512_shuffle_f32x4(eights, eights, 0x08)),
                      _mm512_castps512_ps256(_mm512_shuffle_f32x4(eights, eights, 0x0d))); // a; b
    const __m256 twos = _mm256_add_ps(fours, _mm256_permute_ps(fours, 0x4e));
    const __m256 ones = _mm256_add_ps(twos, _mm256_permute_ps(twos, 0xb1));
    sum[0] = _mm256_cvtss_f32(ones);
    sum[1] = _mm_cvtss_f32(_mm256_extractf128_ps(ones, 1));
}

// One bit for each lane.
KERNEL unsigned below(bool has_sign, Whole a, Whole bound) {
    return has_sign ? _mm512_cmplt_epi32_mask(a, bound) : _mm512_cmplt_epu32_mask(a, bound);
}

// The lower words of four numbers of 64 bits.
KERNEL __m128i lower_words(__m256i a) {
    return _mm256_cvtepi64_epi16(a);
}

#else

enum { LANES = 8 };
typedef __m256i Whole;
typedef __m256 Real;

KERNEL Whole all(int32_t x) {
    return _mm256_set1_epi32(x);
}

KERNEL Real all_real(float x) {
    return _mm256_set1_ps(x);
}

KERNEL Whole first_and(int32_t first, Whole others) {
    return _mm256_blend_epi32(others, all(first), 1);
}

KERNEL Whole all_rows(uint64_t row) {
    return _mm256_set1_epi64x((int64_t)row);
}

KERNEL Whole all_rows_low(__m128i row) {
    return _mm256_broadcastq_epi64(row);
}

KERNEL Whole half_of_rows(const uint64_t *table, const uint32_t *ids) {
    return _mm256_i32gather_epi64((const void *)table, _mm_load_si128((const __m128i *)ids), 8);
}

KERNEL unsigned ids_equal(const uint32_t *ids, uint32_t i) {
    const __m256i same = _mm256_cmpeq_epi32(_mm256_load_si256((const __m256i *)ids), all((int)i));
    return (unsigned)_mm256_movemask_ps((Real)same);
}

KERNEL Whole half_with(Whole half, const uint32_t *ids, uint32_t i, Whole row) {
    const __m128i four = _mm_load_si128((const __m128i *)ids);
    const __m128i same = _mm_cmpeq_epi32(four, _mm_set1_epi32((int)i));
    return _mm256_blendv_epi8(half, row, _mm256_cvtepi32_epi64(same));
}

KERNEL Whole words_less(Whole a, Whole b) {
    return _mm256_sub_epi16(a, b);
}

KERNEL Whole words_scaled(Whole words, Whole scale) {
    return _mm256_mulhrs_epi16(words, scale);
}

KERNEL Whole products(Whole a, Whole b) {
    return _mm256_madd_epi16(a, b);
}

KERNEL Whole first_of_pairs(Whole low, Whole high) {
    return (Whole)_mm256_shuffle_ps((Real)low, (Real)high, 0x88);
}

KERNEL Whole second_of_pairs(Whole low, Whole high) {
    return (Whole)_mm256_shuffle_ps((Real)low, (Real)high, 0xdd);
}

KERNEL Whole sums(Whole a, Whole b) {
    return _mm256_add_epi32(a, b);
}

KERNEL Whole upper_words(Whole a) {
    return _mm256_srai_epi32(a, 16);
}

KERNEL Real reals(Whole a) {
    return _mm256_cvtepi32_ps(_mm256_min_epu32(a, all(INT32_MAX)));
}

KERNEL Real least(Real a, Real b) {
    return _mm256_min_ps(a, b);
}

KERNEL Real roots(Real a) {
    return _mm256_sqrt_ps(a);
}

static const float INVERSE_OFF = 0x1.8p-12f;

KERNEL Real inverse(Real a) {
    return _mm256_rcp_ps(a);
}

KERNEL Whole lane_order(void) {
    return _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7);
}

KERNEL Real reals_of(const float *table, const uint32_t *ids) {
    const Whole eight = _mm256_load_si256((const __m256i *)ids);
    return _mm256_i32gather_ps(table, _mm256_permutevar8x32_epi32(eight, lane_order()), 4);
}

KERNEL Real plus_neighbours(Real sum, Real a, uint32_t n, uint32_t entries) {
    const Whole entry = _mm256_add_epi32(lane_order(), all((int32_t)n));
    const Whole real = _mm256_and_si256(_mm256_cmpgt_epi32(entry, all(0)),
                                        _mm256_cmpgt_epi32(all((int32_t)entries), entry));
    return _mm256_add_ps(sum, _mm256_and_ps((Real)real, a));
}

KERNEL void two_sums(Real a, Real b, float sum[2]) {
    const __m256 fours =
        _mm256_add_ps(_mm256_permute2f128_ps(a, b, 0x20), _mm256_permute2f128_ps(a, b, 0x31));
    const __m256 twos = _mm256_add_ps(fours, _mm256_permute_ps(fours, 0x4e));
    const __m256 ones = _mm256_add_ps(twos, _mm256_permute_ps(twos, 0xb1));
    sum[0] = _mm256_cvtss_f32(ones);
    sum[1] = _mm_cvtss_f32(_mm256_extractf128_ps(ones, 1));
}

KERNEL unsigned below(bool has_sign, Whole a, Whole bound) {
    const Whole flip = all(has_sign ? 0 : INT32_MIN);
    const Whole less = _mm256_cmpgt_epi32(_mm256_xor_si256(bound, flip), _mm256_xor_si256(a, flip));
    return (unsigned)_mm256_movemask_ps((Real)less);
}

KERNEL __m128i lower_words(__m256i a) {
    const __m256i pairs = _mm256_shuffle_epi8(
        a, _mm256_setr_epi8(0, 1, 8, 9, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 1, 8, 9,
                            -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1));
    return _mm_unpacklo_epi32(_mm256_castsi256_si128(pairs), _mm256_extracti128_si256(pairs, 1));
}

#endif
#endif
