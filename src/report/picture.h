// SPDX-License-Identifier: GPL-3.0-or-later
// A configuration as a picture: particles to scale in their periodic box, coloured by species.
#pragma once

#include "base/text.h"
#include "results/results.h"

#include <stdbool.h>

bool picture_exists(const Results *results, const ResultSeries *series); // is it a snapshot?
bool picture_uses(const ResultSeries *series); // part of a snapshot, not to be drawn as a figure
void picture_draw(Text *page, const Results *results, const ResultSeries *series); // SVG
void picture_caption(Text *text, const Results *results, const ResultSeries *series);
