// SPDX-License-Identifier: GPL-3.0-or-later
// Where results come from: what was run, by which program, where and when.
#pragma once

#include "protocol/plan.h"
#include "results/results.h"

// `plan_text`: the run file with every default filled. `seconds`: of wall time.
Status provenance_put(Results *results, const Plan *plan, const char *plan_text, double seconds);
