// SPDX-License-Identifier: GPL-3.0-or-later
// series RESULTS.h5 NAME AXES: reads a series by the library; it has as many axes, all of them
// whole, and nothing is written behind the perrin_series.
#include <perrin/perrin.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(const char *sentence) {
    fprintf(stderr, "series: %s\n", sentence);
    return 1;
}

static int check_axes(const perrin_series *series) {
    size_t size = 1;
    for (size_t a = 0; a < series->axes; a++) {
        size *= series->count[a];
        if (!series->axis_values[a] == !series->axis_labels[a])
            return fail("an axis has either numbers or labels");
        if (strlen(series->axis_name[a]) == 0 || !series->axis_unit[a])
            return fail("an axis has a name and a unit");
    }
    if (size != series->size) return fail("the size is the product of the counts");
    return strcmp(series->axis_name[series->axes - 1], "time") ? fail("time comes last") : 0;
}

static int check_values(const perrin_results *results, const char *name, size_t size) {
    double *mean = malloc(size * sizeof *mean);
    if (!mean) return fail("out of memory");
    int failed = perrin_results_values(results, name, mean, NULL) != PERRIN_OK;
    size_t numbers = 0;
    for (size_t i = 0; !failed && i < size; i++) numbers += isfinite(mean[i]) != 0;
    free(mean);
    return failed || numbers == 0 ? fail("it has values") : 0;
}

int main(int argc, char **argv) {
    perrin_results *results = NULL;
    struct {
        perrin_series series;
        unsigned char behind[256];
    } room;
    memset(&room, 0x5a, sizeof room);
    if (argc != 4 || perrin_results_read(&results, argv[1]) != PERRIN_OK)
        return fail(argc != 4 ? "usage: series RESULTS.h5 NAME AXES" : perrin_error());
    if (perrin_results_series(results, argv[2], &room.series) != PERRIN_OK)
        return fail(perrin_error());
    for (size_t i = 0; i < sizeof room.behind; i++) {
        if (room.behind[i] != 0x5a) return fail("something is written behind the series");
    }
    if (room.series.axes != (size_t)atoi(argv[3])) return fail("it has other axes");
    const int failed = check_axes(&room.series) || check_values(results, argv[2], room.series.size);
    perrin_results_free(results);
    return failed;
}
