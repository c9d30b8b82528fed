// SPDX-License-Identifier: GPL-3.0-or-later
// The known word nearest to one that was mistyped, for error sentences: "...; did you mean X?".
#pragma once

#include <stddef.h>

// Insertions, deletions, replacements and swaps of neighbouring letters that lead from a to b.
size_t word_distance(const char *a, const char *b);

// The index of the nearest of `count` words, or of one that `word` is a part of; `count` if none is
// near enough to be meant.
size_t nearest_word(const char *word, const char *const *words, size_t count);
