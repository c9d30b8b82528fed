// SPDX-License-Identifier: GPL-3.0-or-later
// CRC-32C against the answers of RFC 3720, appendix B.4, and against a bit-by-bit twin.
#include "suite.h"

#include "base/crc32c.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

static uint32_t bit_by_bit(const unsigned char *bytes, size_t size) {
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) crc = (crc >> 1) ^ (crc & 1 ? 0x82f63b78 : 0);
    }
    return ~crc;
}

// Each test runs twice: 0 is the table, 1 the processor's instruction where there is one.
static void choose(int path) {
    if (path == 0)
        setenv("PERRIN_CPU", "portable", 1);
    else
        unsetenv("PERRIN_CPU");
}

START_TEST(answers_of_the_standard) {
    choose(_i);
    unsigned char bytes[32];
    memset(bytes, 0, sizeof bytes);
    ck_assert_uint_eq(crc32c(0, bytes, 32), 0x8a9136aa);
    memset(bytes, 0xff, sizeof bytes);
    ck_assert_uint_eq(crc32c(0, bytes, 32), 0x62a8ab43);
    for (int i = 0; i < 32; i++) bytes[i] = (unsigned char)i;
    ck_assert_uint_eq(crc32c(0, bytes, 32), 0x46dd794e);
    ck_assert_uint_eq(crc32c(0, "123456789", 9), 0xe3069283);
    ck_assert_uint_eq(crc32c(0, "", 0), 0);
}
END_TEST

START_TEST(any_length_and_any_split_is_the_bit_by_bit_remainder) {
    choose(_i);
    unsigned char bytes[67];
    for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (unsigned char)(i * 37 + 11);
    for (size_t size = 0; size <= sizeof bytes; size++) {
        const uint32_t wanted = bit_by_bit(bytes, size);
        for (size_t split = 0; split <= size; split++) {
            const uint32_t first = crc32c(0, bytes, split);
            ck_assert_uint_eq(crc32c(first, bytes + split, size - split), wanted);
        }
    }
}
END_TEST

int main(void) {
    TCase *tests = tcase_create("crc32c");
    tcase_add_loop_test(tests, answers_of_the_standard, 0, 2);
    tcase_add_loop_test(tests, any_length_and_any_split_is_the_bit_by_bit_remainder, 0, 2);
    Suite *suite = suite_create("crc32c");
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
