// SPDX-License-Identifier: GPL-3.0-or-later
// Results as bytes, for the pipe from the process that reads a file to the one that asked.
#include "results/results.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

// A count of things that take at least `least` bytes each: one that cannot be there is refused
// before any memory is asked for.
static size_t count_archive(Archive *archive, size_t count, size_t least) {
    uint64_t stored = count;
    archive_u64(archive, &stored, 1);
    if (archive_status(archive, false) != OK) return 0;
    if (!archive->loading) return count;
    const size_t left = archive->size - archive->position;
    archive_require(archive, stored <= left / least, "it counts more things than it holds");
    return archive_status(archive, false) == OK ? (size_t)stored : 0;
}

static void text_archive(Archive *archive, char **text) {
    const size_t length = count_archive(archive, archive->loading ? 0 : strlen(*text), 1);
    if (archive->loading) *text = calloc(length + 1, 1);
    archive_require(archive, *text != NULL, "out of memory");
    if (*text) archive_bytes(archive, *text, length);
}

// A text of fixed room, ended by '\0' whatever the bytes say.
static void field_archive(Archive *archive, char *field, size_t size) {
    archive_bytes(archive, field, size);
    archive_require(archive, field[size - 1] == '\0', "a name in it does not end");
    if (archive->loading) field[size - 1] = '\0';
}

static void doubles_archive(Archive *archive, double **values, size_t count) {
    if (archive->loading) {
        const size_t left = archive->size - archive->position;
        archive_require(archive, count <= left / sizeof **values, "it ends too early");
        if (archive_status(archive, false) != OK) return;
        *values = memory_new(count, sizeof **values);
        archive_require(archive, *values != NULL, "out of memory");
    }
    if (*values) archive_f64(archive, *values, count);
}

static void labels_archive(Archive *archive, ResultAxis *axis) {
    char **labels = (char **)axis->labels;
    if (archive->loading) {
        labels = memory_new(axis->count, sizeof *labels);
        axis->labels = (const char *const *)labels;
        archive_require(archive, labels != NULL, "out of memory");
    }
    for (size_t i = 0; labels && i < axis->count; i++) text_archive(archive, &labels[i]);
}

static void axis_archive(Archive *archive, ResultAxis *axis) {
    int32_t labelled = axis->labels != NULL;
    archive_i32(archive, &labelled, 1);
    text_archive(archive, (char **)&axis->name);
    text_archive(archive, (char **)&axis->unit);
    axis->count = count_archive(archive, axis->count, 8);
    if (labelled)
        labels_archive(archive, axis);
    else
        doubles_archive(archive, (double **)&axis->values, axis->count);
}

static void series_archive(Archive *archive, ResultSeries *series, size_t replicas) {
    field_archive(archive, series->stage, sizeof series->stage);
    field_archive(archive, series->observable, sizeof series->observable);
    field_archive(archive, series->unit, sizeof series->unit);
    field_archive(archive, series->about, sizeof series->about);
    const size_t axes = count_archive(archive, series->axes, 1);
    archive_require(archive, axes <= RESULT_AXES, "a series has too many axes");
    if (archive_status(archive, false) != OK) return;
    size_t size = 1;
    bool fits = true;
    for (size_t a = 0; a < axes; a++) {
        series->axes = a + 1;
        axis_archive(archive, &series->axis[a]);
        fits = fits && !__builtin_mul_overflow(size, series->axis[a].count, &size);
    }
    series->size = size;
    fits = fits && !__builtin_mul_overflow(size, replicas, &size);
    archive_require(archive, fits, "a series is too long");
    if (archive_status(archive, false) == OK) doubles_archive(archive, &series->values, size);
}

static void scalar_archive(Archive *archive, ResultScalar *scalar, size_t replicas) {
    field_archive(archive, scalar->stage, sizeof scalar->stage);
    field_archive(archive, scalar->quantity, sizeof scalar->quantity);
    field_archive(archive, scalar->unit, sizeof scalar->unit);
    field_archive(archive, scalar->about, sizeof scalar->about);
    doubles_archive(archive, &scalar->values, replicas);
}

static void counter_archive(Archive *archive, ResultCounter *counter) {
    field_archive(archive, counter->name, sizeof counter->name);
    field_archive(archive, counter->about, sizeof counter->about);
    archive_f64(archive, &counter->value, 1);
    archive_f64(archive, &counter->limit, 1);
}

// The length of one of the arrays, with zeroed room for it when loading.
static void array_archive(Archive *archive, void **array, size_t *count, size_t size) {
    *count = count_archive(archive, *count, RESULT_NAME);
    if (!archive->loading) return;
    *array = calloc(*count + 1, size);
    archive_require(archive, *array != NULL, "out of memory");
    if (!*array) *count = 0;
}

#define ARRAY_ARCHIVE(archive, array, count)                                                       \
    array_archive((archive), (void **)&(array), &(count), sizeof *(array))

void results_archive(Results *results, Archive *archive) {
    enum { TAG = 0x53544c5553455201 };
    archive_tag(archive, TAG);
    results->replicas = count_archive(archive, results->replicas, 1);
    ARRAY_ARCHIVE(archive, results->series, results->series_count);
    for (size_t i = 0; i < results->series_count; i++) {
        series_archive(archive, &results->series[i], results->replicas);
    }
    ARRAY_ARCHIVE(archive, results->scalars, results->scalar_count);
    for (size_t i = 0; i < results->scalar_count; i++) {
        scalar_archive(archive, &results->scalars[i], results->replicas);
    }
    ARRAY_ARCHIVE(archive, results->facts, results->fact_count);
    for (size_t i = 0; i < results->fact_count; i++) {
        field_archive(archive, results->facts[i].name, sizeof results->facts[i].name);
        text_archive(archive, &results->facts[i].text);
    }
    ARRAY_ARCHIVE(archive, results->health, results->health_count);
    for (size_t i = 0; i < results->health_count; i++) {
        counter_archive(archive, &results->health[i]);
    }
}
