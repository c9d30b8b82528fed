// SPDX-License-Identifier: GPL-3.0-or-later
// Names along the axes of results.
#include "observables/labels.h"

#include <stdio.h>

static void append(Labels *labels, const char *first, const char *dash, const char *second) {
    char *text = labels->text[labels->count];
    snprintf(text, sizeof labels->text[0], "%.31s%s%.31s", first, dash, second);
    labels->names[labels->count++] = text;
}

void labels_of_species(Labels *labels, const System *system) {
    labels->count = 0;
    for (size_t s = 0; s < system->species_count; s++)
        append(labels, system->species[s].name, "", "");
    if (system->species_count > 1) append(labels, "all", "", "");
}

void labels_of_pairs(Labels *labels, const System *system, const char *last) {
    labels->count = 0;
    for (size_t a = 0; a < system->species_count; a++) {
        for (size_t b = a; b < system->species_count; b++) {
            append(labels, system->species[a].name, "-", system->species[b].name);
        }
    }
    if (last) append(labels, last, "", "");
}
