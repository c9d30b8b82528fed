// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a plan in a directory, from the lock to the report.
#include "session/session.h"

#include "analysis/analysis.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/version.h"
#include "config/config.h"
#include "report/report.h"
#include "session/provenance.h"
#include "store/store.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct Session {
    const Plan *plan;
    char *plan_text;
    Store *store;
    EnsembleSlots *own_slots; // NULL: they are shared
    Ensemble *ensemble;
    bool resumes, anew;
    char report_note[1024];
};

// A line, cut between words where it is longer than a reader wants, as a whole stage would be.
static void add_shortened(Text *text, const char *line) {
    enum { LINE_SHOWN = 160 };
    size_t length = strlen(line);
    const bool cut = length > LINE_SHOWN;
    if (cut) length = LINE_SHOWN;
    while (cut && length > 0 && line[length] != ' ') length--;
    text_bytes(text, line, length);
    if (cut) text_put(text, " ...");
}

// The first lines of `difference`, which is used up, and how many there are besides.
static void add_lines(Text *text, char *difference) {
    enum { LINES_SHOWN = 6 };
    size_t count = 0;
    char *rest = NULL;
    for (char *line = strtok_r(difference, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        if (++count > LINES_SHOWN) continue;
        text_put(text, text->length ? "; " : "");
        add_shortened(text, line);
    }
    if (count > LINES_SHOWN) text_add(text, "; and %zu more", count - LINES_SHOWN);
}

// Key by key, where the other plan can still be read: its version may know other keys.
static Status tell_other_plan(const Session *session, const char *there) {
    Plan *other = NULL;
    char *difference = NULL;
    Text keys = {0};
    char sentence[STATUS_SENTENCE_SIZE];
    snprintf(sentence, sizeof sentence, "%s", status_sentence());
    Status status = config_read_text(&other, "plan.yaml", there, strlen(there), NULL);
    if (status == OK) status = config_difference(other, session->plan, &difference);
    if (status == OK) add_lines(&keys, difference);
    if (keys.length > 0 && text_status(&keys) == OK) {
        snprintf(sentence, sizeof sentence,
                 "'%.1000s' holds a run of another plan: %s; choose another directory with -o",
                 store_directory(session->store), text_words(&keys));
    } else {
        const size_t length = strlen(sentence);
        snprintf(sentence + length, sizeof sentence - length,
                 ". The keys differ: another version may have begun it, which log.txt names");
    }
    text_free(&keys);
    memory_free(difference);
    memory_free(other);
    return status_fail(LOCKED, "%s", sentence);
}

static Status take_plan(Session *session) {
    char *there = NULL;
    Status status = store_take_plan(session->store, session->plan_text, &session->resumes);
    if (status != LOCKED) return status;
    status = store_read_text(session->store, "plan.yaml", &there);
    if (status == OK) status = there ? tell_other_plan(session, there) : LOCKED;
    memory_free(there);
    return status;
}

bool session_has_plan(const char *directory) {
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/plan.yaml", directory);
    return length > 0 && (size_t)length < sizeof path && access(path, F_OK) == 0;
}

// Results of numbers that are not those of now: they cannot be had again once the file that they
// were read from is another.
static Status keep_earlier(Session *session, const Results *earlier) {
    const char *checksum = results_find_fact(earlier, PLAN_CHECKSUM_FACT);
    char name[64];
    snprintf(name, sizeof name, "results-of-%.8s.h5", checksum ? checksum : "unknown");
    session->anew = true;
    TRY(store_rename(session->store, "results.h5", name));
    return store_log(session->store,
                     "the structure that is read is not that of results.h5, which is kept as %s",
                     name);
}

static Status judge_earlier(Session *session, uint32_t checksum) {
    Results *earlier = NULL;
    Text path = {0};
    text_add(&path, "%s/results.h5", store_directory(session->store));
    TRY(text_status(&path));
    const bool whole = store_read_results(&earlier, text_words(&path)) == OK;
    text_free(&path);
    if (!whole) return OK;
    const Status status =
        plan_has_checksum(earlier, checksum) ? OK : keep_earlier(session, earlier);
    results_free(earlier);
    return status;
}

static Status begin(Session *session, const SessionWishes *wishes) {
    uint32_t checksum;
    TRY(plan_check(session->plan));
    TRY(plan_check_input(session->plan, &checksum));
    // Before the directory is made: a wish that cannot be granted leaves nothing behind.
    if (wishes->must_resume && !session_has_plan(wishes->directory)) {
        return status_fail(BAD_USAGE, "nothing to resume in %s", wishes->directory);
    }
    TRY(config_write(session->plan, &session->plan_text));
    store_ignore_signals(); // before the first write
    TRY(store_open(&session->store, wishes->directory));
    TRY(take_plan(session));
    if (session->resumes && checksum != 0) TRY(judge_earlier(session, checksum));
    if (!wishes->slots) TRY(ensemble_slots_create(&session->own_slots, wishes->threads));
    TRY(ensemble_create(&session->ensemble, session->plan, session->store,
                        wishes->slots ? wishes->slots : session->own_slots));
    const size_t threads = ensemble_threads(session->ensemble);
    TRY(store_log(session->store, "perrin %s (%s) %s, %zu thread%s", version_number(),
                  version_commit(), session->resumes ? "resumes" : "starts", threads,
                  threads == 1 ? "" : "s"));
    return ensemble_start(session->ensemble);
}

Status session_open(Session **out, const Plan *plan, const SessionWishes *wishes) {
    Session *session = NULL;
    TRY(NEW(session));
    session->plan = plan;
    const Status status = begin(session, wishes);
    if (status != OK) {
        session_close(session);
        return status;
    }
    *out = session;
    return OK;
}

void session_close(Session *session) {
    if (!session) return;
    ensemble_free(session->ensemble);
    ensemble_slots_free(session->own_slots);
    store_close(session->store);
    memory_free(session->plan_text);
    memory_free(session);
}

bool session_resumes(const Session *session) {
    return session->resumes;
}

bool session_begins_anew(const Session *session) {
    return session->anew;
}

bool session_running(const Session *session) {
    return ensemble_running(session->ensemble);
}

EnsembleProgress session_progress(const Session *session) {
    return ensemble_progress(session->ensemble);
}

void session_stop(Session *session) {
    ensemble_stop(session->ensemble);
}

void session_request_checkpoint(Session *session) {
    ensemble_request_checkpoint(session->ensemble);
}

// The report is a convenience: the run has not failed for want of gnuplot.
static Status write_report(Session *session, const Results *results) {
    const Status status = report_write(results, store_directory(session->store));
    if (status == OK) return OK;
    snprintf(session->report_note, sizeof session->report_note, "%s", status_sentence());
    return store_log(session->store, "report: %s", session->report_note);
}

static Status keep_results(Session *session, Results *results, double seconds) {
    TRY(provenance_put(results, session->plan, session->plan_text, seconds));
    if (!plan_is_theory(session->plan)) {
        TRY(analysis_derive(results, &session->plan->system));
        TRY(analysis_centre(results, session->plan));
        TRY(analysis_equation(results, session->plan));
        TRY(analysis_judge(results, session->plan));
    }
    TRY(store_write_results(session->store, results));
    TRY(write_report(session, results));
    return store_log(session->store, "finished after %.1f s", seconds);
}

Status session_finish(Session *session, Results **out, const char **report_note) {
    Results *results = NULL;
    const double seconds = ensemble_progress(session->ensemble).seconds;
    Status status = ensemble_finish(session->ensemble, &results);
    if (status == OK) status = keep_results(session, results, seconds);
    if (status != OK) {
        // The run's own failure is what the user must read, even if the log cannot take it.
        char sentence[1024];
        snprintf(sentence, sizeof sentence, "%s", status_sentence());
        results_free(results);
        if (store_log(session->store, "stopped: %s", sentence) == OK) {
            return status_fail(status, "%s", sentence);
        }
        return status_fail(status, "%s (and the log could not be written)", sentence);
    }
    *out = results;
    *report_note = session->report_note[0] ? session->report_note : NULL;
    const ResultCounter *broken = results_broken_limit(results);
    if (!broken) return OK;
    return status_fail(UNHEALTHY, "health: %s = %g exceeds its limit %g (%s); results are in %s",
                       broken->name, broken->value, broken->limit, broken->about,
                       store_directory(session->store));
}
