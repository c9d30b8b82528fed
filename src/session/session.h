// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a plan in a directory, from the lock to the report: what `perrin run`, `perrin rerun`
// and the C library do.
#pragma once

#include "ensemble/ensemble.h"
#include "protocol/plan.h"
#include "results/results.h"

typedef struct Session Session;

typedef struct SessionWishes {
    const char *directory;
    int threads;          // 0: as many as processors
    EnsembleSlots *slots; // shared with other sessions, borrowed; NULL: its own, of `threads`
    bool must_resume;     // refuse to start anew
} SessionWishes;

// Locks the directory, refuses one that holds another plan, starts the threads. The plan is
// borrowed until session_close.
Status session_open(Session **out, const Plan *plan, const SessionWishes *wishes);
bool session_has_plan(const char *directory); // a run was begun there
bool session_resumes(const Session *session); // there were results or checkpoints of this plan
// What is read has changed since there were results: these are kept under a name of their own.
bool session_begins_anew(const Session *session);

bool session_running(const Session *session);
EnsembleProgress session_progress(const Session *session);
void session_stop(Session *session);
void session_request_checkpoint(Session *session);

// Waits; then analysis, results.h5 and report.html. The results are yours, also when the status is
// UNHEALTHY: then a limit was broken, and the files say which. NULL with any other failure.
// `report_note`: why the report lacks something, or NULL.
Status session_finish(Session *session, Results **out, const char **report_note);
void session_close(Session *session);

// Measures again, from the trajectories in `directory`, what the stages of `plan` that were
// recorded observe; the plan may observe other things than the run did, with other settings, but
// nothing that needs velocities or collisions (`of_motion`). An observer sees the configurations
// that there are; where these are those that it saw in the run, it gives the same bits. With what
// is derived.
Status session_analyse(Results **out, const Plan *plan, const char *directory);
