// SPDX-License-Identifier: GPL-3.0-or-later
// When an observer looks: at whole steps of the stage, evenly spaced, never at its start.
#pragma once

#include "observables/observables.h"

// The row of an option table, for the member `looks` of the struct `Type`.
#define LOOKS_OPTION(Type, looks, usual)                                                           \
    {                                                                                              \
        .name = "looks", .type = OPTION_INTEGER, .offset = offsetof(Type, looks),                  \
        .fallback = usual, .least = 1, .most = 10000000, .unit = "",                               \
        .about = "Configurations looked at, evenly over the stage: at most this many.",            \
    }

// Ticks between looks so that there are at most `most` of them, and at least half as many where
// the stage has the steps.
int64_t looks_period(const Clock *clock, int64_t most);

// The first look after tick `after`; INT64_MAX when the stage has no more.
int64_t looks_after(const Clock *clock, int64_t period, int64_t after);

// The same, as `next` of an observer that has its `period`.
int64_t looks_next(const Observer *observer, int64_t after);

// How many there are in the whole stage.
int64_t looks_count(const Clock *clock, int64_t period);
