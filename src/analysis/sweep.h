// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of a quantity over the states of a sweep: along one axis of a series, for each row of the
// others. A law is a function of means over replicas; the errors of what it finds are the
// jackknife's: a replica of every state is left out in turn, which is right for states that are
// independent of each other.
#pragma once

#include "results/results.h"

#include <stdbool.h>

enum { STATES_MOST = 64 };

// Means along the axis, some of them NaN.
typedef struct States {
    size_t count;
    const double *at; // values of the axis
    double mean[STATES_MOST];
    double error[STATES_MOST];  // standard errors over all replicas; NaN of a single one
    double beside[STATES_MOST]; // of a second series
} States;

typedef void Law(const States *states, double *out);

typedef struct Sweep {
    const Results *results;
    ResultSeries series;
    const ResultSeries *beside; // of the same shape, or NULL
    size_t beside_waves;        // its elements in a row that count as the first of them; or 1
    size_t axis, inner, rows;   // of the states; elements from one of it to the next
    size_t numbers;             // that the law gives
    double *values;             // [replica][row][number]: pseudo-values
} Sweep;

// Numbers of every row from `first` on, along further axes.
typedef struct Part {
    const char *name;
    size_t first, axes;
    ResultAxis axis[2];
    const char *unit; // NULL: a pure number
} Part;

// Along the axis of this name; false if there is none, with at least two states.
bool sweep_make(Sweep *sweep, const Results *results, const ResultSeries *series, const char *axis);

// The name of the observable without this ending, and another behind it.
void sweep_name(char name[RESULT_NAME], const char *observable, const char *ending,
                const char *part);

// What the law finds, added to the results as OBSERVABLE_PART, the observable without `ending`; of
// an observable that is the ending alone, as PART.
Status sweep_put(Results *results, Sweep *sweep, Law *law, const char *ending, const Part *parts,
                 size_t count);

// Of OBSERVABLE_relaxation_time, _scaled and _plateau over packing fractions.
Status derive_power_law(Results *results, Sweep *sweep);
Status derive_master_curve(Results *results, Sweep *sweep);
Status derive_square_root_law(Results *results, Sweep *sweep);
// Of shear_stress over shear rates.
Status derive_flow_curve(Results *results, Sweep *sweep);
