// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of the store know of each other. Internal to the store.
#pragma once

#include "store/disk.h"
#include "store/store.h"

#include <stdint.h>

struct Store {
    Folder folder;
    int lock;      // descriptor of perrin.lock
    uint64_t plan; // names the plan: hash of its text
};

// HDF5 is used by one thread of the process at a time, whatever the store.
void store_take_hdf5(void);
void store_give_hdf5(void);
