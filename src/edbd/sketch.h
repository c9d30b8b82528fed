// SPDX-License-Identifier: GPL-3.0-or-later
// The sketch: who may meet in what is left of the window, told from single precision for twice as
// many pairs at a time. It never overlooks a pair that meets; whom it lets through is tested
// exactly, so its arithmetic does not show in a result.
//
// A row is where the virtual origin of a particle is, x y or x y z 0, and where two windows would
// take it, likewise. With separations r now and g then, a gap closing in a window w is, for all
// t <= w,
//     |r + v t|^2 - contact^2 >= r^2 + 2 w r.v - contact^2 = r.g - contact^2,
// so that pairs with r.g > contact^2 do not meet; with growth, contact is that at the end of the
// window.
#pragma once

#include "edbd/engine.h"
#include "edbd/lanes.h"

typedef float FourFloats __attribute__((vector_size(16), aligned(16), may_alias));

// Of pairs, in each half of a register.
enum { HALF = WIDE / 2 };
typedef struct Rows {
    const float *sketch;
    const uint32_t *half[2]; // where the rows of each half begin
    int step;                // 0: one row for all of a half
} Rows;

KERNEL const float *row_of(const Rows *rows, int k) {
    return rows->sketch + rows->half[k / HALF][k % HALF * rows->step];
}

// The image of r that is nearest, and the same image of g.
KERNEL void wides_take_nearest(Wides *r, Wides *g, Wides edge, Wides half) {
#if LANES == 8
    const __mmask16 above = (__mmask16)wides_less(half, *r),
                    below = (__mmask16)wides_less(*r, -half);
    *r = (Wides)_mm512_mask_sub_ps((__m512)*r, above, (__m512)*r, (__m512)edge);
    *g = (Wides)_mm512_mask_sub_ps((__m512)*g, above, (__m512)*g, (__m512)edge);
    *r = (Wides)_mm512_mask_add_ps((__m512)*r, below, (__m512)*r, (__m512)edge);
    *g = (Wides)_mm512_mask_add_ps((__m512)*g, below, (__m512)*g, (__m512)edge);
#else
    const Wides shift =
        (Wides)((WideBits)edge & (*r < -half)) - (Wides)((WideBits)edge & (*r > half));
    *r += shift;
    *g += shift;
#endif
}

// The same choice of four lanes from a (0, 1, ...) and b (WIDE, WIDE + 1, ...) in every block of
// four.
#if LANES == 8
#define IN_BLOCKS(a, b, p, q, r, s)                                                                \
    __builtin_shufflevector(a, b, p, q, r, s, p + 4, q + 4, r + 4, s + 4, p + 8, q + 8, r + 8,     \
                            s + 8, p + 12, q + 12, r + 12, s + 12)
#elif LANES == 4
#define IN_BLOCKS(a, b, p, q, r, s)                                                                \
    __builtin_shufflevector(a, b, p, q, r, s, p + 4, q + 4, r + 4, s + 4)
#else
#define IN_BLOCKS(a, b, p, q, r, s) __builtin_shufflevector(a, b, p, q, r, s)
#endif

// Blocks of four rows into blocks of four columns.
KERNEL void wides_turn(const Wides row[4], Wides column[4]) {
    const Wides ab01 = IN_BLOCKS(row[0], row[1], 0, WIDE, 1, WIDE + 1);
    const Wides ab23 = IN_BLOCKS(row[0], row[1], 2, WIDE + 2, 3, WIDE + 3);
    const Wides cd01 = IN_BLOCKS(row[2], row[3], 0, WIDE, 1, WIDE + 1);
    const Wides cd23 = IN_BLOCKS(row[2], row[3], 2, WIDE + 2, 3, WIDE + 3);
    column[0] = IN_BLOCKS(ab01, cd01, 0, 1, WIDE, WIDE + 1);
    column[1] = IN_BLOCKS(ab01, cd01, 2, 3, WIDE + 2, WIDE + 3);
    column[2] = IN_BLOCKS(ab23, cd23, 0, 1, WIDE, WIDE + 1);
    column[3] = IN_BLOCKS(ab23, cd23, 2, 3, WIDE + 2, WIDE + 3);
}

#if LANES == 8
KERNEL Wides wides_four_rows(const Rows *i, int k) {
    const __m512 a = _mm512_castps128_ps512(_mm_load_ps(row_of(i, k)));
    const __m512 b = _mm512_insertf32x4(a, _mm_load_ps(row_of(i, k + 4)), 1);
    const __m512 c = _mm512_insertf32x4(b, _mm_load_ps(row_of(i, k + 8)), 2);
    return (Wides)_mm512_insertf32x4(c, _mm_load_ps(row_of(i, k + 12)), 3);
}
KERNEL Wides wides_two_rows(const Rows *i, int k) {
    const __m512 a = _mm512_castps256_ps512(_mm256_load_ps(row_of(i, k)));
    return (Wides)_mm512_insertf32x8(a, _mm256_load_ps(row_of(i, k + 4)), 1);
}
KERNEL void wides_rows_2d(const Rows *i, const Rows *j, Wides row[4]) {
    for (int k = 0; k < 4; k++) row[k] = wides_four_rows(i, k) - wides_four_rows(j, k);
}
KERNEL void sketch_separate_3d(const Rows *i, const Rows *j, Wides r[4], Wides g[4]) {
    Wides row[8], low[4], high[4]; // the first and the last eight pairs: r, g, r, g
    for (int k = 0; k < 4; k++) row[k] = wides_two_rows(i, k) - wides_two_rows(j, k);
    for (int k = 0; k < 4; k++) row[4 + k] = wides_two_rows(i, 8 + k) - wides_two_rows(j, 8 + k);
    wides_turn(row, low);
    wides_turn(row + 4, high);
    for (int a = 0; a < 3; a++) {
        r[a] = __builtin_shufflevector(low[a], high[a], 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19,
                                       24, 25, 26, 27);
        g[a] = __builtin_shufflevector(low[a], high[a], 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23,
                                       28, 29, 30, 31);
    }
}
#elif LANES == 4
KERNEL Wides wides_two_rows(const Rows *i, int k) {
    const __m256 a = _mm256_castps128_ps256(_mm_load_ps(row_of(i, k)));
    return (Wides)_mm256_insertf128_ps(a, _mm_load_ps(row_of(i, k + 4)), 1);
}
KERNEL void wides_rows_2d(const Rows *i, const Rows *j, Wides row[4]) {
    for (int k = 0; k < 4; k++) row[k] = wides_two_rows(i, k) - wides_two_rows(j, k);
}
KERNEL void sketch_separate_3d(const Rows *i, const Rows *j, Wides r[4], Wides g[4]) {
    Wides row[8], low[4], high[4]; // the first and the last four pairs: r, g
    for (int k = 0; k < 8; k++)
        row[k] = *(const Wides *)row_of(i, k) - *(const Wides *)row_of(j, k);
    wides_turn(row, low);
    wides_turn(row + 4, high);
    for (int a = 0; a < 3; a++) {
        r[a] = __builtin_shufflevector(low[a], high[a], 0, 1, 2, 3, 8, 9, 10, 11);
        g[a] = __builtin_shufflevector(low[a], high[a], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}
#else
KERNEL void wides_rows_2d(const Rows *i, const Rows *j, Wides row[4]) {
    for (int k = 0; k < 4; k++)
        row[k] = *(const Wides *)row_of(i, k) - *(const Wides *)row_of(j, k);
}
KERNEL void sketch_separate_3d(const Rows *i, const Rows *j, Wides r[4], Wides g[4]) {
    Wides now[4], then[4];
    for (int k = 0; k < 4; k++) {
        now[k] = *(const Wides *)row_of(i, k) - *(const Wides *)row_of(j, k);
        then[k] = *(const Wides *)(row_of(i, k) + 4) - *(const Wides *)(row_of(j, k) + 4);
    }
    wides_turn(now, r);
    wides_turn(then, g);
}
#endif

KERNEL void sketch_separate_2d(const Rows *i, const Rows *j, Wides r[4], Wides g[4]) {
    Wides row[4], column[4];
    wides_rows_2d(i, j, row);
    wides_turn(row, column);
    r[0] = column[0], r[1] = column[1];
    g[0] = column[2], g[1] = column[3];
}

// What does not change in a window.
typedef struct Sieve {
    Wides edge[3], half_edge[3];
    Wides offset, offset_then; // of the images above: now, and two windows on
    Wides scale2, error;       // pairs with r.g > scale2 contact^2 + error do not meet
} Sieve;

KERNEL Sieve sieve_of(const int dimension, const int sheared, const Engine *engine) {
    const double scale = engine->scale + engine->growth * engine->settings.window;
    Sieve sieve = {.scale2 = wides_all((float)(scale * scale)),
                   .error = wides_all(engine->sketch_error)};
    for (int a = 0; a < dimension; a++) {
        sieve.edge[a] = wides_all((float)engine->edge[a]);
        sieve.half_edge[a] = sieve.edge[a] * 0.5f;
    }
    if (sheared) {
        const double way = 2 * engine->settings.window * engine->image_velocity;
        sieve.offset = wides_all((float)engine->offset);
        sieve.offset_then = wides_all((float)(engine->offset + way));
    }
    return sieve;
}

// Is any of these separations longer than half an edge?
KERNEL int some_across(Wides y, Wides half) {
    return (wides_less(half, y) | wides_less(y, -half)) != 0;
}

// Which of WIDE pairs may meet between the part `gone` of two windows and the end of the first, one
// bit each.
KERNEL unsigned may_meet(const int dimension, const int sheared, const Sieve *sieve, const Rows *i,
                         const Rows *j, Wides contact2, const float *gone) {
    Wides r[4], g[4], product = {0};
    if (dimension == 2)
        sketch_separate_2d(i, j, r, g);
    else
        sketch_separate_3d(i, j, r, g);
    // After a collision the answer comes late: a branch foretold wrongly would cost more.
    if (sheared && (gone || __builtin_expect(some_across(r[1], sieve->half_edge[1]), 0))) {
        g[0] = wides_lean(g[0], r[1], sieve->half_edge[1], sieve->offset_then);
        r[0] = wides_lean(r[0], r[1], sieve->half_edge[1], sieve->offset);
    }
    for (int a = 0; a < dimension; a++) {
        wides_take_nearest(&r[a], &g[a], sieve->edge[a], sieve->half_edge[a]);
        if (gone) {
            const Wides past = (g[a] - r[a]) * *gone;
            r[a] += past, g[a] -= past;
        }
        product = a == 0 ? r[a] * g[a] : product + r[a] * g[a];
    }
    return wides_less(product, contact2 * sieve->scale2 + sieve->error);
}

// Squares of the distances of WIDE pairs.
KERNEL Wides distance2(const int dimension, const int sheared, const Sieve *sieve, const Rows *i,
                       const Rows *j) {
    Wides r[4], g[4], r2 = {0};
    if (dimension == 2)
        sketch_separate_2d(i, j, r, g);
    else
        sketch_separate_3d(i, j, r, g);
    if (sheared) r[0] = wides_lean(r[0], r[1], sieve->half_edge[1], sieve->offset);
    for (int a = 0; a < dimension; a++) {
        r[a] = wides_nearest(r[a], sieve->edge[a]);
        r2 = a == 0 ? r[a] * r[a] : r2 + r[a] * r[a];
    }
    return r2;
}

#if LANES == 8
// The lanes p to p + 7 of two vectors by turns, and likewise in pairs of lanes.
#define BY_TURNS(a, b, p)                                                                          \
    __builtin_shufflevector(a, b, p, WIDE + p, p + 1, WIDE + p + 1, p + 2, WIDE + p + 2, p + 3,    \
                            WIDE + p + 3, p + 4, WIDE + p + 4, p + 5, WIDE + p + 5, p + 6,         \
                            WIDE + p + 6, p + 7, WIDE + p + 7)
#define PAIRS_BY_TURNS(a, b, p)                                                                    \
    __builtin_shufflevector(a, b, p, p + 1, WIDE + p, WIDE + p + 1, p + 2, p + 3, WIDE + p + 2,    \
                            WIDE + p + 3, p + 4, p + 5, WIDE + p + 4, WIDE + p + 5, p + 6, p + 7,  \
                            WIDE + p + 6, WIDE + p + 7)
#define FOURS_BY_TURNS(a, b, p)                                                                    \
    __builtin_shufflevector(a, b, p, p + 1, p + 2, p + 3, WIDE + p, WIDE + p + 1, WIDE + p + 2,    \
                            WIDE + p + 3, p + 4, p + 5, p + 6, p + 7, WIDE + p + 4, WIDE + p + 5,  \
                            WIDE + p + 6, WIDE + p + 7)

// Four columns into rows of four, one after the other.
KERNEL void wides_rows(const Wides column[4], Wides row[4]) {
    const Wides low01 = BY_TURNS(column[0], column[1], 0);
    const Wides high01 = BY_TURNS(column[0], column[1], 8);
    const Wides low23 = BY_TURNS(column[2], column[3], 0);
    const Wides high23 = BY_TURNS(column[2], column[3], 8);
    row[0] = PAIRS_BY_TURNS(low01, low23, 0);
    row[1] = PAIRS_BY_TURNS(low01, low23, 8);
    row[2] = PAIRS_BY_TURNS(high01, high23, 0);
    row[3] = PAIRS_BY_TURNS(high01, high23, 8);
}

KERNEL void sketch_store_2d(float *to, const Wides column[4]) {
    wides_rows(column, (Wides *)to);
}

KERNEL void sketch_store_3d(float *to, const Wides now[4], const Wides then[4]) {
    Wides row[4], row_then[4];
    wides_rows(now, row);
    wides_rows(then, row_then);
    for (int k = 0; k < 4; k++) {
        ((Wides *)to)[2 * k] = FOURS_BY_TURNS(row[k], row_then[k], 0);
        ((Wides *)to)[2 * k + 1] = FOURS_BY_TURNS(row[k], row_then[k], 8);
    }
}
#else
// Writes four columns as rows of four, which begin `step` apart.
KERNEL void wides_store_rows(float *to, size_t step, const Wides column[4]) {
    Wides row[4];
    wides_turn(column, row);
    for (size_t m = 0; m < WIDE / 4; m++) {
        for (size_t k = 0; k < 4; k++) {
            *(FourFloats *)(to + (4 * m + k) * step) = ((const FourFloats *)&row[k])[m];
        }
    }
}

KERNEL void sketch_store_2d(float *to, const Wides column[4]) {
    wides_store_rows(to, ROW_2D, column);
}

KERNEL void sketch_store_3d(float *to, const Wides now[4], const Wides then[4]) {
    wides_store_rows(to, ROW_3D, now);
    wides_store_rows(to + 4, ROW_3D, then);
}
#endif

// The sketches of WIDE particles from `slot` on, a multiple of WIDE.
KERNEL void sketch_put(const int dimension, const Engine *engine, uint32_t slot, const Wides now[3],
                       const Wides then[3]) {
    const Wides zero = {0};
    float *to = engine->sketch + (size_t)slot * (dimension == 2 ? ROW_2D : ROW_3D);
    if (dimension == 2)
        sketch_store_2d(to, (const Wides[4]){now[0], now[1], then[0], then[1]});
    else
        sketch_store_3d(to, (const Wides[4]){now[0], now[1], now[2], zero},
                        (const Wides[4]){then[0], then[1], then[2], zero});
}

// Of one particle at a place with a velocity. Whole rows are stored: the loads of rows that follow
// would wait for smaller stores.
KERNEL void sketch_one(const int dimension, const Engine *engine, uint32_t slot,
                       const double place[3], const double velocity[3]) {
    const double way = 2 * engine->settings.window;
    FourFloats *to = (FourFloats *)engine->sketch + (size_t)slot * (dimension == 2 ? 1 : 2);
    if (dimension == 2) {
        const Quad row = {place[0], place[1], place[0] + velocity[0] * way,
                          place[1] + velocity[1] * way};
        to[0] = __builtin_convertvector(row, FourFloats);
        return;
    }
    const Quad now = {place[0], place[1], place[2], 0};
    const Quad then = now + (Quad){velocity[0], velocity[1], velocity[2], 0} * way;
    to[0] = __builtin_convertvector(now, FourFloats);
    to[1] = __builtin_convertvector(then, FourFloats);
}

// Four columns into four rows.
KERNEL void quads_turn(const Quad column[4], Quad row[4]) {
    const Quad even01 = __builtin_shufflevector(column[0], column[1], 0, 4, 2, 6);
    const Quad odd01 = __builtin_shufflevector(column[0], column[1], 1, 5, 3, 7);
    const Quad even23 = __builtin_shufflevector(column[2], column[3], 0, 4, 2, 6);
    const Quad odd23 = __builtin_shufflevector(column[2], column[3], 1, 5, 3, 7);
    row[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
    row[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
    row[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
    row[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
}

// The sketches of four particles, each of one part in 2D and of two in 3D.
KERNEL void sketch_quads(const int dimension, const Quad now[4], const Quad then[4],
                         FourFloats row[4][2]) {
    Quad first[4], second[4];
    if (dimension == 2) {
        quads_turn((const Quad[4]){now[0], now[1], then[0], then[1]}, first);
    } else {
        quads_turn(now, first);
        quads_turn(then, second);
    }
    for (int m = 0; m < 4; m++) {
        row[m][0] = __builtin_convertvector(first[m], FourFloats);
        if (dimension == 3) row[m][1] = __builtin_convertvector(second[m], FourFloats);
    }
}
