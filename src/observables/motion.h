// SPDX-License-Identifier: GPL-3.0-or-later
// What observers of displacements share: a row of sums for each lag, to which every displacement
// adds that began at a time origin. Only what is added, and what is made of it, is their own.
#pragma once

#include "observables/displacements.h"

typedef struct Motion Motion;
struct Motion {
    Observer observer;
    uint64_t tag; // of the archive
    Displacements moves;
    size_t row_size; // sums of one row
    double *scratch; // [lanes], the owner's, as long as it adds
    double *sums;    // [row of lags][row_size], over particles and time origins
    void (*add_row)(Motion *self, double *sums); // what has moved is in moves.moved
};

// A new observer whose own fields are set, as are kind, clock, tag, row_size and add_row. It is
// given to `out`, or freed on failure.
Status motion_begin(Observer **out, Motion *self, const State *state, const Lags *lags);
int64_t motion_next(const Observer *observer, int64_t after);
Status motion_see(Observer *observer, int64_t tick, const State *state, const Tally *tally);
void motion_archive(Observer *observer, Archive *archive);
void motion_free(Observer *observer);

// Bytes beside the observer itself.
size_t motion_memory(const System *system, const Lags *lags, size_t row_size);
