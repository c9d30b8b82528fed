// SPDX-License-Identifier: GPL-3.0-or-later
// What every benchmark needs: user CPU seconds of this process, medians, and one line per result,
// for people on stdout and for tools/bench.sh in the file that PERRIN_BENCH_CSV names.
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

static inline double bench_user_seconds(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

// The same without the granularity of a clock's ticks, with what the system does for us.
static inline double bench_cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline int bench_ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Sorts the values. Medians of five and user seconds: what a busy machine disturbs least.
static inline double bench_median(double *values, size_t count) {
    qsort(values, count, sizeof *values, bench_ascending);
    return values[count / 2];
}

// `name` like "edbd 2D 0.79 avx512": without a comma, and the same from version to version.
static inline void bench_result(const char *name, double value, const char *unit) {
    printf("%-48s %12.4g %s\n", name, value, unit);
    fflush(stdout);
    const char *path = getenv("PERRIN_BENCH_CSV");
    FILE *csv = path ? fopen(path, "a") : NULL;
    if (!csv) return;
    fprintf(csv, "%s,%.6g,%s\n", name, value, unit);
    fclose(csv);
}
