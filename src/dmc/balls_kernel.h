// SPDX-License-Identifier: GPL-3.0-or-later
// The hot loop of the chain of balls, compiled once per instruction set; all give the same bits,
// because integers and the rules of balls.h decide.
#pragma once

#include "dmc/balls_look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#if !defined(KERNEL)
#define KERNEL static inline __attribute__((always_inline))
#endif

enum {
    PREFETCHED = 6,      // trials ahead
    FELT_AT_A_TIME = 32, // soft neighbours
};

// The trials of a block, drawn together.

KERNEL uint32_t particle_of(const Balls *balls, uint32_t word) {
    return (uint32_t)((word * (uint64_t)balls->count) >> 32);
}

// A word made odd is an integer distributed evenly about 0, and so is its product, rounded: a step
// and its opposite are equally likely.
KERNEL void draw_uniform(Balls *balls, const uint32_t *words) {
#if defined(__AVX512F__)
    if (balls->state->system.species_count == 1) {
        const __m512 step = _mm512_broadcast_f32x4(_mm_loadu_ps(balls->step[0]));
        for (size_t t = 0; t < TRIALS_PER_BLOCK; t += 4) {
            const __m512i odd =
                _mm512_or_si512(_mm512_loadu_si512(words + 4 * t), _mm512_set1_epi32(1));
            _mm512_store_si512(balls->move[t],
                               _mm512_cvtps_epi32(_mm512_mul_ps(_mm512_cvtepi32_ps(odd), step)));
        }
        return;
    }
#endif
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
        for (int a = 0; a < balls->dimension; a++) {
            balls->move[t][a] = (int32_t)rint(balls->normals[a][t] * width[a]);
        }
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
    }
    if (balls->soft) draw_energies(balls, metropolis);
}

// Of ids, those whose coarse places are within `far` of `own`, or those beyond; the order stays.
// The places are in rows, beside the ids, or else in a table of all. The same from both of a pair.
// Room for `count` + 8 is needed.

#if defined(__AVX512F__)

KERNEL size_t ids_by_distance(const Balls *balls, bool within, const uint64_t *rows,
                              const uint64_t *table, uint64_t own, uint32_t far,
                              const uint32_t *ids, size_t count, uint32_t *found) {
    const __m512i mine = _mm512_set1_epi64((int64_t)own);
    const __m512i scale = _mm512_set1_epi64((int64_t)balls_coarse_scales(balls));
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
    const __m256i scale = _mm256_set1_epi64x((int64_t)balls_coarse_scales(balls));
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

// By the exact rules.

static bool overlaps(const Balls *balls, uint32_t i, const uint32_t to[3]) {
    const uint32_t *list = balls->list + i * balls->room;
    for (uint32_t n = 1; n < balls->ball[i].entries; n++) {
        if (balls_overlap(balls, i, to, list[n])) return true;
    }
    return false;
}

// Neighbours of a soft ball, in columns; contact 0: none.
typedef struct Columns {
    uint32_t place[3][FELT_AT_A_TIME];
    float contact2[FELT_AT_A_TIME];
} Columns;

static Columns columns_of(const Balls *balls, uint32_t i, const uint32_t *ids, size_t count) {
    Columns columns = {0};
    for (size_t k = 0; k < count; k++) {
        const int64_t *place = balls->ball[ids[k]].place;
        const float contact = balls->radius_single[i] + balls->radius_single[ids[k]];
        for (int a = 0; a < 3; a++) columns.place[a][k] = (uint32_t)place[a];
        columns.contact2[k] = contact * contact;
    }
    return columns;
}

// The sum of balls_energy; where it is nothing, the squares do not get too small for speed.
static int64_t energy_of(const Balls *balls, const uint32_t place[3], const Columns *columns) {
    const float *unit = balls->unit_single, faint = balls->faint;
    const float units = (float)ENERGY_UNITS, most = (float)ENERGY_MOST;
    float square[FELT_AT_A_TIME], power[FELT_AT_A_TIME];
    int32_t sum = 0;
    for (int k = 0; k < FELT_AT_A_TIME; k++) {
        const float x = (float)(int32_t)(place[0] - columns->place[0][k]) * unit[0];
        const float y = (float)(int32_t)(place[1] - columns->place[1][k]) * unit[1];
        const float z = (float)(int32_t)(place[2] - columns->place[2][k]) * unit[2];
        const float ratio = columns->contact2[k] / (x * x + y * y + z * z);
        square[k] = ratio > faint ? ratio : faint;
        power[k] = 1;
    }
    if (balls->exponent & 1) {
        for (int k = 0; k < FELT_AT_A_TIME; k++) power[k] = __builtin_sqrtf(square[k]);
    }
    for (int n = balls->exponent / 2; n > 0; n /= 2) {
        for (int k = 0; n & 1 && k < FELT_AT_A_TIME; k++) power[k] *= square[k];
        for (int k = 0; k < FELT_AT_A_TIME; k++) square[k] *= square[k];
    }
    for (int k = 0; k < FELT_AT_A_TIME; k++) {
        const float energy = power[k] * units, least = energy < most ? energy : most;
        sum += (int32_t)((least + 0x1p23f) - 0x1p23f); // rounded to the nearest
    }
    return sum;
}

static int64_t rise_by_list(const Balls *balls, uint32_t i, const uint32_t from[3],
                            const uint32_t to[3]) {
    const uint32_t *list = balls->list + i * balls->room, entries = balls->ball[i].entries;
    int64_t rise = 0;
    for (size_t n = 1; n < entries; n += FELT_AT_A_TIME) {
        const size_t left = entries - n;
        const Columns columns =
            columns_of(balls, i, list + n, left < FELT_AT_A_TIME ? left : FELT_AT_A_TIME);
        rise += energy_of(balls, to, &columns) - energy_of(balls, from, &columns);
    }
    return rise;
}

// Is the trial t accepted? What ends too far from the anchor even of a new list goes without one.
static bool is_accepted(const Balls *balls, size_t t, uint32_t i, const uint32_t to[3],
                        bool strays) {
    uint32_t from[3];
    if (!balls->soft) {
        return !(strays ? balls_overlap_anywhere(balls, i, to) : overlaps(balls, i, to));
    }
    balls_fractions(balls->ball[i].place, from);
    const int64_t rise =
        strays ? balls_energy_anywhere(balls, i, to) - balls_energy_anywhere(balls, i, from)
               : rise_by_list(balls, i, from, to);
    return rise <= balls->affordable[t];
}

static void carry_out(Balls *balls, uint32_t i, const int32_t move[4], const uint32_t to[3],
                      MoveTally *moves) {
    const double x = move[0] * balls->unit[0], y = move[1] * balls->unit[1],
                 z = move[2] * balls->unit[2];
    const uint64_t radius = balls->coarse[i] & 0xffffull << 48;
    for (int a = 0; a < 3; a++) balls->ball[i].place[a] += move[a];
    balls->coarse[i] = balls_coarse(to) | radius;
    moves->accepted++;
    moves->parallel += x * x;
    moves->perpendicular += y * y + z * z;
}

// One trial by the rules; false: no memory for a list.
static __attribute__((noinline)) bool try_exactly(Balls *balls, size_t t, MoveTally *tallies) {
    const uint32_t i = balls->who[t];
    Ball *ball = &balls->ball[i];
    MoveTally *moves = &tallies[ball->species];
    uint32_t from[3], to[3];
    balls_fractions(ball->place, from);
    for (int a = 0; a < 3; a++) to[a] = from[a] + (uint32_t)balls->move[t][a];
    const bool covered = !balls_leaves_anchor(balls, i, to);
    const bool strays = !covered && balls_distance2(balls, from, to) > balls->leash2;
    moves->trials++;
    if (!balls->soft && overlaps(balls, i, to)) return true; // whoever else is near
    if (!covered && !strays && !balls_refresh(balls, i)) return false;
    if ((balls->soft || !covered) && !is_accepted(balls, t, i, to, strays)) return true;
    carry_out(balls, i, balls->move[t], to, moves);
    return !balls_leaves_anchor(balls, i, to) || balls_refresh(balls, i);
}

// Trial after trial.

#if defined(__AVX2__)

// In the lower half: the coarse place, and with it plus the radius, so that the difference to a
// neighbour's row has the sum of the radii.
KERNEL __m128i coarse_of(__m256i place) {
    const __m256i half = _mm256_setr_epi64x(0x8000, 0x8000, 0x8000, 0);
    return lower_words(_mm256_srli_epi64(_mm256_add_epi64(place, half), 16));
}

// Squares of a step: along x; across it.
KERNEL __m128d squares_of(const int32_t step[4], __m256d unit) {
    const __m256d r =
        _mm256_mul_pd(_mm256_cvtepi32_pd(_mm_load_si128((const __m128i *)step)), unit);
    const __m256d squares = _mm256_mul_pd(r, r); // x, y, z, 0
    const __m128d z = _mm_unpacklo_pd(_mm_setzero_pd(), _mm256_extractf128_pd(squares, 1));
    return _mm_add_pd(_mm256_castpd256_pd128(squares), z);
}

// What the loop over trials keeps in registers.
typedef struct Walk {
    Balls *balls;
    Ball *ball;
    uint64_t *coarse;
    const uint32_t *lists; // these two change when a list grows
    size_t room;
    __m256d unit;
    Glass glass;
} Walk;

KERNEL Walk walk_of(const bool unscaled, Balls *balls) {
    return (Walk){balls,
                  balls->ball,
                  balls->coarse,
                  balls->list,
                  balls->room,
                  _mm256_loadu_pd(balls->unit),
                  glass_of(unscaled, balls)};
}

KERNEL const uint32_t *list_at(const Walk *walk, size_t t) {
    return walk->lists + walk->balls->who[t] * walk->room;
}

KERNEL void prefetch(const bool soft, const Walk *walk, size_t t) {
    __builtin_prefetch(&walk->ball[walk->balls->who[t]]);
    __builtin_prefetch(list_at(walk, t));
    if (soft) __builtin_prefetch(list_at(walk, t) + HARD_ENTRIES);
}

KERNEL __m256i place_after(const Walk *walk, size_t t) {
    const Ball *ball = &walk->ball[walk->balls->who[t]];
    const __m128i step = _mm_load_si128((const __m128i *)walk->balls->move[t]);
    return _mm256_add_epi64(_mm256_load_si256((const __m256i *)ball->place),
                            _mm256_cvtepi32_epi64(step));
}

// Here the compiler forgets where a bit comes from. Else it may jump by the outcome of a trial, and
// half of such jumps are mispredicted.
KERNEL uint64_t bit_of(uint64_t bit) {
    __asm__("" : "+r"(bit));
    return bit;
}

// `accepted` is 0 or 1: no jump, and what is written may be what was there. The radius, above the
// place, stays.
KERNEL uint64_t move_ball(const bool has_radius, const Walk *walk, uint32_t i, uint64_t accepted,
                          __m256i place, __m128i row) {
    const uint64_t before = walk->coarse[i], moved = (uint64_t)_mm_cvtsi128_si64(row);
    const uint64_t changes = has_radius ? ~(0xffffull << 48) : ~0ull;
    const uint64_t after = before ^ ((before ^ moved) & changes & -accepted);
    __m256i *at = (__m256i *)walk->ball[i].place;
    const __m256i old = _mm256_load_si256(at), all = _mm256_set1_epi64x(-(int64_t)accepted);
    _mm256_store_si256(at,
                       _mm256_xor_si256(old, _mm256_and_si256(_mm256_xor_si256(old, place), all)));
    return walk->coarse[i] = after;
}

KERNEL void count_trial(MoveTally *moves, uint64_t accepted, __m128d squares) {
    const __m128d all = _mm_castsi128_pd(_mm_set1_epi64x(-(int64_t)accepted));
    moves->trials++;
    moves->accepted += (int64_t)accepted;
    _mm_storeu_pd(&moves->parallel,
                  _mm_add_pd(_mm_loadu_pd(&moves->parallel), _mm_and_pd(squares, all)));
}

// The rows of a list are looked up before the trial before is judged, and put right if that moves
// one of them, which is rare: else a processor that looks ahead works at the next trials before
// this one is decided.
KERNEL bool run_trials(const bool soft, const bool unscaled, const bool one_size, Balls *balls,
                       size_t from, size_t to, MoveTally *tallies) {
    const uint32_t first = soft ? SOFT_ENTRIES : HARD_ENTRIES;
    Walk walk = walk_of(unscaled, balls);
    Seen seen = seen_in(&walk.glass, list_at(&walk, from), first);
    for (size_t t = from; t < to; t++) {
        const uint32_t i = balls->who[t], *list = list_at(&walk, t);
        prefetch(soft, &walk, t + PREFETCHED);
        const Seen next = seen_in(&walk.glass, list_at(&walk, t + 1), first);
        const __m256i place = place_after(&walk, t);
        const __m128i to_row = coarse_of(place);
        const Verdict verdict =
            soft ? look_at_energies(unscaled, one_size, &walk.glass, i, to_row, &seen, list,
                                    walk.ball[i].entries, balls->affordable[t])
                 : look_for_overlaps(unscaled, &walk.glass, to_row, &seen, list,
                                     walk.ball[i].entries);
        const uint64_t accepted = bit_of(verdict.accepted);
        if (__builtin_expect(!bit_of(accepted | verdict.rejected), 0)) {
            if (!try_exactly(balls, t, tallies)) return false;
            walk.lists = balls->list;
            walk.room = balls->room;
            seen = seen_in(&walk.glass, list_at(&walk, t + 1), first);
            continue;
        }
        count_trial(&tallies[walk.ball[i].species], accepted,
                    squares_of(balls->move[t], walk.unit));
        const uint64_t row = move_ball(!soft && !unscaled, &walk, i, accepted, place, to_row);
        seen = next;
        if (__builtin_expect(bit_of(accepted & is_seen(list_at(&walk, t + 1), first, i)), 0)) {
            seen = seen_after(seen, list_at(&walk, t + 1), first, i, row);
        }
    }
    return true;
}

KERNEL bool run_block(Balls *balls, size_t from, size_t to, MoveTally *tallies) {
    const bool soft = balls->soft, unscaled = balls->unscaled, one_size = balls->one_size;
    if (soft && unscaled && one_size) return run_trials(true, true, true, balls, from, to, tallies);
    if (soft && unscaled) return run_trials(true, true, false, balls, from, to, tallies);
    if (soft && one_size) return run_trials(true, false, true, balls, from, to, tallies);
    if (soft) return run_trials(true, false, false, balls, from, to, tallies);
    const bool alone = balls->count == 1; // nobody else fills its list
    if (unscaled && !alone) return run_trials(false, true, true, balls, from, to, tallies);
    if (!alone) return run_trials(false, false, false, balls, from, to, tallies);
    for (size_t t = from; t < to; t++) {
        if (!try_exactly(balls, t, tallies)) return false;
    }
    return true;
}

#else

KERNEL bool run_block(Balls *balls, size_t from, size_t to, MoveTally *tallies) {
    for (size_t t = from; t < to; t++) {
        if (!try_exactly(balls, t, tallies)) return false;
    }
    return true;
}

#endif

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
        return ids_by_distance(balls, false, NULL, balls->coarse + balls->count, own, balls->far,  \
                               ids, count, beyond);                                                \
    }                                                                                              \
    const BallsKernel balls_kernel_##name = {draw_here, run_here, near_here, beyond_here};
