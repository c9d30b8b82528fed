// SPDX-License-Identifier: GPL-3.0-or-later
// What was seen at the last time origins, so that every lag that ends finds what it began with:
// frames of `width` numbers each, whatever they mean to their owner, in a ring.
#pragma once

#include "base/archive.h"
#include "observables/lags.h"

typedef struct History {
    Lags lags;
    size_t width;
    double *frames; // [slots][width]
    int64_t *seen;  // [rows of lags]: origins from which each has been seen
} History;

Status history_make(History *history, const Lags *lags, size_t width);
void history_clear(History *history);
size_t history_memory(const Lags *lags, size_t width); // bytes
void history_archive(History *history, Archive *archive);

// The frame with which lag `k` began, counted as seen, and in `row` where its sums are; NULL if the
// lag does not end at `tick`.
const double *history_begun(History *history, int64_t tick, size_t k, size_t *row);

// Keeps a frame if `tick` is a time origin. To be called after the lags that end have been seen.
void history_keep(History *history, int64_t tick, const double *frame);
