// SPDX-License-Identifier: GPL-3.0-or-later
// The hot loop of the chain of balls, compiled once per instruction set; all give the same bits,
// because integers and the rules of balls.h decide.
#pragma once

#include "dmc/balls.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

enum { FELT_AT_A_TIME = 128 }; // soft neighbours

#define KERNEL static inline __attribute__((always_inline))

// The trials of a block, drawn together.

KERNEL uint32_t particle_of(const Balls *balls, uint32_t word) {
    return (uint32_t)((word * (uint64_t)balls->count) >> 32);
}

// A word made odd is an integer distributed evenly about 0, and so is its product, rounded: a step
// and its opposite are equally likely.
KERNEL void draw_uniform(Balls *balls, const uint32_t *words) {
    for (size_t t = 0; t < TRIALS_PER_BLOCK; t++) {
        const float *step = balls->step[balls->ball[balls->who[t]].species];
#if defined(__x86_64__)
        const __m128i odd =
            _mm_or_si128(_mm_loadu_si128((const __m128i *)(words + 4 * t)), _mm_set1_epi32(1));
        const __m128 moved = _mm_mul_ps(_mm_cvtepi32_ps(odd), _mm_loadu_ps(step));
        _mm_store_si128((__m128i *)balls->move[t], _mm_cvtps_epi32(moved));
#else
        for (int a = 0; a < 4; a++) {
            const int32_t odd = (int32_t)(words[4 * t + (size_t)a] | 1);
            balls->move[t][a] = (int32_t)rintf((float)odd * step[a]);
        }
#endif
    }
}

KERNEL void draw_normal(Balls *balls) {
    for (size_t t = 0; t < TRIALS_PER_BLOCK; t++) {
        const double *width = balls->normal[balls->ball[balls->who[t]].species];
        double length2 = 0;
        for (int a = 0; a < balls->dimension; a++) {
            balls->move[t][a] = (int32_t)rint(balls->normals[a][t] * width[a]);
            const double r = balls->move[t][a] * balls->unit[a];
            length2 += r * r;
        }
        if (length2 > balls->stride * balls->stride) balls->who[t] |= STRAYS;
    }
}

// Uniform steps are all shorter than the lists allow, or, if they are very long, perhaps none.
KERNEL void mark_strays(Balls *balls) {
    if (balls->longest * sqrt(balls->dimension) < balls->stride) return;
    for (size_t t = 0; t < TRIALS_PER_BLOCK; t++) {
        double length2 = 0;
        for (int a = 0; a < balls->dimension; a++) {
            const double r = balls->move[t][a] * balls->unit[a];
            length2 += r * r;
        }
        if (length2 > balls->stride * balls->stride) balls->who[t] |= STRAYS;
    }
}

// -ln u in energy units, rounded down, for u = (word + 1/2)/2^32: with 2^32 u = m 2^e, sqrt(1/2) <=
// m < sqrt 2, by ln m = 2 artanh((m - 1)/(m + 1)).
KERNEL void draw_energies(Balls *balls, const uint32_t *words) {
    const double ln_2 = 0.69314718055994530942;
    const int64_t root_half = 0x3fe6a09e667f3bcc; // bits of sqrt(1/2)
    for (size_t t = 0; t < TRIALS_PER_BLOCK; t++) {
        const double x = (double)words[t] + 0.5;
        int64_t bits;
        memcpy(&bits, &x, sizeof bits);
        const int64_t above = bits - root_half, e = above >> 52;
        bits -= above & ~((1ll << 52) - 1);
        double m;
        memcpy(&m, &bits, sizeof m);
        const double s = (m - 1) / (m + 1), z = s * s;
        double series = 2.0 / 19;
        for (int k = 17; k >= 1; k -= 2) series = series * z + 2.0 / k;
        balls->affordable[t] =
            (int32_t)(((double)(int32_t)(32 - e) * ln_2 - s * series) * ENERGY_UNITS);
    }
}

KERNEL void draw(Balls *balls, const uint32_t *words, const uint32_t *metropolis) {
    for (size_t t = 0; t < TRIALS_PER_BLOCK; t++) {
        balls->who[t] = particle_of(balls, words[4 * t + 3]);
    }
    if (balls->settings.gaussian) {
        draw_normal(balls);
    } else {
        draw_uniform(balls, words);
        mark_strays(balls);
    }
    if (balls->soft) draw_energies(balls, metropolis);
}

// Hard balls.

#if defined(__AVX2__)
KERNEL uint64_t coarse_of(__m128i place) {
    const __m128i half = _mm_setr_epi32(0x8000, 0x8000, 0x8000, 0);
    const __m128i upper = _mm_srli_epi32(_mm_add_epi32(place, half), 16);
    return (uint64_t)_mm_cvtsi128_si64(_mm_packus_epi32(upper, upper));
}
#endif

// Coarse place of a trial, with plus the radius of the particle: the difference to a neighbour's
// has the sum of the radii.
KERNEL uint64_t coarse_trial(const bool alike, uint64_t own, const uint32_t to[4]) {
#if defined(__AVX2__)
    const uint64_t coarse = coarse_of(_mm_load_si128((const __m128i *)to));
#else
    const uint64_t coarse = balls_coarse(to);
#endif
    return alike ? coarse : coarse | (0x10000 - (own >> 48)) << 48;
}

// One bit for each of sixteen neighbours.
typedef struct Judged {
    unsigned near; // it may overlap
    unsigned sure; // it does
} Judged;

KERNEL uint64_t coarse_scales(const Balls *balls) {
    const int16_t *f = balls->coarse_scale;
    return (uint64_t)(uint16_t)f[0] | (uint64_t)(uint16_t)f[1] << 16 |
           (uint64_t)(uint16_t)f[2] << 32;
}

#if defined(__AVX512F__)

KERNEL __m512i rows_of(const Balls *balls, const uint32_t *ids) {
    return _mm512_i32gather_epi64(_mm256_loadu_si256((const __m256i *)ids),
                                  (const void *)balls->coarse, 8);
}

// Sums of the four products of each row, of two times eight rows.
KERNEL __m512i sums_of(__m512i low, __m512i high) {
    const __m512 a = (__m512)low, b = (__m512)high;
    return _mm512_add_epi32((__m512i)_mm512_shuffle_ps(a, b, 0x88),
                            (__m512i)_mm512_shuffle_ps(a, b, 0xdd));
}

KERNEL Judged judge(const bool alike, const Balls *balls, uint64_t trial, const uint32_t *ids) {
    const __m512i own = _mm512_set1_epi64((int64_t)trial);
    __m512i low = _mm512_sub_epi16(own, rows_of(balls, ids));
    __m512i high = _mm512_sub_epi16(own, rows_of(balls, ids + 8));
    if (alike) {
        const __m512i r2 = sums_of(_mm512_madd_epi16(low, low), _mm512_madd_epi16(high, high));
        return (Judged){_mm512_cmplt_epu32_mask(r2, _mm512_set1_epi32((int)balls->below)),
                        _mm512_cmplt_epu32_mask(r2, _mm512_set1_epi32((int)balls->sure))};
    }
    const uint64_t scale = coarse_scales(balls);
    const __m512i plus = _mm512_set1_epi64((int64_t)(scale | 24576ull << 48));
    const __m512i minus = _mm512_set1_epi64((int64_t)(scale | (65536ull - 24576) << 48));
    const __m512i q = sums_of(
        _mm512_madd_epi16(_mm512_mulhrs_epi16(low, plus), _mm512_mulhrs_epi16(low, minus)),
        _mm512_madd_epi16(_mm512_mulhrs_epi16(high, plus), _mm512_mulhrs_epi16(high, minus)));
    return (Judged){_mm512_cmplt_epi32_mask(q, _mm512_set1_epi32(balls->doubt)),
                    _mm512_cmplt_epi32_mask(q, _mm512_set1_epi32(-balls->doubt))};
}

#elif defined(__AVX2__)

KERNEL __m256i rows_of(const Balls *balls, const uint32_t *ids) {
    return _mm256_i32gather_epi64((const void *)balls->coarse,
                                  _mm_loadu_si128((const __m128i *)ids), 8);
}

KERNEL __m256i sums_of(__m256i low, __m256i high) {
    const __m256 a = (__m256)low, b = (__m256)high;
    return _mm256_add_epi32((__m256i)_mm256_shuffle_ps(a, b, 0x88),
                            (__m256i)_mm256_shuffle_ps(a, b, 0xdd));
}

KERNEL unsigned bits_below(__m256i x, int32_t bound) {
    return (unsigned)_mm256_movemask_ps((__m256)_mm256_cmpgt_epi32(_mm256_set1_epi32(bound), x));
}

// The lanes are in another order than the neighbours: bit b is neighbour ORDER[b] of eight.
KERNEL Judged judge(const bool alike, const Balls *balls, uint64_t trial, const uint32_t *ids) {
    const __m256i own = _mm256_set1_epi64x((int64_t)trial);
    const __m256i flip = _mm256_set1_epi32(INT32_MIN); // compares as if unsigned
    const uint64_t scale = coarse_scales(balls);
    const __m256i plus = _mm256_set1_epi64x((int64_t)(scale | 24576ull << 48));
    const __m256i minus = _mm256_set1_epi64x((int64_t)(scale | (65536ull - 24576) << 48));
    Judged judged = {0, 0};
    for (int half = 0; half < 2; half++) {
        const __m256i low = _mm256_sub_epi16(own, rows_of(balls, ids + 8 * half));
        const __m256i high = _mm256_sub_epi16(own, rows_of(balls, ids + 8 * half + 4));
        if (alike) {
            const __m256i r2 = _mm256_xor_si256(
                sums_of(_mm256_madd_epi16(low, low), _mm256_madd_epi16(high, high)), flip);
            judged.near |= bits_below(r2, (int32_t)(balls->below ^ 0x80000000)) << (8 * half);
            judged.sure |= bits_below(r2, (int32_t)(balls->sure ^ 0x80000000)) << (8 * half);
        } else {
            const __m256i q = sums_of(
                _mm256_madd_epi16(_mm256_mulhrs_epi16(low, plus), _mm256_mulhrs_epi16(low, minus)),
                _mm256_madd_epi16(_mm256_mulhrs_epi16(high, plus),
                                  _mm256_mulhrs_epi16(high, minus)));
            judged.near |= bits_below(q, balls->doubt) << (8 * half);
            judged.sure |= bits_below(q, -balls->doubt) << (8 * half);
        }
    }
    return judged;
}

#endif

#if defined(__AVX2__)

// Which neighbour of sixteen a bit means: the sums of AVX registers come in blocks of two rows.
KERNEL size_t neighbour_of_bit(unsigned bit) {
#if defined(__AVX512F__)
    static const unsigned char order[16] = {0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15};
#else
    static const unsigned char order[16] = {0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15};
#endif
    return order[bit];
}

// The few that coarse distances leave in doubt.
static __attribute__((noinline)) bool any_overlaps(const Balls *balls, uint32_t i,
                                                   const uint32_t to[4], const uint32_t *ids,
                                                   unsigned bits) {
    for (; bits; bits &= bits - 1) {
        const size_t k = neighbour_of_bit((unsigned)__builtin_ctz(bits));
        if (balls_overlap(balls, i, to, ids[k])) return true;
    }
    return false;
}

KERNEL bool overlaps(const bool alike, const Balls *balls, uint32_t i, const uint32_t to[4],
                     uint64_t trial) {
    const uint32_t *list = balls->list + i * balls->room;
    const uint32_t neighbours = balls->ball[i].neighbours;
    for (size_t n = 0; n < neighbours; n += NEIGHBOURS_AT_A_TIME) {
        const Judged judged = judge(alike, balls, trial, list + n);
        if (judged.sure) return true;
        if (__builtin_expect(judged.near != 0, 0) &&
            any_overlaps(balls, i, to, list + n, judged.near)) {
            return true;
        }
    }
    return false;
}

#else

// Without vectors the coarse distances gain nothing.
KERNEL bool overlaps(const bool alike, const Balls *balls, uint32_t i, const uint32_t to[4],
                     uint64_t trial) {
    (void)alike, (void)trial;
    const uint32_t *list = balls->list + i * balls->room;
    for (uint32_t n = 0; n < balls->ball[i].neighbours; n++) {
        if (balls_overlap(balls, i, to, list[n])) return true;
    }
    return false;
}

#endif

// Of ids, those whose coarse places are within `far` of `own`, or those beyond; the order stays.
// The places are in rows, beside the ids, or else in a table of all. The same from both of a pair.
// Room for `count` + 8 is needed.

#if defined(__AVX512F__)

KERNEL size_t ids_by_distance(const Balls *balls, bool within, const uint64_t *rows,
                              const uint64_t *table, uint64_t own, uint32_t far,
                              const uint32_t *ids, size_t count, uint32_t *found) {
    const __m512i mine = _mm512_set1_epi64((int64_t)own);
    const __m512i scale = _mm512_set1_epi64((int64_t)coarse_scales(balls));
    size_t number = 0;
    for (size_t n = 0; n < count; n += 8) {
        const __m256i eight = _mm256_loadu_si256((const __m256i *)(ids + n));
        const __m512i theirs = rows ? _mm512_loadu_si512(rows + n)
                                    : _mm512_i32gather_epi64(eight, (const void *)table, 8);
        const __m512i apart =
            _mm512_mulhrs_epi16(_mm512_abs_epi16(_mm512_sub_epi16(mine, theirs)), scale);
        const __m512i two = _mm512_madd_epi16(apart, apart);
        const __m512i r2 = _mm512_add_epi64(_mm512_srli_epi64(two, 32),
                                            _mm512_and_si512(two, _mm512_set1_epi64(0xffffffff)));
        const __mmask8 real = count - n < 8 ? (__mmask8)((1u << (count - n)) - 1) : 0xff;
        const __mmask8 near = _mm512_cmple_epu64_mask(r2, _mm512_set1_epi64((int64_t)far));
        const __mmask8 bits = (__mmask8)(real & (within ? near : ~near));
        _mm256_storeu_si256((__m256i *)(found + number), _mm256_maskz_compress_epi32(bits, eight));
        number += (size_t)__builtin_popcount(bits);
    }
    return number;
}

#elif defined(__AVX2__)

KERNEL size_t ids_by_distance(const Balls *balls, bool within, const uint64_t *rows,
                              const uint64_t *table, uint64_t own, uint32_t far,
                              const uint32_t *ids, size_t count, uint32_t *found) {
    const __m256i mine = _mm256_set1_epi64x((int64_t)own);
    const __m256i scale = _mm256_set1_epi64x((int64_t)coarse_scales(balls));
    size_t number = 0;
    for (size_t n = 0; n < count; n += 4) {
        const __m128i four = _mm_loadu_si128((const __m128i *)(ids + n));
        const __m256i theirs = rows ? _mm256_loadu_si256((const __m256i *)(rows + n))
                                    : _mm256_i32gather_epi64((const void *)table, four, 8);
        const __m256i apart =
            _mm256_mulhrs_epi16(_mm256_abs_epi16(_mm256_sub_epi16(mine, theirs)), scale);
        const __m256i two = _mm256_madd_epi16(apart, apart);
        const __m256i r2 = _mm256_add_epi64(_mm256_srli_epi64(two, 32),
                                            _mm256_and_si256(two, _mm256_set1_epi64x(0xffffffff)));
        const __m256i beyond = _mm256_cmpgt_epi64(r2, _mm256_set1_epi64x(far));
        const unsigned others = (unsigned)_mm256_movemask_pd(_mm256_castsi256_pd(beyond));
        const unsigned real = count - n < 4 ? (1u << (count - n)) - 1 : 15;
        const unsigned bits = real & (within ? ~others : others);
        for (unsigned k = 0; k < 4; k++) {
            found[number] = ids[n + k];
            number += bits >> k & 1;
        }
    }
    return number;
}

#else

KERNEL size_t ids_by_distance(const Balls *balls, bool within, const uint64_t *rows,
                              const uint64_t *table, uint64_t own, uint32_t far,
                              const uint32_t *ids, size_t count, uint32_t *found) {
    size_t number = 0;
    for (size_t n = 0; n < count; n++) {
        const uint64_t theirs = rows ? rows[n] : table[ids[n]];
        uint32_t r2 = 0;
        for (int a = 0; a < 3; a++) {
            const int32_t apart = abs((int16_t)((own >> (16 * a)) - (theirs >> (16 * a))));
            const int32_t scaled = (apart * balls->coarse_scale[a]) >> 15;
            r2 += (uint32_t)(scaled * scaled);
        }
        found[number] = ids[n];
        number += (r2 <= far) == within;
    }
    return number;
}

#endif

// Soft balls.

#if defined(__AVX512F__)

KERNEL __m512 square_of(const Balls *balls, const __m512i at[3], const uint32_t place[4]) {
    __m512 r2 = _mm512_setzero_ps();
    for (int a = 0; a < 3; a++) {
        const __m512i apart = _mm512_sub_epi32(_mm512_set1_epi32((int)place[a]), at[a]);
        const __m512 r =
            _mm512_mul_ps(_mm512_cvtepi32_ps(apart), _mm512_set1_ps(balls->unit_single[a]));
        r2 = a == 0 ? _mm512_mul_ps(r, r) : _mm512_add_ps(r2, _mm512_mul_ps(r, r));
    }
    return r2;
}

KERNEL __m512i energies(const Balls *balls, __m512 contact2, __m512 r2) {
    const __m512 y = _mm512_div_ps(contact2, r2);
    __m512 power = balls->exponent & 1 ? _mm512_sqrt_ps(y) : _mm512_set1_ps(1), square = y;
    for (int n = balls->exponent / 2; n > 0; n /= 2) {
        if (n & 1) power = _mm512_mul_ps(power, square);
        square = _mm512_mul_ps(square, square);
    }
    power = _mm512_mul_ps(power, _mm512_set1_ps((float)ENERGY_UNITS));
    return _mm512_cvtps_epi32(_mm512_min_ps(power, _mm512_set1_ps((float)ENERGY_MOST)));
}

// Of sixteen at most. Lanes without a neighbour hold the particle itself: infinite powers cost
// nothing, tiny ones would.
KERNEL int64_t rise_of_sixteen(const Balls *balls, uint32_t i, const uint32_t to[4], __m512i ids,
                               __mmask16 real) {
    const Ball *ball = &balls->ball[i];
    const __m512 radius = _mm512_set1_ps(balls->radius_single[i]);
    __m512i at[3];
    for (int a = 0; a < 3; a++) at[a] = _mm512_i32gather_epi32(ids, balls->column[a], 4);
    const __m512 contact =
        balls->alike ? _mm512_add_ps(radius, radius)
                     : _mm512_add_ps(radius, _mm512_i32gather_ps(ids, balls->radius_single, 4));
    const __m512 contact2 = _mm512_mul_ps(contact, contact);
    const __m512i after = energies(balls, contact2, square_of(balls, at, to));
    const __m512i before = energies(balls, contact2, square_of(balls, at, ball->place));
    return _mm512_reduce_add_epi32(_mm512_maskz_sub_epi32(real, after, before));
}

KERNEL int64_t energy_rise(const Balls *balls, uint32_t i, const uint32_t to[4],
                           const uint32_t *list, size_t neighbours) {
    int64_t rise = 0;
    for (size_t n = 0; n < neighbours; n += 16) {
        const size_t left = neighbours - n;
        const __mmask16 real = left < 16 ? (__mmask16)((1u << left) - 1) : 0xffff;
        const __m512i ids = _mm512_mask_loadu_epi32(_mm512_set1_epi32((int)i), real, list + n);
        rise += rise_of_sixteen(balls, i, to, ids, real);
    }
    return rise;
}

#elif defined(__AVX2__)

KERNEL __m256 square_of(const Balls *balls, const __m256i at[3], const uint32_t place[4]) {
    __m256 r2 = _mm256_setzero_ps();
    for (int a = 0; a < 3; a++) {
        const __m256i apart = _mm256_sub_epi32(_mm256_set1_epi32((int)place[a]), at[a]);
        const __m256 r =
            _mm256_mul_ps(_mm256_cvtepi32_ps(apart), _mm256_set1_ps(balls->unit_single[a]));
        r2 = a == 0 ? _mm256_mul_ps(r, r) : _mm256_add_ps(r2, _mm256_mul_ps(r, r));
    }
    return r2;
}

KERNEL __m256i energies(const Balls *balls, __m256 contact2, __m256 r2) {
    const __m256 y = _mm256_div_ps(contact2, r2);
    __m256 power = balls->exponent & 1 ? _mm256_sqrt_ps(y) : _mm256_set1_ps(1), square = y;
    for (int n = balls->exponent / 2; n > 0; n /= 2) {
        if (n & 1) power = _mm256_mul_ps(power, square);
        square = _mm256_mul_ps(square, square);
    }
    power = _mm256_mul_ps(power, _mm256_set1_ps((float)ENERGY_UNITS));
    return _mm256_cvtps_epi32(_mm256_min_ps(power, _mm256_set1_ps((float)ENERGY_MOST)));
}

KERNEL int64_t sum_of(__m256i x) {
    const __m128i four = _mm_add_epi32(_mm256_castsi256_si128(x), _mm256_extracti128_si256(x, 1));
    const __m128i two = _mm_add_epi32(four, _mm_unpackhi_epi64(four, four));
    return _mm_cvtsi128_si32(two) + _mm_extract_epi32(two, 1);
}

KERNEL int64_t energy_rise(const Balls *balls, uint32_t i, const uint32_t to[4],
                           const uint32_t *list, size_t neighbours) {
    const Ball *ball = &balls->ball[i];
    const __m256 radius = _mm256_set1_ps(balls->radius_single[i]);
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    int64_t rise = 0;
    for (size_t n = 0; n < neighbours; n += 8) {
        const __m256i real = _mm256_cmpgt_epi32(_mm256_set1_epi32((int)(neighbours - n)), lane);
        const __m256i ids = _mm256_blendv_epi8(
            _mm256_set1_epi32((int)i), _mm256_loadu_si256((const __m256i *)(list + n)), real);
        __m256i at[3];
        for (int a = 0; a < 3; a++) {
            at[a] = _mm256_i32gather_epi32((const int *)balls->column[a], ids, 4);
        }
        const __m256 contact =
            balls->alike ? _mm256_add_ps(radius, radius)
                         : _mm256_add_ps(radius, _mm256_i32gather_ps(balls->radius_single, ids, 4));
        const __m256 contact2 = _mm256_mul_ps(contact, contact);
        const __m256i after = energies(balls, contact2, square_of(balls, at, to));
        const __m256i before = energies(balls, contact2, square_of(balls, at, ball->place));
        rise += sum_of(_mm256_and_si256(real, _mm256_sub_epi32(after, before)));
    }
    return rise;
}

#else

KERNEL int64_t energy_rise(const Balls *balls, uint32_t i, const uint32_t to[4],
                           const uint32_t *list, size_t neighbours) {
    int64_t rise = 0;
    for (size_t n = 0; n < neighbours; n++) {
        rise += balls_energy(balls, i, to, list[n]) -
                balls_energy(balls, i, balls->ball[i].place, list[n]);
    }
    return rise;
}

#endif

// Whoever feels one end of a trial is within reach + half its length of the middle.
KERNEL uint64_t middle_of(const uint32_t from[4], const uint32_t to[4]) {
#if defined(__AVX2__)
    const __m128i start = _mm_load_si128((const __m128i *)from);
    const __m128i step = _mm_sub_epi32(_mm_load_si128((const __m128i *)to), start);
    return coarse_of(_mm_add_epi32(start, _mm_srai_epi32(step, 1)));
#else
    uint32_t middle[3];
    for (int a = 0; a < 3; a++) {
        middle[a] = from[a] + (uint32_t)((int32_t)(to[a] - from[a]) >> 1);
    }
    return balls_coarse(middle);
#endif
}

// By how much a trial raises the energy: of those that feel it, before or after.
KERNEL int64_t rise_by_list(const Balls *balls, uint32_t i, const uint32_t to[4]) {
    const uint32_t *list = balls->list + i * balls->room;
    const uint64_t middle = middle_of(balls->ball[i].place, to);
    uint32_t near[FELT_AT_A_TIME + NEIGHBOURS_AT_A_TIME];
    int64_t rise = 0;
    for (size_t n = 0; n < balls->ball[i].neighbours; n += FELT_AT_A_TIME) {
        const size_t left = balls->ball[i].neighbours - n;
        const size_t count =
            ids_by_distance(balls, true, NULL, balls->coarse, middle, balls->unfelt, list + n,
                            left < FELT_AT_A_TIME ? left : FELT_AT_A_TIME, near);
        rise += energy_rise(balls, i, to, near, count);
    }
    return rise;
}

#if defined(__AVX512F__)

// Of sixteen ids, the first `left` of which are neighbours, those that feel the trial come first.
KERNEL __m512i felt_ids(const Balls *balls, uint64_t middle, const uint32_t *ids, uint32_t left,
                        size_t *count) {
    const __m512i order = _mm512_setr_epi32(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
    const __m512i own = _mm512_set1_epi64((int64_t)middle);
    const __m512i scale = _mm512_set1_epi64((int64_t)coarse_scales(balls));
    const __m512i low = _mm512_mulhrs_epi16(_mm512_sub_epi16(own, rows_of(balls, ids)), scale);
    const __m512i high = _mm512_mulhrs_epi16(_mm512_sub_epi16(own, rows_of(balls, ids + 8)), scale);
    const __m512i r2 = sums_of(_mm512_madd_epi16(low, low), _mm512_madd_epi16(high, high));
    const __mmask16 real = _mm512_cmplt_epu32_mask(order, _mm512_set1_epi32((int)left));
    const __mmask16 felt =
        _mm512_mask_cmple_epu32_mask(real, r2, _mm512_set1_epi32((int)balls->unfelt));
    *count = (size_t)__builtin_popcount(felt);
    return _mm512_maskz_compress_epi32(felt,
                                       _mm512_permutexvar_epi32(order, _mm512_loadu_si512(ids)));
}

// Who feels a trial, in a register; `overflow`: more than sixteen, or the list is long.
typedef struct Felt {
    uint64_t middle;
    __m512i ids;
    __mmask16 real;
    bool overflow;
} Felt;

KERNEL Felt felt_by(const Balls *balls, uint32_t i, const uint32_t to[4]) {
    const uint32_t *list = balls->list + i * balls->room, neighbours = balls->ball[i].neighbours;
    const uint64_t middle = middle_of(balls->ball[i].place, to);
    const uint32_t left = neighbours < 16 ? 0 : neighbours - 16;
    size_t first, second;
    const __m512i near = felt_ids(balls, middle, list, neighbours, &first);
    const __m512i more = felt_ids(balls, middle, list + 16, left, &second);
    const __mmask16 real = (__mmask16)((1u << (first + second)) - 1);
    const __mmask16 free = (__mmask16)(real & (0xffffu << first));
    const __m512i both = _mm512_mask_expand_epi32(near, free, more);
    return (Felt){middle, _mm512_mask_mov_epi32(_mm512_set1_epi32((int)i), real, both), real,
                  neighbours > NEIGHBOURS_PER_ROOM || first + second > 16};
}

// May a particle that has just moved be among those who feel the trial, or be the one that makes
// it?
KERNEL bool is_felt(const Balls *balls, uint32_t i, const Felt *felt) {
    const __m128i apart =
        _mm_mulhrs_epi16(_mm_sub_epi16(_mm_cvtsi64_si128((int64_t)felt->middle),
                                       _mm_cvtsi64_si128((int64_t)balls->coarse[i])),
                         _mm_cvtsi64_si128((int64_t)coarse_scales(balls)));
    const __m128i two = _mm_madd_epi16(apart, apart);
    return (uint32_t)_mm_cvtsi128_si32(two) + (uint32_t)_mm_extract_epi32(two, 1) <= balls->unfelt;
}

KERNEL int64_t rise_of(const Balls *balls, uint32_t i, const uint32_t to[4], const Felt *felt) {
    if (felt->overflow) return rise_by_list(balls, i, to);
    return rise_of_sixteen(balls, i, to, felt->ids, felt->real);
}

#else

typedef struct Felt {
    char none;
} Felt;

KERNEL Felt felt_by(const Balls *balls, uint32_t i, const uint32_t to[4]) {
    (void)balls, (void)i, (void)to;
    return (Felt){0};
}

KERNEL bool is_felt(const Balls *balls, uint32_t i, const Felt *felt) {
    (void)balls, (void)i, (void)felt;
    return false;
}

KERNEL int64_t rise_of(const Balls *balls, uint32_t i, const uint32_t to[4], const Felt *felt) {
    (void)felt;
    return rise_by_list(balls, i, to);
}

#endif

// One trial.

// Far trials go without lists; they are few.
static __attribute__((noinline)) bool strayed_is_accepted(const Balls *balls, size_t t, uint32_t i,
                                                          const uint32_t to[4]) {
    if (!balls->soft) return !balls_overlap_anywhere(balls, i, to);
    return balls_energy_anywhere(balls, i, to) -
               balls_energy_anywhere(balls, i, balls->ball[i].place) <=
           balls->affordable[t];
}

// Is this farther from the particle's anchor than its list allows?
KERNEL bool leaves_anchor(const Balls *balls, const Ball *ball, const uint32_t place[4]) {
#if defined(__AVX2__)
    const __m128i apart = _mm_sub_epi32(_mm_load_si128((const __m128i *)place),
                                        _mm_load_si128((const __m128i *)ball->anchor));
    const __m128 r = _mm_mul_ps(_mm_cvtepi32_ps(apart), _mm_loadu_ps(balls->unit_single));
    return _mm_cvtss_f32(_mm_dp_ps(r, r, 0x71)) > balls->leash2;
#else
    float r[3];
    for (int a = 0; a < 3; a++) {
        r[a] = (float)(int32_t)(place[a] - ball->anchor[a]) * balls->unit_single[a];
    }
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] > balls->leash2;
#endif
}

KERNEL void place_after(const Ball *ball, const int32_t move[4], uint32_t place[4]) {
#if defined(__AVX2__)
    _mm_store_si128((__m128i *)place, _mm_add_epi32(_mm_load_si128((const __m128i *)ball->place),
                                                    _mm_load_si128((const __m128i *)move)));
#else
    for (int a = 0; a < 4; a++) place[a] = ball->place[a] + (uint32_t)move[a];
#endif
}

// Whether a trial is accepted cannot be foretold: nothing branches on it, so that the processor
// goes on with the next ones while this one is judged.

#if defined(__AVX2__)

KERNEL void count_move(const Balls *balls, const int32_t move[4], bool accepted, MoveTally *moves) {
    const __m256d r = _mm256_mul_pd(_mm256_cvtepi32_pd(_mm_load_si128((const __m128i *)move)),
                                    _mm256_loadu_pd(balls->unit));
    const __m256d squares = _mm256_mul_pd(r, r); // x, y, z, 0
    const __m128d z = _mm_unpacklo_pd(_mm_setzero_pd(), _mm256_extractf128_pd(squares, 1));
    const __m128d both = _mm_add_pd(_mm256_castpd256_pd128(squares), z); // x; y + z
    const __m128d counted = _mm_and_pd(both, _mm_castsi128_pd(_mm_set1_epi64x(-(int64_t)accepted)));
    moves->trials++;
    moves->accepted += accepted;
    _mm_storeu_pd(&moves->parallel, _mm_add_pd(_mm_loadu_pd(&moves->parallel), counted));
}

// The fourth of the places is always 0 and does not move, and nor does what lies behind the images.
KERNEL void move_ball(Ball *ball, const uint32_t to[4], const int32_t move[4], bool accepted) {
    const __m128i from = _mm_load_si128((const __m128i *)ball->place);
    const __m128i place = _mm_load_si128((const __m128i *)to);
    const __m128i moved = _mm_load_si128((const __m128i *)move);
    const __m128i image = _mm_load_si128((const __m128i *)ball->image);
    const __m128i taken = _mm_set1_epi32(-(int32_t)accepted), flip = _mm_set1_epi32(INT32_MIN);
    const __m128i below = _mm_cmpgt_epi32(_mm_xor_si128(from, flip), _mm_xor_si128(place, flip));
    const __m128i crossed = _mm_sub_epi32(_mm_srai_epi32(moved, 31), below);
    _mm_store_si128((__m128i *)ball->image, _mm_add_epi32(image, _mm_and_si128(crossed, taken)));
    _mm_store_si128((__m128i *)ball->place, _mm_blendv_epi8(from, place, taken));
}

#else

KERNEL void count_move(const Balls *balls, const int32_t move[4], bool accepted, MoveTally *moves) {
    const double x = move[0] * balls->unit[0], y = move[1] * balls->unit[1],
                 z = move[2] * balls->unit[2];
    moves->trials++;
    moves->accepted += accepted;
    moves->parallel += accepted * (x * x);
    moves->perpendicular += accepted * (y * y + z * z);
}

KERNEL void move_ball(Ball *ball, const uint32_t to[4], const int32_t move[4], bool accepted) {
    for (int a = 0; a < 3 && accepted; a++) {
        ball->image[a] += (to[a] < ball->place[a]) - (move[a] < 0);
        ball->place[a] = to[a];
    }
}

#endif

KERNEL void carry_out(const bool soft, Balls *balls, uint32_t i, const uint32_t to[4],
                      const int32_t move[4], uint64_t trial, bool accepted) {
    Ball *ball = &balls->ball[i];
    move_ball(ball, to, move, accepted);
    for (int a = 0; a < 3 && soft; a++) balls->column[a][i] = ball->place[a];
    const uint64_t places = ~(0xffffull << 48) & -(uint64_t)accepted;
    balls->coarse[i] ^= (balls->coarse[i] ^ trial) & places;
}

// Who feels trial t, as all stand now.
KERNEL Felt felt_ahead(const Balls *balls, size_t t) {
    const uint32_t i = balls->who[t] & ~STRAYS;
    _Alignas(16) uint32_t place[4];
    place_after(&balls->ball[i], balls->move[t], place);
    return felt_by(balls, i, place);
}

// Who feels a soft trial is looked up while the one before is judged, and again if that one is
// near.
KERNEL bool run_trials(const bool soft, const bool alike, Balls *balls, size_t from, size_t to,
                       MoveTally *moves) {
    Felt felt, next;
    if (soft && from < to) next = felt_ahead(balls, from);
    for (size_t t = from; t < to; t++) {
        const uint32_t i = balls->who[t] & ~STRAYS, ahead = balls->who[t + 6] & ~STRAYS;
        bool strays = balls->who[t] & STRAYS;
        __builtin_prefetch(&balls->ball[ahead]);
        __builtin_prefetch(balls->list + ahead * balls->room);
        __builtin_prefetch(balls->list + ahead * balls->room + NEIGHBOURS_AT_A_TIME);
        const Ball *ball = &balls->ball[i];
        _Alignas(16) uint32_t place[4];
        place_after(ball, balls->move[t], place);
        const uint64_t trial = coarse_trial(soft || alike, balls->coarse[i], place);
        if (__builtin_expect(leaves_anchor(balls, ball, place) && !strays, 0)) {
            if (!balls_refresh(balls, i)) return false; // look round from where it is
            strays = leaves_anchor(balls, ball, place);
            if (soft) next = felt_ahead(balls, t);
        }
        if (soft) {
            felt = next;
            if (t + 1 < to) next = felt_ahead(balls, t + 1);
        }
        const bool accepted = __builtin_expect(strays, 0) ? strayed_is_accepted(balls, t, i, place)
                              : soft ? rise_of(balls, i, place, &felt) <= balls->affordable[t]
                                     : !overlaps(alike, balls, i, place, trial);
        if (!soft && !accepted) {
            moves[ball->species].trials++;
            continue;
        }
        count_move(balls, balls->move[t], accepted, &moves[ball->species]);
        carry_out(soft, balls, i, place, balls->move[t], trial, accepted);
        if (__builtin_expect(strays, 0) && accepted && !balls_refresh(balls, i)) return false;
        if (soft && t + 1 < to && __builtin_expect(is_felt(balls, i, &next), 0)) {
            next = felt_ahead(balls, t + 1);
        }
    }
    return true;
}

KERNEL bool run_block(Balls *balls, size_t from, size_t to, MoveTally *moves) {
    if (balls->soft) return run_trials(true, false, balls, from, to, moves);
    if (balls->alike) return run_trials(false, true, balls, from, to, moves);
    return run_trials(false, false, balls, from, to, moves);
}

#define BALLS_KERNEL(name)                                                                         \
    static void draw_here(Balls *balls, const uint32_t *words, const uint32_t *metropolis) {       \
        draw(balls, words, metropolis);                                                            \
    }                                                                                              \
    static bool run_here(Balls *balls, size_t from, size_t to, MoveTally *moves) {                 \
        return run_block(balls, from, to, moves);                                                  \
    }                                                                                              \
    static size_t near_here(const Balls *balls, uint64_t own, const uint64_t *rows,                \
                            const uint32_t *ids, size_t count, uint32_t *near) {                   \
        return ids_by_distance(balls, true, rows, NULL, own, balls->far, ids, count, near);        \
    }                                                                                              \
    static size_t beyond_here(const Balls *balls, uint64_t own, const uint32_t *ids, size_t count, \
                              uint32_t *beyond) {                                                  \
        return ids_by_distance(balls, false, NULL, balls->coarse_anchor, own, balls->far, ids,     \
                               count, beyond);                                                     \
    }                                                                                              \
    const BallsKernel balls_kernel_##name = {draw_here, run_here, near_here, beyond_here};
