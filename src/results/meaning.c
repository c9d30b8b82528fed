// SPDX-License-Identifier: GPL-3.0-or-later
// What the numbers of a run mean, by their names.
#include "results/results.h"

#include <string.h>

// Becomes: {"wake_length", "tracer_surroundings", "Integral of ..."}, ...
static const ResultMeaning meanings[] = {
#define MEANING(name, of, about) {name, of, about},
#include "results/meanings.def"
#undef MEANING
};

const ResultMeaning *result_meaning_at(size_t row) {
    return row < sizeof meanings / sizeof *meanings ? &meanings[row] : NULL;
}

// "acceptance*" fits acceptance and acceptance_tracer.
static bool fits(const char *row, const char *quantity) {
    const size_t length = strcspn(row, "*");
    if (strncmp(row, quantity, length) != 0) return false;
    return quantity[length] == '\0' || (row[length] == '*' && quantity[length] == '_');
}

const ResultMeaning *result_meaning(const char *quantity) {
    const ResultMeaning *longest = NULL;
    for (size_t i = 0; result_meaning_at(i); i++) {
        if (!fits(meanings[i].name, quantity)) continue;
        if (!longest || strlen(meanings[i].name) > strlen(longest->name)) longest = &meanings[i];
    }
    return longest;
}
