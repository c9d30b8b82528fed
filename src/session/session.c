// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a plan in a directory, from the lock to the report.
#include "session/session.h"

#include "analysis/analysis.h"
#include "base/cpu.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/version.h"
#include "config/config.h"
#include "report/report.h"
#include "store/store.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct Session {
    const Plan *plan;
    char *plan_text;
    Store *store;
    Ensemble *ensemble;
    bool resumes;
    char report_note[1024];
};

// Key by key, where the other plan can still be read: its version may know other keys.
static Status tell_other_plan(const Session *session, const char *there) {
    Plan *other = NULL;
    char *difference = NULL, *rest = NULL;
    Text keys = {0};
    char sentence[1024];
    snprintf(sentence, sizeof sentence, "%s", status_sentence());
    Status status = config_read_text(&other, "plan.yaml", there, strlen(there), NULL);
    if (status == OK) status = config_difference(other, session->plan, &difference);
    char *line = status == OK ? strtok_r(difference, "\n", &rest) : NULL;
    for (; line; line = strtok_r(NULL, "\n", &rest)) {
        text_add(&keys, "%s%s", keys.length ? "; " : "", line);
    }
    if (keys.length > 0 && text_status(&keys) == OK) {
        snprintf(sentence, sizeof sentence,
                 "'%s' holds a run of another plan: %.700s; choose another directory with -o",
                 store_directory(session->store), text_words(&keys));
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

// Asked before the directory is made: a wish that cannot be granted leaves nothing behind.
static bool has_plan(const char *directory) {
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/plan.yaml", directory);
    return length > 0 && (size_t)length < sizeof path && access(path, F_OK) == 0;
}

static Status begin(Session *session, const SessionWishes *wishes) {
    TRY(plan_check(session->plan));
    if (wishes->must_resume && !has_plan(wishes->directory)) {
        return status_fail(BAD_USAGE, "nothing to resume in %s", wishes->directory);
    }
    TRY(config_write(session->plan, &session->plan_text));
    store_ignore_signals(); // before the first write
    TRY(store_open(&session->store, wishes->directory));
    TRY(take_plan(session));
    TRY(ensemble_create(&session->ensemble, session->plan, session->store, wishes->threads));
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
    store_close(session->store);
    memory_free(session->plan_text);
    memory_free(session);
}

bool session_resumes(const Session *session) {
    return session->resumes;
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

static Status put_integer(Results *results, const char *name, int64_t value) {
    char text[32];
    snprintf(text, sizeof text, "%lld", (long long)value);
    return results_put_fact(results, name, text);
}

static Status put_when_and_where(Results *results, double seconds) {
    char text[256];
    const time_t now = time(NULL);
    struct tm utc;
    strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    TRY(results_put_fact(results, "finished", text));
    if (gethostname(text, sizeof text) != 0) strcpy(text, "unknown");
    text[sizeof text - 1] = '\0';
    TRY(results_put_fact(results, "host", text));
    snprintf(text, sizeof text, "%.3f", seconds);
    return results_put_fact(results, "wall_seconds", text);
}

// Platelets have no volume, so that their number density says how dense they are.
static void put_density(Text *words, const System *system) {
    const double packing = system_packing_fraction(system);
    if (packing > 0)
        text_add(words, "packing fraction %.6g", packing);
    else
        text_add(words, "number density %.6g d^-%d", system_number_density(system),
                 (int)system->dimension);
}

// "1000 particles in 2 dimensions, packing fraction 0.7: 500 small of diameter 1, 500 big of ..."
static Status put_system(Results *results, const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    Text words = {0};
    text_add(&words, "%lld particles in %d dimensions, ", (long long)system->particles,
             (int)system->dimension);
    put_density(&words, system);
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        text_add(&words, "%s%zu %s of diameter %.6g", s ? ", " : ": ", counts[s], species->name,
                 species->diameter);
        if (species->length > 0) text_add(&words, " and length %.6g", species->length);
        if (species->spread != SPREAD_NONE)
            text_add(&words, " ± %.3g %%", 100 * species->spread_width);
        if (species->mass != 1) text_add(&words, " and mass %.6g", species->mass);
    }
    const Status status = results_put_fact(results, "system", text_words(&words));
    text_free(&words);
    return status;
}

// "settle: newtonian, 200 d sqrt(m/kT); quiescent: event-driven, 10 d^2/D0"
static Status put_stages(Results *results, const Plan *plan) {
    Text words = {0};
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Stage *stage = &plan->stages[s];
        text_add(&words, "%s%s: %s, %.6g %s", s ? "; " : "", stage->name,
                 stage->dynamics.kind->name, stage->time, stage->dynamics.kind->time_unit);
    }
    const Status status = results_put_fact(results, "stages", text_words(&words));
    text_free(&words);
    return status;
}

static Status put_provenance(const Session *session, Results *results, double seconds) {
    TRY(results_put_fact(results, "title", session->plan->title));
    TRY(put_system(results, &session->plan->system));
    TRY(put_stages(results, session->plan));
    TRY(results_put_fact(results, "version", version_number()));
    TRY(results_put_fact(results, "commit", version_commit()));
    TRY(results_put_fact(results, "compiler", version_compiler()));
    TRY(results_put_fact(results, "flags", version_flags()));
    TRY(results_put_fact(results, "vector_path", cpu_path_name(cpu_path())));
    TRY(put_integer(results, "seed", session->plan->ensemble.seed));
    TRY(put_integer(results, "replicas", session->plan->ensemble.replicas));
    TRY(results_put_fact(results, "plan", session->plan_text));
    return put_when_and_where(results, seconds);
}

// The report is a convenience: the run has not failed for want of gnuplot.
static Status write_report(Session *session, const Results *results) {
    const Status status = report_write(results, store_directory(session->store));
    if (status == OK) return OK;
    snprintf(session->report_note, sizeof session->report_note, "%s", status_sentence());
    return store_log(session->store, "report: %s", session->report_note);
}

static Status keep_results(Session *session, Results *results, double seconds) {
    TRY(put_provenance(session, results, seconds));
    TRY(analysis_derive(results, &session->plan->system));
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
