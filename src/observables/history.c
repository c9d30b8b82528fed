// SPDX-License-Identifier: GPL-3.0-or-later
// A ring of frames at time origins.
#include "observables/history.h"

#include "base/memory.h"

#include <string.h>

Status history_make(History *history, const Lags *lags, size_t width) {
    history->lags = *lags;
    history->width = width;
    TRY(NEW_ARRAY(history->frames, lags->slots * width));
    return NEW_ARRAY(history->seen, lags_rows(lags));
}

void history_clear(History *history) {
    memory_free(history->frames);
    memory_free(history->seen);
}

size_t history_memory(const Lags *lags, size_t width) {
    return lags->slots * width * sizeof(double) + lags_rows(lags) * sizeof(int64_t);
}

void history_archive(History *history, Archive *archive) {
    archive_f64(archive, history->frames, history->lags.slots * history->width);
    archive_i64(archive, history->seen, lags_rows(&history->lags));
}

const double *history_begun(History *history, int64_t tick, size_t k, size_t *row) {
    const int64_t slot = lags_slot(&history->lags, tick - history->lags.ticks[k]);
    if (slot == LAGS_NO_ORIGIN) return NULL;
    *row = lags_row(&history->lags, slot, k);
    history->seen[*row]++;
    return history->frames + (size_t)slot * history->width;
}

void history_keep(History *history, int64_t tick, const double *frame) {
    const int64_t slot = lags_slot(&history->lags, tick);
    if (slot == LAGS_NO_ORIGIN) return;
    memcpy(history->frames + (size_t)slot * history->width, frame, history->width * sizeof *frame);
}
