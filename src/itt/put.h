// SPDX-License-Identifier: GPL-3.0-or-later
// Results of the theory under shear: stage `theory`, one replica. Inside itt/ only.
#pragma once

#include "base/archive.h"
#include "itt/itt.h"
#include "itt/plane.h"
#include "itt/transient.h"

// What is kept while time goes on, the slowest index first.
typedef struct Record {
    const TheorySpecies *species;
    size_t species_count, rows; // rows: pairs of species and their total, which is alone of one
    size_t waves, times, times_most;
    double wave_number[OPTION_LIST_SIZE];
    double *time, *modulus; // [times_most]
    size_t strains, strains_most;
    double *strain, *stress; // [strains_most], and [strains_most][2]: shear, normal difference
    double *collective;      // [times_most][row][direction][wave]
    double *tagged;          // [times_most][species][direction][wave]; NULL: none
    double *displacement;    // [times_most][species][direction]; NULL: none
} Record;

// Room for these times and strains; which wave numbers and species is set by the caller.
Status record_create(Record *record, size_t waves, size_t times, size_t strains, bool tagged);
void record_free(Record *record);
// Saves what is kept, or loads it where there is the same room.
void record_archive(Record *record, Archive *archive);

Status record_put(const Record *record, Results *results);

// S_ab(q) under shear and its change, on the plane and along its cuts, [pair][size of the plane];
// `rest` is S at rest.
Status record_put_structure(const Record *record, Results *results, const Plane *plane,
                            const double *rest, const double *change);

// The wave vector of this length in a direction.
void record_vector(int direction, double length, double *x, double *y);
