// SPDX-License-Identifier: GPL-3.0-or-later
// Trajectories of a tracer begin and end where there are configurations to see, and between them it
// jumps.
#pragma once

#include "observables/observables.h"

#include <math.h>

// BAD_DATA with a sentence if stored configurations, which are all there are, miss the beginnings
// of the tracer's trajectories.
static inline Status tracer_check_frames(const Clock *clock) {
    const Pull *pull = &clock->drive->pull;
    const double spacing = clock->tick * (double)clock->ticks_per_step;
    int64_t period, on;
    drive_pull_ticks(pull, clock->tick, clock->ticks_per_step, &period, &on);
    if (!clock->whole_steps || period == INT64_MAX) return OK;
    const double off = fabs(pull->period - clock->tick * (double)period),
                 rests_off = fabs(pull->rest - clock->tick * (double)(period - on));
    if (off <= clock->tick && rests_off <= clock->tick) return OK;
    return status_fail(BAD_DATA,
                       "pull = {period: %g, rest: %g}: these are no multiples of the %g between "
                       "stored configurations, so that beginnings and ends of the tracer's "
                       "trajectories are not among them; run again with a trajectory.every that is",
                       pull->period, pull->rest, spacing);
}

// BAD_DATA with a sentence for an observable that follows particles, if some of them jump: the
// tracer begins each trajectory somewhere else, often in place of another particle.
static inline Status tracer_check_stays(const char *observable, const Clock *clock) {
    if (!clock->drive || !(drive_kinds(clock->drive) & DRIVE_PULL)) return OK;
    int64_t period, on;
    drive_pull_ticks(&clock->drive->pull, clock->tick, clock->ticks_per_step, &period, &on);
    if (period >= clock->ticks) return OK;
    return status_fail(BAD_DATA,
                       "%s follows particles, and in stage '%s' the tracer goes to another place "
                       "every %g %s; leave out the period of its pull, or take pulled_tracer",
                       observable, clock->stage, clock->drive->pull.period, clock->unit);
}
