// SPDX-License-Identifier: GPL-3.0-or-later
// A number or a curve out of Results by name: "STAGE/QUANTITY", an element of an array as
// "STAGE/OBSERVABLE[all,total,0.06]" with a label or a number per axis, the difference or ratio of
// two of these as "A - B", "A / B", taken replica by replica. A "*" leaves one axis open: a curve.
#pragma once

#include "results/results.h"

#include <stdbool.h>
#include <stdio.h>

bool measure_is_curve(const char *quantity);

Status measure_number(const Results *results, const char *quantity, Estimate *estimate);

// A header and a row "x,value,error" per element along the open axis.
Status measure_curve(const Results *results, const char *quantity, FILE *out);
