// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a run file in a directory with progress, signals and a summary: for `run` and `rerun`.
#pragma once

#include "campaign/campaign.h"

Status runner_run(const ConfigPoints *points, const SessionWishes *wishes, bool quiet);

// Reads a --threads value: 1 to 4096; 0 if the text is NULL.
Status runner_threads(const char *text, int *threads);
