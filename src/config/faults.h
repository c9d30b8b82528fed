// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a run file, told together: whoever made five slips wants five sentences at
// once, not five attempts. Inside config/ only.
#pragma once

#include "base/status.h"

#include <stddef.h>

enum { FAULTS_MOST = 10, FAULTS_SIZE = STATUS_SENTENCE_SIZE };

// Sentences, a line each; those beyond FAULTS_MOST or the room are left for the next attempt.
typedef struct Faults {
    size_t count;
    char sentences[FAULTS_SIZE];
} Faults; // {0} is none

// Keeps what a call found wrong with the run file and gives OK, so that the reading goes on; any
// other failure is given back.
Status faults_keep(Faults *faults, Status status);

// BAD_DATA with all sentences that were kept, or OK if there are none.
Status faults_tell(const Faults *faults);
