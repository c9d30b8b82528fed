// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest words by the Damerau-Levenshtein distance (optimal string alignment).
#include "base/nearest.h"

#include <string.h>

enum { WORD_MOST = 128 }; // letters compared; names are shorter

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

size_t word_distance(const char *a, const char *b) {
    const size_t rows = least(strlen(a), WORD_MOST), columns = least(strlen(b), WORD_MOST);
    // distance[i % 3][j]: between the first i letters of a and the first j of b
    size_t distance[3][WORD_MOST + 1];
    for (size_t j = 0; j <= columns; j++) distance[0][j] = j;
    for (size_t i = 1; i <= rows; i++) {
        size_t *now = distance[i % 3];
        const size_t *before = distance[(i + 2) % 3], *before_that = distance[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= columns; j++) {
            now[j] = least(before[j], now[j - 1]) + 1;
            now[j] = least(now[j], before[j - 1] + (a[i - 1] != b[j - 1]));
            const int swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) now[j] = least(now[j], before_that[j - 2] + 1);
        }
    }
    return distance[rows % 3][columns];
}

// For a part of a longer word, as "density" of "number_density": the shortest word that has it.
static size_t word_around(const char *part, const char *const *words, size_t count) {
    enum { PART_LEAST = 4 }; // letters; shorter parts are in too many words
    size_t around = count;
    for (size_t i = 0; strlen(part) >= PART_LEAST && i < count; i++) {
        if (!strstr(words[i], part)) continue;
        if (around == count || strlen(words[i]) < strlen(words[around])) around = i;
    }
    return around;
}

size_t nearest_word(const char *word, const char *const *words, size_t count) {
    size_t nearest = count, shortest = (strlen(word) + 2) / 3 + 1; // a third may be wrong
    for (size_t i = 0; i < count; i++) {
        const size_t distance = word_distance(word, words[i]);
        if (distance >= shortest) continue;
        shortest = distance;
        nearest = i;
    }
    return nearest < count ? nearest : word_around(word, words, count);
}
