// SPDX-License-Identifier: GPL-3.0-or-later
// What a run left in its directory.
#pragma once

#include "results/results.h"

// From DIRECTORY/results.h5, or from that file itself; yours.
Status stored_results(Results **out, const char *directory);
