// SPDX-License-Identifier: GPL-3.0-or-later
// The man page, perrin(1), from the tables of the commands: docs/perrin.1 is what this prints.
#pragma once

#include <stdio.h>

void manual_write(FILE *out);
