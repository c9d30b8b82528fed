// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint/replica-NNNN.a and .b: two slots per replica, written in turn, the newest valid one
// counts; so a checkpoint acknowledged is there after a kill or a loss of power. The bytes are
// those of an Archive; the format around them is our own (docs/file-format.md).
#pragma once

#include "store/store.h"

// Durable when it returns OK. Different replicas may be written from different threads.
Status checkpoint_write(Store *store, size_t replica, const void *bytes, size_t size);

// The newest valid checkpoint of this store's plan, yours to free(); NULL if there never was one.
// Where the newest is damaged the one before is taken and the log says so; BAD_DATA if none is
// whole, or if they belong to another plan.
Status checkpoint_read(Store *store, size_t replica, void **bytes, size_t *size);

// The payload of a checkpoint file held in memory, checked: borrowed from `file`. `path` is for
// the sentence of a failure.
Status checkpoint_check(const void *file, size_t file_size, const char *path, uint64_t *sequence,
                        const void **bytes, size_t *size);
