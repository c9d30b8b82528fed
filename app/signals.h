// SPDX-License-Identifier: GPL-3.0-or-later
// What signals ask of a run. First SIGINT, SIGTERM or SIGUSR1: checkpoint and stop. Second SIGINT:
// out at once. SIGUSR2: checkpoint and go on.
#pragma once

#include <stdbool.h>

void signals_catch(void);
bool signals_want_stop(void);
bool signals_want_checkpoint(void); // true once per SIGUSR2
