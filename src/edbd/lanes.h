// SPDX-License-Identifier: GPL-3.0-or-later
// Several pairs at a time: as many doubles as one vector register of the instruction set holds.
// Each lane does what one pair alone would do, so the number of lanes never shows in a result.
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define LANES 8
#elif defined(__AVX2__)
#define LANES 4
#else
#define LANES 2
#endif

#define KERNEL static inline __attribute__((always_inline))

typedef double Lanes __attribute__((vector_size(8 * LANES), aligned(8 * LANES), may_alias));
typedef int64_t LaneBits __attribute__((vector_size(8 * LANES)));
#if LANES == 8
typedef __mmask8 Where; // one bit per lane
#else
typedef LaneBits Where; // all ones in the lanes where it is true
#endif

KERNEL Lanes lanes_all(double x) {
#if LANES == 8
    return (Lanes){x, x, x, x, x, x, x, x};
#elif LANES == 4
    return (Lanes){x, x, x, x};
#else
    return (Lanes){x, x};
#endif
}
KERNEL Lanes lanes_load(const double *from) {
    return *(const Lanes *)from;
}
KERNEL void lanes_store(double *to, Lanes lanes) {
    *(Lanes *)to = lanes;
}

KERNEL Where lanes_less(Lanes a, Lanes b) {
#if LANES == 8
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
#else
    return a < b;
#endif
}

KERNEL unsigned lanes_bits(Where where) {
#if LANES == 8
    return where;
#elif LANES == 4
    return (unsigned)_mm256_movemask_pd((__m256d)where);
#elif defined(__x86_64__)
    return (unsigned)_mm_movemask_pd((__m128d)where);
#else
    return (unsigned)((where[0] & 1) | (where[1] & 2));
#endif
}

KERNEL Lanes lanes_sqrt(Lanes x) {
#if LANES == 8
    return (Lanes)_mm512_sqrt_pd((__m512d)x);
#elif LANES == 4
    return (Lanes)_mm256_sqrt_pd((__m256d)x);
#elif defined(__x86_64__)
    return (Lanes)_mm_sqrt_pd((__m128d)x);
#else
    return (Lanes){sqrt(x[0]), sqrt(x[1])};
#endif
}

// `x` where it is positive, else 0.
KERNEL Lanes lanes_positive(Lanes x) {
#if LANES == 8
    return (Lanes)_mm512_max_pd((__m512d)x, _mm512_setzero_pd());
#else
    return (Lanes)((LaneBits)x & (x > 0));
#endif
}

// The nearest image of a separation between two points of the box.
KERNEL Lanes lanes_nearest(Lanes r, Lanes edge, Lanes half) {
#if LANES == 8
    const Where above = lanes_less(half, r), below = lanes_less(r, -half);
    r = (Lanes)_mm512_mask_sub_pd((__m512d)r, above, (__m512d)r, (__m512d)edge);
    return (Lanes)_mm512_mask_add_pd((__m512d)r, below, (__m512d)r, (__m512d)edge);
#else
    return r - (Lanes)((LaneBits)edge & (r > half)) + (Lanes)((LaneBits)edge & (r < -half));
#endif
}

// Four doubles, which every instruction set can split or join: half a row in 3D, a row in 2D.
typedef double Quad __attribute__((vector_size(32), aligned(32), may_alias));

// Two doubles: a velocity in 2D.
typedef double Pair __attribute__((vector_size(16), aligned(16), may_alias));
typedef float TwoFloats __attribute__((vector_size(8), aligned(8), may_alias));
typedef float FourFloats __attribute__((vector_size(16), aligned(16), may_alias));

KERNEL Pair pair_widen(const float *from) {
    return __builtin_convertvector(*(const TwoFloats *)from, Pair);
}
#define quad_widen(from) __builtin_convertvector(*(const FourFloats *)(from), Quad)

KERNEL void quad_keep_larger(Quad *most, const Quad *other) {
#if LANES >= 4
    *most = (Quad)_mm256_max_pd((__m256d)*most, (__m256d)*other);
#else
    for (int k = 0; k < 4; k++) (*most)[k] = (*other)[k] > (*most)[k] ? (*other)[k] : (*most)[k];
#endif
}

// Is any of the four outside [least, bound)?
KERNEL int quad_strays(const Quad *x, const Quad *least, const Quad *bound) {
#if LANES >= 4
    return _mm256_movemask_pd((__m256d)((*x < *least) | (*x >= *bound)));
#else
    int strays = 0;
    for (int k = 0; k < 4; k++) strays |= (*x)[k] < (*least)[k] || (*x)[k] >= (*bound)[k];
    return strays;
#endif
}

KERNEL Lanes lanes_load_at(const double *from) { // at any address
    Lanes lanes;
    memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

KERNEL void lanes_store_at(double *to, Lanes lanes) {
    memcpy(to, &lanes, sizeof lanes);
}

// Writes first + k step for each set bit k; room for LANES numbers is needed.
KERNEL void lanes_pack_numbers(uint32_t *to, unsigned bits, uint32_t first, uint32_t step) {
#if LANES == 8
    const __m256i count = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i numbers = _mm256_add_epi32(
        _mm256_set1_epi32((int)first), _mm256_mullo_epi32(count, _mm256_set1_epi32((int)step)));
    _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32((__mmask8)bits, numbers));
#else
    for (; bits; bits &= bits - 1) *to++ = first + step * (unsigned)__builtin_ctz(bits);
#endif
}

// Writes those of LANES integers whose bits are set; room for LANES is needed.
KERNEL void lanes_pack_u32(uint32_t *to, unsigned bits, const uint32_t *from) {
#if LANES == 8
    const __m256i all = _mm256_loadu_si256((const __m256i *)from);
    _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32((__mmask8)bits, all));
#else
    for (; bits; bits &= bits - 1) *to++ = from[__builtin_ctz(bits)];
#endif
}

// Writes the lanes of the set bits; room for LANES values is needed.
KERNEL void lanes_pack_floats(float *to, unsigned bits, Lanes values) {
#if LANES == 8
    const __m256 floats = _mm512_cvtpd_ps((__m512d)values);
    _mm256_storeu_ps(to, _mm256_maskz_compress_ps((__mmask8)bits, floats));
#else
    for (; bits; bits &= bits - 1) *to++ = (float)values[__builtin_ctz(bits)];
#endif
}

KERNEL Lanes lanes_widen(const float *from) {
    typedef float Floats __attribute__((vector_size(4 * LANES), aligned(4 * LANES), may_alias));
    return __builtin_convertvector(*(const Floats *)from, Lanes);
}

// Separations and relative velocities of LANES pairs of rows (edbd/engine.h): rows are subtracted
// whole, the differences then turned into columns.
#if LANES == 8
KERNEL Lanes lanes_two_rows(const double *low, const double *high) {
    return (Lanes)_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(low)),
                                     _mm256_load_pd(high), 1);
}

KERNEL void lanes_separate_2d(const double *const i[LANES], const double *const j[LANES],
                              Lanes r[3], Lanes v[3]) {
    const Lanes a = lanes_two_rows(i[0], i[2]) - lanes_two_rows(j[0], j[2]);
    const Lanes b = lanes_two_rows(i[1], i[3]) - lanes_two_rows(j[1], j[3]);
    const Lanes c = lanes_two_rows(i[4], i[6]) - lanes_two_rows(j[4], j[6]);
    const Lanes d = lanes_two_rows(i[5], i[7]) - lanes_two_rows(j[5], j[7]);
    const Lanes ab0 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes ab1 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes cd0 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes cd1 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    r[0] = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5, 8, 9, 12, 13);
    r[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5, 8, 9, 12, 13);
    v[0] = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7, 10, 11, 14, 15);
    v[1] = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7, 10, 11, 14, 15);
}

KERNEL void lanes_separate_3d(const double *const i[LANES], const double *const j[LANES],
                              Lanes r[3], Lanes v[3]) {
    Lanes low[4], high[4]; // low: x y z R, high: vx vy vz m, of two pairs each
    for (int k = 0; k < 4; k++) {
        const Lanes p = lanes_load(i[k]) - lanes_load(j[k]);
        const Lanes q = lanes_load(i[k + 4]) - lanes_load(j[k + 4]);
        low[k] = __builtin_shufflevector(p, q, 0, 1, 2, 3, 8, 9, 10, 11);
        high[k] = __builtin_shufflevector(p, q, 4, 5, 6, 7, 12, 13, 14, 15);
    }
    for (int part = 0; part < 2; part++) {
        const Lanes *row = part == 0 ? low : high;
        Lanes *column = part == 0 ? r : v;
        const Lanes a = __builtin_shufflevector(row[0], row[1], 0, 8, 2, 10, 4, 12, 6, 14);
        const Lanes b = __builtin_shufflevector(row[0], row[1], 1, 9, 3, 11, 5, 13, 7, 15);
        const Lanes c = __builtin_shufflevector(row[2], row[3], 0, 8, 2, 10, 4, 12, 6, 14);
        const Lanes d = __builtin_shufflevector(row[2], row[3], 1, 9, 3, 11, 5, 13, 7, 15);
        column[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
        column[1] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
        column[2] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
    }
}
#elif LANES == 4
KERNEL void lanes_separate_2d(const double *const i[LANES], const double *const j[LANES],
                              Lanes r[3], Lanes v[3]) {
    Lanes d[LANES];
    for (int k = 0; k < LANES; k++) d[k] = lanes_load(i[k]) - lanes_load(j[k]);
    const Lanes a = __builtin_shufflevector(d[0], d[1], 0, 4, 2, 6);
    const Lanes b = __builtin_shufflevector(d[0], d[1], 1, 5, 3, 7);
    const Lanes e = __builtin_shufflevector(d[2], d[3], 0, 4, 2, 6);
    const Lanes f = __builtin_shufflevector(d[2], d[3], 1, 5, 3, 7);
    r[0] = __builtin_shufflevector(a, e, 0, 1, 4, 5);
    r[1] = __builtin_shufflevector(b, f, 0, 1, 4, 5);
    v[0] = __builtin_shufflevector(a, e, 2, 3, 6, 7);
    v[1] = __builtin_shufflevector(b, f, 2, 3, 6, 7);
}

KERNEL void lanes_separate_3d(const double *const i[LANES], const double *const j[LANES],
                              Lanes r[3], Lanes v[3]) {
    for (int part = 0; part < 2; part++) {
        Lanes d[LANES];
        for (int k = 0; k < LANES; k++) {
            d[k] = lanes_load(i[k] + 4 * part) - lanes_load(j[k] + 4 * part);
        }
        Lanes *column = part == 0 ? r : v;
        const Lanes a = __builtin_shufflevector(d[0], d[1], 0, 4, 2, 6);
        const Lanes b = __builtin_shufflevector(d[0], d[1], 1, 5, 3, 7);
        const Lanes e = __builtin_shufflevector(d[2], d[3], 0, 4, 2, 6);
        const Lanes f = __builtin_shufflevector(d[2], d[3], 1, 5, 3, 7);
        column[0] = __builtin_shufflevector(a, e, 0, 1, 4, 5);
        column[1] = __builtin_shufflevector(b, f, 0, 1, 4, 5);
        column[2] = __builtin_shufflevector(a, e, 2, 3, 6, 7);
    }
}
#else
KERNEL void lanes_two_columns(const double *const i[LANES], const double *const j[LANES], int at,
                              Lanes *first, Lanes *second) {
    const Lanes p = lanes_load(i[0] + at) - lanes_load(j[0] + at);
    const Lanes q = lanes_load(i[1] + at) - lanes_load(j[1] + at);
    *first = __builtin_shufflevector(p, q, 0, 2);
    *second = __builtin_shufflevector(p, q, 1, 3);
}

KERNEL void lanes_separate_2d(const double *const i[LANES], const double *const j[LANES],
                              Lanes r[3], Lanes v[3]) {
    lanes_two_columns(i, j, 0, &r[0], &r[1]);
    lanes_two_columns(i, j, 2, &v[0], &v[1]);
}

KERNEL void lanes_separate_3d(const double *const i[LANES], const double *const j[LANES],
                              Lanes r[3], Lanes v[3]) {
    Lanes unused;
    lanes_two_columns(i, j, 0, &r[0], &r[1]);
    lanes_two_columns(i, j, 2, &r[2], &unused);
    lanes_two_columns(i, j, 4, &v[0], &v[1]);
    lanes_two_columns(i, j, 6, &v[2], &unused);
}
#endif

KERNEL void lanes_separate(const int dimension, const double *const i[LANES],
                           const double *const j[LANES], Lanes r[3], Lanes v[3]) {
    if (dimension == 2)
        lanes_separate_2d(i, j, r, v);
    else
        lanes_separate_3d(i, j, r, v);
}
