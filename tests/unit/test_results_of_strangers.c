// SPDX-License-Identifier: GPL-3.0-or-later
// results.h5 from people who mean harm: files with a right seal and wrong HDF5 inside. Reading one
// ends in a sentence, or in results, and never in a crash, a hang, or the contents of other files.
#include "suite.h"

#include "base/crc32c.h"
#include "base/memory.h"
#include "store/store.h"

#include <check.h>
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SEAL = 256, SIZE = 16, CONTENTS_CRC = 184, SEAL_CRC = 188 }; // docs/file-format.md
enum { MUTATIONS = 300 };

static char directory[] = "/tmp/perrin-strangers-123456"; // the digits are mkdtemp's to change
static char path[sizeof directory + 16];

static void make_directory(void) {
    memset(directory + sizeof directory - 7, 'X', 6);
    ck_assert_ptr_nonnull(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/results.h5", directory);
}

static void remove_directory(void) {
    char command[sizeof directory + 16];
    snprintf(command, sizeof command, "rm -rf %s", directory);
    ck_assert_int_eq(system(command), 0);
}

static unsigned char *file_bytes(size_t *size, size_t more) {
    struct stat about;
    ck_assert_int_eq(stat(path, &about), 0);
    *size = (size_t)about.st_size;
    unsigned char *bytes = calloc(*size + more, 1);
    FILE *file = fopen(path, "rb");
    ck_assert_uint_eq(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

// Writes the bytes, of which the last are room for the seal, with the seal that belongs to them.
static void write_sealed(unsigned char *bytes, size_t size) {
    static const uint32_t head[2] = {1, 0x01020304};
    unsigned char *seal = bytes + size - SEAL;
    memset(seal, 0, SEAL);
    memcpy(seal, "PERRINRS", 8);
    memcpy(seal + 8, head, sizeof head);
    const uint64_t length = size;
    memcpy(seal + SIZE, &length, sizeof length);
    const uint32_t contents = crc32c(0, bytes, size - SEAL);
    memcpy(seal + CONTENTS_CRC, &contents, sizeof contents);
    const uint32_t crc = crc32c(0, seal, SEAL_CRC);
    memcpy(seal + SEAL_CRC, &crc, sizeof crc);
    FILE *file = fopen(path, "wb");
    ck_assert_uint_eq(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void seal_file(void) {
    size_t size;
    unsigned char *bytes = file_bytes(&size, SEAL);
    write_sealed(bytes, size + SEAL);
    free(bytes);
}

static void write_attribute(hid_t object, const char *name, const char *text) {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, H5T_VARIABLE);
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, &text);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

static void write_integer(hid_t object, const char *name, int64_t value) {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(object, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_INT64, &value);
    H5Aclose(attribute);
    H5Sclose(space);
}

// A file with all that perrin's have, up to one quantity, which is the stranger's.
typedef struct Stranger {
    hid_t file, quantities;
} Stranger;

static hid_t new_group(hid_t parent, const char *name) {
    const hid_t creation = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    const hid_t group = H5Gcreate2(parent, name, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    return group;
}

static Stranger stranger_begin(int64_t replicas) {
    Stranger s = {.file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)};
    write_integer(s.file, "format_version", 1);
    write_integer(s.file, "replicas", replicas);
    const hid_t perrin = new_group(s.file, "perrin");
    H5Gclose(new_group(perrin, "health"));
    H5Gclose(perrin);
    const hid_t stages = new_group(s.file, "stages"), stage = new_group(stages, "stage");
    s.quantities = new_group(stage, "quantities");
    H5Gclose(stage);
    H5Gclose(stages);
    return s;
}

static void stranger_set(const Stranger *s, hsize_t extent, hid_t creation) {
    const hid_t space = H5Screate_simple(1, &extent, NULL);
    const hid_t set =
        H5Dcreate2(s->quantities, "x", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    ck_assert(set >= 0);
    write_attribute(set, "unit", "");
    write_attribute(set, "description", "");
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(creation);
}

static void stranger_end(const Stranger *s) {
    H5Gclose(s->quantities);
    H5Fclose(s->file);
    seal_file();
}

static void is_refused(void) {
    Results *results = NULL;
    ck_assert_int_eq(store_read_results(&results, path), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), path));
}

START_TEST(what_is_like_ours_is_read) {
    const Stranger s = stranger_begin(2);
    stranger_set(&s, 2, H5Pcreate(H5P_DATASET_CREATE));
    const hid_t set = H5Dopen2(s.quantities, "x", H5P_DEFAULT);
    const double values[2] = {1, 2};
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(set);
    stranger_end(&s);
    Results *results = NULL;
    ck_assert_msg(store_read_results(&results, path) == OK, "%s", status_sentence());
    ck_assert_double_eq(results_find_scalar(results, "stage", "x")->values[1], 2);
    results_free(results);
}
END_TEST

START_TEST(numbers_that_lie_in_another_file_are_refused) {
    const Stranger s = stranger_begin(2);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, "/etc/passwd", 0, 16);
    stranger_set(&s, 2, creation);
    stranger_end(&s);
    is_refused();
}
END_TEST

START_TEST(links_that_are_not_hard_are_refused) {
    Stranger s = stranger_begin(2);
    H5Lcreate_soft("/perrin/health", s.quantities, "x", H5P_DEFAULT, H5P_DEFAULT);
    stranger_end(&s);
    is_refused();
    s = stranger_begin(2);
    H5Lcreate_external("/tmp/other.h5", "/x", s.quantities, "x", H5P_DEFAULT, H5P_DEFAULT);
    stranger_end(&s);
    is_refused();
}
END_TEST

START_TEST(chunks_and_filters_are_refused) {
    const Stranger s = stranger_begin(2);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 2;
    H5Pset_chunk(creation, 1, &chunk);
    H5Pset_shuffle(creation);
    stranger_set(&s, 2, creation);
    stranger_end(&s);
    is_refused();
}
END_TEST

START_TEST(petabytes_that_are_not_there_are_refused) {
    const hsize_t extent = (hsize_t)1 << 51;
    const Stranger s = stranger_begin((int64_t)extent);
    stranger_set(&s, extent, H5Pcreate(H5P_DATASET_CREATE)); // given no place in the file
    stranger_end(&s);
    is_refused();
}
END_TEST

START_TEST(a_group_that_contains_itself_is_refused) {
    const Stranger s = stranger_begin(2);
    H5Lcreate_hard(s.file, "stages", s.quantities, "x", H5P_DEFAULT, H5P_DEFAULT);
    stranger_end(&s);
    is_refused();
}
END_TEST

static Results *some_results(void) {
    static const double times[3] = {0.1, 1, 10};
    static const char *const names[2] = {"small", "big"};
    const ResultSeries shape = {
        .stage = "s",
        .observable = "o",
        .unit = "d",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = 2, .labels = names},
                 {.name = "time", .unit = "t", .count = 3, .values = times}},
    };
    const double values[6] = {1, 2, 3, 4, 5, 6};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    results_put_series(results, &shape, 0, values);
    results_put_scalar(results, "s", "q", "d", "a number", 0, 7);
    results_put_fact(results, "plan", "particles: 10\n");
    results_put_health(results, "overlaps", "pairs", 0, 0);
    return results;
}

static uint64_t next_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return *state >> 33;
}

START_TEST(any_bytes_changed_under_a_right_seal_do_no_harm) {
    Store *store = NULL;
    Results *results = some_results();
    ck_assert_int_eq(store_open(&store, directory), OK);
    ck_assert_int_eq(store_write_results(store, results), OK);
    results_free(results);
    size_t size;
    unsigned char *whole = file_bytes(&size, 0), *bytes = malloc(size);
    // HDF5's own structures are few and far between: only bytes near one that is not 0 are changed.
    size_t *places = calloc(size, sizeof *places), count = 0;
    for (size_t i = 4; i + SEAL + 4 < size; i++) {
        if (whole[i - 4] || whole[i] || whole[i + 4]) places[count++] = i;
    }
    uint64_t random = 20231, read = 0;
    for (int trial = 0; trial < MUTATIONS; trial++) {
        memcpy(bytes, whole, size);
        const uint64_t changes = 1 + next_random(&random) % 4;
        for (uint64_t c = 0; c < changes; c++) {
            bytes[places[next_random(&random) % count]] = (unsigned char)next_random(&random);
        }
        write_sealed(bytes, size);
        results = NULL;
        const Status status = store_read_results(&results, path);
        ck_assert(status == OK || status == BAD_DATA);
        if (status == BAD_DATA) ck_assert_ptr_nonnull(strstr(status_sentence(), path));
        if (status != OK) continue;
        results_free(results);
        read++;
    }
    printf("%d files with changed bytes: %d read, %d refused\n", MUTATIONS, (int)read,
           MUTATIONS - (int)read);
    free(places);
    free(whole);
    free(bytes);
    store_close(store);
}
END_TEST

int main(void) {
    TCase *tests = tcase_create("strangers");
    tcase_add_checked_fixture(tests, make_directory, remove_directory);
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, what_is_like_ours_is_read);
    tcase_add_test(tests, numbers_that_lie_in_another_file_are_refused);
    tcase_add_test(tests, links_that_are_not_hard_are_refused);
    tcase_add_test(tests, chunks_and_filters_are_refused);
    tcase_add_test(tests, petabytes_that_are_not_there_are_refused);
    tcase_add_test(tests, a_group_that_contains_itself_is_refused);
    tcase_add_test(tests, any_bytes_changed_under_a_right_seal_do_no_harm);
    Suite *suite = suite_create("strangers");
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
