// SPDX-License-Identifier: GPL-3.0-or-later
// The page around the figures.
#pragma once

#include "base/text.h"
#include "results/results.h"

void page_begin(Text *page, const Results *results);   // head, title, verdict on health
void page_numbers(Text *page, const Results *results); // scalars beside their references
void page_health(Text *page, const Results *results);
void page_provenance(Text *page, const Results *results);
void page_end(Text *page);
