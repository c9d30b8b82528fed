// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers: known answers of the generators, equal bits on every instruction set, and the
// numbers against the exact distributions. Fixed seeds; bounds are of probability 1e-6 or less.
#include "base/constants.h"
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

START_TEST(the_hot_path_is_threefry2x32_20) {
    uint32_t words[2];
    normals_words((const uint32_t[2]){0, 0}, 0, 0, words);
    ck_assert_uint_eq(words[0], 0x6b200159);
    ck_assert_uint_eq(words[1], 0x99ba4efe);
    normals_words((const uint32_t[2]){0x13198a2e, 0x03707344}, 0x243f6a88, 0x85a308d3, words);
    ck_assert_uint_eq(words[0], 0xc4923a9c);
    ck_assert_uint_eq(words[1], 0x483df7a0);
    Rng rng = rng_open(KEY, STREAM_PACKING, 0, 0);
    for (int i = 0; i < 1000; i++) {
        const uint64_t a = rng_bits(&rng), b = rng_bits(&rng);
        const threefry2x32_ctr_t counter = {{(uint32_t)a, (uint32_t)(a >> 32)}};
        const threefry2x32_key_t key = {{(uint32_t)b, (uint32_t)(b >> 32)}};
        const threefry2x32_ctr_t expected = threefry2x32(counter, key);
        normals_words(key.v, counter.v[0], counter.v[1], words);
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

int main(void) {
    Suite *suite = suite_create("rng");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 60);
    tcase_add_test(all, the_cold_path_is_philox4x64_10);
    tcase_add_test(all, the_hot_path_is_threefry2x32_20);
    tcase_add_test(all, every_instruction_set_gives_the_same_bits);
    suite_add_tcase(suite, all);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
