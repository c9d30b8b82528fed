// SPDX-License-Identifier: GPL-3.0-or-later
// A ring of frames at time origins.
#include "observables/history.h"

#include "base/memory.h"

#include <string.h>

Status history_make(History *history, const Lags *lags, size_t width) {
    history->lags = *lags;
    history->width = width;
    TRY(NEW_ARRAY(history->frames, lags->slots * width));
    return NEW_ARRAY(history->seen, lags->count);
}

void history_clear(History *history) {
    memory_free(history->frames);
    memory_free(history->seen);
}

size_t history_memory(const Lags *lags, size_t width) {
    return lags->slots * width * sizeof(double) + lags->count * sizeof(int64_t);
}

void history_archive(History *history, Archive *archive) {
    archive_f64(archive, history->frames, history->lags.slots * history->width);
    archive_i64(archive, history->seen, history->lags.count);
}

const double *history_begun(History *history, int64_t tick, size_t k) {
    if (!lags_ends(&history->lags, tick, k)) return NULL;
    history->seen[k]++;
    return history->frames + lags_slot(&history->lags, tick, k) * history->width;
}

void history_keep(History *history, int64_t tick, const double *frame) {
    if (!lags_is_origin(&history->lags, tick)) return;
    const size_t slot = (size_t)(tick / history->lags.spacing) % history->lags.slots;
    memcpy(history->frames + slot * history->width, frame, history->width * sizeof *frame);
}
