// SPDX-License-Identifier: GPL-3.0-or-later
// From the bytes of a results.h5 to Results. Internal to the store.
#pragma once

#include "results/results.h"

// `results` is given even when this fails, once it was begun. To be called where a crash of HDF5
// does no harm.
Status store_parse_results(Results **results, void *bytes, size_t size);
