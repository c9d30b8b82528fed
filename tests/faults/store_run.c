// SPDX-License-Identifier: GPL-3.0-or-later
// A run without physics for the fault tests: two replicas of particles on a known path, with
// trajectory, checkpoints and results through the store alone, resumable like a real run.
//   store_run DIR [FRAMES [PARTICLES [MICROSECONDS]]]
// The exit code is the Status; every frame and checkpoint acknowledged is told on stdout.
#include "base/memory.h"
#include "store/checkpoint.h"
#include "store/store.h"
#include "store/trajectory.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { REPLICAS = 2, FRAMES_PER_CHECKPOINT = 2 };

typedef struct Wishes {
    const char *directory;
    int64_t frames, particles;
    useconds_t pause; // after each frame
} Wishes;

static Wishes read_wishes(int count, char **words) {
    return (Wishes){
        .directory = count > 1 ? words[1] : "run",
        .frames = count > 2 ? atoll(words[2]) : 4,
        .particles = count > 3 ? atoll(words[3]) : 50,
        .pause = count > 4 ? (useconds_t)atol(words[4]) : 0,
    };
}

static System some_system(int64_t particles) {
    return (System){
        .dimension = 3,
        .particles = particles,
        .packing_fraction = 0.2,
        .species_count = 2,
        .species = {{.name = "a", .shape = SHAPE_SPHERE, .diameter = 1, .mass = 1, .fraction = 0.5},
                    {.name = "b",
                     .shape = SHAPE_SPHEROCYLINDER,
                     .diameter = 2,
                     .length = 3,
                     .mass = 2,
                     .fraction = 0.5}},
    };
}

// A turn by the angle whose cosine is 0.6, and the axes of space in turn.
static void turn(State *state, size_t i) {
    double *const *u = state->orientation;
    const double x = u[0][i], y = u[1][i], z = u[2][i];
    u[0][i] = z;
    u[1][i] = 0.6 * x - 0.8 * y;
    u[2][i] = 0.8 * x + 0.6 * y;
}

// Numbers that depend on all before them, so that a wrong resume cannot go unseen.
static void step(State *state, size_t replica) {
    for (size_t i = 0; i < state->count; i++) {
        for (int a = 0; a < 3; a++) {
            double *x = &state->position[a][i];
            *x = 3.7 * *x * (1 - *x / state->box.edge[a]) + 1e-3 * (double)(replica + 1);
            if (!(*x >= 0 && *x < state->box.edge[a])) *x = 0.3;
        }
        state->image[0][i]++;
        turn(state, i);
    }
    state->step++;
}

static void place(State *state) {
    for (size_t i = 0; i < state->count; i++) {
        state->diameter[i] = state->species_of[i] + 1;
        for (int a = 0; a < 3; a++) state->position[a][i] = 0.01 * (double)(i + 1) + 0.1 * a;
    }
}

static Status resume(State *state, Store *store, size_t replica) {
    void *bytes = NULL;
    size_t size;
    place(state);
    TRY(checkpoint_read(store, replica, &bytes, &size));
    if (!bytes) return OK;
    Archive archive = archive_reader(bytes, size);
    state_archive(state, &archive);
    const Status status = archive_status(&archive, true);
    free(bytes);
    return status;
}

static Status save(State *state, Store *store, size_t replica, Trajectory *trajectory) {
    TRY(trajectory_sync(trajectory));
    Archive archive = archive_writer();
    state_archive(state, &archive);
    Status status = archive_status(&archive, true);
    if (status == OK) status = checkpoint_write(store, replica, archive.bytes, archive.size);
    archive_free(&archive);
    if (status == OK) printf("checkpoint %zu %lld\n", replica, (long long)state->step);
    return status;
}

static Status advance(State *state, Store *store, size_t replica, Trajectory *trajectory,
                      const Wishes *wishes) {
    while (state->step < wishes->frames) {
        const int64_t frame = state->step;
        step(state, replica);
        TRY(trajectory_write(trajectory, state, state->step, 0.5 * (double)state->step));
        printf("frame %zu %lld\n", replica, (long long)frame);
        if (wishes->pause) usleep(wishes->pause);
        const bool last = state->step == wishes->frames;
        if (last || state->step % FRAMES_PER_CHECKPOINT == 0) {
            TRY(save(state, store, replica, trajectory));
        }
    }
    return OK;
}

static Status run_replica(Store *store, size_t replica, State *state, const Wishes *wishes) {
    Trajectory *trajectory = NULL;
    TRY(resume(state, store, replica));
    TRY(trajectory_open(&trajectory, store, replica, state, wishes->frames, state->step));
    const Status status = advance(state, store, replica, trajectory, wishes);
    if (status != OK) {
        char sentence[1024];
        snprintf(sentence, sizeof sentence, "%s", status_sentence());
        trajectory_close(trajectory);
        return status_fail(status, "%s", sentence);
    }
    return trajectory_close(trajectory);
}

static Status measure(Results *results, size_t replica, const State *state) {
    const double numbers[3] = {0, 1, 2};
    const ResultSeries shape = {
        .stage = "walk",
        .observable = "position",
        .unit = "d",
        .about = "of the first particle",
        .axes = 1,
        .axis = {{.name = "direction", .unit = "", .count = 3, .values = numbers}},
    };
    const double values[3] = {state->position[0][0], state->position[1][0], state->position[2][0]};
    TRY(results_put_fact(results, "version", "test"));
    TRY(results_put_scalar(results, "walk", "last", "d", "x of the last particle", replica,
                           state->position[0][state->count - 1]));
    return results_put_series(results, &shape, replica, values);
}

static Status run_all(Store *store, const Wishes *wishes, Results *results) {
    const System system = some_system(wishes->particles);
    for (size_t replica = 0; replica < REPLICAS; replica++) {
        State *state = NULL;
        TRY(state_create(&state, &system));
        Status status = run_replica(store, replica, state, wishes);
        if (status == OK) status = measure(results, replica, state);
        state_free(state);
        TRY(status);
    }
    return store_write_results(store, results);
}

static Status run(Store *store, const Wishes *wishes) {
    char plan[128];
    bool resumes;
    snprintf(plan, sizeof plan, "frames: %lld\nparticles: %lld\n", (long long)wishes->frames,
             (long long)wishes->particles);
    TRY(store_take_plan(store, plan, &resumes));
    TRY(store_log(store, resumes ? "resumes" : "starts"));
    Results *results = NULL;
    TRY(results_create(&results, REPLICAS));
    const Status status = run_all(store, wishes, results);
    results_free(results);
    return status;
}

int main(int count, char **words) {
    const Wishes wishes = read_wishes(count, words);
    setvbuf(stdout, NULL, _IOLBF, 0);
    store_ignore_signals();
    Store *store = NULL;
    Status status = store_open(&store, wishes.directory);
    if (status == OK) status = run(store, &wishes);
    if (status != OK) fprintf(stderr, "error: %s\n", status_sentence());
    store_close(store);
    return status;
}
