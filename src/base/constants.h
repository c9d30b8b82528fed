// SPDX-License-Identifier: GPL-3.0-or-later
// Mathematical constants that C11 does not name.
#pragma once

static const double PI = 3.14159265358979323846;
