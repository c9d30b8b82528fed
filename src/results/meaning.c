// SPDX-License-Identifier: GPL-3.0-or-later
// What the numbers and series of a run mean, by their names.
#include "results/results.h"

#include <stdio.h>
#include <string.h>

// Becomes: {.name = "wake_length", .of = "tracer_surroundings", .about = "Integral of ..."}, ...
#define MEANING(name_, of_, ...) {.name = name_, .of = of_, .about = __VA_ARGS__},
#define SERIES MEANING
static const ResultMeaning numbers[] = {
#include "results/meanings.def"
};
static const ResultMeaning series[] = {
#include "results/series.def"
};
#undef SERIES
#undef MEANING

const ResultMeaning *result_meaning_at(size_t row) {
    return row < sizeof numbers / sizeof *numbers ? &numbers[row] : NULL;
}

const ResultMeaning *result_series_meaning_at(size_t row) {
    return row < sizeof series / sizeof *series ? &series[row] : NULL;
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
        if (!fits(numbers[i].name, quantity)) continue;
        if (!longest || strlen(numbers[i].name) > strlen(longest->name)) longest = &numbers[i];
    }
    return longest;
}

bool result_series_source(char source[RESULT_NAME], const char *name, const ResultMeaning *row) {
    const size_t length = strlen(name), end = strlen(row->name) - 1;
    if (row->name[0] != '*' || length <= end || length - end >= RESULT_NAME) return false;
    if (strcmp(name + length - end, row->name + 1) != 0) return false;
    snprintf(source, RESULT_NAME, "%.*s", (int)(length - end), name);
    return result_series_meaning(source) != NULL;
}

const ResultMeaning *result_series_meaning(const char *name) {
    const ResultMeaning *found = NULL;
    char source[RESULT_NAME];
    for (size_t i = 0; result_series_meaning_at(i); i++) {
        if (strcmp(series[i].name, name) == 0) return &series[i];
        if (!result_series_source(source, name, &series[i])) continue;
        if (!found || strlen(series[i].name) > strlen(found->name)) found = &series[i];
    }
    return found;
}
