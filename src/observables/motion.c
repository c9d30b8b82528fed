// SPDX-License-Identifier: GPL-3.0-or-later
// What observers of displacements share.
#include "observables/motion.h"

#include "base/memory.h"
#include "observables/begin.h"

static size_t sum_count(const Motion *self) {
    return lags_rows(&self->moves.history.lags) * self->row_size;
}

static Status allocate(Motion *self, const State *state, const Lags *lags) {
    TRY(displacements_make(&self->moves, state, lags));
    TRY(NEW_ARRAY(self->scratch, self->moves.lanes));
    return NEW_ARRAY(self->sums, sum_count(self));
}

void motion_free(Observer *observer) {
    Motion *self = (Motion *)observer;
    displacements_clear(&self->moves);
    memory_free(self->scratch);
    memory_free(self->sums);
    memory_free(self);
}

Status motion_begin(Observer **out, Motion *self, const State *state, const Lags *lags) {
    return observer_begin(out, &self->observer, allocate(self, state, lags));
}

int64_t motion_next(const Observer *observer, int64_t after) {
    return lags_next(&((const Motion *)observer)->moves.history.lags, &observer->clock, after);
}

Status motion_see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Motion *self = (Motion *)observer;
    displacements_look(&self->moves, state);
    for (size_t k = 0; k < self->moves.history.lags.count; k++) {
        size_t row = 0;
        if (displacements_ended(&self->moves, tick, k, &row))
            self->add_row(self, self->sums + row * self->row_size);
    }
    displacements_keep(&self->moves, tick);
    return OK;
}

void motion_archive(Observer *observer, Archive *archive) {
    Motion *self = (Motion *)observer;
    archive_tag(archive, self->tag);
    displacements_archive(&self->moves, archive);
    archive_f64(archive, self->sums, sum_count(self));
}

size_t motion_memory(const System *system, const Lags *lags, size_t row_size) {
    return displacements_memory(system, lags) +
           ((size_t)system->particles + lags_rows(lags) * row_size) * sizeof(double);
}
