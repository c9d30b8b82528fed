// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of what theories of mixtures put into Results: stage `theory`, one replica, labels of
// species and their pairs, axes.
#pragma once

#include "theory/theory.h"

// Point into each other: not to be copied.
typedef struct TheoryLabels {
    size_t count;
    const char *names[MIXTURE_PAIRS_MOST + 1];
    char text[MIXTURE_PAIRS_MOST + 1][2 * THEORY_NAME_SIZE];
} TheoryLabels;

// "small-small", "small-big", "big-big", and "total", their sum over ordered pairs.
void theory_label_pairs(TheoryLabels *labels, const TheorySpecies *species, size_t count);
void theory_label_species(TheoryLabels *labels, const TheorySpecies *species, size_t count);

// `about` where the name stands for something else in a simulation; else empty.
ResultSeries theory_series(const char *name, const char *unit, const char *about);
void theory_add_labels(ResultSeries *series, const char *axis, size_t count,
                       const char *const *labels);
void theory_add_numbers(ResultSeries *series, const char *axis, const char *unit, size_t count,
                        const double *values);

// [time][line] as [line][time].
void theory_turn(const double *kept, size_t times, size_t lines, double *out);

Status theory_put_number(Results *results, const char *name, const char *unit, const char *about,
                         double value);
// Of each species, under the name with that of the species where there are several.
Status theory_put_each(Results *results, const TheorySpecies *species, size_t count,
                       const char *name, const char *unit, const char *about, const double *values);
