// SPDX-License-Identifier: GPL-3.0-or-later
// What people and machines read: notation of errors, names, JSON, CSV, and the page.
#include "suite.h"

#include "report/figure.h"
#include "report/flow_table.h"
#include "report/files.h"
#include "report/gnuplot.h"
#include "report/json.h"
#include "report/notation.h"
#include "report/picture.h"
#include "report/report.h"
#include "report/utf8.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *written(double value, double error) {
    static char words[64];
    Text text = {0};
    notation_estimate(&text, (Estimate){.value = value, .error = error, .n = 8});
    snprintf(words, sizeof words, "%s", text_words(&text));
    text_free(&text);
    return words;
}

START_TEST(an_error_stands_in_units_of_the_last_digits) {
    ck_assert_str_eq(written(5.1234, 0.0042), "5.123(4)");
    ck_assert_str_eq(written(-5.1234, 0.0042), "-5.123(4)");
    ck_assert_str_eq(written(5.1234, 0.0014), "5.1234(14)"); // up to 354 two digits
    ck_assert_str_eq(written(5.1234, 0.0035), "5.1234(35)");
    ck_assert_str_eq(written(5.1234, 0.0036), "5.123(4)");
    ck_assert_str_eq(written(5.1234, 0.0096), "5.123(10)"); // 960 rounds up to 1000
    ck_assert_str_eq(written(0.5, 0.2), "0.50(20)");
    ck_assert_str_eq(written(12.0, 3.0), "12.0(3.0)");
    ck_assert_str_eq(written(3.21, 0.98), "3.2(1.0)");
    ck_assert_str_eq(written(1234.0, 56.0), "1230(60)");
    ck_assert_str_eq(written(0.001, 50.0), "0(50)");
}
END_TEST

START_TEST(very_small_and_large_values_have_a_power_of_ten) {
    ck_assert_str_eq(written(1.2345e-7, 2e-10), "1.2345(20)e-07");
    ck_assert_str_eq(written(6.02214e23, 4.6e19), "6.0221(5)e+23");
    ck_assert_str_eq(written(0.0, 3e-7), "0.0(3.0)e-07");
}
END_TEST

START_TEST(without_an_error_no_digits_are_claimed) {
    ck_assert_str_eq(written(3.14159265, NAN), "3.14159");
    ck_assert_str_eq(written(1000, 0), "1000");
    ck_assert_str_eq(written(1 + 8e-15, 3e-15), "1"); // but for rounding
    ck_assert_str_eq(written(NAN, 1), "-");
    ck_assert_str_eq(written(INFINITY, NAN), "-");
}
END_TEST

START_TEST(units_are_set_with_raised_and_lowered_digits) {
    Text text = {0};
    notation_unit(&text, "d^2/D0 d^-2 sqrt(kT/m)");
    ck_assert_str_eq(text_words(&text), "d²/D₀ d⁻² √(kT/m)");
    text_free(&text);
    notation_unit(&text, "1/d");
    ck_assert_str_eq(text_words(&text), "d⁻¹");
    text_free(&text);
    notation_unit(&text,
                  "sigma_xy, G -> (t/t0)^-a, exp(-(t/tau)^beta), method, phi_c; betas, beat");
    ck_assert_str_eq(text_words(&text),
                     "σ_xy, G -> (t/t0)^-a, exp(-(t/τ)^β), method, φ_c; betas, beat");
    text_free(&text);
    notation_unit(&text, "chi_4, delta(xi), 2 pi/kappa, mu nu; pit, beta-scaling, zeta");
    ck_assert_str_eq(text_words(&text), "χ_4, δ(ξ), 2 π/κ, μ ν; pit, β-scaling, zeta");
    text_free(&text);
}
END_TEST

START_TEST(json_escapes_what_would_break_it) {
    Text text = {0};
    json_string(&text, "a\"b\\c\n\x01 é \xff\xc3");
    ck_assert_str_eq(text_words(&text), "\"a\\\"b\\\\c\\n\\u0001 é \\ufffd\\ufffd\"");
    text_free(&text);
    json_number(&text, NAN);
    json_number(&text, -INFINITY);
    ck_assert_str_eq(text_words(&text), "nullnull");
    text_free(&text);
    ck_assert_uint_eq(utf8_length("\xed\xa0\x80"), 0); // a surrogate
    ck_assert_uint_eq(utf8_length("\xc0\xaf"), 0);     // overlong
    ck_assert_uint_eq(utf8_length("\xf0\x9f\x98\x80"), 4);
}
END_TEST

// Two replicas; a stage `quiescent` with scalars and a series of time and species.
static Results *sample(void) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    results_put_fact(results, "title", "a \"title\", <b>");
    results_put_health(results, "overlaps", "pairs", 0, 0);
    const double times[] = {0.1, 1};
    const char *const species[] = {"small", "big"};
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "mean_squared_displacement",
        .unit = "d^2",
        .about = "how far",
        .axes = 2,
        .axis = {{.name = "time", .unit = "d^2/D0", .count = 2, .values = times},
                 {.name = "species", .unit = "", .count = 2, .labels = species}},
    };
    for (size_t r = 0; r < 2; r++) {
        results_put_scalar(results, "quiescent", "pressure", "kT/d^2", "momentum, and area", r,
                           9.0 + 0.5 * (double)r);
        results_put_scalar(results, "settle", "pressure", "kT/d^2", "", r, 1.0);
        results_put_scalar(results, "quiescent", "long_time_diffusion", "D0", "", r, NAN);
        const double values[] = {0.4, 0.3, 2 + 0.5 * (double)r, NAN};
        results_put_series(results, &shape, r, values);
    }
    return results;
}

static char *shown(ShowFormat format, const char *quantity) {
    Results *results = sample();
    Text text = {0};
    ck_assert_int_eq(report_show(&text, results, format, quantity), OK);
    results_free(results);
    return text.bytes;
}

START_TEST(json_has_run_quantities_and_series) {
    char *json = shown(SHOW_JSON, NULL);
    ck_assert_ptr_nonnull(strstr(json, "\"title\": \"a \\\"title\\\", <b>\""));
    ck_assert_ptr_nonnull(strstr(json, "\"quiescent/pressure\": {\"value\": 9.25, \"error\": 0.25, "
                                       "\"unit\": \"kT/d^2\", \"n\": 2, \"about\": "
                                       "\"momentum, and area\"}"));
    ck_assert_ptr_nonnull(strstr(json, "\"quiescent/long_time_diffusion\": {\"value\": null, "
                                       "\"error\": null, \"unit\": \"D0\", \"n\": 0"));
    ck_assert_ptr_nonnull(strstr(json, "\"axes\": [\"time\", \"species\"]"));
    ck_assert_ptr_nonnull(strstr(json, "\"species\": [\"small\", \"big\"]"));
    ck_assert_ptr_nonnull(strstr(json, "\"mean\": [[0.4, 0.3], [2.25, null]]"));
    ck_assert_ptr_nonnull(strstr(json, "\"error\": [[0, 0], [0.25, null]]"));
    free(json);
}
END_TEST

START_TEST(json_of_one_quantity_holds_only_that) {
    char *json = shown(SHOW_JSON, "long_time_diffusion");
    ck_assert_ptr_nonnull(strstr(json, "quiescent/long_time_diffusion"));
    ck_assert_ptr_null(strstr(json, "pressure"));
    ck_assert_ptr_null(strstr(json, "mean_squared_displacement"));
    free(json);
}
END_TEST

START_TEST(csv_quotes_commas_and_leaves_gaps_for_no_number) {
    char *csv = shown(SHOW_CSV, NULL);
    ck_assert_str_eq(csv, "quantity,value,error,unit,n,about\n"
                          "quiescent/pressure,9.25,0.25,kT/d^2,2,\"momentum, and area\"\n"
                          "settle/pressure,1,0,kT/d^2,2,\n"
                          "quiescent/long_time_diffusion,,,D0,0,\n");
    free(csv);
    csv = shown(SHOW_CSV, "mean_squared_displacement");
    ck_assert_str_eq(csv, "time,species,value,error,unit,n\n"
                          "0.1,small,0.4,0,d^2,2\n"
                          "0.1,big,0.3,0,d^2,2\n"
                          "1,small,2.25,0.25,d^2,2\n"
                          "1,big,,,d^2,0\n");
    free(csv);
}
END_TEST

START_TEST(the_table_aligns_its_columns) {
    char *table = shown(SHOW_TABLE, "quiescent/pressure");
    ck_assert_str_eq(table, "quantity            value     unit    n  about\n"
                            "quiescent/pressure  9.25(25)  kT/d^2  2  momentum, and area\n");
    free(table);
}
END_TEST

START_TEST(an_unknown_or_ambiguous_name_is_told_with_the_names_there_are) {
    Results *results = sample();
    Text text = {0};
    ck_assert_int_eq(report_show(&text, results, SHOW_TABLE, "pressure"), BAD_USAGE);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "quiescent/pressure or settle/pressure"));
    ck_assert_int_eq(report_show(&text, results, SHOW_TABLE, "long_time_difusion"), BAD_USAGE);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "mean quiescent/long_time_diffusion?"));
    ck_assert_int_eq(report_show(&text, results, SHOW_TABLE, ""), BAD_USAGE);
    ck_assert_uint_eq(text.length, 0);
    results_free(results);
}
END_TEST

// A directory of its own, with a blank in its name, in which a report is written.
typedef struct Place {
    char directory[64];
    char page[96];
} Place;

static Place new_place(void) {
    Place place;
    snprintf(place.directory, sizeof place.directory, "/tmp/perrin report %d", (int)getpid());
    ck_assert_int_eq(mkdir(place.directory, 0700), 0);
    snprintf(place.page, sizeof place.page, "%s/report.html", place.directory);
    return place;
}

static void remove_place(const Place *place) {
    const char *const files[] = {"report.html",
                                 "figures/quiescent_mean_squared_displacement.csv",
                                 "figures/quiescent_mean_squared_displacement.gp",
                                 "figures/quiescent_mean_squared_displacement.svg",
                                 "figures",
                                 ""};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[160];
        snprintf(path, sizeof path, "%s/%s", place->directory, files[i]);
        remove(path);
    }
    ck_assert_int_ne(access(place->directory, F_OK), 0);
}

static Text read_page(const Place *place) {
    Text page = {0};
    ck_assert_int_eq(file_read(&page, place->page), OK);
    return page;
}

START_TEST(the_page_is_whole_in_itself_and_escapes_what_it_is_told) {
    const Place place = new_place();
    Results *results = sample();
    ck_assert_msg(report_write(results, place.directory) == OK, "%s", status_sentence());
    Text page = read_page(&place);
    ck_assert_ptr_nonnull(strstr(page.bytes, "<h1>a &quot;title&quot;, &lt;b&gt;</h1>"));
    ck_assert_ptr_nonnull(strstr(page.bytes, "<svg"));
    ck_assert_ptr_nonnull(strstr(page.bytes, "9.25(25)"));
    ck_assert_ptr_nonnull(strstr(page.bytes, "</html>"));
    ck_assert_ptr_null(strstr(page.bytes, "<script"));
    ck_assert_ptr_null(strstr(page.bytes, " src="));
    ck_assert_ptr_null(strstr(page.bytes, "@import"));
    ck_assert_ptr_null(strstr(page.bytes, "id='gpDot'")); // ids bear the figure's name
    ck_assert_ptr_nonnull(strstr(page.bytes, "id='quiescent_mean_squared_displacement-gpDot'"));
    text_free(&page);
    results_free(results);
    remove_place(&place);
}
END_TEST

START_TEST(without_gnuplot_the_page_is_written_and_says_what_it_lacks) {
    const Place place = new_place();
    Results *results = sample();
    char path[4096];
    snprintf(path, sizeof path, "%s", getenv("PATH"));
    setenv("PATH", "/nowhere", 1);
    ck_assert_int_eq(report_write(results, place.directory), IO_FAILED);
    setenv("PATH", path, 1);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "gnuplot does not start"));
    Text page = read_page(&place);
    ck_assert_ptr_nonnull(strstr(page.bytes, "No figure: gnuplot does not start"));
    ck_assert_ptr_nonnull(strstr(page.bytes, "9.25(25)"));
    ck_assert_ptr_nonnull(strstr(page.bytes, "</html>"));
    text_free(&page);
    results_free(results);
    remove_place(&place);
}
END_TEST

START_TEST(points_without_an_error_are_drawn_all_the_same) {
    const Place place = new_place();
    Results *results = sample();
    double *values = results->series[0].values;
    for (size_t i = 0; i < results->series[0].size; i++) values[i] = NAN; // of the first replica
    ck_assert_msg(report_write(results, place.directory) == OK, "%s", status_sentence());
    results_free(results);
    remove_place(&place);
}
END_TEST

START_TEST(a_reference_stands_beside_its_number_with_the_deviation) {
    const Place place = new_place();
    Results *results = sample();
    for (size_t r = 0; r < 2; r++) {
        results_put_scalar(results, "quiescent", "pressure_theory", "kT/d^2", "By X.", r, 10);
    }
    report_write(results, place.directory);
    Text page = read_page(&place);
    ck_assert_ptr_nonnull(strstr(page.bytes, "−7.50 % (−3.0 σ)"));
    ck_assert_ptr_nonnull(strstr(page.bytes, "References: By X."));
    ck_assert_ptr_null(strstr(page.bytes, "<td>pressure theory</td>"));
    text_free(&page);
    results_free(results);
    remove_place(&place);
}
END_TEST

static size_t count_of(const char *words, const char *part) {
    size_t count = 0;
    while ((words = strstr(words, part)) != NULL) count++, words++;
    return count;
}

START_TEST(a_disc_at_the_corner_is_drawn_with_its_images) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double ids[] = {0, 1}, edges[] = {10, 10};
    const double rows[] = {0.2, 9.9, 0, 1, 0, /* and at the right: */ 9.8, 5, 0, 1.4, 1};
    const char *const columns[] = {"x", "y", "z", "diameter", "species"}, *const axes[] = {"x",
                                                                                           "y"};
    const ResultSeries snapshot = {
        .stage = "quiescent",
        .observable = "snapshot",
        .axes = 2,
        .axis = {{.name = "particle", .unit = "", .count = 2, .values = ids},
                 {.name = "column", .unit = "", .count = 5, .labels = columns}}};
    const ResultSeries box = {
        .stage = "quiescent",
        .observable = "snapshot_box",
        .axes = 1,
        .axis = {{.name = "direction", .unit = "", .count = 2, .labels = axes}}};
    results_put_series(results, &snapshot, 0, rows);
    results_put_series(results, &box, 0, edges);
    const ResultSeries *series = results_find_series(results, "quiescent", "snapshot");
    ck_assert(picture_exists(results, series));
    Text picture = {0};
    picture_draw(&picture, results, series);
    ck_assert_uint_eq(count_of(picture.bytes, "<circle"), 4 + 2);
    text_free(&picture);
    results_free(results);
}
END_TEST

// A rod in the middle of a face, a platelet seen at 60 degrees, a ball: the rod is three lines, the
// ball a disc and its light, and no image of either touches the window.
START_TEST(bodies_are_drawn_as_they_are_seen_along_z) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double ids[] = {0, 1, 2}, edges[] = {10, 10, 10}, director[] = {0, 0, 1};
    const double rows[] = {5, 5, 9, 1,   0, 4, 1,          0, 0,   /* and */
                           3, 3, 8, 1.2, 1, 0, sqrt(0.75), 0, 0.5, /* and */
                           7, 7, 7, 1,   2, 0, 0,          0, 0};
    const char *const columns[] = {"x",      "y",      "z",      "diameter", "species",
                                   "length", "axis_x", "axis_y", "axis_z"};
    const char *const axes[] = {"x", "y", "z"};
    const ResultSeries snapshot = {
        .stage = "rest",
        .observable = "snapshot",
        .axes = 2,
        .axis = {{.name = "particle", .unit = "", .count = 3, .values = ids},
                 {.name = "column", .unit = "", .count = 9, .labels = columns}}};
    ResultSeries vector = {.stage = "rest",
                           .observable = "snapshot_box",
                           .axes = 1,
                           .axis = {{.name = "direction", .unit = "", .count = 3, .labels = axes}}};
    results_put_series(results, &snapshot, 0, rows);
    results_put_series(results, &vector, 0, edges);
    strcpy(vector.observable, "snapshot_director");
    results_put_series(results, &vector, 0, director);
    const ResultSeries *series = results_find_series(results, "rest", "snapshot");
    ck_assert(picture_exists(results, series));
    Text picture = {0};
    picture_draw(&picture, results, series);
    const char *words = picture.bytes;
    const double pixels = 56;                                           // per d
    ck_assert_uint_eq(count_of(words, "stroke-linecap=\"round\""), 3);  // of the rod
    ck_assert_ptr_nonnull(strstr(words, "d=\"M168.00 280.00l224.00 ")); // 3 d to 7 d
    char ellipse[128];
    snprintf(ellipse, sizeof ellipse, "rx=\"%.2f\" ry=\"%.2f\"", 0.3 * pixels, 0.6 * pixels);
    ck_assert_ptr_nonnull(strstr(words, ellipse));
    ck_assert_uint_eq(count_of(words, "<circle"), 2);
    text_free(&picture);
    results_free(results);
}
END_TEST

START_TEST(a_broken_limit_is_the_first_thing_a_reader_sees) {
    const Place place = new_place();
    Results *results = sample();
    results_put_health(results, "overlaps", "pairs", 0, 3);
    report_write(results, place.directory);
    Text page = read_page(&place);
    const char *verdict = strstr(page.bytes, "A health limit is broken: overlaps = 3,");
    ck_assert_ptr_nonnull(verdict);
    ck_assert(verdict < strstr(page.bytes, "<table>"));
    text_free(&page);
    results_free(results);
    remove_place(&place);
}
END_TEST

START_TEST(where_nothing_can_be_written_the_sentence_names_the_path) {
    Results *results = sample();
    ck_assert_int_eq(report_write(results, "/proc/nowhere"), IO_FAILED);
    ck_assert_ptr_nonnull(strstr(status_sentence(), "cannot write /proc/nowhere/report.html"));
    results_free(results);
}
END_TEST

// Of a sweep: what a rheometer tells, a row per point; in the text and on the page.
START_TEST(flow_curves_of_a_sweep_stand_in_one_table) {
    static const char *const NAMES[] = {"shear_stress", "shear_viscosity", "mean_pressure"};
    const double rates[] = {0.3, 3};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    for (size_t i = 0; i < 3; i++) {
        ResultSeries shape = {
            .stage = "flow",
            .unit = "kT/d^2",
            .axes = 1,
            .axis = {{.name = "shear_rate", .unit = "", .count = 2, .values = rates}}};
        strcpy(shape.observable, NAMES[i]);
        for (size_t r = 0; r < 2; r++) {
            const double values[] = {1 + (double)i, 11 + (double)i + 0.2 * (double)r};
            results_put_series(results, &shape, r, values);
        }
    }
    Text words = {0};
    ck_assert_int_eq(report_show(&words, results, SHOW_TABLE, NULL), OK);
    ck_assert_ptr_nonnull(
        strstr(text_words(&words), "\nflow, flow curves\nshear_rate  shear_stress"));
    ck_assert_ptr_nonnull(strstr(text_words(&words), "\n3           11.10(10)"));
    text_free(&words);
    flow_table_put(&words, results);
    ck_assert_ptr_nonnull(strstr(text_words(&words),
                                 "<td class=\"n\">3</td><td class=\"n\">11.10(10)</td>"
                                 "<td class=\"n\">12.10(10)</td>"));
    text_free(&words);
    results_free(results);
}
END_TEST

START_TEST(an_observable_without_a_row_is_drawn_by_the_plain_rule) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double q[] = {1, 2, 3}, t[] = {0.01, 0.1, 1};
    const ResultSeries shape = {
        .stage = "a stage",
        .observable = "new_thing",
        .unit = "d^2",
        .about = "New.",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = 3, .values = q},
                 {.name = "time", .unit = "d^2/D0", .count = 3, .values = t}}};
    const double values[] = {1, 2, 3, 4, 5, NAN, 7, 8, 9};
    results_put_series(results, &shape, 0, values);
    ck_assert(figure_exists(results, &results->series[0]));
    const Figure figure = figure_of(results, &results->series[0]);
    Text csv = {0};
    figure_numbers(&csv, &figure);
    ck_assert_str_eq(text_words(&csv), "time,\"q = 1 d⁻¹\",\"q = 1 d⁻¹ error\","
                                       "\"q = 2 d⁻¹\",\"q = 2 d⁻¹ error\","
                                       "\"q = 3 d⁻¹\",\"q = 3 d⁻¹ error\"\n"
                                       "0.01,1,,4,,7,\n0.1,2,,5,,8,\n1,3,,,,9,\n");
    ck_assert_str_eq(figure.name, "a_stage_new_thing");
    text_free(&csv);
    results_free(results);
}
END_TEST

// Structure of one species: its own curve is the total, and has no need of a name.
START_TEST(one_species_is_drawn_once) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double q[] = {1, 2};
    const char *const pairs[] = {"disc-disc", "total"};
    const ResultSeries shape = {
        .stage = "theory",
        .observable = "structure_factor",
        .axes = 2,
        .axis = {{.name = "pair", .unit = "", .count = 2, .labels = pairs},
                 {.name = "wave_number", .unit = "1/d", .count = 2, .values = q}}};
    const double values[] = {1, 2, 1, 2};
    results_put_series(results, &shape, 0, values);
    const Figure figure = figure_of(results, &results->series[0]);
    ck_assert_uint_eq(figure.curve_count, 1);
    ck_assert_uint_eq(figure.curve[0].first, 2);
    ck_assert_str_eq(figure.curve[0].title, "");
    results_free(results);
}
END_TEST

// G falls as t^-a from values that would hide the rest, on an axis whose unit is t_sigma.
START_TEST(beta_scaling_is_shown_about_its_plateau) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double t[] = {1e-6, 1, 100}, values[] = {82, 0, -10};
    const ResultSeries shape = {
        .stage = "theory",
        .observable = "beta_scaling_fluid",
        .axes = 1,
        .axis = {{.name = "time", .unit = "t_sigma", .count = 3, .values = t}}};
    results_put_series(results, &shape, 0, values);
    const Figure figure = figure_of(results, &results->series[0]);
    Text script = {0};
    figure_script(&script, &figure);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set yrange [-4:8]"));
    ck_assert_ptr_null(strstr(text_words(&script), "t / t_"));
    text_free(&script);
    results_free(results);
}
END_TEST

// Relaxation times over four densities and two wave numbers, which the points of a sweep had in
// common with the first: with `points` numbers of each.
static void figure_of_a_sweep(size_t points, bool together, bool *exists, Text *caption) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double density[] = {0.5, 0.6, 0.7, 0.8}, q[] = {3, 6};
    const ResultSeries shape = {
        .stage = "rest",
        .observable = "self_scattering_centred_relaxation_time",
        .unit = "d^2/D0",
        .about = "tau.",
        .axes = 2,
        .axis = {{.name = "packing_fraction", .unit = "", .count = 4, .values = density},
                 {.name = "wave_number", .unit = "1/d", .count = 2, .values = q}}};
    double values[8];
    for (size_t i = 0; i < 8; i++) values[i] = i < 2 * points ? 1 : NAN;
    results_put_series(results, &shape, 0, values);
    if (!together)
        results_put_fact(results, RESULTS_NOT_SIDE_BY_SIDE,
                         "rest/pressure, rest/self_scattering_centred_relaxation_time");
    *exists = figure_exists(results, &results->series[0]);
    const Figure figure = figure_of(results, &results->series[0]);
    figure_title(caption, &figure);
    figure_caption(caption, &figure);
    results_free(results);
}

START_TEST(a_figure_of_a_sweep_says_which_points_it_lacks) {
    bool exists = false;
    Text text = {0};
    figure_of_a_sweep(4, true, &exists, &text);
    ck_assert(exists);
    ck_assert_ptr_null(strstr(text_words(&text), "Only of points"));
    ck_assert_ptr_nonnull(
        strstr(text_words(&text), "Relaxation time, self-scattering, about the centre of mass"));
    text_free(&text);
    figure_of_a_sweep(2, false, &exists, &text);
    ck_assert(exists);
    ck_assert_ptr_nonnull(strstr(text_words(&text), "Only of points of the sweep"));
    text_free(&text);
    figure_of_a_sweep(1, false, &exists, &text); // a point is no curve
    ck_assert(!exists);
    text_free(&text);
}
END_TEST

// Friction at three forces, and what theory says of weak ones.
static Results *friction_of(const double peclet[3], const double friction[3]) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double weak[] = {1.4, 1.4, 1.4};
    ResultSeries shape = {.stage = "pulled",
                          .observable = "effective_friction",
                          .axes = 1,
                          .axis = {{.name = "peclet", .unit = "", .count = 3, .values = peclet}}};
    results_put_series(results, &shape, 0, friction);
    snprintf(shape.observable, sizeof shape.observable, "friction_weak");
    results_put_series(results, &shape, 0, weak);
    return results;
}

// Of weak forces over their half of the axis.
START_TEST(a_limit_is_drawn_over_its_half_of_the_axis) {
    const double peclet[] = {1, 10, 100}, friction[] = {2, 1.5, 1.2};
    Results *results = friction_of(peclet, friction);
    const Figure figure = figure_of(results, &results->series[0]);
    ck_assert(!figure_exists(results, &results->series[1]));
    Text csv = {0}, script = {0};
    figure_numbers(&csv, &figure);
    ck_assert_str_eq(text_words(&csv), "peclet,\"value\",\"value error\",\"value friction_weak\"\n"
                                       "1,2,,1.4\n10,1.5,,1.4\n100,1.2,,1.4\n");
    figure_script(&script, &figure);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "[1:10] '+' using 1:(1.4) with lines"));
    ck_assert_ptr_null(strstr(text_words(&script), "at rest"));
    text_free(&script);
    text_free(&csv);
    results_free(results);
}
END_TEST

// A logarithmic axis has no place for 0: the value there is a level over the left half, which
// begins at the first force, as limits do.
START_TEST(friction_at_rest_is_a_level_where_forces_are_weak) {
    const double peclet[] = {0, 1, 100}, friction[] = {2.5, 2, 1.2};
    Results *results = friction_of(peclet, friction);
    const Figure figure = figure_of(results, &results->series[0]);
    Text script = {0};
    figure_script(&script, &figure);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "[1:10] '+' using 1:(2.5) with lines"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "[1:10] '+' using 1:(1.4) with lines"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "title 'at rest'"));
    text_free(&script);
    results_free(results);
}
END_TEST

// A viscosity whose slope has not settled is a bound: the caption says so.
START_TEST(a_bound_behind_a_line_is_told) {
    const double times[] = {1, 2, 4}, values[] = {0.1, 0.2, 0.3};
    for (int bound = 0; bound < 2; bound++) {
        Results *results = NULL;
        Text caption = {0};
        ck_assert_int_eq(results_create(&results, 1), OK);
        const ResultSeries shape = {
            .stage = "rest",
            .observable = "viscosity",
            .unit = "kT/D0",
            .axes = 1,
            .axis = {{.name = "time", .unit = "d^2/D0", .count = 3, .values = times}}};
        results_put_series(results, &shape, 0, values);
        results_put_scalar(results, "rest", "zero_shear_viscosity", "kT/D0",
                           bound ? "Lower bound." : NULL, 0, 0.3);
        const Figure figure = figure_of(results, &results->series[0]);
        figure_caption(&caption, &figure);
        ck_assert_ptr_nonnull(strstr(text_words(&caption), "Dashed: its value at long times."));
        ck_assert_int_eq(strstr(text_words(&caption), "times. Lower bound. ") != NULL, bound);
        text_free(&caption);
        results_free(results);
    }
}
END_TEST

// Three rounds at four forces: against cycles, although there are more forces.
START_TEST(the_tracers_step_is_drawn_against_cycles) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double peclet[] = {0, 1, 10, 100}, cycles[] = {500, 1000, 1500};
    const ResultSeries shape = {
        .stage = "pulled",
        .observable = "tracer_step",
        .unit = "d",
        .axes = 2,
        .axis = {{.name = "peclet", .unit = "", .count = 4, .values = peclet},
                 {.name = "cycles", .unit = "", .count = 3, .values = cycles}}};
    double values[12];
    for (int i = 0; i < 12; i++) values[i] = 0.03;
    results_put_series(results, &shape, 0, values);
    const Figure figure = figure_of(results, &results->series[0]);
    ck_assert_str_eq(figure.x->name, "cycles");
    ck_assert_str_eq(figure.curve[3].title, "peclet = 100");
    results_free(results);
}
END_TEST

// Of a sweep over forces one map is drawn, that of the strongest, and the caption says so.
START_TEST(of_several_pictures_the_furthest_is_drawn_and_told) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double peclet[] = {0, 10}, r[] = {-0.5, 0.5}, across[] = {0.5, 1.5};
    const ResultSeries shape = {
        .stage = "pulled",
        .observable = "tracer_surroundings",
        .axes = 3,
        .axis = {{.name = "peclet", .unit = "", .count = 2, .values = peclet},
                 {.name = "along", .unit = "d", .count = 2, .values = r},
                 {.name = "across", .unit = "d", .count = 2, .values = across}}};
    double values[] = {0, 1, 2, 3, 4, 5, 6, 7};
    results_put_series(results, &shape, 0, values);
    const Figure figure = figure_of(results, &results->series[0]);
    Text caption = {0}, csv = {0};
    figure_caption(&caption, &figure);
    figure_map_numbers(&csv, &figure);
    ck_assert_uint_eq(figure.curve[0].first, 4);
    ck_assert_ptr_nonnull(strstr(text_words(&caption), " This is that of peclet = 10; the others"));
    ck_assert_ptr_nonnull(strstr(text_words(&csv), "-0.5,0.5,4,NaN\n"));
    text_free(&csv);
    text_free(&caption);
    results_free(results);
}
END_TEST

// A sweep over `points` packing fractions of a mean squared displacement, which is compared with
// free diffusion; of two species and their sum, or of one.
static Results *sweep_of_displacements(size_t points, size_t species) {
    static const char *const names[] = {"small", "big", "all"}, *const direction[] = {"total"};
    const double t[] = {0.1, 1};
    double phi[12], values[12 * 3 * 2];
    for (size_t p = 0; p < points; p++) phi[p] = 0.5 + 0.01 * (double)p;
    for (size_t i = 0; i < 12 * 3 * 2; i++) values[i] = 1 + (double)i;
    ResultSeries shape = {
        .stage = "rest",
        .observable = "mean_squared_displacement",
        .unit = "d^2",
        .about = "How far.",
        .axes = 4,
        .axis = {{.name = "packing_fraction", .unit = "", .count = points, .values = phi},
                 {.name = "species", .unit = "", .count = species, .labels = names},
                 {.name = "direction", .unit = "", .count = 1, .labels = direction},
                 {.name = "time", .unit = "d^2/D0", .count = 2, .values = t}}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    results_put_series(results, &shape, 0, values);
    strcpy(shape.observable, "free_displacement");
    results_put_series(results, &shape, 0, values);
    return results;
}

START_TEST(of_too_many_curves_those_of_all_species_from_first_to_last_are_drawn) {
    Results *results = sweep_of_displacements(4, 3);
    Figure figure = figure_of(results, &results->series[0]);
    ck_assert_uint_eq(figure.curve_count, 4);
    ck_assert_uint_eq(figure.left_out, 8);
    ck_assert_str_eq(figure.curve[3].title, "packing fraction = 0.53");
    ck_assert_uint_eq(figure.curve[3].first, (3 * 3 + 2) * 2); // of all
    Text caption = {0};
    figure_caption(&caption, &figure);
    ck_assert_ptr_nonnull(strstr(text_words(&caption), "Of all species together. 8 further"));
    text_free(&caption);
    results_free(results);

    results = sweep_of_displacements(12, 1);
    figure = figure_of(results, &results->series[0]);
    ck_assert_uint_eq(figure.curve_count, FIGURE_CURVES);
    ck_assert_uint_eq(figure.left_out, 4);
    ck_assert(!figure.sums_alone);
    ck_assert_uint_eq(figure.curve[0].first, 0);
    ck_assert_uint_eq(figure.curve[FIGURE_CURVES - 1].first, 11 * 2);
    results_free(results);

    results = sweep_of_displacements(2, 3); // few enough: each species has its own
    figure = figure_of(results, &results->series[0]);
    ck_assert_uint_eq(figure.curve_count, 6);
    ck_assert_str_eq(figure.curve[1].title, "packing fraction = 0.5, big");
    results_free(results);
}
END_TEST

START_TEST(many_names_stand_below_two_panels_and_not_on_them) {
    Results *results = sweep_of_displacements(2, 3);
    Figure figure = figure_of(results, &results->series[0]);
    Text script = {0};
    figure_script(&script, &figure); // six names and that of free diffusion, in two columns
    ck_assert_ptr_nonnull(strstr(text_words(&script), "svg size 760,824 "));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set key at screen 0.5575, screen 0.1262 "));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set bmargin at screen 0.2311\n"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), " width -7 ")); // a quarter of 29 letters
    text_free(&script);
    results_free(results);

    results = sweep_of_displacements(1, 3);
    figure = figure_of(results, &results->series[0]);
    figure_script(&script, &figure);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "svg size 760,720 "));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set key left top "));
    text_free(&script);
    results_free(results);
}
END_TEST

// Three lags of displacements along x and of their product with y, of two replicas; at the second
// lag only one has numbers of the product.
static Results *displacements_in_a_flow(const char *observable) {
    static const char *const directions[] = {"x", "xy"};
    const double times[] = {0.1, 1, 10};
    ResultSeries shape = {
        .stage = "flow",
        .unit = "d^2",
        .axes = 2,
        .axis = {{.name = "direction", .unit = "", .count = 2, .labels = directions},
                 {.name = "time", .unit = "d^2/D0", .count = 3, .values = times}}};
    strcpy(shape.observable, observable);
    const double values[2][6] = {{1, 2, 3, 0.1, -2, -3}, {1, 2, 3.1, 0.1, NAN, -3.1}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    for (size_t r = 0; r < 2; r++) results_put_series(results, &shape, r, values[r]);
    return results;
}

static Text script_of(const Results *results) {
    const Figure figure = figure_of(results, &results->series[0]);
    Text script = {0};
    figure_script(&script, &figure);
    return script;
}

// The product of x and y falls below zero when the rate is positive.
START_TEST(a_logarithmic_axis_shows_the_negative_of_what_ends_below_zero) {
    Results *results = displacements_in_a_flow("non_affine_displacement");
    Text script = script_of(results);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "data using 1:($2)"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "data using 1:(-$4)"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "title 'minus xy'"));
    text_free(&script);
    results_free(results);
}
END_TEST

// Nor has the rate of a flow backwards a place on one.
START_TEST(flows_both_ways_are_drawn_on_plain_axes) {
    for (int backwards = 0; backwards < 2; backwards++) {
        const double rates[] = {backwards ? -1 : 0.1, 1}, stresses[] = {backwards ? -2 : 0.2, 2};
        const ResultSeries shape = {
            .stage = "flow",
            .observable = "shear_stress",
            .unit = "kT/d^2",
            .axes = 1,
            .axis = {{.name = "shear_rate", .unit = "D0/d^2", .count = 2, .values = rates}}};
        Results *results = NULL;
        ck_assert_int_eq(results_create(&results, 1), OK);
        results_put_series(results, &shape, 0, stresses);
        Text script = script_of(results);
        ck_assert_ptr_nonnull(strstr(text_words(&script), "set xlabel 'γ̇  [D₀/d²]'"));
        ck_assert_int_eq(strstr(text_words(&script), "set logscale x") == NULL, backwards);
        ck_assert_int_eq(strstr(text_words(&script), "set logscale y") == NULL, backwards);
        text_free(&script);
        results_free(results);
    }
}
END_TEST

START_TEST(noise_without_an_error_is_not_drawn_where_noise_is_not) {
    Results *results = displacements_in_a_flow("non_affine_displacement_exponent");
    Text script = script_of(results);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "(valid(5) && column(5) <= 0.3 ? $4 : NaN)"));
    text_free(&script);
    results_free(results);
}
END_TEST

// "first lag of the fit", over decades.
START_TEST(lags_over_decades_are_drawn_over_decades) {
    Results *results = displacements_in_a_flow("self_scattering_kohlrausch_scan");
    Text script = script_of(results);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set logscale x"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set xlabel 'first lag of the fit"));
    text_free(&script);
    results_free(results);
}
END_TEST

// Without a row of its own: a point per decade is enough, in any order; not where there is one
// below 0.
START_TEST(rates_over_decades_are_drawn_over_decades) {
    static const double orders[][3] = {{0.3, 3, 30}, {30, 3, 0.3}, {1, 2, 3}, {2, 1, -4}};
    const double *rates = orders[_i], values[] = {1, 2, 3};
    const ResultSeries shape = {
        .stage = "flow",
        .observable = "stress_strain",
        .axes = 1,
        .axis = {{.name = "shear_rate", .unit = "", .count = 3, .values = rates}}};
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    results_put_series(results, &shape, 0, values);
    Text script = script_of(results);
    ck_assert_int_eq(strstr(text_words(&script), "set logscale x") != NULL, _i < 2);
    text_free(&script);
    ck_assert(figure_exists(results, &results->series[0]));
    strcpy(results->series[0].observable, "shear_rate"); // against itself
    ck_assert(!figure_exists(results, &results->series[0]));
    results_free(results);
}
END_TEST

START_TEST(the_relation_of_transients_has_a_figure) {
    static const char *const NAMES[] = {"self_scattering_relation",
                                        "advected_scattering_normalised_relation",
                                        "non_affine_displacement_relation"};
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        Results *results = displacements_in_a_flow(NAMES[i]);
        ck_assert(figure_exists(results, &results->series[0]));
        results_free(results);
    }
}
END_TEST

START_TEST(a_series_over_a_plane_is_drawn_as_a_picture) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double q[] = {-1, 0, 1};
    static const char *const pairs[] = {"small-small", "total"};
    const ResultSeries shape = {
        .stage = "rest",
        .observable = "planar_structure_factor",
        .unit = "",
        .about = "S.",
        .axes = 3,
        .axis = {{.name = "pair", .unit = "", .count = 2, .labels = pairs},
                 {.name = "wave_number_x", .unit = "1/d", .count = 3, .values = q},
                 {.name = "wave_number_y", .unit = "1/d", .count = 3, .values = q}}};
    double values[18];
    for (int i = 0; i < 18; i++) values[i] = i == 13 ? NAN : i;
    results_put_series(results, &shape, 0, values);
    const Figure figure = figure_of(results, &results->series[0]);
    ck_assert_ptr_nonnull(figure.y);
    ck_assert_uint_eq(figure.curve_count, 1);
    Text csv = {0}, script = {0};
    figure_map_numbers(&csv, &figure);
    ck_assert_str_eq(text_words(&csv), "wave_number_x,wave_number_y,value,error\n"
                                       "-1,-1,9,NaN\n-1,0,10,NaN\n-1,1,11,NaN\n"
                                       "0,-1,12,NaN\n0,0,NaN,NaN\n0,1,14,NaN\n"
                                       "1,-1,15,NaN\n1,0,16,NaN\n1,1,17,NaN\n");
    figure_map_script(&script, &figure);
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set xlabel 'q_x  [d⁻¹]'\n"));
    ck_assert_ptr_nonnull(strstr(text_words(&script), "set yrange [-1.5:1.5]\n"));
    ck_assert_ptr_null(strstr(text_words(&script), "missing")); // would shift all behind the NaN
    text_free(&script);
    text_free(&csv);
    results_free(results);
}
END_TEST

// One wave number tells no curve from another, so that the caption must say which it is; and a
// theory has its own words, not those of a simulation's time origins.
START_TEST(a_caption_says_where_the_only_number_of_an_axis_is) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    const double q[] = {6.6}, t[] = {0.1, 1}, values[] = {1, 0.5};
    const ResultSeries shape = {
        .stage = "theory",
        .observable = "self_scattering",
        .about = "Of a tagged particle.",
        .axes = 2,
        .axis = {{.name = "wave_number", .unit = "1/d", .count = 1, .values = q},
                 {.name = "time", .unit = "d^2/D0", .count = 2, .values = t}}};
    results_put_series(results, &shape, 0, values);
    const Figure figure = figure_of(results, &results->series[0]);
    Text caption = {0};
    figure_caption(&caption, &figure);
    ck_assert_str_eq(text_words(&caption), "Of a tagged particle. At q = 6.6 d⁻¹.");
    text_free(&caption);
    results_free(results);
}
END_TEST

START_TEST(gnuplot_takes_quoted_words_literally) {
    Text script = {0};
    gnuplot_quoted(&script, "it's `rm`\n$x");
    ck_assert_str_eq(text_words(&script), "'it''s `rm` $x'");
    text_free(&script);
}
END_TEST

int main(void) {
    TCase *tests = tcase_create("report");
    tcase_add_test(tests, an_error_stands_in_units_of_the_last_digits);
    tcase_add_test(tests, very_small_and_large_values_have_a_power_of_ten);
    tcase_add_test(tests, without_an_error_no_digits_are_claimed);
    tcase_add_test(tests, units_are_set_with_raised_and_lowered_digits);
    tcase_add_test(tests, json_escapes_what_would_break_it);
    tcase_add_test(tests, json_has_run_quantities_and_series);
    tcase_add_test(tests, json_of_one_quantity_holds_only_that);
    tcase_add_test(tests, csv_quotes_commas_and_leaves_gaps_for_no_number);
    tcase_add_test(tests, the_table_aligns_its_columns);
    tcase_add_test(tests, an_unknown_or_ambiguous_name_is_told_with_the_names_there_are);
    tcase_add_test(tests, the_page_is_whole_in_itself_and_escapes_what_it_is_told);
    tcase_add_test(tests, without_gnuplot_the_page_is_written_and_says_what_it_lacks);
    tcase_add_test(tests, points_without_an_error_are_drawn_all_the_same);
    tcase_add_test(tests, a_reference_stands_beside_its_number_with_the_deviation);
    tcase_add_test(tests, a_disc_at_the_corner_is_drawn_with_its_images);
    tcase_add_test(tests, bodies_are_drawn_as_they_are_seen_along_z);
    tcase_add_test(tests, a_broken_limit_is_the_first_thing_a_reader_sees);
    tcase_add_test(tests, where_nothing_can_be_written_the_sentence_names_the_path);
    tcase_add_test(tests, flow_curves_of_a_sweep_stand_in_one_table);
    tcase_add_test(tests, an_observable_without_a_row_is_drawn_by_the_plain_rule);
    tcase_add_test(tests, one_species_is_drawn_once);
    tcase_add_test(tests, beta_scaling_is_shown_about_its_plateau);
    tcase_add_test(tests, a_figure_of_a_sweep_says_which_points_it_lacks);
    tcase_add_test(tests, a_limit_is_drawn_over_its_half_of_the_axis);
    tcase_add_test(tests, friction_at_rest_is_a_level_where_forces_are_weak);
    tcase_add_test(tests, a_bound_behind_a_line_is_told);
    tcase_add_test(tests, the_tracers_step_is_drawn_against_cycles);
    tcase_add_test(tests, of_several_pictures_the_furthest_is_drawn_and_told);
    tcase_add_test(tests, of_too_many_curves_those_of_all_species_from_first_to_last_are_drawn);
    tcase_add_test(tests, many_names_stand_below_two_panels_and_not_on_them);
    tcase_add_test(tests, a_logarithmic_axis_shows_the_negative_of_what_ends_below_zero);
    tcase_add_test(tests, flows_both_ways_are_drawn_on_plain_axes);
    tcase_add_test(tests, noise_without_an_error_is_not_drawn_where_noise_is_not);
    tcase_add_test(tests, lags_over_decades_are_drawn_over_decades);
    tcase_add_loop_test(tests, rates_over_decades_are_drawn_over_decades, 0, 4);
    tcase_add_test(tests, the_relation_of_transients_has_a_figure);
    tcase_add_test(tests, a_series_over_a_plane_is_drawn_as_a_picture);
    tcase_add_test(tests, a_caption_says_where_the_only_number_of_an_axis_is);
    tcase_add_test(tests, gnuplot_takes_quoted_words_literally);
    tcase_set_timeout(tests, 60); // gnuplot on a busy machine
    Suite *suite = suite_create("report");
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
