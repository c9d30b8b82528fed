// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a plan whose every value is right by itself, told at the place in the run
// file that the reader should look at. Inside config/ only.
#pragma once

#include "config/tree.h"
#include "protocol/plan.h"

// `root` is the run file that became this plan.
Status judge_plan(const Node *root, const Plan *plan);

// Likewise a run of the theory.
Status judge_theory(const Node *root, const TheoryPlan *theory);
Status judge_itt(const Node *root, const IttPlan *itt);
Status judge_schematic(const Node *root, const SchematicPlan *schematic);

// BAD_DATA if one replica does not fit into the memory of this machine.
Status judge_memory(const Node *root, const Plan *plan);
