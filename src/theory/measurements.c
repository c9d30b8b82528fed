// SPDX-License-Identifier: GPL-3.0-or-later
// Structure factors from results.h5 files.
#include "theory/measurements.h"

#include "base/crc32c.h"
#include "base/memory.h"
#include "base/number.h"
#include "store/store.h"

#include <dirent.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH = 1024, RUNS_MOST = 32 };
static const double COMPOSITION = 1e-2; // how far diameters and fractions may be off
static const char OBSERVABLE[] = "structure_factor", MIXTURE_FACT[] = "mixture";

typedef struct MeasuredRun {
    double packing_fraction;
    size_t replicas, count;
    double *wave_number, *factor; // [count], [replicas][pair][count]
} MeasuredRun;

struct Measurements {
    Mixture mixture;
    size_t count;
    MeasuredRun runs[RUNS_MOST];
};

// ---- One file ----------------------------------------------------------------------------------

// "dimension=2 packing_fraction=0.7 diameters=1,1.4 fractions=0.5,0.5", as provenance writes it.
static bool read_list(const char *text, const char *key, double *values, size_t most,
                      size_t *count) {
    const char *at = strstr(text, key);
    *count = 0;
    if (!at) return false;
    for (at += strlen(key); *count < most; at++) {
        char number[NUMBER_SIZE];
        const size_t length = strcspn(at, ", ");
        if (length >= sizeof number) return false;
        snprintf(number, sizeof number, "%.*s", (int)length, at);
        if (!number_read(number, &values[(*count)++])) return false;
        at += length;
        if (*at != ',') return true;
    }
    return false;
}

static Status read_mixture(const Results *results, const char *path, Mixture *mixture,
                           double *packing_fraction) {
    const char *text = results_find_fact(results, MIXTURE_FACT);
    double dimension = 0;
    size_t one, fractions;
    *mixture = (Mixture){0};
    if (text && read_list(text, "dimension=", &dimension, 1, &one) &&
        read_list(text, "packing_fraction=", packing_fraction, 1, &one) &&
        read_list(text, "diameters=", mixture->diameter, MIXTURE_SPECIES_MOST, &mixture->species) &&
        read_list(text, "fractions=", mixture->fraction, MIXTURE_SPECIES_MOST, &fractions) &&
        fractions == mixture->species) {
        mixture->dimension = (int)dimension;
        return mixture_check(mixture);
    }
    return status_fail(BAD_DATA,
                       "%s does not say of which mixture of hard discs or spheres it is: soft or "
                       "long particles, sizes that are spread, or an earlier version of perrin",
                       path);
}

// Of pairs of species against the wave number, not over what is swept.
static bool is_plain(const ResultSeries *series) {
    return strcmp(series->observable, OBSERVABLE) == 0 && series->axes == 2 &&
           strcmp(series->axis[0].name, "pair") == 0 && series->axis[1].values;
}

static const ResultSeries *find_series(const Results *results, const char *stage, size_t *found) {
    const ResultSeries *series = NULL;
    *found = 0;
    for (size_t i = 0; i < results->series_count; i++) {
        if (!is_plain(&results->series[i])) continue;
        if (stage[0] && strcmp(results->series[i].stage, stage) != 0) continue;
        series = &results->series[i];
        ++*found;
    }
    return series;
}

// The rows of the series are those of the pairs, then the total.
static Status copy_series(MeasuredRun *run, const ResultSeries *series, size_t replicas,
                          size_t pairs) {
    run->count = series->axis[1].count;
    run->replicas = replicas;
    TRY(NEW_ARRAY(run->wave_number, run->count));
    TRY(NEW_ARRAY(run->factor, replicas * pairs * run->count));
    memcpy(run->wave_number, series->axis[1].values, run->count * sizeof(double));
    for (size_t r = 0; r < replicas; r++)
        memcpy(run->factor + r * pairs * run->count, series->values + r * series->size,
               pairs * run->count * sizeof(double));
    for (size_t i = 0; i < replicas * pairs * run->count; i++) {
        if (!isfinite(run->factor[i]))
            return status_fail(BAD_DATA, "a structure factor is not a finite number");
    }
    return OK;
}

static bool alike(const Mixture *a, const Mixture *b, double tolerance) {
    bool same = a->dimension == b->dimension && a->species == b->species;
    for (size_t s = 0; s < b->species && same; s++)
        same = fabs(a->diameter[s] - b->diameter[s]) <= tolerance * b->diameter[s] &&
               fabs(a->fraction[s] - b->fraction[s]) <= tolerance;
    return same;
}

static Status take_results(Measurements *m, const Results *results, const char *path,
                           const char *stage) {
    Mixture mixture;
    size_t found;
    const ResultSeries *series = find_series(results, stage, &found);
    if (found > 1)
        return status_fail(BAD_DATA, "%s has %s in %zu stages; structure.stage says which", path,
                           OBSERVABLE, found);
    if (m->count == RUNS_MOST)
        return status_fail(BAD_DATA, "more than %d results.h5 with %s", RUNS_MOST, OBSERVABLE);
    MeasuredRun *run = &m->runs[m->count];
    TRY(read_mixture(results, path, &mixture, &run->packing_fraction));
    if (m->count > 0 && !alike(&mixture, &m->mixture, 0))
        return status_fail(BAD_DATA, "%s is of another mixture than those before it", path);
    m->mixture = mixture;
    if (series->axis[0].count != mixture_pairs(&mixture) + 1)
        return status_fail(BAD_DATA, "%s: %s has not all pairs of species", path, OBSERVABLE);
    m->count++;
    return copy_series(run, series, results->replicas, mixture_pairs(&mixture));
}

// A file without the observable is left alone.
static Status take_file(Measurements *m, const char *path, const char *stage) {
    Results *results = NULL;
    size_t found;
    TRY(store_read_results(&results, path));
    Status status = OK;
    if (find_series(results, stage, &found)) status = take_results(m, results, path, stage);
    results_free(results);
    return status;
}

// ---- Folders -----------------------------------------------------------------------------------

static Status join(char path[PATH], const char *folder, const char *name, const char *file) {
    const int length = snprintf(path, PATH, "%s/%s%s%s", folder, name, file[0] ? "/" : "", file);
    if (length > 0 && length < PATH) return OK;
    return status_fail(BAD_DATA, "the path %s/%s is too long", folder, name);
}

static bool is_there(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}

static Status take_folders(Measurements *m, const char *path, const char *stage) {
    struct dirent **entries = NULL;
    const int count = scandir(path, &entries, NULL, alphasort);
    Status status = OK;
    if (count < 0) return status_fail_errno(BAD_DATA, "cannot read the folder %s", path);
    for (int i = 0; i < count; i++) {
        char file[PATH];
        if (status == OK && entries[i]->d_name[0] != '.')
            status = join(file, path, entries[i]->d_name, "results.h5");
        if (status == OK && entries[i]->d_name[0] != '.' && is_there(file))
            status = take_file(m, file, stage);
        free(entries[i]);
    }
    free(entries);
    return status;
}

// What a sweep has in its own results.h5 stands over what is swept: then the points are looked at.
static Status take_path(Measurements *m, const char *path, const char *stage) {
    struct stat kind;
    char file[PATH];
    if (stat(path, &kind) != 0) return status_fail_errno(BAD_DATA, "cannot find %s", path);
    if (!S_ISDIR(kind.st_mode)) return take_file(m, path, stage);
    TRY(join(file, path, "results.h5", ""));
    if (is_there(file)) TRY(take_file(m, file, stage));
    return m->count > 0 ? OK : take_folders(m, path, stage);
}

static int by_packing_fraction(const void *a, const void *b) {
    const double one = ((const MeasuredRun *)a)->packing_fraction;
    const double other = ((const MeasuredRun *)b)->packing_fraction;
    return (one > other) - (one < other);
}

static Status check(const Measurements *m, const MeasurementsInput *input) {
    if (m->count == 0)
        return status_fail(BAD_DATA, "there is no %s%s%s in %s", OBSERVABLE,
                           input->stage[0] ? " of a stage " : "", input->stage, input->path);
    if (!alike(&m->mixture, &input->mixture, COMPOSITION))
        return status_fail(BAD_DATA,
                           "structure.file = %s: the species there are not those here: the "
                           "dimension, their order, diameters and fractions must be the same",
                           input->path);
    if (input->transition && m->count < 2)
        return status_fail(BAD_DATA,
                           "structure.file = %s: the glass transition is looked for between "
                           "packing fractions; structure factors of two at least are needed",
                           input->path);
    return OK;
}

Status measurements_read(Measurements **out, const MeasurementsInput *input) {
    Measurements *m = NULL;
    *out = NULL;
    TRY(NEW(m));
    Status status = take_path(m, input->path, input->stage);
    if (status == OK) status = check(m, input);
    if (status != OK) {
        measurements_free(m);
        return status;
    }
    qsort(m->runs, m->count, sizeof *m->runs, by_packing_fraction);
    *out = m;
    return OK;
}

Status measurements_check(const MeasurementsInput *input, uint32_t *checksum) {
    Measurements *m = NULL;
    const Status status = measurements_read(&m, input);
    if (status == OK) *checksum = measurements_checksum(m);
    measurements_free(m);
    return status;
}

void measurements_free(Measurements *m) {
    for (size_t i = 0; m && i < RUNS_MOST; i++) {
        memory_free(m->runs[i].wave_number);
        memory_free(m->runs[i].factor);
    }
    memory_free(m);
}

const Mixture *measurements_mixture(const Measurements *m) {
    return &m->mixture;
}

size_t measurements_replicas(const Measurements *m) {
    size_t least = SIZE_MAX;
    for (size_t i = 0; i < m->count; i++) {
        if (m->runs[i].replicas < least) least = m->runs[i].replicas;
    }
    return least;
}

static uint32_t sum_numbers(uint32_t before, const double *values, size_t count) {
    return crc32c(before, values, count * sizeof *values);
}

uint32_t measurements_checksum(const Measurements *m) {
    const Mixture *mixture = &m->mixture;
    const double dimension = mixture->dimension;
    uint32_t sum = sum_numbers(0, &dimension, 1);
    sum = sum_numbers(sum, mixture->diameter, mixture->species);
    sum = sum_numbers(sum, mixture->fraction, mixture->species);
    for (size_t i = 0; i < m->count; i++) {
        const MeasuredRun *run = &m->runs[i];
        sum = sum_numbers(sum, &run->packing_fraction, 1);
        sum = sum_numbers(sum, run->wave_number, run->count);
        sum = sum_numbers(sum, run->factor, run->replicas * mixture_pairs(mixture) * run->count);
    }
    return sum;
}

Status measurements_fit(Measured **out, const Measurements *m, size_t groups, size_t omitted) {
    TRY(measured_create(out, &m->mixture));
    Status status = OK;
    for (size_t i = 0; i < m->count && status == OK; i++) {
        const MeasuredRun *run = &m->runs[i];
        status = measured_add(*out,
                              &(MeasuredState){.packing_fraction = run->packing_fraction,
                                               .replicas = run->replicas,
                                               .count = run->count,
                                               .wave_number = run->wave_number,
                                               .factor = run->factor},
                              groups, omitted);
    }
    if (status == OK) return OK;
    measured_free(*out);
    *out = NULL;
    return status;
}
