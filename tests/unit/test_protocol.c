// SPDX-License-Identifier: GPL-3.0-or-later
// A replica's way through its stages, with a propagator and an observer of our own that can be
// predicted: particles drift by one ten-thousandth of an edge per tick. So the seams themselves are
// tested.
#include "observe.h"
#include "suite.h"

#include "base/memory.h"
#include "protocol/replica.h"

#include <math.h>

// --- a propagator whose cost per tick, and so the length of a slice, can be chosen

typedef struct Drift {
    Propagator base;
    State *state;
} Drift;

typedef struct DriftSettings {
    double cost; // seconds per particle and tick, as told to the house
    int64_t ticks_per_step;
} DriftSettings;

static const DriftSettings *drift_settings(const Settings *settings) {
    return (const DriftSettings *)settings->bytes;
}

static Status drift_check(const Settings *settings, const System *system) {
    (void)settings, (void)system;
    return OK;
}

static double drift_tick(const Settings *settings, const System *system) {
    (void)settings, (void)system;
    return 0.25;
}

static double drift_flight(const Settings *settings) {
    (void)settings;
    return 0.01;
}

static int64_t drift_ticks_per_step(const Settings *settings) {
    return drift_settings(settings)->ticks_per_step;
}

static double drift_cost(const Settings *settings, const System *system) {
    (void)system;
    return drift_settings(settings)->cost;
}

static size_t drift_memory(const System *system) {
    (void)system;
    return 0;
}

static const PropagatorKind drift_kind;

static Status drift_create(Propagator **out, const Settings *settings, State *state, RngKey key) {
    (void)settings, (void)key;
    Drift *drift = NULL;
    TRY(NEW(drift));
    *drift = (Drift){.base = {.kind = &drift_kind}, .state = state};
    *out = &drift->base;
    return OK;
}

static Status drift_advance(Propagator *propagator, int64_t ticks, Tally *tally) {
    State *state = ((Drift *)propagator)->state;
    for (int64_t t = 0; t < ticks; t++) {
        for (size_t i = 0; i < state->count; i++) {
            state->position[0][i] += 1e-4 * state->box.edge[0];
            if (state->position[0][i] < state->box.edge[0]) continue;
            state->position[0][i] -= state->box.edge[0];
            state->image[0][i]++;
        }
        tally->windows++;
        state->step++;
    }
    return OK;
}

static void drift_free(Propagator *propagator) {
    memory_free(propagator);
}

static const PropagatorKind drift_kind = {
    .name = "drift",
    .time_unit = "tock",
    .check = drift_check,
    .tick = drift_tick,
    .flight_time = drift_flight,
    .ticks_per_step = drift_ticks_per_step,
    .seconds_per_particle_tick = drift_cost,
    .memory = drift_memory,
    .create = drift_create,
    .advance = drift_advance,
    .free = drift_free,
};

// --- an observer that looks at every third tick and keeps what it saw

typedef struct Witness {
    Observer base;
    int64_t looks, last;
    double sum; // of tick times first unfolded coordinate
} Witness;

static Status witness_create(Observer **out, const Settings *settings, const State *state,
                             const Clock *clock) {
    (void)settings, (void)state;
    Witness *witness = NULL;
    extern const ObservableKind witness_kind;
    TRY(NEW(witness));
    *witness = (Witness){.base = {.kind = &witness_kind, .clock = *clock}, .last = -1};
    *out = &witness->base;
    return OK;
}

static int64_t witness_next(const Observer *observer, int64_t after) {
    (void)observer;
    return after < 0 ? 0 : after - after % 3 + 3;
}

static Status witness_see(Observer *observer, int64_t tick, const State *state,
                          const Tally *tally) {
    Witness *witness = (Witness *)observer;
    ck_assert_int_eq(tick % 3, 0);
    ck_assert_uint_eq(tally->windows, (uint64_t)tick);
    ck_assert_int_eq(tick, witness->last < 0 ? 0 : witness->last + 3);
    witness->last = tick;
    witness->looks++;
    witness->sum += (double)tick * state_unfolded(state, 0, 0);
    return OK;
}

static void witness_archive(Observer *observer, Archive *archive) {
    Witness *witness = (Witness *)observer;
    archive_i64(archive, &witness->looks, 1);
    archive_i64(archive, &witness->last, 1);
    archive_f64(archive, &witness->sum, 1);
}

static Status witness_write(const Observer *observer, const State *state, Results *results,
                            size_t replica) {
    (void)state;
    const Witness *witness = (const Witness *)observer;
    TRY(results_put_scalar(results, observer->clock.stage, "looks", "", "", replica,
                           (double)witness->looks));
    return results_put_scalar(results, observer->clock.stage, "sum", "", "", replica, witness->sum);
}

static void witness_free(Observer *observer) {
    memory_free(observer);
}

extern const ObservableKind witness_kind;
const ObservableKind witness_kind = {
    .name = "witness",
    .create = witness_create,
    .next = witness_next,
    .see = witness_see,
    .archive = witness_archive,
    .write = witness_write,
    .free = witness_free,
};

// --- plans

static void plan_stage(Plan *plan, const char *name, double time, double cost, int64_t per_step) {
    Stage *stage = &plan->stages[plan->stage_count++];
    strcpy(stage->name, name);
    stage->time = time;
    stage->dynamics.kind = &drift_kind;
    const DriftSettings settings = {cost, per_step};
    memcpy(stage->dynamics.settings.bytes, &settings, sizeof settings);
    stage->observations[stage->observation_count++].kind = &witness_kind;
}

static Plan *two_stages(double cost) {
    Plan *plan = memory_new(1, sizeof *plan);
    plan->system = (System){
        .dimension = 2,
        .particles = 16,
        .packing_fraction = 0.1,
        .species_count = 1,
        .species = {
            {.name = "disc", .shape = SHAPE_DISC, .diameter = 1, .mass = 1, .fraction = 1}}};
    plan->ensemble.replicas = 1;
    plan->output.trajectory_every = 10;       // 40 ticks
    plan_stage(plan, "first", 25, cost, 1);   // 100 ticks
    plan_stage(plan, "second", 250, cost, 5); // 1000 ticks
    return plan;
}

static void end_of(Replica *replica, Archive *archive) {
    while (!replica_finished(replica)) {
        ck_assert_int_eq(replica_advance(replica), OK);
        while (replica_frame_due(replica)) replica_frame_taken(replica);
    }
    replica_save(replica, archive);
    ck_assert_int_eq(archive_status(archive, true), OK);
}

static Replica *fresh(const Plan *plan) {
    Replica *replica = NULL;
    ck_assert_int_eq(replica_create(&replica, plan, 0, NULL), OK);
    if (replica_frame_due(replica)) replica_frame_taken(replica);
    return replica;
}

// The times that packing and advancing took are saved too, and differ from run to run.
static void assert_same_end(const Archive *a, const Archive *b) {
    ck_assert_uint_eq(a->size, b->size);
    const size_t times = 9 * 8, after = times + 2 * 8;
    ck_assert_mem_eq(a->bytes, b->bytes, times);
    ck_assert_mem_eq(a->bytes + after, b->bytes + after, a->size - after);
}

static void assert_refused(Plan *plan, const char *words) {
    ck_assert_int_eq(plan_check(plan), BAD_DATA);
    ck_assert_msg(strstr(status_sentence(), words), "'%s' is not in: %s", words, status_sentence());
    memory_free(plan);
}

START_TEST(observers_see_just_the_ticks_they_wished_for) {
    Plan *plan = two_stages(1e-9);
    Replica *replica = fresh(plan);
    Archive end = archive_writer();
    end_of(replica, &end);
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(replica_write(replica, results), OK);
    ck_assert_double_eq(results_find_scalar(results, "first", "looks")->values[0], 34);
    ck_assert_double_eq(results_find_scalar(results, "second", "looks")->values[0], 334);
    ck_assert_int_eq(replica_frames_done(replica), 1 + 2 + 25);
    ck_assert_int_eq(plan_frames(plan), 28);
    ck_assert_double_eq_tol(replica_recorded_time(replica), 275, 1e-12);
    ck_assert_uint_eq(replica_tally(replica).windows, 1100);
    results_free(results);
    archive_free(&end);
    replica_free(replica);
    memory_free(plan);
}
END_TEST

START_TEST(one_stage_alone_can_be_recorded_from_its_start) {
    Plan *plan = two_stages(1e-9);
    strcpy(plan->output.trajectory_stage, "second");
    ck_assert_int_eq(plan_check(plan), OK);
    ck_assert_int_eq(plan_frames(plan), 1 + 25);
    Replica *replica = fresh(plan);
    ck_assert_int_eq(replica_frames_done(replica), 0);
    Archive end = archive_writer();
    end_of(replica, &end);
    ck_assert_int_eq(replica_frames_done(replica), 26);
    ck_assert_double_eq_tol(replica_recorded_time(replica), 250, 1e-12);
    archive_free(&end);
    replica_free(replica);
    strcpy(plan->output.trajectory_stage, "third");
    assert_refused(plan, "no stage 'third'");
}
END_TEST

START_TEST(how_time_is_sliced_changes_no_bit) {
    Archive ends[3];
    static const double costs[3] = {1e-9, 3e-4, 10}; // all at once, ten ticks, single steps
    for (int k = 0; k < 3; k++) {
        Plan *plan = two_stages(costs[k]);
        Replica *replica = fresh(plan);
        ends[k] = archive_writer();
        end_of(replica, &ends[k]);
        replica_free(replica);
        memory_free(plan);
    }
    assert_same_end(&ends[0], &ends[1]);
    assert_same_end(&ends[0], &ends[2]);
    for (int k = 0; k < 3; k++) archive_free(&ends[k]);
}
END_TEST

// Saves and loads after each advance, from the first to the last.
START_TEST(a_replica_saved_and_loaded_anywhere_ends_in_the_same_bits) {
    Plan *plan = two_stages(3e-4);
    Replica *replica = fresh(plan);
    Archive expected = archive_writer(), found = archive_writer();
    end_of(replica, &expected);
    replica_free(replica);

    int loads = 0;
    replica = fresh(plan);
    while (!replica_finished(replica)) {
        ck_assert_int_eq(replica_advance(replica), OK);
        while (replica_frame_due(replica)) replica_frame_taken(replica);
        if (!replica_can_save(replica)) continue;
        Archive saved = archive_writer();
        replica_save(replica, &saved);
        replica_free(replica);
        Archive reader = archive_reader(saved.bytes, saved.size);
        ck_assert_int_eq(replica_load(&replica, plan, 0, &reader), OK);
        archive_free(&saved);
        loads++;
    }
    ck_assert_int_gt(loads, 50);
    replica_save(replica, &found);
    assert_same_end(&expected, &found);
    archive_free(&expected);
    archive_free(&found);
    replica_free(replica);
    memory_free(plan);
}
END_TEST

// At rest, sheared by less and by a whole edge of the box, and at rest in the box that leans.
static Plan *sheared_between_rests(void) {
    static const double rates[3] = {0, 0.65, 0};
    static const char *const names[3] = {"before", "sheared", "after"};
    Plan *plan = two_stages(1e-9);
    plan->system.particles = 40;
    plan->output.trajectory_every = 0;
    plan->stage_count = 3;
    for (size_t s = 0; s < 3; s++) {
        Stage *stage = &plan->stages[s];
        *stage = (Stage){.time = 1, .observation_count = 2};
        strcpy(stage->name, names[s]);
        stage->dynamics = (Dynamics){.kind = &propagator_event_driven,
                                     .settings = settings_of(&propagator_event_driven.options)};
        set_number(&stage->dynamics.settings, &propagator_event_driven.options,
                   "thermostat_interval", 0.05);
        stage->drive.flow.rate = rates[s];
        const ObservableKind *kinds[2][2] = {
            {&observable_structure_factor, &observable_collective_scattering},
            {&observable_planar_structure_factor, &observable_advected_scattering}};
        for (size_t k = 0; k < 2; k++) {
            const ObservableKind *kind = kinds[s == 1][k];
            stage->observations[k] = (Observation){kind, settings_of(&kind->options)};
        }
    }
    return plan;
}

static Results *results_of(const Replica *replica) {
    Results *results = NULL;
    ck_assert_int_eq(results_create(&results, 1), OK);
    ck_assert_int_eq(replica_write(replica, results), OK);
    return results;
}

static void assert_same_series(const Results *a, const Results *b) {
    ck_assert_uint_eq(a->series_count, b->series_count);
    for (size_t i = 0; i < a->series_count; i++) {
        const ResultSeries *one = &a->series[i], *other = &b->series[i];
        ck_assert_uint_eq(one->size, other->size);
        ck_assert_mem_eq(one->values, other->values, one->size * sizeof(double));
        for (size_t k = 0; k < one->axes; k++) {
            if (!one->axis[k].values) continue;
            ck_assert_mem_eq(one->axis[k].values, other->axis[k].values,
                             one->axis[k].count * sizeof(double));
        }
    }
}

// Wave vectors are those of the box in which a stage began, also of one that is over.
START_TEST(what_a_sheared_box_has_seen_is_loaded_as_it_was) {
    Plan *plan = sheared_between_rests();
    ck_assert_int_eq(plan_check(plan), OK);
    Replica *replica = fresh(plan);
    while (!replica_finished(replica)) ck_assert_int_eq(replica_advance(replica), OK);
    Results *expected = results_of(replica);
    replica_free(replica);
    replica = fresh(plan);
    size_t loads[4] = {0};
    while (!replica_finished(replica)) {
        ck_assert_int_eq(replica_advance(replica), OK);
        if (!replica_can_save(replica)) continue;
        Archive saved = archive_writer();
        replica_save(replica, &saved);
        replica_free(replica);
        Archive reader = archive_reader(saved.bytes, saved.size);
        ck_assert_msg(replica_load(&replica, plan, 0, &reader) == OK, "%s", status_sentence());
        archive_free(&saved);
        loads[replica_stage(replica)]++;
    }
    for (int s = 0; s < 3; s++) ck_assert_uint_gt(loads[s], 10);
    Results *found = results_of(replica);
    assert_same_series(expected, found);
    results_free(expected);
    results_free(found);
    replica_free(replica);
    memory_free(plan);
}
END_TEST

START_TEST(torn_and_spoiled_saves_are_refused) {
    Plan *plan = two_stages(3e-4);
    Replica *replica = fresh(plan), *loaded = NULL;
    for (int k = 0; k < 5; k++) ck_assert_int_eq(replica_advance(replica), OK);
    Archive saved = archive_writer();
    replica_save(replica, &saved);
    for (size_t cut = 0; cut < saved.size; cut += 7) {
        Archive torn = archive_reader(saved.bytes, cut);
        ck_assert_int_eq(replica_load(&loaded, plan, 0, &torn), BAD_DATA);
    }
    saved.bytes[8] = saved.bytes[15] = 77; // a stage that is not there, nor would it fit in memory
    Archive spoiled = archive_reader(saved.bytes, saved.size);
    ck_assert_int_eq(replica_load(&loaded, plan, 0, &spoiled), BAD_DATA);
    archive_free(&saved);
    Archive ahead = archive_writer();
    ((State *)replica_state(replica))->step = INT64_MAX; // one more would overflow
    replica_save(replica, &ahead);
    Archive forged = archive_reader(ahead.bytes, ahead.size);
    ck_assert_int_eq(replica_load(&loaded, plan, 0, &forged), BAD_DATA);
    archive_free(&ahead);
    replica_free(replica);
    memory_free(plan);
}
END_TEST

START_TEST(what_is_no_number_ends_the_run_before_the_next_frame) {
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    Plan *plan = two_stages(3e-4);
    Replica *replica = fresh(plan);
    while (!replica_frame_due(replica)) ck_assert_int_eq(replica_advance(replica), OK);
    replica_frame_taken(replica);
    ((State *)replica_state(replica))->position[1][7] = bad[_i]; // as if a propagator had
    const int64_t done = replica_frames_done(replica);
    Status status = OK;
    while (status == OK && !replica_finished(replica)) {
        status = replica_advance(replica);
        if (status != OK) break;
        ck_assert(!replica_frame_due(replica));
    }
    ck_assert_int_eq(status, UNHEALTHY);
    ck_assert_msg(strstr(status_sentence(), "particle 7"), "%s", status_sentence());
    ck_assert_int_eq(replica_frames_done(replica), done);
    replica_free(replica);
    memory_free(plan);
}
END_TEST

START_TEST(a_stage_lasts_a_whole_number_of_steps) {
    Plan *plan = two_stages(1e-9);
    plan->stages[1].time = 0.25 * 12; // 12 ticks of 5 per step: 2.4 steps
    ck_assert_int_eq(plan_clock(plan, 1).ticks, 10);
    plan->stages[1].time = 1e-5;
    ck_assert_int_eq(plan_clock(plan, 1).ticks, 5);
    memory_free(plan);
}
END_TEST

START_TEST(what_cannot_be_is_said) {
    Plan *plan = two_stages(1e-9);
    ck_assert_int_eq(plan_check(plan), OK);
    plan->system.species[0].fraction = 0.9;
    assert_refused(plan, "add to 0.9");
    plan = two_stages(1e-9);
    plan->system.species[0].shape = SHAPE_SPHERE;
    assert_refused(plan, "lives in 3 dimensions");
    plan = two_stages(1e-9);
    plan->system.number_density = 1;
    assert_refused(plan, "one of the two");
    plan = two_stages(1e-9);
    strcpy(plan->stages[1].name, "first");
    assert_refused(plan, "two stages are called 'first'");
    plan = two_stages(1e-9);
    plan->system.aspect = (OptionReals){.count = 3, .values = {1, 1, 1}};
    assert_refused(plan, "3 numbers");
    plan = two_stages(1e-9);
    plan->stage_count = 0;
    assert_refused(plan, "needs a stage");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("protocol");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 60);
    tcase_add_test(all, observers_see_just_the_ticks_they_wished_for);
    tcase_add_test(all, one_stage_alone_can_be_recorded_from_its_start);
    tcase_add_test(all, how_time_is_sliced_changes_no_bit);
    tcase_add_test(all, a_replica_saved_and_loaded_anywhere_ends_in_the_same_bits);
    tcase_add_test(all, what_a_sheared_box_has_seen_is_loaded_as_it_was);
    tcase_add_test(all, torn_and_spoiled_saves_are_refused);
    tcase_add_loop_test(all, what_is_no_number_ends_the_run_before_the_next_frame, 0, 3);
    tcase_add_test(all, a_stage_lasts_a_whole_number_of_steps);
    tcase_add_test(all, what_cannot_be_is_said);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
