// SPDX-License-Identifier: GPL-3.0-or-later
// same_results A.h5 B.h5: whether two results hold the same numbers bit for bit, provenance and
// the machinery's counters aside. Exit code 0 if so, 1 with the first difference if not.
#include "store/store.h"

#include <stdio.h>
#include <string.h>

static int differ(const char *what, const char *stage, const char *name) {
    printf("%s %s/%s differs\n", what, stage, name);
    return 1;
}

static int compare_axes(const ResultSeries *a, const ResultSeries *b) {
    if (a->axes != b->axes || a->size != b->size) return 1;
    for (size_t i = 0; i < a->axes; i++) {
        const ResultAxis *x = &a->axis[i], *y = &b->axis[i];
        if (strcmp(x->name, y->name) != 0 || x->count != y->count) return 1;
        if (!x->labels != !y->labels) return 1;
        if (x->values && memcmp(x->values, y->values, x->count * sizeof *x->values) != 0) return 1;
    }
    return 0;
}

static int compare(const Results *a, const Results *b) {
    if (a->replicas != b->replicas || a->series_count != b->series_count ||
        a->scalar_count != b->scalar_count) {
        return differ("number of", "things", "");
    }
    for (size_t i = 0; i < a->series_count; i++) {
        const ResultSeries *x = &a->series[i];
        const ResultSeries *y = results_find_series(b, x->stage, x->observable);
        const size_t bytes = a->replicas * x->size * sizeof *x->values;
        if (!y || compare_axes(x, y) || memcmp(x->values, y->values, bytes) != 0) {
            return differ("series", x->stage, x->observable);
        }
    }
    for (size_t i = 0; i < a->scalar_count; i++) {
        const ResultScalar *x = &a->scalars[i];
        const ResultScalar *y = results_find_scalar(b, x->stage, x->quantity);
        if (!y || memcmp(x->values, y->values, a->replicas * sizeof *x->values) != 0) {
            return differ("quantity", x->stage, x->quantity);
        }
    }
    return 0;
}

int main(int count, char **paths) {
    Results *results[2] = {NULL, NULL};
    if (count != 3) return BAD_USAGE;
    for (int i = 0; i < 2; i++) {
        const Status status = store_read_results(&results[i], paths[i + 1]);
        if (status == OK) continue;
        printf("%s\n", status_sentence());
        results_free(results[0]);
        return status;
    }
    const int difference = compare(results[0], results[1]);
    results_free(results[0]);
    results_free(results[1]);
    return difference;
}
