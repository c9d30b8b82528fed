// SPDX-License-Identifier: GPL-3.0-or-later
// A run without particles: the one of the theories that a plan asks for.
#pragma once

#include "base/archive.h"
#include "protocol/plan.h"

typedef struct Calculation Calculation;

Status calculation_create(Calculation **out, const Plan *plan);
void calculation_free(Calculation *calculation);
uint32_t calculation_checksum(const Calculation *calculation); // of what it has read; 0: nothing

// A slice of the work: mostly below a second. Results are put in as they come.
Status calculation_advance(Calculation *calculation, Results *results);
bool calculation_finished(const Calculation *calculation);
double calculation_progress(const Calculation *calculation);   // 0 to 1
const char *calculation_doing(const Calculation *calculation); // "critical point"
double calculation_time(const Calculation *calculation);       // in d^2/D0; 0: none

// Only the transients of a theory under shear take long enough to be saved, and what was done with
// all samples and without some of them. They are loaded into a calculation that has just been
// created; what was put into results before is put there again.
bool calculation_can_save(const Calculation *calculation);
void calculation_save(Calculation *calculation, Archive *archive);
Status calculation_load(Calculation *calculation, Results *results, Archive *archive);
