// SPDX-License-Identifier: GPL-3.0-or-later
// Decimal numbers read strictly and written so that they read back exactly, whatever the locale.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// A decimal number and nothing else: sign, digits, point, exponent. No hexadecimal, infinity, NaN
// or blanks; correctly rounded. False for anything else and for what a double cannot hold.
bool number_read(const char *text, double *value);
// As number_read, but whole and within int64_t: 1e6 is a whole number, 1.5 is not.
bool number_read_whole(const char *text, int64_t *value);

enum { NUMBER_SIZE = 32 };
// The shortest decimal number that reads back as the same double; "nan", "inf" for those.
const char *number_write(char out[NUMBER_SIZE], double value);
