// SPDX-License-Identifier: GPL-3.0-or-later
// How long things take.
#pragma once

double
seconds_now(void); // wall-clock seconds since some time before the program began; never set back
