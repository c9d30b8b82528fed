// SPDX-License-Identifier: GPL-3.0-or-later
// Run files and plans: what is written reads back equal, what is left out gets its default, what
// differs is told. Broken run files are in tests/cli/.
#include "observe.h"
#include "suite.h"

#include "config/config.h"
#include "results/results.h"

#include "base/memory.h"
#include "base/text.h"
#include "config/options.h"
#include "base/number.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char mixture[] = "title: \"A \\\"mixture\\\" of Größe \\\\ and #: signs\"\n"
                              "system:\n"
                              "  dimension: 2\n"
                              "  particles: 1e3\n"
                              "  packing_fraction: 0.7\n"
                              "  box: {aspect: [2, 0.1]}\n"
                              "  species:\n"
                              "    small: {shape: disc, fraction: 0.1, mass: 3}\n"
                              "    big:\n"
                              "      shape: disc\n"
                              "      diameter: 1.4\n"
                              "      fraction: 0.9\n"
                              "      spread: {distribution: gaussian, width: 0.05}\n"
                              "dynamics: {method: event-driven, thermostat_interval: 0.003}\n"
                              "protocol:\n"
                              "  - {stage: settle, time: 5, dynamics: {method: newtonian}}\n"
                              "  - stage: rest\n"
                              "    time: 0.5\n"
                              "    observe: [pressure, mean_squared_displacement: {origins: 7}]\n"
                              "observe:\n"
                              "  pressure: {blocks: 3}\n"
                              "ensemble: {replicas: 8, seed: 9007199254740992}\n"
                              "output: {trajectory: {every: 0.1}, checkpoint_every: 2 min}\n";

static Plan *plan_of(const char *text, const ConfigOverrides *overrides) {
    Plan *plan = NULL;
    const Status status = config_read_text(&plan, "test", text, strlen(text), overrides);
    ck_assert_msg(status == OK, "%s", status_sentence());
    return plan;
}

static void assert_equal(const Plan *a, const Plan *b) {
    char *difference = NULL;
    ck_assert_int_eq(config_difference(a, b, &difference), OK);
    ck_assert_str_eq(difference, "");
    memory_free(difference);
    ck_assert(memcmp(a, b, sizeof *a) == 0);
}

START_TEST(a_written_plan_reads_back_equal) {
    Plan *plan = plan_of(mixture, NULL);
    char *text = NULL;
    ck_assert_int_eq(config_write(plan, &text), OK);
    Plan *again = plan_of(text, NULL);
    assert_equal(plan, again);
    char *text_again = NULL;
    ck_assert_int_eq(config_write(again, &text_again), OK);
    ck_assert_str_eq(text, text_again);
    memory_free(text);
    memory_free(text_again);
    memory_free(plan);
    memory_free(again);
}
END_TEST

static bool observable_of_discs(const ObservableKind *kind) {
    const System discs = system_of(2, 100, 0.5, 1);
    const Clock clock = {.tick = 0.01,
                         .ticks = 100,
                         .ticks_per_step = 1,
                         .unit = "d^2/D0",
                         .stage = "rest",
                         .flies = true};
    const Settings settings = settings_of(&kind->options);
    return !kind->check || kind->check(&settings, &discs, &clock) == OK;
}

START_TEST(a_plan_of_every_observable_reads_back_equal) {
    char text[4096];
    size_t length = (size_t)snprintf(text, sizeof text,
                                     "system: {dimension: 2, particles: 100, packing_fraction: "
                                     "0.5, species: {disc: {shape: disc}}}\n"
                                     "dynamics: {method: event-driven}\n"
                                     "protocol:\n  - stage: rest\n    time: 1\n    observe:\n");
    for (size_t k = 0; observable_kinds[k]; k++) {
        if (!observable_of_discs(observable_kinds[k])) continue;
        length += (size_t)snprintf(text + length, sizeof text - length, "      - %s\n",
                                   observable_kinds[k]->name);
    }
    Plan *plan = plan_of(text, NULL);
    char *written = NULL;
    ck_assert_int_eq(config_write(plan, &written), OK);
    Plan *again = plan_of(written, NULL);
    assert_equal(plan, again);
    memory_free(again);
    memory_free(written);
    memory_free(plan);
}
END_TEST

START_TEST(values_arrive_where_they_belong) {
    Plan *plan = plan_of(mixture, NULL);
    ck_assert_str_eq(plan->title, "A \"mixture\" of Größe \\ and #: signs");
    ck_assert_int_eq(plan->system.particles, 1000);
    ck_assert(plan->system.packing_fraction == 0.7 && plan->system.number_density == 0);
    ck_assert(plan->system.aspect.count == 2 && plan->system.aspect.values[1] == 0.1);
    ck_assert_uint_eq(plan->system.species_count, 2);
    ck_assert_str_eq(plan->system.species[0].name, "small");
    ck_assert(plan->system.species[0].mass == 3 && plan->system.species[0].diameter == 1);
    ck_assert_int_eq(plan->system.species[1].spread, SPREAD_GAUSSIAN);
    ck_assert_str_eq(plan->stages[0].dynamics.kind->name, "newtonian");
    ck_assert_str_eq(plan->stages[1].dynamics.kind->name, "event-driven");
    ck_assert_uint_eq(plan->stages[0].observation_count, 0);
    ck_assert_uint_eq(plan->stages[1].observation_count, 2);
    ck_assert_str_eq(plan->stages[1].observations[0].kind->name, "pressure");
    ck_assert_int_eq(plan->ensemble.seed, INT64_C(9007199254740992));
    ck_assert(plan->output.trajectory_every == 0.1 && plan->output.checkpoint_every == 120);
    memory_free(plan);
}
END_TEST

// The value of a key in the table of a kind.
static double setting(const OptionTable *table, const Settings *settings, const char *name) {
    for (size_t i = 0; i < table->count; i++) {
        const Option *row = &table->rows[i];
        if (strcmp(row->name, name) != 0) continue;
        if (row->type == OPTION_REAL) return *(const double *)(settings->bytes + row->offset);
        return (double)*(const int64_t *)(settings->bytes + row->offset);
    }
    ck_abort_msg("no key %s", name);
    return 0;
}

START_TEST(settings_of_an_observable_come_from_stage_then_file_then_table) {
    Plan *plan = plan_of(mixture, NULL);
    const Observation *pressure = &plan->stages[1].observations[0];
    const Observation *displacement = &plan->stages[1].observations[1];
    ck_assert(setting(&pressure->kind->options, &pressure->settings, "blocks") == 3);
    ck_assert(setting(&displacement->kind->options, &displacement->settings, "origins") == 7);
    memory_free(plan);
    static const char *const in_stage[] = {"protocol.rest.observe=[pressure: {blocks: 5}]"};
    const ConfigOverrides overrides = {1, in_stage};
    plan = plan_of(mixture, &overrides);
    pressure = &plan->stages[1].observations[0];
    ck_assert(setting(&pressure->kind->options, &pressure->settings, "blocks") == 5);
    memory_free(plan);
}
END_TEST

START_TEST(a_stage_overrides_some_keys_of_the_dynamics) {
    static const char *const longer[] = {"protocol.rest.dynamics.thermostat_interval=0.01"};
    const ConfigOverrides overrides = {1, longer};
    Plan *plan = plan_of(mixture, &overrides);
    const Dynamics *all = &plan->dynamics, *rest = &plan->stages[1].dynamics;
    ck_assert_ptr_eq(rest->kind, all->kind);
    ck_assert(setting(&all->kind->options, &all->settings, "thermostat_interval") == 0.003);
    ck_assert(setting(&rest->kind->options, &rest->settings, "thermostat_interval") == 0.01);
    memory_free(plan);
}
END_TEST

START_TEST(a_title_may_fill_its_room) {
    char setting[OPTION_TEXT_SIZE + 8] = "title=";
    memset(setting + strlen(setting), 't', OPTION_TEXT_SIZE - 1);
    const char *const settings[] = {setting};
    const ConfigOverrides overrides = {1, settings};
    Plan *plan = plan_of(mixture, &overrides);
    ck_assert_uint_eq(strlen(plan->title), OPTION_TEXT_SIZE - 1);
    memory_free(plan);
}
END_TEST

START_TEST(overrides_replace_and_add_values) {
    static const char *const settings[] = {"system.particles=500", "ensemble={seed: 3}",
                                           "system.species.big.diameter=1.3",
                                           "protocol.settle.time=7", "title=another"};
    const ConfigOverrides overrides = {5, settings};
    Plan *plan = plan_of(mixture, &overrides);
    ck_assert_int_eq(plan->system.particles, 500);
    ck_assert_int_eq(plan->ensemble.seed, 3);
    ck_assert(plan->system.species[1].diameter == 1.3);
    ck_assert(plan->stages[0].time == 7);
    ck_assert_str_eq(plan->title, "another");
    memory_free(plan);
}
END_TEST

START_TEST(a_difference_is_told_key_by_key) {
    static const char *const settings[] = {"system.species.big.diameter=1.3",
                                           "protocol.rest.time=0.25",
                                           "protocol.rest.observe=[pressure]", "ensemble.seed=2"};
    const ConfigOverrides overrides = {4, settings};
    Plan *a = plan_of(mixture, NULL), *b = plan_of(mixture, &overrides);
    char *text = NULL;
    ck_assert_int_eq(config_difference(a, b, &text), OK);
    ck_assert_ptr_nonnull(strstr(text, "system.species.big.diameter: was 1.4, now 1.3\n"));
    ck_assert_ptr_nonnull(strstr(text, "protocol.rest.time: was 0.5, now 0.25\n"));
    ck_assert_ptr_nonnull(strstr(text, "protocol.rest.observe: was {mean_squared_displacement"));
    ck_assert_ptr_nonnull(strstr(text, "ensemble.seed: was 9007199254740992, now 2\n"));
    ck_assert_ptr_null(strstr(text, "pressure"));
    memory_free(text);
    ck_assert_int_eq(config_difference(b, a, &text), OK);
    ck_assert_ptr_nonnull(strstr(text, "protocol.rest.observe: was not there, now {mean_squared_"));
    memory_free(text);
    memory_free(a);
    memory_free(b);
}
END_TEST

typedef struct AllTypes {
    double real, duration;
    int64_t integer, boolean, choice;
    uint64_t choices;
    char text[OPTION_TEXT_SIZE];
    OptionReals reals;
} AllTypes;

static const char *const axes[] = {"x", "y", "xy", NULL};

static const Option all_rows[] = {
    {"real", OPTION_REAL, offsetof(AllTypes, real), 0.25, 0, 0, "d", "A number."},
    {"below.duration", OPTION_DURATION, offsetof(AllTypes, duration), 5, 0, 1e6, "s", "A time."},
    {"below.integer", OPTION_INTEGER, offsetof(AllTypes, integer), 3, 0, 0, "", "A count."},
    {"boolean", OPTION_BOOLEAN, offsetof(AllTypes, boolean), 1, 0, 0, "", "Whether."},
    {"choice", OPTION_CHOICE, offsetof(AllTypes, choice), 1, 0, 0, "", "Which.", axes},
    {"choices", OPTION_CHOICES, offsetof(AllTypes, choices), 0, 0, 0, "", "Which of.", axes,
     "[x, xy]"},
    {"text", OPTION_TEXT, offsetof(AllTypes, text), 0, 0, 0, "", "A word.", NULL, "some words"},
    {"reals", OPTION_REALS, offsetof(AllTypes, reals), 0, 0, 0, "", "Numbers.", NULL, "[1, 2.5]"},
};
static const OptionTable all_types = OPTION_TABLE(all_rows, AllTypes);

static Status read_all(const char *text, AllTypes *values) {
    const OptionTarget target = {&all_types, values};
    const OptionMap options = {"all types", &target, 1, NULL};
    Node *root = NULL;
    Status status = tree_read(&root, "test", text, strlen(text));
    if (status == OK) status = options_read(&options, root, true);
    tree_free(root);
    return status;
}

START_TEST(every_type_has_its_default) {
    AllTypes values;
    memset(&values, 0xFF, sizeof values);
    ck_assert_int_eq(options_default(&all_types, &values), OK);
    ck_assert(values.real == 0.25 && values.duration == 5 && values.integer == 3);
    ck_assert(values.boolean == 1 && values.choice == 1 && values.choices == 5);
    ck_assert_str_eq(values.text, "some words");
    ck_assert(values.reals.count == 2 && values.reals.values[1] == 2.5);
}
END_TEST

START_TEST(every_type_is_read) {
    AllTypes values = {0};
    ck_assert_int_eq(read_all("{real: -1e-3, below: {duration: 2 h, integer: -7}, boolean: false,"
                              " choice: xy, choices: [y, x], text: '1', reals: 4}",
                              &values),
                     OK);
    ck_assert(values.real == -0.001 && values.duration == 7200 && values.integer == -7);
    ck_assert(values.boolean == 0 && values.choice == 2 && values.choices == 3);
    ck_assert_str_eq(values.text, "1");
    ck_assert(values.reals.count == 1 && values.reals.values[0] == 4);
}
END_TEST

START_TEST(every_type_is_refused_with_what_was_expected) {
    static const struct {
        const char *text, *sentence;
    } cases[] = {
        {"boolean: 1", "test:1:1: error: boolean = 1 is not true or false"},
        {"boolean: [true]", "test:1:1: error: boolean is a list; expected true or false"},
        {"choice: z", "test:1:1: error: choice = z is unknown; did you mean x?"},
        {"choices: {x: 1}", "test:1:1: error: choices is a map; expected a list of words from x, y,"
                            " xy"},
        {"choices: [x, diagonal]", "test:1:14: error: choices = diagonal is not one of x, y, xy"},
        {"reals: {x: 1}", "test:1:1: error: reals is a map; expected a list of numbers"},
        {"below: {duration: [1 s]}", "test:1:9: error: below.duration is a list; expected a "
                                     "duration such as 600 s, 10 min or 2 h, from 0 to 1e6 s"},
        {"below: {real: 1}",
         "test:1:9: error: unknown key 'real' in below of all types; expected duration, "
         "integer"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        AllTypes values = {0};
        ck_assert_int_eq(read_all(cases[i].text, &values), BAD_DATA);
        ck_assert_str_eq(status_sentence(), cases[i].sentence);
    }
}
END_TEST

START_TEST(every_type_reads_back_as_written) {
    AllTypes values = {0}, back = {0};
    ck_assert_int_eq(options_default(&all_types, &values), OK);
    ck_assert_int_eq(options_default(&all_types, &back), OK);
    values.boolean = 0;
    values.choices = 6;
    strcpy(values.text, "\"quoted\" \\ 1");
    values.reals = (OptionReals){3, {0.1, -1e300, 3}};
    for (size_t i = 0; i < all_types.count; i++) {
        Text text = {0};
        Node *node = NULL;
        option_write(&all_rows[i], &values, &text);
        ck_assert_int_eq(tree_read_value(&node, "test", text_words(&text)), OK);
        ck_assert_int_eq(option_read(&all_rows[i], node, &back), OK);
        tree_free(node);
        text_free(&text);
    }
    ck_assert(memcmp(&values, &back, sizeof values) == 0);
}
END_TEST

START_TEST(every_double_reads_back_from_its_shortest_number) {
    uint64_t bits = UINT64_C(0x9E3779B97F4A7C15); // any start: a walk through all exponents
    for (int i = 0; i < 20000; i++) {
        bits = bits * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        double value, back = 0;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        char text[NUMBER_SIZE];
        number_write(text, value);
        ck_assert_msg(number_read(text, &back), "%s", text);
        ck_assert_msg(back == value, "%s is not %a", text, value);
    }
}
END_TEST

START_TEST(numbers_are_written_as_people_write_them) {
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},
                 {1, "1"},
                 {-0.5, "-0.5"},
                 {0.1, "0.1"},
                 {1000, "1000"},
                 {1e6, "1e6"},
                 {1234567, "1234567"},
                 {1e-3, "0.001"},
                 {1e-7, "1e-7"},
                 {2e9, "2e9"},
                 {1e22, "1e22"},
                 {0.3, "0.3"},
                 {1.0 / 3, "0.3333333333333333"},
                 {5e-324, "5e-324"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[NUMBER_SIZE];
        ck_assert_str_eq(number_write(text, cases[i].value), cases[i].text);
    }
}
END_TEST

START_TEST(only_decimal_numbers_are_numbers) {
    static const char *const numbers[] = {"1",    "-1",   "+1", "0.5", ".5",   "5.",
                                          "1e-3", "1E+3", "0",  "0e5", "00012"};
    static const char *const others[] = {"",      "-",      ".",     "e5", "1e",  "1e+",   "0x10",
                                         "nan",   "inf",    "1 ",    " 1", "1,5", "1_000", "1.2.3",
                                         "1e400", "1e-400", "0x1p3", "1f", "--1"};
    double value;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        ck_assert_msg(number_read(numbers[i], &value), "%s", numbers[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        ck_assert_msg(!number_read(others[i], &value), "%s", others[i]);
}
END_TEST

START_TEST(whole_numbers_are_exact) {
    int64_t value = 0;
    ck_assert(number_read_whole("9223372036854775807", &value) && value == INT64_MAX);
    ck_assert(number_read_whole("-9223372036854775808", &value) && value == INT64_MIN);
    ck_assert(number_read_whole("1e6", &value) && value == 1000000);
    ck_assert(number_read_whole("-0.2e1", &value) && value == -2);
    ck_assert(!number_read_whole("9223372036854775808", &value));
    ck_assert(!number_read_whole("1.5", &value));
    ck_assert(!number_read_whole("1e17", &value));
}
END_TEST

START_TEST(every_key_of_every_table_can_be_explained) {
    FILE *nowhere = fopen("/dev/null", "w");
    ck_assert_ptr_nonnull(nowhere);
    ck_assert_int_eq(config_explain(NULL, nowhere), OK);
    for (size_t k = 0; observable_kinds[k]; k++) {
        ck_assert_int_eq(config_explain(observable_kinds[k]->name, nowhere), OK);
        for (size_t i = 0; i < observable_kinds[k]->options.count; i++)
            ck_assert_int_eq(config_explain(observable_kinds[k]->options.rows[i].name, nowhere),
                             OK);
    }
    for (size_t k = 0; propagator_kinds[k]; k++)
        ck_assert_int_eq(config_explain(propagator_kinds[k]->name, nowhere), OK);
    for (size_t k = 0; k < SHAPES; k++)
        ck_assert_int_eq(config_explain(shape_names[k], nowhere), OK);
    for (size_t k = 0; result_meaning_at(k); k++) {
        char name[RESULT_NAME];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(result_meaning_at(k)->name, "*"),
                 result_meaning_at(k)->name);
        ck_assert_int_eq(config_explain(name, nowhere), OK);
        ck_assert_ptr_eq(result_meaning(name), result_meaning_at(k));
    }
    for (size_t k = 0; result_series_meaning_at(k); k++) {
        const ResultMeaning *row = result_series_meaning_at(k);
        char name[RESULT_NAME];
        snprintf(name, sizeof name, "%s%s", row->of ? "" : "self_scattering",
                 row->name + (row->of ? 0 : 1));
        ck_assert_int_eq(config_explain(name, nowhere), OK);
        ck_assert_ptr_eq(result_series_meaning(name), row);
    }
    ck_assert_ptr_null(result_series_meaning("gibberish_scaled"));
    ck_assert_ptr_null(result_series_meaning("_scaled"));
    ck_assert_str_eq(result_meaning("long_time_diffusion_y_big")->name, "long_time_diffusion*");
    ck_assert_ptr_null(result_meaning("long_time_diffusions"));
    ck_assert_ptr_null(result_meaning("wake_length_big"));
    ck_assert_int_eq(config_explain("gibberish", nowhere), BAD_USAGE);
    fclose(nowhere);
}
END_TEST

START_TEST(a_stage_is_written_with_its_own_drive_alone) {
    static const char sheared[] = "system: {dimension: 2, particles: 100, packing_fraction: 0.5, "
                                  "species: {a: {shape: disc}}}\n"
                                  "dynamics: {method: event-driven, thermostat_interval: 0.01}\n"
                                  "protocol:\n"
                                  "  - {stage: rest, time: 1}\n"
                                  "  - {stage: flow, strain: 2, shear_rate: 0.5}\n";
    Plan *plan = plan_of(sheared, NULL), *again = NULL;
    char *text = NULL;
    ck_assert_int_eq(config_write(plan, &text), OK);
    const char *rest = strstr(text, "stage: \"rest\""), *flow = strstr(text, "stage: \"flow\"");
    ck_assert_ptr_nonnull(rest);
    ck_assert_ptr_nonnull(flow);
    ck_assert(strstr(rest, "shear_rate") > flow);
    ck_assert(strstr(rest, "strain") > flow);
    ck_assert_ptr_nonnull(strstr(flow, "shear_rate: 0.5"));
    ck_assert_ptr_null(strstr(flow, " time:"));
    ck_assert_ptr_null(strstr(text, "pull"));
    ck_assert_ptr_null(strstr(text, "until"));
    again = plan_of(text, NULL);
    assert_equal(plan, again);
    memory_free(text);
    memory_free(plan);
    memory_free(again);
}
END_TEST

static void assert_refused(const char *text, const char *sentences) {
    Plan *plan = NULL;
    ck_assert_int_eq(config_read_text(&plan, "slips", text, strlen(text), NULL), BAD_DATA);
    ck_assert_ptr_null(plan);
    ck_assert_str_eq(status_sentence(), sentences);
}

// The misspelt key is not asked for again as one that is missing, nor is the stage's step judged
// under a method that is unknown, nor the same setting told for each stage that uses it.
START_TEST(all_slips_of_a_run_file_are_told_at_once) {
    assert_refused("system:\n"
                   "  dimension: 4\n"
                   "  particels: 100\n"
                   "  packing_fraction: 0.7\n"
                   "  species: {a: {shape: disk, fraction: 1}}\n"
                   "dynamics: {method: event-drivn}\n"
                   "protocol:\n"
                   "  - {stage: settle, time: 5, dynamics: {step: 1}, observe: [pressure]}\n"
                   "  - {stage: rest, tim: 10, observe: [pressure]}\n"
                   "observe: {pressure: {blocks: -3}}\n",
                   "slips:2:3: error: dimension = 4 is out of range; expected a value from 2 to 3\n"
                   "slips:3:3: error: unknown key 'particels' in system; did you mean "
                   "'particles'?\n"
                   "slips:5:17: error: shape = disk is unknown; did you mean disc?\n"
                   "slips:6:12: error: unknown method 'event-drivn'; did you mean event-driven?\n"
                   "slips:10:22: error: blocks = -3 is out of range; expected a value from 1 to "
                   "100000\n"
                   "slips:9:19: error: unknown key 'tim' in stage 'rest'; did you mean 'time'?");
}
END_TEST

START_TEST(what_no_single_value_shows_is_told_at_once_too) {
    assert_refused("system:\n"
                   "  dimension: 2\n"
                   "  particles: 100\n"
                   "  packing_fraction: 0.7\n"
                   "  box: {aspect: [1, 1, 1]}\n"
                   "  species:\n"
                   "    a: {shape: sphere, fraction: 0.5}\n"
                   "    b: {shape: disc, length: 3, fraction: 0.5}\n"
                   "dynamics: {method: event-driven, thermostat_interval: 0.01}\n"
                   "protocol: [{stage: rest, time: 1}]\n",
                   "slips:5:9: error: box.aspect has 3 numbers; a box in 2 dimensions has 2 "
                   "edges\n"
                   "slips:7:9: error: shape = sphere lives in 3 dimensions, but dimension = 2\n"
                   "slips:8:22: error: length = 3 is that of a spherocylinder; a disc has none");
    assert_refused("title: nothing\n", "slips:1:1: error: there is no 'system': what is simulated\n"
                                       "slips:1:1: error: there is no 'dynamics': how time "
                                       "advances, as {method: event-driven}\n"
                                       "slips:1:1: error: there is no 'protocol': the list of "
                                       "stages");
}
END_TEST

START_TEST(of_many_slips_the_first_ten_are_told) {
    Text text = {0};
    for (int i = 1; i <= 30; i++) text_add(&text, "unheard-of-%d: 1\n", i);
    Plan *plan = NULL;
    ck_assert_int_eq(config_read_text(&plan, "slips", text.bytes, text.length, NULL), BAD_DATA);
    const char *line = status_sentence();
    for (int i = 1; i <= 10; i++, line += strcspn(line, "\n") + 1) {
        char begin[64];
        const int length = snprintf(begin, sizeof begin, "slips:%d:1: error: unknown key", i);
        ck_assert_msg(strncmp(line, begin, (size_t)length) == 0, "%s", line);
        if (i == 10) ck_assert_ptr_null(strchr(line, '\n'));
    }
    text_free(&text);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("config");
    TCase *cases = tcase_create("run files");
    tcase_add_test(cases, a_written_plan_reads_back_equal);
    tcase_add_test(cases, a_plan_of_every_observable_reads_back_equal);
    tcase_add_test(cases, values_arrive_where_they_belong);
    tcase_add_test(cases, settings_of_an_observable_come_from_stage_then_file_then_table);
    tcase_add_test(cases, a_stage_overrides_some_keys_of_the_dynamics);
    tcase_add_test(cases, a_title_may_fill_its_room);
    tcase_add_test(cases, overrides_replace_and_add_values);
    tcase_add_test(cases, a_difference_is_told_key_by_key);
    tcase_add_test(cases, every_type_has_its_default);
    tcase_add_test(cases, every_type_is_read);
    tcase_add_test(cases, every_type_is_refused_with_what_was_expected);
    tcase_add_test(cases, every_type_reads_back_as_written);
    tcase_add_test(cases, every_double_reads_back_from_its_shortest_number);
    tcase_add_test(cases, numbers_are_written_as_people_write_them);
    tcase_add_test(cases, only_decimal_numbers_are_numbers);
    tcase_add_test(cases, whole_numbers_are_exact);
    tcase_add_test(cases, every_key_of_every_table_can_be_explained);
    tcase_add_test(cases, a_stage_is_written_with_its_own_drive_alone);
    tcase_add_test(cases, all_slips_of_a_run_file_are_told_at_once);
    tcase_add_test(cases, what_no_single_value_shows_is_told_at_once_too);
    tcase_add_test(cases, of_many_slips_the_first_ten_are_told);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
