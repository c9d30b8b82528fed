// SPDX-License-Identifier: GPL-3.0-or-later
// The gallery reads small tables, takes numbers and curves out of results by name, and judges them
// as its README says. Results are made up here; each test has a folder of its own.
#include "gallery.h"
#include "measure.h"
#include "suite.h"

#include "base/memory.h"
#include "store/store.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char folder[] = "/tmp/perrin-gallery-123456"; // the digits are mkdtemp's to change

static void make_folder(void) {
    memset(folder + sizeof folder - 7, 'X', 6);
    ck_assert_ptr_nonnull(mkdtemp(folder));
}

static void remove_folder(void) {
    char command[sizeof folder + 16];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    ck_assert_int_eq(system(command), 0);
}

static void put_file(const char *name, const char *text) {
    char path[GALLERY_PATH];
    ck_assert_int_eq(gallery_path(path, folder, name), OK);
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fputs(text, file);
    fclose(file);
}

static char *file_text(const char *name) {
    char path[GALLERY_PATH];
    char *text = NULL;
    ck_assert_int_eq(gallery_path(path, folder, name), OK);
    ck_assert_int_eq(csv_read_text(path, &text), OK);
    return text;
}

START_TEST(tables_have_quotes_comments_and_short_lines) {
    Csv *csv = NULL;
    char path[GALLERY_PATH];
    double x;
    put_file("table.csv", "# said first\nname,x,words\n\na,1e-3,\"one, two\"\n# between\nb,,\nc\n");
    ck_assert_int_eq(gallery_path(path, folder, "table.csv"), OK);
    ck_assert_int_eq(csv_read(&csv, path), OK);
    ck_assert_uint_eq(csv->rows, 3);
    ck_assert_str_eq(csv_cell(csv, 0, "words"), "one, two");
    ck_assert_str_eq(csv_cell(csv, 2, "words"), "");
    ck_assert_str_eq(csv_cell(csv, 0, "nothing"), "");
    ck_assert_int_eq(csv_number(csv, 0, "x", 7, &x), OK);
    ck_assert_double_eq(x, 1e-3);
    ck_assert_int_eq(csv_number(csv, 1, "x", 7, &x), OK);
    ck_assert_double_eq(x, 7);
    ck_assert_int_eq(csv_number(csv, 0, "words", 7, &x), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "words = 'one, two' is not a number"));
    csv_free(csv);
}
END_TEST

// Z is 2 x + `shift` +- 0.01 over four replicas; a curve of two species at three times.
static Results *made_up(double x, double shift) {
    static const double times[3] = {0.1, 1, 10};
    static const char *const species[2] = {"small", "big"};
    const ResultSeries shape = {
        .stage = "rest",
        .observable = "msd",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = 2, .labels = species},
                 {.name = "time", .unit = "d^2/D0", .count = 3, .values = times}}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 4), OK);
    for (size_t r = 0; r < 4; r++) {
        const double noise = 0.01 * sqrt(3) * (r % 2 ? 1 : -1);
        const double values[6] = {1, 2, 3, 4, 5, 6 + noise};
        results_put_scalar(results, "rest", "Z", "", "", r, 2 * x + shift + noise);
        results_put_scalar(results, "rest", "same", "", "", r, noise);
        results_put_series(results, &shape, r, values);
    }
    return results;
}

START_TEST(numbers_are_found_by_name_and_key_and_combined_by_replica) {
    Results *results = made_up(1, 0);
    Estimate e;
    ck_assert_int_eq(measure_number(results, "rest/Z", &e), OK);
    ck_assert_double_eq_tol(e.value, 2, 1e-14);
    ck_assert_double_eq_tol(e.error, 0.01, 1e-14);
    ck_assert_int_eq(measure_number(results, "rest/msd[big,10]", &e), OK);
    ck_assert_double_eq_tol(e.value, 6, 1e-14);
    ck_assert_int_eq(measure_number(results, "rest/msd[small,1]", &e), OK);
    ck_assert_double_eq(e.value, 2);
    ck_assert_int_eq(measure_number(results, "rest/Z - rest/same", &e), OK);
    ck_assert_double_eq_tol(e.error, 0, 1e-15); // the noise is the same in each replica
    ck_assert_int_eq(measure_number(results, "rest/msd[big,10] / rest/msd[small,1]", &e), OK);
    ck_assert_double_eq_tol(e.value, 3, 1e-14);
    results_free(results);
}
END_TEST

START_TEST(a_name_that_is_not_there_is_told) {
    static const char *const wrong[] = {"rest/nothing",      "nothing",       "rest/msd[huge,1]",
                                        "rest/msd[small,2]", "rest/msd[big]", "walk/msd[big,1]"};
    Results *results = made_up(1, 0);
    Estimate e;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        ck_assert_int_eq(measure_number(results, wrong[i], &e), BAD_DATA);
    }
    results_free(results);
}
END_TEST

START_TEST(an_open_key_is_a_curve) {
    Results *results = made_up(1, 0);
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    ck_assert(measure_is_curve("rest/msd[big,*]"));
    ck_assert_int_eq(measure_curve(results, "rest/msd[big,*]", out), OK);
    ck_assert_int_eq(measure_curve(results, "rest/msd[*,1]", out), BAD_DATA); // labels
    fclose(out);
    ck_assert_ptr_nonnull(strstr(text, "time,value,error\n0.1,4,0\n1,5,0\n10,6,0.01\n"));
    free(text);
    results_free(results);
}
END_TEST

static void put_results(const char *point, double x, double shift) {
    char path[GALLERY_PATH];
    Store *store = NULL;
    Results *results = made_up(x, shift);
    ck_assert_int_eq(gallery_path(path, folder, point), OK);
    ck_assert_int_eq(store_open(&store, path), OK);
    ck_assert_int_eq(store_write_results(store, results), OK);
    store_close(store);
    results_free(results);
}

START_TEST(verdicts_are_as_the_readme_says) {
    GalleryRun run = {.full = false};
    size_t missed, count;
    strcpy(run.entry, folder);
    strcpy(run.directory, folder);
    put_results("a", 1, 0.5); // Z = 2 x + 0.5: 0.5 at x = 0
    put_results("b", 2, 0.5);
    put_file("points.csv", "point,curve,x,settings\na,line,1,\nb,line,2,\n");
    put_file("measures.csv",
             "measure,quantity\nZ,rest/Z\npeak,rest/overshoot_strain\nmsd,\"rest/msd[big,*]\"\n");
    put_file("expected.csv",
             "subject,measure,expected,uncertainty,tolerance,precision,kind,source\n"
             "a,Z,2.529,0,0,,exact,within three standard errors\n"
             "a,Z,2.531,0,0,,exact,beyond\n"
             "a,Z,2.531,0,0.002,,exact,within tolerance\n"
             "a,Z,2.55,0.015,0,,exact,the expectation is uncertain\n"
             "a,Z,2.5,0,0,0.009,exact,too coarse\n"
             "line@0,Z,0.5,0,0,0.03,exact,a straight line to zero\n"
             "a,Z,b,0,1.99,,independent,another point with an error as large\n"
             "a,Z,b,0,1.95,,independent,beyond\n"
             "a,Z,0.5 * b,0,0.24,,independent,half of another point and of its error\n"
             "a,Z,0.5 * b,0,0.2,,independent,beyond\n"
             "a,Z,> 0.5 * b,0,0,,published,a bound that is a multiple\n"
             "a,Z,> 2.4,0,0,,published,a bound\n"
             "a,Z,>2.49,0,0,,published,near a bound\n"
             "a,Z,< 2.6,0,0,,published,a bound\n"
             "a,Z,< 2.4,0,0,,published,beyond a bound\n"
             "a,Z,-1 * b,0,0,,independent,the opposite\n"
             "a,peak,0.07,0,0.03,,published,not told of this run\n");
    FILE *out = fopen("/dev/null", "w");
    ck_assert_int_eq(gallery_judge(&run, out, &missed, &count), OK);
    ck_assert_uint_eq(count, 17);
    ck_assert_uint_eq(missed, 8);
    static const char *const verdicts[] = {"met",    "MISSED", "met",    "met",    "coarse", "met",
                                           "met",    "MISSED", "met",    "MISSED", "met",    "met",
                                           "coarse", "met",    "MISSED", "MISSED", "coarse"};
    Csv *csv = NULL;
    char path[GALLERY_PATH];
    ck_assert_int_eq(gallery_path(path, folder, "verdict.csv"), OK);
    ck_assert_int_eq(csv_read(&csv, path), OK);
    for (size_t i = 0; i < 17; i++) ck_assert_str_eq(csv_cell(csv, i, "verdict"), verdicts[i]);
    ck_assert_str_eq(csv_cell(csv, 0, "deviation"), "-2.9");
    // Errors of 0.01 at x = 1 and 2: sqrt(2^2 + 1) of them at 0.
    double value;
    ck_assert_int_eq(csv_number(csv, 5, "error", NAN, &value), OK);
    ck_assert_double_eq_tol(value, 0.01 * sqrt(5), 1e-9);
    ck_assert_int_eq(csv_number(csv, 15, "uncertainty", NAN, &value), OK);
    ck_assert_double_eq_tol(value, 0.01, 1e-9);
    csv_free(csv);
    put_file("expected.csv",
             "subject,measure,expected,uncertainty,tolerance,precision,kind,source\n"
             "a,Z,half * b,0,0,,exact,no number\n");
    ck_assert_int_eq(gallery_judge(&run, out, &missed, &count), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "'half' before ' * ' is not a number"));
    put_file("measures.csv", "measure,quantity\nZ,rest/overshot_strain\n");
    ck_assert_int_eq(gallery_judge(&run, out, &missed, &count), BAD_DATA);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "no result rest/overshot_strain"));
    fclose(out);
    char *curve = file_text("b-msd.csv");
    ck_assert_ptr_nonnull(strstr(curve, "1,5,0\n"));
    memory_free(curve);
}
END_TEST

int main(void) {
    TCase *tests = tcase_create("gallery");
    tcase_add_checked_fixture(tests, make_folder, remove_folder);
    tcase_add_test(tests, tables_have_quotes_comments_and_short_lines);
    tcase_add_test(tests, numbers_are_found_by_name_and_key_and_combined_by_replica);
    tcase_add_test(tests, a_name_that_is_not_there_is_told);
    tcase_add_test(tests, an_open_key_is_a_curve);
    tcase_add_test(tests, verdicts_are_as_the_readme_says);
    Suite *suite = suite_create("gallery");
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
