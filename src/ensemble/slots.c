// SPDX-License-Identifier: GPL-3.0-or-later
// Processors that several ensembles share.
#include "ensemble/unit.h"

#include "base/memory.h"

#include <errno.h>
#include <semaphore.h>
#include <unistd.h>

struct EnsembleSlots {
    size_t count;
    sem_t free;
};

Status ensemble_slots_create(EnsembleSlots **out, int threads) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    EnsembleSlots *slots = NULL;
    TRY(NEW(slots));
    slots->count = threads > 0 ? (size_t)threads : processors > 0 ? (size_t)processors : 1;
    if (sem_init(&slots->free, 0, (unsigned)slots->count) != 0) {
        memory_free(slots);
        return status_fail_errno(NO_MEMORY, "cannot share %d threads", threads);
    }
    *out = slots;
    return OK;
}

void ensemble_slots_free(EnsembleSlots *slots) {
    if (!slots) return;
    sem_destroy(&slots->free);
    memory_free(slots);
}

size_t ensemble_slots_count(const EnsembleSlots *slots) {
    return slots->count;
}

int ensemble_slots_free_now(EnsembleSlots *slots) {
    int free = 0;
    sem_getvalue(&slots->free, &free);
    return free;
}

void slots_take(EnsembleSlots *slots) {
    while (sem_wait(&slots->free) != 0) ASSERT(errno == EINTR);
}

void slots_give(EnsembleSlots *slots) {
    sem_post(&slots->free);
}
