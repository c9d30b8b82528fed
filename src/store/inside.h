// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of the store know of each other. Internal to the store.
#pragma once

#include "store/disk.h"
#include "store/store.h"

#include <pthread.h>

struct Store {
    Folder folder;
    int lock;             // descriptor of perrin.lock
    uint64_t plan;        // names the plan: hash of its text
    pthread_mutex_t hdf5; // HDF5 is used by one thread at a time
};
