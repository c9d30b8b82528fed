// SPDX-License-Identifier: GPL-3.0-or-later
// All points of a run file: a run each, side by side where processors are free, and what they found
// put together. A run file without `sweep:` is one run in the directory itself; the points of a
// sweep have folders in it.
#pragma once

#include "config/config.h"
#include "session/session.h"

typedef struct Campaign Campaign;

// Locks the directory and refuses one that holds another run file. The points are borrowed.
Status campaign_open(Campaign **out, const ConfigPoints *points, const SessionWishes *wishes);
bool campaign_resumes(const Campaign *campaign);
// How many runs so far began anew, for what they read has changed since they had results.
size_t campaign_anew(const Campaign *campaign);

// Starts the runs of further points and ends those that are done; false when none is left. To be
// asked several times a second.
bool campaign_tend(Campaign *campaign);
EnsembleProgress campaign_progress(const Campaign *campaign);
void campaign_stop(Campaign *campaign);
void campaign_request_checkpoint(Campaign *campaign);

// What session_finish says of a single run. Of a sweep: every quantity of the points' stages as a
// series over what is swept, in results.h5 and report.html of the directory; the first failure of
// a point, told with its name, after what the others found has been written.
Status campaign_finish(Campaign *campaign, Results **out, const char **report_note);
void campaign_close(Campaign *campaign);
