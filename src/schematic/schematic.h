// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the schematic model F12: what the section `schematic` of a run file says, and the
// calculation of it, in slices, into Results with the names that stresses of a simulation have.
#pragma once

#include "base/option.h"
#include "base/text.h"
#include "results/results.h"
#include "schematic/f12.h"

#include <stdbool.h>

// What can be calculated: bits of `calculate`.
typedef enum SchematicPart {
    SCHEMATIC_TRANSITION,
    SCHEMATIC_CORRELATOR,
    SCHEMATIC_FLOW_CURVE,
    SCHEMATIC_YIELD_STRESS,
    SCHEMATIC_PARTS
} SchematicPart;

typedef struct SchematicPlan {
    bool given; // false: no run of a schematic model
    double v2, separation, v1;
    double decay_rate, critical_strain, modulus, softening_strain;
    double shear_rate, last_strain;
    double amplitude, frequency;
    OptionReals table_times, table_rates;
    double duration; // of the table
    int64_t moments, periods;
    double first_time, last_time;
    int64_t times_per_decade, block;
    double first_rate, last_rate;
    int64_t rates_per_decade;
    uint64_t calculate; // bits 1 << SchematicPart
} SchematicPlan;

extern const OptionTable schematic_options;

Status schematic_check(const SchematicPlan *plan); // BAD_DATA with a sentence
size_t schematic_memory(const SchematicPlan *plan);
double schematic_seconds(const SchematicPlan *plan); // rough
F12 schematic_model(const SchematicPlan *plan);
bool schematic_oscillates(const SchematicPlan *plan);
bool schematic_has_table(const SchematicPlan *plan);
// "shear rate 0.1 D0/d^2", "at rest".
void schematic_say_drive(Text *text, const SchematicPlan *plan);

typedef struct Schematic Schematic;
Status schematic_create(Schematic **out, const SchematicPlan *plan);
void schematic_free(Schematic *schematic);

// A slice of the work: mostly below a second. Results are put in as they come.
Status schematic_advance(Schematic *schematic, Results *results);
bool schematic_finished(const Schematic *schematic);
double schematic_progress(const Schematic *schematic);   // 0 to 1
const char *schematic_doing(const Schematic *schematic); // "flow curve"
double schematic_time(const Schematic *schematic);       // of the correlator; 0 before
