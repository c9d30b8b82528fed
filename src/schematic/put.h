// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and curves of the schematic model as results. Inside schematic/ only.
#pragma once

#include "results/results.h"

Status put_scalar(Results *results, const char *name, const char *unit, const char *about,
                  double value);
// Against one axis of numbers.
Status put_line(Results *results, const char *name, const char *unit, const char *about,
                const char *axis, const char *unit_of_axis, const double *x, size_t count,
                const double *values);
// The shear stress, on the axis `stress` that observers have and then this.
Status put_stress(Results *results, const char *about, const char *axis, const char *unit_of_axis,
                  const double *x, size_t count, const double *values);
// Values [row][x], rows at numbers of their own.
Status put_rows(Results *results, const char *name, const char *about, const char *row_axis,
                const double *rows, size_t row_count, const double *time, size_t count,
                const double *values);
// Moduli of the harmonics 1, 2, ...: values [elastic, viscous][count].
Status put_harmonics(Results *results, size_t count, const double *moduli);
