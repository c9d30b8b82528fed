// SPDX-License-Identifier: GPL-3.0-or-later
// What shears the schematic model: a strain that oscillates, or the integral of rates in a table.
// Both repeat, the table with the strain that it leaves: how it was before the beginning changes
// nothing that is asked for. Inside schematic/ only.
#pragma once

#include <stddef.h>

enum { STRAIN_RATES_MOST = 64 };

typedef struct Strain {
    double amplitude, frequency; // of amplitude sin(frequency t); used where there is no table
    size_t count;                // of the table: straight lines between rates, constant outside
    double time[STRAIN_RATES_MOST], rate[STRAIN_RATES_MOST];
    double duration; // of what the table is for
} Strain;

double strain_period(const Strain *strain);
double strain_at(const Strain *strain, double time);
