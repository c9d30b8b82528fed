// SPDX-License-Identifier: GPL-3.0-or-later
// Shear rates against time from a file that a run file names. Inside config/ only.
#pragma once

#include "config/tree.h"
#include "protocol/plan.h"

// Puts the numbers of flow->table.file, seen from the folder of the run file in which `node`, the
// map shear_table, stands, in place of its name. BAD_DATA with file and line.
Status rate_table_read(Flow *flow, const Node *node);
