// SPDX-License-Identifier: GPL-3.0-or-later
// Finds what a name means: the whole of it, what stands behind the stage, or any end of it.
#include "report/select.h"

#include "base/memory.h"
#include "base/nearest.h"

#include <stdio.h>
#include <string.h>

static void full_name(char out[FULL_NAME], const char *stage, const char *name) {
    snprintf(out, FULL_NAME, "%s/%s", stage, name);
}

// The full names of the scalars, then of the series.
static void name_of_entry(char out[FULL_NAME], const Results *results, size_t entry) {
    if (entry < results->scalar_count) {
        full_name(out, results->scalars[entry].stage, results->scalars[entry].quantity);
    } else {
        const ResultSeries *series = &results->series[entry - results->scalar_count];
        full_name(out, series->stage, series->observable);
    }
}

typedef enum Match { MATCH_NOT, MATCH_END, MATCH_NAME, MATCH_WHOLE } Match;

static Match match(const char *full, const char *asked) {
    const size_t length = strlen(full), wanted = strlen(asked);
    if (wanted == 0 || wanted > length || strcmp(full + length - wanted, asked) != 0) {
        return MATCH_NOT;
    }
    if (wanted == length) return MATCH_WHOLE;
    return full[length - wanted - 1] == '/' ? MATCH_NAME : MATCH_END;
}

// The best match; `several` if another name matches as well.
static Match best_match(char best[FULL_NAME], char rival[FULL_NAME], const Results *results,
                        const char *asked) {
    Match found = MATCH_NOT;
    best[0] = rival[0] = '\0';
    for (size_t i = 0; i < results->scalar_count + results->series_count; i++) {
        char full[FULL_NAME];
        name_of_entry(full, results, i);
        const Match now = match(full, asked);
        if (now == MATCH_NOT || now < found) continue;
        if (now > found)
            rival[0] = '\0';
        else if (strcmp(full, best) != 0)
            memcpy(rival, full, FULL_NAME);
        if (now > found) memcpy(best, full, FULL_NAME);
        found = now;
    }
    return found;
}

static Status unknown(const Results *results, const char *asked) {
    const size_t count = results->scalar_count + results->series_count;
    char(*names)[FULL_NAME];
    const char **words = NULL;
    TRY(NEW_ARRAY(names, count));
    if (NEW_ARRAY(words, 2 * count) != OK) {
        memory_free(names);
        return NO_MEMORY;
    }
    for (size_t i = 0; i < count; i++) { // with the stage and without
        name_of_entry(names[i], results, i);
        words[i] = strchr(names[i], '/') + 1;
        words[count + i] = names[i];
    }
    const size_t near = nearest_word(asked, words, 2 * count);
    const Status status =
        near < 2 * count
            ? status_fail(BAD_USAGE, "no quantity '%s' in these results; did you mean %s?", asked,
                          names[near % count])
            : status_fail(BAD_USAGE,
                          "no quantity '%s' in these results; perrin show DIR lists them", asked);
    memory_free(words);
    memory_free(names);
    return status;
}

Status select_quantity(Selection *out, const Results *results, const char *quantity) {
    *out = (Selection){.all = quantity == NULL};
    if (!quantity) return OK;
    char rival[FULL_NAME];
    if (best_match(out->name, rival, results, quantity) == MATCH_NOT) {
        return unknown(results, quantity);
    }
    if (rival[0]) {
        return status_fail(BAD_USAGE, "'%s' can mean %s or %s; give the full name", quantity,
                           out->name, rival);
    }
    return OK;
}

static bool selects(const Selection *selection, const char *stage, const char *name) {
    if (selection->all) return true;
    char full[FULL_NAME];
    full_name(full, stage, name);
    return strcmp(full, selection->name) == 0;
}

bool selects_said_before(const Results *results, const ResultScalar *scalar) {
    for (const ResultScalar *before = results->scalars; before < scalar; before++) {
        const bool same_stage = strcmp(before->stage, scalar->stage) == 0;
        if (same_stage && strcmp(before->about, scalar->about) == 0) return true;
    }
    return false;
}

bool selects_scalar(const Selection *selection, const ResultScalar *scalar) {
    return selects(selection, scalar->stage, scalar->quantity);
}

bool selects_series(const Selection *selection, const ResultSeries *series) {
    return selects(selection, series->stage, series->observable);
}
