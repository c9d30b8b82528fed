// SPDX-License-Identifier: GPL-3.0-or-later
// The store: what is written is read back, what is damaged is refused in a sentence, and nobody
// writes over anybody. Each test works in a directory of its own.
#include "suite.h"

#include "base/memory.h"
#include "store/checkpoint.h"
#include "store/store.h"
#include "store/trajectory.h"

#include <check.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char directory[] = "/tmp/perrin-store-123456"; // the digits are mkdtemp's to change
static char run[sizeof directory + 8];

static void make_directory(void) {
    memset(directory + sizeof directory - 7, 'X', 6);
    ck_assert_ptr_nonnull(mkdtemp(directory));
    snprintf(run, sizeof run, "%s/run", directory);
}

static void remove_directory(void) {
    char command[sizeof directory + 16];
    snprintf(command, sizeof command, "rm -rf %s", directory);
    ck_assert_int_eq(system(command), 0);
}

static void says(const char *words) {
    if (!strstr(status_sentence(), words)) {
        ck_abort_msg("'%s' is not in the sentence: %s", words, status_sentence());
    }
}

static Store *open_run(void) {
    Store *store = NULL;
    bool resumes;
    ck_assert_msg(store_open(&store, run) == OK, "%s", status_sentence());
    ck_assert_msg(store_take_plan(store, "particles: 10\n", &resumes) == OK, "%s",
                  status_sentence());
    return store;
}

static char *path_of(const char *name) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", run, name);
    return path;
}

static long file_size(const char *name) {
    struct stat about;
    return stat(path_of(name), &about) == 0 ? (long)about.st_size : -1;
}

static unsigned char *file_bytes(const char *name, size_t *size) {
    *size = (size_t)file_size(name);
    unsigned char *bytes = malloc(*size + 1);
    FILE *file = fopen(path_of(name), "rb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static void write_bytes(const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(path_of(name), "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void flip_bit(const char *name, long byte, int bit) {
    size_t size;
    unsigned char *bytes = file_bytes(name, &size);
    bytes[byte] ^= (unsigned char)(1 << bit);
    write_bytes(name, bytes, size);
    free(bytes);
}

// ---- the directory ----

START_TEST(second_store_on_a_directory_is_locked_out_with_the_name_of_the_holder) {
    Store *first = open_run(), *second = NULL;
    ck_assert_int_eq(store_open(&second, run), LOCKED);
    char holder[64];
    snprintf(holder, sizeof holder, "process %ld on ", (long)getpid());
    says(holder);
    says(run);
    store_close(first);
    ck_assert_int_eq(store_open(&second, run), OK);
    store_close(second);
}
END_TEST

START_TEST(another_plan_is_refused_with_the_line_that_differs) {
    store_close(open_run());
    Store *store = NULL;
    bool resumes;
    ck_assert_int_eq(store_open(&store, run), OK);
    ck_assert_int_eq(store_take_plan(store, "particles: 11\n", &resumes), LOCKED);
    says("line 1");
    says("'particles: 10'");
    says("'particles: 11'");
    ck_assert_int_eq(store_take_plan(store, "particles: 10\n", &resumes), OK);
    ck_assert(resumes);
    store_close(store);
}
END_TEST

START_TEST(results_without_a_plan_are_not_written_over) {
    ck_assert_int_eq(mkdir(run, 0777), 0);
    write_bytes("results.h5", "precious", 8);
    Store *store = NULL;
    bool resumes;
    ck_assert_int_eq(store_open(&store, run), OK);
    ck_assert_int_eq(store_take_plan(store, "particles: 10\n", &resumes), LOCKED);
    says("results.h5");
    ck_assert_int_eq(file_size("plan.yaml"), -1);
    store_close(store);
}
END_TEST

START_TEST(texts_and_log_lines_are_kept) {
    Store *store = open_run();
    char *text = NULL;
    ck_assert_int_eq(store_read_text(store, "plan.yaml", &text), OK);
    ck_assert_str_eq(text, "particles: 10\n");
    free(text);
    ck_assert_int_eq(store_read_text(store, "nothing.txt", &text), OK);
    ck_assert_ptr_null(text);
    ck_assert_int_eq(store_log(store, "one %d", 1), OK);
    ck_assert_int_eq(store_log(store, "two"), OK);
    ck_assert_int_eq(store_read_text(store, "log.txt", &text), OK);
    ck_assert_ptr_nonnull(strstr(text, " one 1\n"));
    int zone = 0, read = 0; // that a reader elsewhere knows when it was
    ck_assert_int_eq(sscanf(text, "%*d-%*d-%*d %*d:%*d:%*d %5d%n", &zone, &read), 1);
    ck_assert_int_eq(read, (int)strlen("2026-01-31 12:00:00 +0000"));
    ck_assert_ptr_nonnull(strstr(text, " two\n"));
    free(text);
    store_close(store);
}
END_TEST

START_TEST(a_directory_that_cannot_be_made_is_an_io_failure_with_path_and_reason) {
    Store *store = NULL;
    ck_assert_int_eq(store_open(&store, "/proc/nowhere/run"), IO_FAILED);
    says("/proc/nowhere/run");
    says("No such file");
    fclose(fopen(run, "w"));
    ck_assert_int_eq(store_open(&store, run), IO_FAILED);
    says("Not a directory");
}
END_TEST

START_TEST(left_over_temporary_files_do_no_harm) {
    Store *store = open_run();
    write_bytes("notes.txt.new", "torn", 4);
    ck_assert_int_eq(store_write_text(store, "notes.txt", "whole"), OK);
    ck_assert_int_eq(file_size("notes.txt"), 5);
    ck_assert_int_eq(file_size("notes.txt.new"), -1);
    store_close(store);
}
END_TEST

// ---- checkpoints ----

static void write_checkpoint(Store *store, const char *text) {
    ck_assert_msg(checkpoint_write(store, 3, text, strlen(text)) == OK, "%s", status_sentence());
}

static void reads_checkpoint(Store *store, const char *text) {
    void *bytes = NULL;
    size_t size;
    ck_assert_msg(checkpoint_read(store, 3, &bytes, &size) == OK, "%s", status_sentence());
    ck_assert_ptr_nonnull(bytes);
    ck_assert_uint_eq(size, strlen(text));
    ck_assert_mem_eq(bytes, text, size);
    free(bytes);
}

START_TEST(the_newest_checkpoint_counts_and_the_one_before_stays) {
    Store *store = open_run();
    void *bytes = NULL;
    size_t size;
    ck_assert_int_eq(checkpoint_read(store, 3, &bytes, &size), OK);
    ck_assert_ptr_null(bytes);
    const char *texts[] = {"first", "second one", "third", "fourth"};
    for (int i = 0; i < 4; i++) {
        write_checkpoint(store, texts[i]);
        reads_checkpoint(store, texts[i]);
    }
    ck_assert_int_eq(unlink(path_of("checkpoint/replica-0003.b")), 0);
    reads_checkpoint(store, "third");
    store_close(store);
}
END_TEST

START_TEST(a_damaged_newest_checkpoint_falls_back_to_the_one_before_and_the_log_says_so) {
    Store *store = open_run();
    write_checkpoint(store, "first");
    write_checkpoint(store, "second");
    flip_bit("checkpoint/replica-0003.b", file_size("checkpoint/replica-0003.b") - 1, 5);
    reads_checkpoint(store, "first");
    char *log = NULL;
    ck_assert_int_eq(store_read_text(store, "log.txt", &log), OK);
    ck_assert_ptr_nonnull(strstr(log, "replica-0003.b"));
    free(log);
    write_checkpoint(store, "third");
    reads_checkpoint(store, "third");
    store_close(store);
}
END_TEST

START_TEST(every_flipped_bit_and_every_cut_of_a_checkpoint_is_seen) {
    Store *store = open_run();
    write_checkpoint(store, "the state");
    const char *name = "checkpoint/replica-0003.a";
    size_t size;
    unsigned char *whole = file_bytes(name, &size);
    void *bytes = NULL;
    size_t length;
    for (size_t bit = 0; bit < 8 * size; bit++) {
        flip_bit(name, (long)(bit / 8), (int)(bit % 8));
        ck_assert_int_eq(checkpoint_read(store, 3, &bytes, &length), BAD_DATA);
        says(name);
        write_bytes(name, whole, size);
    }
    for (size_t cut = 0; cut < size; cut++) {
        write_bytes(name, whole, cut);
        ck_assert_int_eq(checkpoint_read(store, 3, &bytes, &length), BAD_DATA);
        says("cut off");
    }
    write_bytes(name, whole, size);
    reads_checkpoint(store, "the state");
    free(whole);
    store_close(store);
}
END_TEST

START_TEST(a_checkpoint_of_another_plan_or_replica_is_refused) {
    Store *store = open_run();
    write_checkpoint(store, "the state");
    void *bytes = NULL;
    size_t size;
    ck_assert_int_eq(rename(path_of("checkpoint/replica-0003.a"), "/tmp/perrin-moved"), 0);
    ck_assert_int_eq(rename("/tmp/perrin-moved", path_of("checkpoint/replica-0004.a")), 0);
    ck_assert_int_eq(checkpoint_read(store, 4, &bytes, &size), BAD_DATA);
    says("another replica");
    store_close(store);
    ck_assert_int_eq(unlink(path_of("plan.yaml")), 0);
    bool resumes;
    ck_assert_int_eq(store_open(&store, run), OK);
    write_bytes("plan.yaml", "particles: 11\n", 14);
    ck_assert_int_eq(store_take_plan(store, "particles: 11\n", &resumes), OK);
    ck_assert_int_eq(checkpoint_read(store, 4, &bytes, &size), BAD_DATA);
    says("another plan");
    store_close(store);
}
END_TEST

// ---- results ----

static Results *some_results(void) {
    static const double times[3] = {0.1, 1, 10};
    static const char *const species[2] = {"small", "größer"};
    const ResultSeries shape = {
        .stage = "quiescent",
        .observable = "mean_squared_displacement",
        .unit = "d^2",
        .about = "how far",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = 2, .labels = species},
                 {.name = "time", .unit = "d^2/D0", .count = 3, .values = times}},
    };
    const ResultSeries empty = {
        .stage = "quiescent",
        .observable = "nothing",
        .axes = 1,
        .axis = {{.name = "time", .unit = "", .count = 0, .values = times}},
    };
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 2), OK);
    for (size_t r = 0; r < 2; r++) {
        const double values[6] = {1, 2, 3, 4, 5, r ? NAN : 6.5};
        ck_assert_int_eq(results_put_series(results, &shape, r, values), OK);
        ck_assert_int_eq(results_put_series(results, &empty, r, values), OK);
    }
    results_put_scalar(results, "quiescent", "pressure", "kT/d^2", "of the wall", 0, 9.25);
    results_put_scalar(results, "quiescent", "pressure", "kT/d^2", "of the wall", 1, 9.75);
    results_put_scalar(results, "alone", "a", "", "", 1, -1);
    results_put_fact(results, "version", "0.1.0");
    results_put_fact(results, "title", "");
    results_put_fact(results, "replicas", "2");
    char *plan = malloc(100001);
    memset(plan, 'x', 100000);
    plan[100000] = '\0';
    results_put_fact(results, "plan", plan);
    free(plan);
    results_put_health(results, "overlaps", "pairs that overlap", 0, 0);
    results_put_health(results, "depth", "the deepest", NAN, 1e-14);
    return results;
}

static void write_results(Store *store) {
    Results *results = some_results();
    ck_assert_msg(store_write_results(store, results) == OK, "%s", status_sentence());
    results_free(results);
}

// As many axes as there may be, and replicas before them.
START_TEST(all_axes_come_back) {
    enum { SIZE = 1 << RESULT_AXES };
    static const double two[2] = {1, 2};
    static const char *const names[RESULT_AXES] = {"a", "b", "c", "d", "e", "f", "g", "h"};
    double values[SIZE];
    ResultSeries shape = {.stage = "stage", .observable = "cube", .axes = RESULT_AXES};
    for (size_t a = 0; a < RESULT_AXES; a++)
        shape.axis[a] = (ResultAxis){.name = names[a], .unit = "", .count = 2, .values = two};
    for (int i = 0; i < SIZE; i++) values[i] = i;
    Results *results = NULL, *found = NULL;
    Store *store = open_run();
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(results_put_series(results, &shape, 0, values), OK);
    ck_assert_msg(store_write_results(store, results) == OK, "%s", status_sentence());
    ck_assert_msg(store_read_results(&found, path_of("results.h5")) == OK, "%s", status_sentence());
    const ResultSeries *there = results_find_series(found, "stage", "cube");
    ck_assert_uint_eq(there->axes, RESULT_AXES);
    ck_assert_mem_eq(there->values, values, sizeof values);
    results_free(found);
    results_free(results);
    store_close(store);
}
END_TEST

START_TEST(results_come_back_as_they_were) {
    Store *store = open_run();
    write_results(store);
    Results *wanted = some_results(), *found = NULL;
    ck_assert_msg(store_read_results(&found, path_of("results.h5")) == OK, "%s", status_sentence());
    ck_assert_uint_eq(found->replicas, 2);
    ck_assert_uint_eq(found->series_count, wanted->series_count);
    ck_assert_uint_eq(found->scalar_count, wanted->scalar_count);
    ck_assert_uint_eq(found->fact_count, wanted->fact_count);
    for (size_t i = 0; i < wanted->fact_count; i++) {
        ck_assert_str_eq(results_find_fact(found, wanted->facts[i].name), wanted->facts[i].text);
    }
    const ResultSeries *a = &wanted->series[0];
    const ResultSeries *b = results_find_series(found, a->stage, a->observable);
    ck_assert_ptr_nonnull(b);
    ck_assert_str_eq(a->unit, b->unit);
    ck_assert_str_eq(a->about, b->about);
    ck_assert_uint_eq(b->axes, 2);
    ck_assert_str_eq(b->axis[0].name, "species");
    ck_assert_str_eq(b->axis[0].labels[1], "größer");
    ck_assert_str_eq(b->axis[1].unit, "d^2/D0");
    ck_assert_double_eq(b->axis[1].values[2], 10);
    ck_assert_mem_eq(a->values, b->values, 12 * sizeof(double)); // the NaN as well
    ck_assert_str_eq(found->scalars[0].quantity, "pressure");
    ck_assert_double_eq(results_scalar_estimate(found, &found->scalars[0]).value, 9.5);
    ck_assert(isnan(found->scalars[1].values[0]));
    ck_assert_str_eq(found->health[1].name, "depth");
    ck_assert_str_eq(found->health[1].about, "the deepest");
    ck_assert_double_eq(found->health[1].value, 1e-14);
    ck_assert_double_eq(found->health[0].limit, 0);
    ck_assert(isnan(found->health[1].limit));
    results_free(found);
    results_free(wanted);
    store_close(store);
}
END_TEST

START_TEST(any_number_of_results_is_kept) {
    Store *store = open_run();
    const ResultSeries number = {.stage = "s", .observable = "without axes"};
    for (int count = 0; count < 600; count += 1 + count / 8) {
        Results *results = NULL, *found = NULL;
        ck_assert_int_eq(results_create(&results, 1), OK);
        const double one = 1;
        ck_assert_int_eq(results_put_series(results, &number, 0, &one), OK);
        for (int i = 0; i < count; i++) {
            char name[16], text[1100];
            snprintf(name, sizeof name, "name%d", i);
            memset(text, 'x', sizeof text);
            text[i % 2 ? 1099 : 10] = '\0'; // a dataset, an attribute
            ck_assert_int_eq(results_put_scalar(results, "s", name, "", "", 0, i), OK);
            ck_assert_int_eq(results_put_fact(results, name, text), OK);
        }
        ck_assert_msg(store_write_results(store, results) == OK, "%d: %s", count,
                      status_sentence());
        ck_assert_msg(store_read_results(&found, path_of("results.h5")) == OK, "%d: %s", count,
                      status_sentence());
        ck_assert_uint_eq(found->scalar_count, (size_t)count);
        ck_assert_uint_eq(found->fact_count, (size_t)count);
        ck_assert_double_eq(results_find_series(found, "s", "without axes")->values[0], 1);
        results_free(results);
        results_free(found);
    }
    store_close(store);
}
END_TEST

START_TEST(the_same_results_are_the_same_bytes) {
    Store *store = open_run();
    size_t first_size, second_size;
    write_results(store);
    unsigned char *first = file_bytes("results.h5", &first_size);
    sleep(1); // a second that HDF5 would write down
    write_results(store);
    unsigned char *second = file_bytes("results.h5", &second_size);
    ck_assert_uint_eq(first_size, second_size);
    ck_assert_mem_eq(first, second, first_size);
    free(first);
    free(second);
    store_close(store);
}
END_TEST

START_TEST(results_cut_or_changed_are_refused_in_a_sentence) {
    Store *store = open_run();
    write_results(store);
    size_t size;
    unsigned char *whole = file_bytes("results.h5", &size);
    Results *results = NULL;
    for (size_t cut = 0; cut < size; cut += 1 + size / 97) {
        write_bytes("results.h5", whole, cut);
        ck_assert_int_eq(store_read_results(&results, path_of("results.h5")), BAD_DATA);
        says("results.h5");
    }
    for (size_t byte = 0; byte < size; byte += 1 + size / 211) {
        write_bytes("results.h5", whole, size);
        flip_bit("results.h5", (long)byte, (int)(byte % 8));
        ck_assert_int_eq(store_read_results(&results, path_of("results.h5")), BAD_DATA);
        says("results.h5");
    }
    free(whole);
    ck_assert_int_eq(store_read_results(&results, path_of("no.h5")), BAD_DATA);
    says("there is no file");
    store_close(store);
}
END_TEST

// ---- trajectories ----

static State *some_state(size_t count) {
    State *state = NULL;
    System system = {.dimension = 2,
                     .particles = (int64_t)count,
                     .packing_fraction = 0.3,
                     .species_count = 2,
                     .species = {{.name = "small", .diameter = 1, .mass = 1, .fraction = 0.5},
                                 {.name = "big", .diameter = 1.4, .mass = 1, .fraction = 0.5}}};
    ck_assert_msg(state_create(&state, &system) == OK, "%s", status_sentence());
    for (size_t i = 0; i < count; i++) state->diameter[i] = i < count / 2 ? 1 : 1.4;
    return state;
}

static void move(State *state, int64_t step) {
    for (size_t i = 0; i < state->count; i++) {
        state->position[0][i] = (double)i + (double)step / 64;
        state->position[1][i] = 0.5 * (double)i;
        state->image[0][i] = (int32_t)step;
    }
    state->step = step;
}

static Status write_frames(Trajectory *trajectory, State *state, int64_t from, int64_t to) {
    for (int64_t step = from; step < to; step++) {
        move(state, step);
        TRY(trajectory_write(trajectory, state, step, 0.01 * (double)step));
    }
    return OK;
}

static void has_frames(int64_t whole) {
    TrajectoryFile *file = NULL;
    ck_assert_msg(trajectory_file_open(&file, path_of("trajectory/replica-0002.h5")) == OK, "%s",
                  status_sentence());
    const TrajectoryContents contents = trajectory_file_contents(file);
    ck_assert_int_eq(contents.dimension, 2);
    ck_assert(!contents.oriented);
    ck_assert_double_eq(contents.diameter[contents.particles - 1], 1.4);
    ck_assert_int_eq(contents.species[contents.particles - 1], 1);
    for (int64_t k = 0; k < contents.frames; k++) {
        TrajectoryFrame frame;
        bool there;
        ck_assert_int_eq(trajectory_file_frame(file, k, &frame, &there), OK);
        ck_assert_int_eq(there, k < whole);
        if (!there) continue;
        ck_assert_int_eq(frame.step, k);
        ck_assert_double_eq(frame.position[3], 1 + (double)k / 64);
        ck_assert_int_eq(frame.image[3], (int)k);
        ck_assert_double_eq(frame.time, 0.01 * (double)k);
    }
    trajectory_file_close(file);
}

START_TEST(frames_come_back_and_those_not_written_are_not_there) {
    Store *store = open_run();
    State *state = some_state(10);
    Trajectory *trajectory = NULL;
    ck_assert_msg(trajectory_open(&trajectory, store, 2, state, 5, 0) == OK, "%s",
                  status_sentence());
    ck_assert_int_eq(write_frames(trajectory, state, 0, 3), OK);
    has_frames(3);
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    state_free(state);
    store_close(store);
}
END_TEST

// Spheres and rods, whose axes turn from frame to frame.
static State *some_bodies(size_t count) {
    State *state = NULL;
    System system = {
        .dimension = 3,
        .particles = (int64_t)count,
        .number_density = 0.01,
        .species_count = 2,
        .species = {
            {.name = "ball", .shape = SHAPE_SPHERE, .diameter = 3, .mass = 1, .fraction = 0.5},
            {.name = "rod",
             .shape = SHAPE_SPHEROCYLINDER,
             .diameter = 1,
             .length = 5,
             .mass = 1,
             .fraction = 0.5}}};
    ck_assert_msg(state_create(&state, &system) == OK, "%s", status_sentence());
    for (size_t i = 0; i < count; i++) state->diameter[i] = i < count / 2 ? 3 : 1;
    return state;
}

static void aim(State *state, int64_t step) {
    for (size_t i = 0; i < state->count; i++) {
        const double angle = 0.1 * (double)step + (double)i;
        state->orientation[0][i] = cos(angle);
        state->orientation[1][i] = sin(angle);
        state->orientation[2][i] = 0;
    }
    state->step = step;
}

START_TEST(body_axes_are_written_read_and_compared) {
    Store *store = open_run();
    State *state = some_bodies(20);
    Trajectory *trajectory = NULL;
    ck_assert_msg(trajectory_open(&trajectory, store, 2, state, 4, 0) == OK, "%s",
                  status_sentence());
    for (int64_t step = 0; step < 3; step++) {
        aim(state, step);
        ck_assert_int_eq(trajectory_write(trajectory, state, step, 1.0 * (double)step), OK);
    }
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    TrajectoryFile *file = NULL;
    ck_assert_msg(trajectory_file_open(&file, path_of("trajectory/replica-0002.h5")) == OK, "%s",
                  status_sentence());
    ck_assert(trajectory_file_contents(file).oriented);
    for (int64_t k = 0; k < 4; k++) {
        TrajectoryFrame frame;
        bool there;
        ck_assert_int_eq(trajectory_file_frame(file, k, &frame, &there), OK);
        ck_assert_int_eq(there, k < 3);
        if (there) ck_assert_double_eq(frame.orientation[3 * 7 + 1], sin(0.1 * (double)k + 7));
    }
    trajectory_file_close(file);
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 4, 2), OK);
    aim(state, 2);
    state->orientation[2][19] = 1e-9;
    ck_assert_int_eq(trajectory_write(trajectory, state, 2, 2), UNHEALTHY);
    says("frame 2");
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    state_free(state);
    store_close(store);
}
END_TEST

START_TEST(any_size_of_trajectory_is_written_and_read) {
    static const size_t particles[] = {2, 3, 7, 64, 500};
    static const int64_t frames[] = {1, 2, 7, 100, 400};
    for (size_t i = 0; i < 25; i++) {
        const int64_t count = frames[i / 5];
        Store *store = open_run();
        State *state = some_state(particles[i % 5]);
        Trajectory *trajectory = NULL;
        ck_assert_msg(trajectory_open(&trajectory, store, 2, state, count, 0) == OK, "%s",
                      status_sentence());
        const int64_t written = count < 10 ? count : 10;
        ck_assert_int_eq(write_frames(trajectory, state, 0, written), OK);
        ck_assert_int_eq(trajectory_close(trajectory), OK);
        has_frames(written);
        state_free(state);
        store_close(store);
        remove_directory();
        make_directory();
    }
}
END_TEST

START_TEST(a_resumed_trajectory_compares_what_is_there_and_goes_on) {
    Store *store = open_run();
    State *state = some_state(10);
    Trajectory *trajectory = NULL;
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 0), OK);
    ck_assert_int_eq(write_frames(trajectory, state, 0, 4), OK);
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    ck_assert_msg(trajectory_open(&trajectory, store, 2, state, 5, 2) == OK, "%s",
                  status_sentence());
    ck_assert_int_eq(write_frames(trajectory, state, 2, 5), OK);
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    has_frames(5);
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 2), OK);
    move(state, 2);
    state->position[0][0] = nextafter(state->position[0][0], 99);
    ck_assert_int_eq(trajectory_write(trajectory, state, 2, 0.02), UNHEALTHY);
    says("frame 2");
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    has_frames(5);
    state_free(state);
    store_close(store);
}
END_TEST

START_TEST(a_torn_frame_after_the_checkpoint_is_written_again_and_before_it_refused) {
    Store *store = open_run();
    State *state = some_state(1000);
    Trajectory *trajectory = NULL;
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 0), OK);
    ck_assert_int_eq(write_frames(trajectory, state, 0, 5), OK);
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    const char *name = "trajectory/replica-0002.h5";
    // Positions are the first of the frames: frame 3 begins 1000 * 24 * 3 bytes behind the header.
    flip_bit(name, 65536 + 40000 + 3 * 24000, 3);
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 5), BAD_DATA);
    says("not whole");
    int64_t damaged = 0;
    while (trajectory_open(&trajectory, store, 2, state, 5, damaged) == OK) {
        ck_assert_int_eq(trajectory_close(trajectory), OK);
        damaged++;
    }
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, damaged - 1), OK);
    ck_assert_int_eq(write_frames(trajectory, state, damaged - 1, 5), OK);
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    has_frames(5);
    state_free(state);
    store_close(store);
}
END_TEST

START_TEST(a_trajectory_of_a_stranger_or_cut_off_is_refused) {
    Store *store = open_run();
    State *state = some_state(10);
    Trajectory *trajectory = NULL;
    const char *name = "trajectory/replica-0002.h5";
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 3), BAD_DATA);
    says("missing");
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 0), OK);
    ck_assert_int_eq(trajectory_close(trajectory), OK);
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 6, 0), BAD_DATA);
    says("not the trajectory of this run");
    size_t size;
    unsigned char *whole = file_bytes(name, &size);
    write_bytes(name, whole, size - 1);
    ck_assert_int_eq(trajectory_open(&trajectory, store, 2, state, 5, 0), BAD_DATA);
    says(name);
    TrajectoryFile *file = NULL;
    ck_assert_int_eq(trajectory_file_open(&file, path_of(name)), BAD_DATA);
    write_bytes(name, whole, 100);
    ck_assert_int_eq(trajectory_file_open(&file, path_of(name)), BAD_DATA);
    for (size_t byte = 0; byte < 400; byte += 7) {
        write_bytes(name, whole, size);
        flip_bit(name, (long)byte, 1);
        ck_assert_int_eq(trajectory_file_open(&file, path_of(name)), BAD_DATA);
        says(name);
    }
    free(whole);
    state_free(state);
    store_close(store);
}
END_TEST

int main(void) {
    TCase *tests = tcase_create("store");
    tcase_add_checked_fixture(tests, make_directory, remove_directory);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, second_store_on_a_directory_is_locked_out_with_the_name_of_the_holder);
    tcase_add_test(tests, another_plan_is_refused_with_the_line_that_differs);
    tcase_add_test(tests, results_without_a_plan_are_not_written_over);
    tcase_add_test(tests, texts_and_log_lines_are_kept);
    tcase_add_test(tests, a_directory_that_cannot_be_made_is_an_io_failure_with_path_and_reason);
    tcase_add_test(tests, left_over_temporary_files_do_no_harm);
    tcase_add_test(tests, the_newest_checkpoint_counts_and_the_one_before_stays);
    tcase_add_test(tests,
                   a_damaged_newest_checkpoint_falls_back_to_the_one_before_and_the_log_says_so);
    tcase_add_test(tests, every_flipped_bit_and_every_cut_of_a_checkpoint_is_seen);
    tcase_add_test(tests, a_checkpoint_of_another_plan_or_replica_is_refused);
    tcase_add_test(tests, results_come_back_as_they_were);
    tcase_add_test(tests, all_axes_come_back);
    tcase_add_test(tests, any_number_of_results_is_kept);
    tcase_add_test(tests, the_same_results_are_the_same_bytes);
    tcase_add_test(tests, results_cut_or_changed_are_refused_in_a_sentence);
    tcase_add_test(tests, frames_come_back_and_those_not_written_are_not_there);
    tcase_add_test(tests, body_axes_are_written_read_and_compared);
    tcase_add_test(tests, any_size_of_trajectory_is_written_and_read);
    tcase_add_test(tests, a_resumed_trajectory_compares_what_is_there_and_goes_on);
    tcase_add_test(tests, a_torn_frame_after_the_checkpoint_is_written_again_and_before_it_refused);
    tcase_add_test(tests, a_trajectory_of_a_stranger_or_cut_off_is_refused);
    Suite *suite = suite_create("store");
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
