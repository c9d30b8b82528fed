// SPDX-License-Identifier: GPL-3.0-or-later
// All points of a run file.
#include "campaign/campaign.h"

#include "analysis/analysis.h"
#include "base/memory.h"
#include "base/seconds.h"
#include "base/text.h"
#include "base/version.h"
#include "campaign/combine.h"
#include "report/report.h"
#include "session/provenance.h"
#include "store/store.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SENTENCE_SIZE = 1024 };

typedef enum Turn { WAITING, RUNNING, ENDED } Turn;

typedef struct Point {
    Turn turn;
    double work; // expected CPU seconds of all its replicas
    size_t replicas, slots;
    Plan *plan; // while it runs
    Session *session;
} Point;

struct Campaign {
    const ConfigPoints *points;
    SessionWishes wishes;
    EnsembleSlots *slots;
    Store *store; // NULL: there is no sweep
    char *plan_text;
    size_t count, first_waiting, running;
    size_t anew; // points whose earlier results were of another structure
    Point *point;
    double start, work;
    bool stopping, resumes;
    Status failure; // the first
    char sentence[SENTENCE_SIZE];
    Results *results; // of a single run
    char note[SENTENCE_SIZE];
};

static Status weigh_points(Campaign *campaign) {
    for (size_t p = 0; p < campaign->count; p++) {
        Point *point = &campaign->point[p];
        Plan *plan = NULL;
        TRY(config_point_plan(&plan, campaign->points, p));
        point->replicas = (size_t)plan->ensemble.replicas;
        point->slots = plan_slots(plan);
        point->work = plan_seconds(plan) * (double)point->replicas;
        campaign->work += point->work;
        memory_free(plan);
    }
    return OK;
}

static Status open_store(Campaign *campaign) {
    const char *directory = campaign->wishes.directory;
    if (campaign->wishes.must_resume && !session_has_plan(directory)) {
        return status_fail(BAD_USAGE, "nothing to resume in %s", directory);
    }
    campaign->wishes.must_resume = false; // a point may not have begun
    store_ignore_signals();               // before the first write
    TRY(store_open(&campaign->store, directory));
    TRY(store_take_plan(campaign->store, campaign->plan_text, &campaign->resumes));
    return store_log(campaign->store, "a sweep of %zu points %s", campaign->count,
                     campaign->resumes ? "resumes" : "starts");
}

static Status begin(Campaign *campaign) {
    campaign->count = config_point_count(campaign->points);
    campaign->start = seconds_now();
    TRY(NEW_ARRAY(campaign->point, campaign->count));
    TRY(weigh_points(campaign));
    TRY(ensemble_slots_create(&campaign->slots, campaign->wishes.threads));
    campaign->wishes.slots = campaign->slots;
    TRY(config_write_points(campaign->points, &campaign->plan_text));
    return config_sweep_keys(campaign->points) > 0 ? open_store(campaign) : OK;
}

static void name_point(const Campaign *campaign, size_t p, char name[POINT_NAME_SIZE]) {
    config_point_name(campaign->points, p, name);
}

static void folder_of(const Campaign *campaign, size_t p, Text *folder) {
    char name[POINT_NAME_SIZE];
    name_point(campaign, p, name);
    text_put(folder, campaign->wishes.directory);
    if (campaign->store) text_add(folder, "/%s", name);
}

static Status read_finished(Results **out, const char *folder) {
    Text path = {0};
    text_add(&path, "%s/results.h5", folder);
    Status status = text_status(&path);
    if (status == OK) status = store_read_results(out, text_words(&path));
    text_free(&path);
    return status;
}

// The same plan has been run to its end there, with what the files that it reads hold now.
static bool is_of_now(const Plan *plan, const Results *results) {
    char *text = NULL;
    uint32_t checksum;
    const char *plan_there = results_find_fact(results, "plan");
    const bool same = plan_there && config_write(plan, &text) == OK && !strcmp(text, plan_there);
    const bool healthy = !results_broken_limit(results);
    memory_free(text);
    return same && healthy && plan_check_input(plan, &checksum) == OK &&
           plan_has_checksum(results, checksum);
}

// A simulation alone goes on from its last checkpoint, and what is derived of it is derived anew; a
// theory has none when it has ended, and is done again by another program only.
static bool may_stand(const Campaign *campaign, const Results *results) {
    const char *commit = results_find_fact(results, "commit");
    return campaign->store || (commit && strcmp(commit, version_commit()) == 0);
}

static bool is_finished(Campaign *campaign, const Plan *plan, const char *folder) {
    Results *results = NULL;
    if (!campaign->store && !plan_is_theory(plan)) return false;
    if (read_finished(&results, folder) != OK) return false;
    const bool finished = may_stand(campaign, results) && is_of_now(plan, results);
    if (finished && !campaign->store)
        campaign->results = results;
    else
        results_free(results);
    return finished;
}

static Status open_session(Campaign *campaign, Point *point, const char *folder) {
    if (is_finished(campaign, point->plan, folder)) return OK;
    SessionWishes wishes = campaign->wishes;
    wishes.directory = folder;
    return session_open(&point->session, point->plan, &wishes);
}

static void keep_failure(Campaign *campaign, size_t p, Status status) {
    if (campaign->failure != OK && campaign->failure != INTERRUPTED) return;
    char name[POINT_NAME_SIZE];
    name_point(campaign, p, name);
    campaign->failure = status;
    snprintf(campaign->sentence, sizeof campaign->sentence, "%s%s%s", name, name[0] ? ": " : "",
             status_sentence());
}

static void end_point(Point *point) {
    session_close(point->session);
    memory_free(point->plan);
    point->session = NULL;
    point->plan = NULL;
    point->turn = ENDED;
}

// What disturbs one point need not disturb the others; that nothing can be written does.
static bool disturbs_all(Status status) {
    return status == IO_FAILED || status == NO_MEMORY || status == INTERRUPTED;
}

static void note_failure(Campaign *campaign, size_t p, Status status) {
    if (status == OK) return;
    keep_failure(campaign, p, status);
    if (disturbs_all(status)) campaign_stop(campaign);
}

static void begin_point(Campaign *campaign) {
    const size_t p = campaign->first_waiting++;
    Point *point = &campaign->point[p];
    Text folder = {0};
    folder_of(campaign, p, &folder);
    Status status = config_point_plan(&point->plan, campaign->points, p);
    if (status == OK) status = text_status(&folder);
    if (status == OK) status = open_session(campaign, point, text_words(&folder));
    text_free(&folder);
    if (point->session) {
        campaign->anew += session_begins_anew(point->session);
        point->turn = RUNNING;
        campaign->running++;
        return;
    }
    note_failure(campaign, p, status);
    end_point(point);
}

static void finish_point(Campaign *campaign, size_t p) {
    Point *point = &campaign->point[p];
    Results *results = NULL;
    const char *note = NULL;
    const Status status = session_finish(point->session, &results, &note);
    note_failure(campaign, p, status);
    if (note) snprintf(campaign->note, sizeof campaign->note, "%s", note);
    if (campaign->store)
        results_free(results);
    else
        campaign->results = results;
    campaign->running--;
    end_point(point);
}

Status campaign_open(Campaign **out, const ConfigPoints *points, const SessionWishes *wishes) {
    Campaign *campaign = NULL;
    TRY(NEW(campaign));
    campaign->points = points;
    campaign->wishes = *wishes;
    Status status = begin(campaign);
    if (status == OK) {
        begin_point(campaign);
        if (!campaign->store && campaign->failure != OK)
            status = status_fail(campaign->failure, "%s", campaign->sentence);
    }
    if (status == OK && !campaign->store)
        campaign->resumes = campaign->results || session_resumes(campaign->point[0].session);
    if (status == OK)
        *out = campaign;
    else
        campaign_close(campaign);
    return status;
}

void campaign_close(Campaign *campaign) {
    if (!campaign) return;
    for (size_t p = 0; campaign->point && p < campaign->count; p++) {
        if (campaign->point[p].turn == RUNNING) end_point(&campaign->point[p]);
    }
    results_free(campaign->results);
    ensemble_slots_free(campaign->slots);
    store_close(campaign->store);
    memory_free(campaign->plan_text);
    memory_free(campaign->point);
    memory_free(campaign);
}

bool campaign_resumes(const Campaign *campaign) {
    return campaign->resumes;
}

size_t campaign_anew(const Campaign *campaign) {
    return campaign->anew;
}

bool campaign_tend(Campaign *campaign) {
    for (size_t p = 0; p < campaign->first_waiting; p++) {
        const Point *point = &campaign->point[p];
        if (point->turn == RUNNING && !session_running(point->session)) finish_point(campaign, p);
    }
    const bool more = campaign->first_waiting < campaign->count && !campaign->stopping;
    const bool free = campaign->running == 0 || ensemble_slots_free_now(campaign->slots) > 0;
    if (more && free) begin_point(campaign);
    return more || campaign->running > 0;
}

static void add_progress(EnsembleProgress *sum, const EnsembleProgress *one) {
    sum->running += one->running;
    sum->rate += one->rate;
    if (sum->stage[0] || one->running == 0) return;
    sum->stage = one->stage;
    sum->stage_time = one->stage_time;
    sum->stage_unit = one->stage_unit;
}

EnsembleProgress campaign_progress(const Campaign *campaign) {
    EnsembleProgress sum = {.seconds = seconds_now() - campaign->start, .stage = ""};
    double done = 0;
    for (size_t p = 0; p < campaign->count; p++) {
        const Point *point = &campaign->point[p];
        sum.replicas += point->replicas;
        if (point->turn == ENDED) {
            sum.finished += point->replicas;
            done += point->work;
        } else if (point->turn == RUNNING) {
            const EnsembleProgress one = session_progress(point->session);
            if (!campaign->store) return one;
            add_progress(&sum, &one);
            sum.finished += one.finished;
            done += one.fraction * point->work;
        }
    }
    sum.fraction = campaign->work > 0 ? done / campaign->work : 0;
    sum.seconds_left = done > 0 ? sum.seconds * (campaign->work - done) / done : (double)NAN;
    return sum;
}

void campaign_stop(Campaign *campaign) {
    campaign->stopping = true;
    for (size_t p = 0; p < campaign->first_waiting; p++) {
        if (campaign->point[p].turn == RUNNING) session_stop(campaign->point[p].session);
    }
}

void campaign_request_checkpoint(Campaign *campaign) {
    for (size_t p = 0; p < campaign->first_waiting; p++) {
        if (campaign->point[p].turn == RUNNING)
            session_request_checkpoint(campaign->point[p].session);
    }
}

static void say_keys(const ConfigPoints *points, Text *words) {
    text_add(words, "%zu points", config_point_count(points));
    for (size_t k = 0; k < config_sweep_keys(points); k++) {
        const SweepKey *key = config_sweep_key(points, k);
        text_add(words, "%s %s from %s to %s (%zu values)", k ? ";" : ":", key->path, key->words[0],
                 key->words[key->count - 1], key->count);
    }
}

static double number_of_fact(const Results *results, const char *name) {
    const char *text = results_find_fact(results, name);
    return text ? strtod(text, NULL) : 0;
}

// `seconds` of processors are summed from the points.
static Status put_facts(const Campaign *campaign, Results *all, double seconds) {
    Plan *first = NULL;
    Text words = {0};
    char digits[32];
    TRY(config_point_plan(&first, campaign->points, 0));
    Status status =
        provenance_put(all, first, campaign->plan_text, seconds_now() - campaign->start);
    memory_free(first);
    say_keys(campaign->points, &words);
    if (status == OK) status = results_put_fact(all, "system", text_words(&words));
    text_free(&words);
    snprintf(digits, sizeof digits, "%.3f", seconds);
    return status == OK ? results_put_fact(all, "cpu_seconds", digits) : status;
}

static Status add_point(const Campaign *campaign, Results *all, size_t p, double *seconds) {
    Text folder = {0};
    Results *one = NULL;
    folder_of(campaign, p, &folder);
    Status status = text_status(&folder);
    const bool there = status == OK && read_finished(&one, text_words(&folder)) == OK;
    text_free(&folder);
    if (!there) return status; // its failure has been kept; NaN stands in its place
    *seconds += number_of_fact(one, "cpu_seconds");
    status = combine_point(all, campaign->points, p, one);
    results_free(one);
    return status;
}

static Status combine(const Campaign *campaign, Results *all) {
    double seconds = 0;
    for (size_t p = 0; p < campaign->count; p++) TRY(add_point(campaign, all, p, &seconds));
    return put_facts(campaign, all, seconds);
}

static Status write_all(Campaign *campaign, Results *all) {
    TRY(combine(campaign, all));
    TRY(analysis_derive_sweep(all));
    TRY(store_write_results(campaign->store, all));
    if (report_write(all, store_directory(campaign->store)) != OK)
        snprintf(campaign->note, sizeof campaign->note, "%s", status_sentence());
    return store_log(campaign->store, "finished after %.1f s", seconds_now() - campaign->start);
}

static Status finish_sweep(Campaign *campaign, Results **out) {
    size_t replicas = 0;
    for (size_t p = 0; p < campaign->count; p++) {
        if (campaign->point[p].slots > replicas) replicas = campaign->point[p].slots;
    }
    Results *all = NULL;
    TRY(results_create(&all, replicas));
    const Status status = write_all(campaign, all);
    if (status == OK)
        *out = all;
    else
        results_free(all);
    return status;
}

Status campaign_finish(Campaign *campaign, Results **out, const char **report_note) {
    *out = NULL;
    if (campaign->stopping && campaign->failure == OK && campaign->first_waiting < campaign->count)
        campaign->failure = INTERRUPTED;
    const bool complete = !disturbs_all(campaign->failure);
    if (campaign->store && complete) TRY(finish_sweep(campaign, out));
    if (!campaign->store) {
        *out = campaign->results;
        campaign->results = NULL;
    }
    *report_note = campaign->note[0] ? campaign->note : NULL;
    return campaign->failure == OK ? OK : status_fail(campaign->failure, "%s", campaign->sentence);
}
