// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers: known answers of the generators, equal bits on every instruction set, and the
// numbers against the exact distributions. Fixed seeds; bounds are of probability 1e-6 or less.
#include "suite.h"

#include "base/memory.h"
#include "rng/normals.h"
#include "rng/rng.h"

#include <Random123/threefry.h>
#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MANY = 1 << 20 };
static const RngKey KEY = {.seed = 42, .replica = 3};

// `count` particles 0, 1, 2, ... at one step; freed by the caller in one piece.
typedef struct Sample {
    uint32_t *ids;
    double *normals[3];
} Sample;

static Sample sample_of(size_t count) {
    Sample sample = {.ids = memory_new(count, sizeof(uint32_t))};
    for (int a = 0; a < 3; a++) sample.normals[a] = memory_new(count, sizeof(double));
    for (size_t i = 0; i < count; i++) sample.ids[i] = (uint32_t)i;
    return sample;
}

static void sample_free(Sample *sample) {
    memory_free(sample->ids);
    for (int a = 0; a < 3; a++) memory_free(sample->normals[a]);
}

// Random123's own vectors for philox4x64-10 (its kat_vectors file): all zeros, all ones, digits of
// pi. The engine's key is (seed, replica), its counter (block, particle, step, stream).
START_TEST(the_cold_path_is_philox4x64_10) {
    Rng zero = rng_open((RngKey){0, 0}, (RngStream)0, 0, 0);
    ck_assert_uint_eq(rng_bits(&zero), 0x16554d9eca36314c);
    ck_assert_uint_eq(rng_bits(&zero), 0xdb20fe9d672d0fdc);
    ck_assert_uint_eq(rng_bits(&zero), 0xd7e772cee186176b);
    ck_assert_uint_eq(rng_bits(&zero), 0x7e68b68aec7ba23b);
    Rng pi = {
        .key = {0x452821e638d01377, 0xbe5466cf34e90c6c},
        .counter = {0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
        .used = 4};
    ck_assert_uint_eq(rng_bits(&pi), 0xa528f45403e61d95);
    ck_assert_uint_eq(rng_bits(&pi), 0x38c72dbd566e9788);
    ck_assert_uint_eq(rng_bits(&pi), 0xa5a1610e72fd18b5);
    ck_assert_uint_eq(rng_bits(&pi), 0x57bd43b5e52b7fe6);
}
END_TEST

START_TEST(the_hot_path_is_threefry2x32_13) {
    uint32_t words[2] = {0, 0};
    normals_words((const uint32_t[2]){0, 0}, words);
    ck_assert_uint_eq(words[0], 0x9d1c5ec6);
    ck_assert_uint_eq(words[1], 0x8bd50731);
    Rng rng = rng_open(KEY, STREAM_PACKING, 0, 0);
    for (int i = 0; i < 1000; i++) {
        const uint64_t a = rng_bits(&rng), b = rng_bits(&rng);
        const threefry2x32_ctr_t counter = {{(uint32_t)a, (uint32_t)(a >> 32)}};
        const threefry2x32_key_t key = {{(uint32_t)b, (uint32_t)(b >> 32)}};
        const threefry2x32_ctr_t expected = threefry2x32_R(13, counter, key);
        memcpy(words, counter.v, sizeof words);
        normals_words(key.v, words);
        ck_assert_mem_eq(words, expected.v, sizeof words);
    }
}
END_TEST

START_TEST(every_instruction_set_gives_the_same_bits) {
    Sample expected = sample_of(MANY), found = sample_of(MANY);
    for (int components = 2; components <= 3; components++) {
        rng_normals_with(CPU_PORTABLE, KEY, STREAM_VELOCITY, 7, expected.ids, MANY, components,
                         expected.normals);
        for (int path = 1; path <= (int)cpu_path(); path++) {
            rng_normals_with((CpuPath)path, KEY, STREAM_VELOCITY, 7, found.ids, MANY, components,
                             found.normals);
            for (int a = 0; a < components; a++) {
                ck_assert_mem_eq(found.normals[a], expected.normals[a], MANY * sizeof(double));
            }
        }
    }
    sample_free(&expected);
    sample_free(&found);
}
END_TEST

START_TEST(single_precision_has_the_same_numbers) {
    enum { ODD = 1003 }; // not a multiple of any register
    static const float UNTOUCHED = 77;
    Sample expected = sample_of(ODD);
    float *single[3];
    for (int a = 0; a < 3; a++) ck_assert_int_eq(NEW_ARRAY(single[a], ODD + 1), OK);
    for (int components = 2; components <= 3; components++) {
        rng_normals(KEY, STREAM_VELOCITY, 7, expected.ids, ODD, components, expected.normals);
        for (int path = 0; path <= (int)cpu_path(); path++) {
            for (int a = 0; a < 3; a++) single[a][ODD] = UNTOUCHED;
            rng_normals_single_with((CpuPath)path, KEY, STREAM_VELOCITY, 7, expected.ids, ODD,
                                    components, single);
            for (int a = 0; a < components; a++) {
                for (size_t i = 0; i < ODD; i++) {
                    ck_assert((double)single[a][i] == expected.normals[a][i]);
                }
                ck_assert(single[a][ODD] == UNTOUCHED);
            }
        }
    }
    for (int a = 0; a < 3; a++) memory_free(single[a]);
    sample_free(&expected);
}
END_TEST

// Fowler, Noll and Vo's hash of the bits, so that each compiler and level of optimisation can be
// seen to give those of the others.
START_TEST(every_compiler_gives_these_bits) {
    enum { SOME = 1000 };
    Sample sample = sample_of(SOME);
    rng_normals(KEY, STREAM_VELOCITY, 7, sample.ids, SOME, 3, sample.normals);
    uint64_t hash = 0xcbf29ce484222325;
    for (int a = 0; a < 3; a++) {
        for (int i = 0; i < SOME; i++) {
            uint64_t bits;
            memcpy(&bits, &sample.normals[a][i], sizeof bits);
            hash = (hash ^ bits) * 0x100000001b3;
        }
    }
    ck_assert_uint_eq(hash, 0x67083247ba464b85);
    sample_free(&sample);
}
END_TEST

START_TEST(a_number_depends_on_its_particle_only) {
    enum { FEW = 37, LONG = 1000 };
    Sample all = sample_of(LONG), some = sample_of(LONG);
    rng_normals(KEY, STREAM_VELOCITY, 5, all.ids, LONG, 3, all.normals);
    for (uint32_t i = 0; i < FEW; i++) some.ids[i] = (i * 389 + 11) % LONG;
    rng_normals(KEY, STREAM_VELOCITY, 5, some.ids, FEW, 3, some.normals);
    for (int i = 0; i < FEW; i++) {
        for (int a = 0; a < 3; a++) {
            ck_assert(some.normals[a][i] == all.normals[a][some.ids[i]]);
            ck_assert(some.normals[a][FEW] == 0); // nothing written beyond count
        }
    }
    rng_normals(KEY, STREAM_VELOCITY, 5, some.ids, FEW, 2, some.normals);
    ck_assert(some.normals[1][7] == all.normals[1][some.ids[7]]);
    sample_free(&all);
    sample_free(&some);
}
END_TEST

// The transform of given words in long double, as normals_kernel.h defines it.
static const long double EXACT_PI = 3.14159265358979323846264338L;

static long double exact_radius(uint32_t radius_word, uint32_t angle_word) {
    const long double fraction = (long double)((angle_word & 0x7fffff) | 1) * 0x1p-23L;
    const long double whole = (long double)(radius_word >> 1);
    const long double minus_log = whole < 0x1p30L
                                      ? -logl((whole + fraction) * 0x1p-31L)
                                      : -log1pl(-(0x1p31L - whole - fraction) * 0x1p-31L);
    return sqrtl(2 * minus_log);
}

static bool is_close(double found, long double exact, long double *worst) {
    const long double error = fabsl(found / exact - 1);
    *worst = fmaxl(*worst, error);
    return error < 3 * 0x1p-23L;
}

static bool transform_is_close(uint32_t radius_word, uint32_t angle_word, long double *worst) {
    const long double r = exact_radius(radius_word, angle_word);
    const long double half_circle = (long double)(int32_t)(angle_word | 1) * 0x1p-32L * EXACT_PI;
    const long double angle = (long double)(int32_t)(angle_word << 2 | 2) * 0x1p-33L * EXACT_PI;
    const bool exchanged = angle_word >> 30 & 1;
    const long double sign = angle_word >> 31 ? -1 : 1;
    double pair[2];
    normals_pair(radius_word, angle_word, pair);
    return is_close(normals_one(radius_word, angle_word), r * sinl(half_circle), worst) &&
           is_close(pair[exchanged], sign * r * cosl(angle), worst) &&
           is_close(pair[!exchanged], sign * r * sinl(angle), worst);
}

// To three units of 2^-23, over all magnitudes of u and 1 - u, and all over the circle.
START_TEST(the_transform_is_exact_to_single_precision) {
    long double worst = 0;
    Rng rng = rng_open(KEY, STREAM_PACKING, 1, 0);
    for (int i = 0; i < 300000; i++) {
        const uint64_t bits = rng_bits(&rng);
        const uint32_t high = (uint32_t)(bits >> 32), low = (uint32_t)bits;
        const int shift = (int)rng_below(&rng, 32);
        ck_assert(transform_is_close(high >> shift, low, &worst));
        ck_assert(transform_is_close(~(high >> shift), low, &worst));
        ck_assert(transform_is_close(high, low >> shift, &worst));
    }
    ck_assert(transform_is_close(0, 0x7fffffff, &worst));
    ck_assert(transform_is_close(0xffffffff, 0x80000000, &worst));
    ck_assert(worst > 0x1p-25L); // the comparison compares
}
END_TEST

START_TEST(the_largest_number_is_8_6_and_the_smallest_is_not_zero) {
    ck_assert_double_eq_tol(normals_one(0, 0x7f800001), 8.65, 0.05); // u = 2^-54
    ck_assert(normals_one(0xffffffff, 0) != 0);
    ck_assert(normals_one(0xffffffff, 0) < 1e-9);
}
END_TEST

// Pearson's statistic in standard deviations, (chi^2 - k)/sqrt(2 k): with hundreds of cells a
// normal number to good accuracy; 5.5 has a probability of 1e-7 or so.
static double excess_of_chi_square(const double *observed, const double *expected, int cells) {
    double chi_square = 0;
    for (int i = 0; i < cells; i++) {
        const double difference = observed[i] - expected[i];
        chi_square += difference * difference / expected[i];
    }
    const double freedom = cells - 1;
    return (chi_square - freedom) / sqrt(2 * freedom);
}

static double normal_cumulative(double x) {
    return 0.5 * erfc(-x / sqrt(2));
}

enum { STEPS = 8, CELLS = 400 }; // STEPS * MANY * 3 = 2.5e7 numbers

// Cells of width 0.02 from -4 to 4, the outer two open.
START_TEST(each_component_has_the_normal_distribution) {
    static double observed[3][CELLS], expected[CELLS];
    Sample sample = sample_of(MANY);
    for (uint64_t step = 0; step < STEPS; step++) {
        rng_normals(KEY, STREAM_VELOCITY, step, sample.ids, MANY, 3, sample.normals);
        for (int a = 0; a < 3; a++) {
            for (int i = 0; i < MANY; i++) {
                const double cell = floor((sample.normals[a][i] + 4) / 8 * CELLS);
                observed[a][(int)fmin(fmax(cell, 0), CELLS - 1)]++;
            }
        }
    }
    for (int cell = 0; cell < CELLS; cell++) {
        const double from = cell == 0 ? -INFINITY : -4 + 8.0 * cell / CELLS;
        const double to = cell == CELLS - 1 ? INFINITY : -4 + 8.0 * (cell + 1) / CELLS;
        const double share = cell < CELLS / 2 ? normal_cumulative(to) - normal_cumulative(from)
                                              : normal_cumulative(-from) - normal_cumulative(-to);
        expected[cell] = share * STEPS * MANY;
    }
    for (int a = 0; a < 3; a++) {
        ck_assert_double_le(fabs(excess_of_chi_square(observed[a], expected, CELLS)), 5.5);
    }
    sample_free(&sample);
}
END_TEST

// <x^n> = (n-1)!! or 0, with the variance of its estimate, (<x^2n> - <x^n>^2)/count.
START_TEST(the_moments_are_those_of_the_normal_distribution) {
    static const double moment[13] = {1, 0, 1, 0, 3, 0, 15, 0, 105, 0, 945, 0, 10395};
    Sample sample = sample_of(MANY);
    double sum[3][7] = {{0}};
    for (uint64_t step = 100; step < 100 + STEPS; step++) {
        rng_normals(KEY, STREAM_VELOCITY, step, sample.ids, MANY, 3, sample.normals);
        for (int a = 0; a < 3; a++) {
            for (int i = 0; i < MANY; i++) {
                double power = 1;
                for (int n = 1; n <= 6; n++) sum[a][n] += power *= sample.normals[a][i];
            }
        }
    }
    const double count = (double)STEPS * MANY;
    for (int a = 0; a < 3; a++) {
        for (int n = 1; n <= 6; n++) {
            const double sigma = sqrt((moment[2 * n] - moment[n] * moment[n]) / count);
            ck_assert_double_eq_tol(sum[a][n] / count, moment[n], 5 * sigma);
        }
    }
    sample_free(&sample);
}
END_TEST

// Beyond 4, 4.5 and 5 standard deviations, on both sides: Poisson counts of 1594, 171 and 14.4.
START_TEST(the_tails_are_full) {
    static const double limit[3] = {4, 4.5, 5};
    double beyond[3][2] = {{0}};
    Sample sample = sample_of(MANY);
    for (uint64_t step = 200; step < 200 + 2 * STEPS; step++) {
        rng_normals(KEY, STREAM_VELOCITY, step, sample.ids, MANY, 3, sample.normals);
        for (int k = 0; k < 9 * MANY; k++) {
            const double x = sample.normals[k / 3 / MANY][k / 3 % MANY];
            const int side = x > 0;
            beyond[k % 3][side] += fabs(x) > limit[k % 3];
        }
    }
    for (int i = 0; i < 3; i++) {
        const double mean = 2.0 * STEPS * MANY * 3 * normal_cumulative(-limit[i]);
        for (int side = 0; side < 2; side++) {
            ck_assert_double_le(fabs(beyond[i][side] - mean), 5.5 * sqrt(mean) + 2);
        }
    }
    sample_free(&sample);
}
END_TEST

static double correlation(const double *x, const double *y, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += x[i] * y[i];
    return sum / sqrt((double)count); // in standard deviations
}

static double correlation_of_squares(const double *x, const double *y, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += (x[i] * x[i] - 1) * (y[i] * y[i] - 1);
    return sum / sqrt(4 * (double)count);
}

static void check_independent(const double *x, const double *y, size_t count) {
    ck_assert_double_le(fabs(correlation(x, y, count)), 5.5);
    ck_assert_double_le(fabs(correlation_of_squares(x, y, count)), 5.5);
}

START_TEST(components_particles_steps_streams_and_replicas_are_independent) {
    Sample sample = sample_of(MANY), other = sample_of(MANY);
    rng_normals(KEY, STREAM_VELOCITY, 9, sample.ids, MANY, 3, sample.normals);
    for (int a = 0; a < 3; a++) {
        check_independent(sample.normals[a], sample.normals[(a + 1) % 3], MANY);
        for (size_t lag = 1; lag < MANY / 2; lag *= 2) { // ids that differ in few bits
            check_independent(sample.normals[a], sample.normals[a] + lag, MANY - lag);
        }
    }
    const struct {
        RngKey key;
        RngStream stream;
        uint64_t step;
    } others[] = {{KEY, STREAM_VELOCITY, 10},
                  {KEY, STREAM_VELOCITY, 9 + (1ull << 32)},
                  {KEY, STREAM_SWELLING, 9},
                  {{KEY.seed, KEY.replica + 1}, STREAM_VELOCITY, 9},
                  {{KEY.seed + 1, KEY.replica}, STREAM_VELOCITY, 9},
                  {{KEY.seed + (1ull << 40), KEY.replica}, STREAM_VELOCITY, 9}};
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
        rng_normals(others[k].key, others[k].stream, others[k].step, other.ids, MANY, 3,
                    other.normals);
        for (int a = 0; a < 3; a++) {
            check_independent(sample.normals[a], other.normals[a], MANY);
            check_independent(sample.normals[a], other.normals[(a + 1) % 3], MANY);
        }
    }
    sample_free(&sample);
    sample_free(&other);
}
END_TEST

// Pairs of neighbours and of components fall into 32 x 32 equal-share cells as they should.
START_TEST(pairs_fill_the_plane_evenly) {
    enum { SIDE = 32 };
    static double observed[4][SIDE * SIDE], expected[SIDE * SIDE];
    Sample sample = sample_of(MANY);
    for (int i = 0; i < SIDE * SIDE; i++) expected[i] = (double)(MANY - 1) / (SIDE * SIDE);
    rng_normals(KEY, STREAM_VELOCITY, 11, sample.ids, MANY, 3, sample.normals);
    for (size_t i = 0; i < MANY - 1; i++) {
        int cell[3], next[3];
        for (int a = 0; a < 3; a++) {
            cell[a] = (int)(normal_cumulative(sample.normals[a][i]) * SIDE);
            next[a] = (int)(normal_cumulative(sample.normals[a][i + 1]) * SIDE);
        }
        observed[0][cell[0] * SIDE + cell[1]]++;
        observed[1][cell[1] * SIDE + cell[2]]++;
        observed[2][cell[0] * SIDE + next[0]]++;
        observed[3][cell[2] * SIDE + next[2]]++;
    }
    for (int k = 0; k < 4; k++) {
        ck_assert_double_le(fabs(excess_of_chi_square(observed[k], expected, SIDE * SIDE)), 5.5);
    }
    sample_free(&sample);
}
END_TEST

static int ascending(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// First words of blocks over replicas, streams, steps and particles, 64 bits of each: among 2^18
// a pair would be equal by chance with probability 2e-9.
START_TEST(no_two_blocks_are_equal) {
    enum { REPLICAS = 64, PER_STREAM = 4, ALL = REPLICAS * STREAMS * PER_STREAM * PER_STREAM };
    uint64_t *words = memory_new(ALL, sizeof *words);
    size_t count = 0;
    for (uint64_t replica = 0; replica < REPLICAS; replica++) {
        for (int stream = 0; stream < STREAMS; stream++) {
            for (uint64_t step = 0; step < PER_STREAM; step++) {
                for (uint64_t particle = 0; particle < PER_STREAM; particle++) {
                    Rng rng = rng_open((RngKey){1, replica}, (RngStream)stream, step, particle);
                    words[count++] = rng_bits(&rng);
                }
            }
        }
    }
    qsort(words, count, sizeof *words, ascending);
    for (size_t i = 1; i < count; i++) ck_assert_uint_ne(words[i - 1], words[i]);
    memory_free(words);
}
END_TEST

// A bound of 3/4 2^64 would show the bias of a plain remainder at once: a third too many below
// 2^64/4. And small bounds are hit evenly.
START_TEST(rng_below_is_unbiased) {
    enum { DRAWS = 100000 };
    const uint64_t bound = 3ull << 62;
    Rng rng = rng_open(KEY, STREAM_PACKING, 2, 0);
    double low = 0, digits[10] = {0};
    for (int i = 0; i < DRAWS; i++) {
        const uint64_t draw = rng_below(&rng, bound);
        ck_assert(draw < bound);
        low += draw < bound / 3;
        digits[rng_below(&rng, 10)]++;
    }
    ck_assert_double_eq_tol(low / DRAWS, 1.0 / 3, 5 * sqrt(2.0 / 9 / DRAWS));
    for (int d = 0; d < 10; d++) {
        ck_assert_double_eq_tol(digits[d] / DRAWS, 0.1, 5 * sqrt(0.09 / DRAWS));
    }
    ck_assert_uint_eq(rng_below(&rng, 1), 0);
}
END_TEST

START_TEST(the_cold_path_is_uniform_and_normal) {
    enum { DRAWS = 400000 };
    Rng rng = rng_open(KEY, STREAM_DIAMETERS, 0, 1);
    double sum = 0, square = 0, normal = 0, normal_square = 0, fourth = 0;
    for (int i = 0; i < DRAWS; i++) {
        const double u = rng_uniform(&rng), x = rng_normal(&rng);
        ck_assert(u >= 0 && u < 1);
        sum += u, square += u * u;
        normal += x, normal_square += x * x, fourth += x * x * x * x;
    }
    ck_assert_double_eq_tol(sum / DRAWS, 0.5, 5 * sqrt(1.0 / 12 / DRAWS));
    ck_assert_double_eq_tol(square / DRAWS, 1.0 / 3, 5 * sqrt(4.0 / 45 / DRAWS));
    ck_assert_double_eq_tol(normal / DRAWS, 0, 5 * sqrt(1.0 / DRAWS));
    ck_assert_double_eq_tol(normal_square / DRAWS, 1, 5 * sqrt(2.0 / DRAWS));
    ck_assert_double_eq_tol(fourth / DRAWS, 3, 5 * sqrt(96.0 / DRAWS));
}
END_TEST

// Pair i of a block is Threefry2x32-13 of (i, third word of the key); the key is the Philox block
// that only this use has.
START_TEST(words_are_threefry_keyed_by_philox) {
    static uint32_t words[RNG_BLOCK];
    Rng philox = {.key = KEY, .counter = {1, UINT64_MAX, 77, STREAM_TRIALS}, .used = 4};
    const uint64_t a = rng_bits(&philox), b = rng_bits(&philox);
    const uint32_t key[2] = {(uint32_t)a, (uint32_t)(a >> 32)};
    rng_words(KEY, STREAM_TRIALS, 77, words);
    for (uint32_t i = 0; i < RNG_BLOCK / 2; i++) {
        uint32_t expected[2] = {i, (uint32_t)b};
        normals_words(key, expected);
        ck_assert_uint_eq(words[i], expected[0]);
        ck_assert_uint_eq(words[i + RNG_BLOCK / 2], expected[1]);
    }
}
END_TEST

START_TEST(every_instruction_set_gives_the_same_words) {
    static uint32_t expected[RNG_BLOCK], found[RNG_BLOCK];
    for (uint64_t block = 0; block < 100; block++) {
        rng_words_with(CPU_PORTABLE, KEY, STREAM_TRIALS, block, expected);
        for (int path = 1; path <= (int)cpu_path(); path++) {
            rng_words_with((CpuPath)path, KEY, STREAM_TRIALS, block, found);
            ck_assert_mem_eq(found, expected, sizeof found);
        }
    }
}
END_TEST

// Upper and lower halves of the words, and sums of neighbours, over 4e7 words; and no bit of a word
// goes with that of the same place in the next block, stream or replica.
START_TEST(words_are_even_and_independent) {
    enum { BLOCKS = 10000, SHARES = 1024 };
    static double observed[3][SHARES], expected[SHARES], equal[3];
    static uint32_t words[RNG_BLOCK], others[3][RNG_BLOCK];
    for (uint64_t block = 0; block < BLOCKS; block++) {
        rng_words(KEY, STREAM_TRIALS, block, words);
        rng_words(KEY, STREAM_TRIALS, block + 1, others[0]);
        rng_words(KEY, STREAM_SQUEEZING, block, others[1]);
        rng_words((RngKey){KEY.seed, KEY.replica + 1}, STREAM_TRIALS, block, others[2]);
        for (int i = 0; i < RNG_BLOCK; i++) {
            observed[0][words[i] >> 22]++;
            observed[1][words[i] & 1023]++;
            observed[2][(words[i] + words[(i + 1) % RNG_BLOCK]) >> 22]++;
            for (int k = 0; k < 3; k++) {
                equal[k] += __builtin_popcount(words[i] ^ others[k][i]);
            }
        }
    }
    const double drawn = (double)BLOCKS * RNG_BLOCK;
    for (int share = 0; share < SHARES; share++) expected[share] = drawn / SHARES;
    for (int k = 0; k < 3; k++) {
        ck_assert_double_le(fabs(excess_of_chi_square(observed[k], expected, SHARES)), 5.5);
        ck_assert_double_eq_tol(equal[k], 16 * drawn, 5.5 * sqrt(8 * drawn));
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("rng");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 60);
    tcase_add_test(all, the_cold_path_is_philox4x64_10);
    tcase_add_test(all, the_hot_path_is_threefry2x32_13);
    tcase_add_test(all, every_instruction_set_gives_the_same_bits);
    tcase_add_test(all, single_precision_has_the_same_numbers);
    tcase_add_test(all, every_compiler_gives_these_bits);
    tcase_add_test(all, a_number_depends_on_its_particle_only);
    tcase_add_test(all, the_transform_is_exact_to_single_precision);
    tcase_add_test(all, the_largest_number_is_8_6_and_the_smallest_is_not_zero);
    tcase_add_test(all, each_component_has_the_normal_distribution);
    tcase_add_test(all, the_moments_are_those_of_the_normal_distribution);
    tcase_add_test(all, the_tails_are_full);
    tcase_add_test(all, components_particles_steps_streams_and_replicas_are_independent);
    tcase_add_test(all, pairs_fill_the_plane_evenly);
    tcase_add_test(all, no_two_blocks_are_equal);
    tcase_add_test(all, rng_below_is_unbiased);
    tcase_add_test(all, the_cold_path_is_uniform_and_normal);
    tcase_add_test(all, words_are_threefry_keyed_by_philox);
    tcase_add_test(all, every_instruction_set_gives_the_same_words);
    tcase_add_test(all, words_are_even_and_independent);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
