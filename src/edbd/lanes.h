// SPDX-License-Identifier: GPL-3.0-or-later
// Registers of the instruction set: several pairs at a time in single precision, half as many
// particles in double.
// Each lane does what one pair alone would do, so the number of lanes never shows in a result.
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define LANES 8 // doubles in a register
#elif defined(__AVX2__)
#define LANES 4
#else
#define LANES 2
#endif

#define KERNEL static inline __attribute__((always_inline))

typedef double Lanes __attribute__((vector_size(8 * LANES), aligned(8 * LANES), may_alias));
typedef float Narrow __attribute__((vector_size(4 * LANES), aligned(4 * LANES), may_alias));

KERNEL Lanes lanes_load(const double *from) {
    return *(const Lanes *)from;
}
KERNEL void lanes_store(double *to, Lanes lanes) {
    *(Lanes *)to = lanes;
}
KERNEL Lanes lanes_widen(const float *from) {
    return __builtin_convertvector(*(const Narrow *)from, Lanes);
}

KERNEL Lanes lanes_larger(Lanes a, Lanes b) {
#if LANES == 8
    return (Lanes)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif LANES == 4
    return (Lanes)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
    for (int k = 0; k < LANES; k++) a[k] = a[k] > b[k] ? a[k] : b[k];
    return a;
#endif
}

// Which are outside [0, edge), one bit each.
KERNEL unsigned lanes_outside(Lanes x, double edge) {
    const Lanes bound = edge - (Lanes){0};
#if LANES == 8 // as numbers without a sign, where negative ones are largest
    return _mm512_cmpge_epu64_mask((__m512i)x, (__m512i)bound);
#elif LANES == 4
    return (unsigned)_mm256_movemask_pd((__m256d)((x < 0) | (x >= bound)));
#else
    unsigned bits = 0;
    for (unsigned k = 0; k < LANES; k++) bits |= (unsigned)(x[k] < 0 || x[k] >= bound[k]) << k;
    return bits;
#endif
}

// Four doubles: collisions, and sums over them.
typedef double Quad __attribute__((vector_size(32), aligned(32), may_alias));
typedef int64_t QuadBits __attribute__((vector_size(32)));

KERNEL Quad quads_gather(const double *from, const uint32_t at[4]) {
    return (Quad){from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
}

KERNEL Quad quads_choose(QuadBits which, Quad yes, Quad no) {
    return (Quad)((which & (QuadBits)yes) | (~which & (QuadBits)no));
}

KERNEL Quad quads_sqrt(Quad x) {
#if LANES >= 4
    return (Quad)_mm256_sqrt_pd((__m256d)x);
#else
    for (int k = 0; k < 4; k++) x[k] = sqrt(x[k]);
    return x;
#endif
}

// Which of four are x, one bit each.
KERNEL unsigned fours_equal(const uint32_t at[4], uint32_t x) {
#if defined(__x86_64__)
    const __m128i four = _mm_loadu_si128((const __m128i *)at);
    return (unsigned)_mm_movemask_ps(
        _mm_castsi128_ps(_mm_cmpeq_epi32(four, _mm_set1_epi32((int)x))));
#else
    unsigned bits = 0;
    for (unsigned k = 0; k < 4; k++) bits |= (unsigned)(at[k] == x) << k;
    return bits;
#endif
}

#define WIDE (2 * LANES) // floats at a time

typedef float Wides __attribute__((vector_size(4 * WIDE), aligned(4 * WIDE), may_alias));
typedef int32_t WideBits __attribute__((vector_size(4 * WIDE)));

KERNEL Wides wides_all(float x) {
    return x - (Wides){0};
}

// Which of two sets of numbers are less than the others, one bit each.
KERNEL unsigned wides_less(Wides a, Wides b) {
#if LANES == 8
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
#elif LANES == 4
    return (unsigned)_mm256_movemask_ps((__m256)(a < b));
#elif defined(__x86_64__)
    return (unsigned)_mm_movemask_ps((__m128)(a < b));
#else
    unsigned bits = 0;
    for (unsigned k = 0; k < WIDE; k++) bits |= (unsigned)(a[k] < b[k]) << k;
    return bits;
#endif
}

KERNEL Wides wides_narrow(Lanes low, Lanes high) {
    const Narrow a = __builtin_convertvector(low, Narrow),
                 b = __builtin_convertvector(high, Narrow);
#if LANES == 8
    return (Wides)_mm512_insertf32x8(_mm512_castps256_ps512((__m256)a), (__m256)b, 1);
#elif LANES == 4
    return (Wides)_mm256_insertf128_ps(_mm256_castps128_ps256((__m128)a), (__m128)b, 1);
#else
    return __builtin_shufflevector(a, b, 0, 1, 2, 3);
#endif
}

KERNEL Wides wides_nearest(Wides r, Wides edge) {
    const Wides half = edge * 0.5f;
#if LANES == 8
    const __mmask16 above = (__mmask16)wides_less(half, r), below = (__mmask16)wides_less(r, -half);
    r = (Wides)_mm512_mask_sub_ps((__m512)r, above, (__m512)r, (__m512)edge);
    return (Wides)_mm512_mask_add_ps((__m512)r, below, (__m512)r, (__m512)edge);
#else
    return r - (Wides)((WideBits)edge & (r > half)) + (Wides)((WideBits)edge & (r < -half));
#endif
}

// Separations x of images that are displaced by `offset` for those y across an edge above.
KERNEL Wides wides_lean(Wides x, Wides y, Wides half, Wides offset) {
#if LANES == 8
    const __mmask16 above = (__mmask16)wides_less(half, y), below = (__mmask16)wides_less(y, -half);
    x = (Wides)_mm512_mask_sub_ps((__m512)x, above, (__m512)x, (__m512)offset);
    return (Wides)_mm512_mask_add_ps((__m512)x, below, (__m512)x, (__m512)offset);
#else
    return x - (Wides)((WideBits)offset & (y > half)) + (Wides)((WideBits)offset & (y < -half));
#endif
}

KERNEL Wides wides_load_at(const float *from) { // at any address
    Wides wides;
    memcpy(&wides, from, sizeof wides);
    return wides;
}

KERNEL void wides_store_at(float *to, Wides wides) {
    memcpy(to, &wides, sizeof wides);
}

KERNEL Wides wides_sqrt(Wides x) {
#if LANES == 8
    return (Wides)_mm512_sqrt_ps((__m512)x);
#elif LANES == 4
    return (Wides)_mm256_sqrt_ps((__m256)x);
#elif defined(__x86_64__)
    return (Wides)_mm_sqrt_ps((__m128)x);
#else
    for (int k = 0; k < WIDE; k++) x[k] = sqrtf(x[k]);
    return x;
#endif
}

// Half a register from each of two addresses.
KERNEL Wides wides_load_halves(const float *low, const float *high) {
#if LANES == 8
    return (Wides)_mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(low)),
                                     _mm256_loadu_ps(high), 1);
#elif LANES == 4
    return (Wides)_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)),
                                       _mm_loadu_ps(high), 1);
#else
    return (Wides){low[0], low[1], high[0], high[1]};
#endif
}

// Writes first + k step for each set bit k; room for WIDE numbers is needed.
KERNEL void wides_pack_numbers(uint32_t *to, unsigned bits, uint32_t first, uint32_t step) {
#if LANES == 8
    const __m512i count = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i numbers = _mm512_add_epi32(
        _mm512_set1_epi32((int)first), _mm512_mullo_epi32(count, _mm512_set1_epi32((int)step)));
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32((__mmask16)bits, numbers));
#else
    for (; bits; bits &= bits - 1) *to++ = first + step * (unsigned)__builtin_ctz(bits);
#endif
}

// Writes the numbers of the set bits; room for WIDE is needed.
KERNEL void wides_pack(float *to, unsigned bits, Wides values) {
#if LANES == 8
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps((__mmask16)bits, (__m512)values));
#else
    for (; bits; bits &= bits - 1) *to++ = values[__builtin_ctz(bits)];
#endif
}

// Writes those of WIDE integers whose bits are set; room for WIDE is needed.
KERNEL void wides_pack_u32(uint32_t *to, unsigned bits, const uint32_t *from) {
#if LANES == 8
    const __m512i all = _mm512_loadu_si512(from);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32((__mmask16)bits, all));
#else
    for (; bits; bits &= bits - 1) *to++ = from[__builtin_ctz(bits)];
#endif
}
