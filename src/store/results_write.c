// SPDX-License-Identifier: GPL-3.0-or-later
// results.h5: /stages/STAGE/OBSERVABLE, /stages/STAGE/quantities/NAME, /perrin and /perrin/health,
// built in memory and written whole. docs/file-format.md specifies it.
#include "base/crc32c.h"
#include "base/memory.h"
#include "store/inside.h"
#include "store/image.h"
#include "store/seal.h"

#include <math.h>
#include <string.h>

enum { ATTRIBUTE_MOST = 1024 }; // longer facts (the plan) become datasets; HDF5 stops at 64 kB

static Status write_axis(hid_t group, const ResultAxis *axis) {
    hid_t set;
    if (axis->labels) {
        TRY(image_labels(group, axis->name, axis->labels, axis->count, &set));
    } else {
        const ImageShape shape = {.type = H5T_IEEE_F64LE, .rank = 1, .extent = {axis->count}};
        TRY(image_numbers(group, axis->name, &shape, axis->values, &set));
    }
    const Status status = image_text_attribute(set, "unit", axis->unit);
    image_end(set);
    return status;
}

static Status write_values(hid_t group, const char *name, const ResultSeries *series,
                           const ImageShape *shape, const double *values) {
    hid_t set;
    TRY(image_numbers(group, name, shape, values, &set));
    const Status status = image_text_attribute(set, "unit", series->unit);
    image_end(set);
    return status;
}

// The series' own shape, or with the replicas in front of it.
static ImageShape series_shape(const ResultSeries *series, size_t replicas) {
    ImageShape shape = {.type = H5T_IEEE_F64LE};
    if (replicas > 0) shape.extent[shape.rank++] = replicas;
    for (size_t a = 0; a < series->axes; a++) shape.extent[shape.rank++] = series->axis[a].count;
    return shape;
}

static Status write_estimates(hid_t group, const Results *results, const ResultSeries *series,
                              double *mean, double *error) {
    for (size_t i = 0; i < series->size; i++) {
        const Estimate estimate = results_series_estimate(results, series, i);
        mean[i] = estimate.value;
        error[i] = estimate.error;
    }
    const ImageShape one = series_shape(series, 0);
    TRY(write_values(group, "mean", series, &one, mean));
    TRY(write_values(group, "error", series, &one, error));
    const ImageShape all = series_shape(series, results->replicas);
    return write_values(group, "replicas", series, &all, series->values);
}

bool store_keeps_name(const char *name) {
    return strcmp(name, "mean") == 0 || strcmp(name, "error") == 0 || strcmp(name, "replicas") == 0;
}

static Status write_series_into(hid_t group, const Results *results, const ResultSeries *series) {
    const char *names[RESULT_AXES];
    TRY(image_text_attribute(group, "unit", series->unit));
    TRY(image_text_attribute(group, "description", series->about));
    for (size_t a = 0; a < series->axes; a++) names[a] = series->axis[a].name;
    TRY(image_texts_attribute(group, "axes", names, series->axes));
    for (size_t a = 0; a < series->axes; a++) TRY(write_axis(group, &series->axis[a]));
    double *mean = NULL, *error = NULL;
    Status status = NEW_ARRAY(mean, series->size);
    if (status == OK) status = NEW_ARRAY(error, series->size);
    if (status == OK) status = write_estimates(group, results, series, mean, error);
    memory_free(mean);
    memory_free(error);
    return status;
}

static Status write_series(hid_t stage, const Results *results, const ResultSeries *series) {
    hid_t group;
    TRY(image_group(stage, series->observable, &group));
    const Status status = write_series_into(group, results, series);
    image_end(group);
    return status;
}

static Status write_scalar(hid_t group, const Results *results, const ResultScalar *scalar) {
    const ImageShape shape = {.type = H5T_IEEE_F64LE, .rank = 1, .extent = {results->replicas}};
    const Estimate estimate = results_scalar_estimate(results, scalar);
    const int64_t n = (int64_t)estimate.n;
    hid_t set;
    TRY(image_numbers(group, scalar->quantity, &shape, scalar->values, &set));
    Status status = image_number_attribute(set, "value", estimate.value);
    if (status == OK) status = image_number_attribute(set, "error", estimate.error);
    if (status == OK) status = image_integers_attribute(set, "n", &n, 1);
    if (status == OK) status = image_text_attribute(set, "unit", scalar->unit);
    if (status == OK) status = image_text_attribute(set, "description", scalar->about);
    image_end(set);
    return status;
}

static Status write_quantities(hid_t stage, const Results *results, const char *name) {
    hid_t group;
    TRY(image_group(stage, "quantities", &group));
    Status status = OK;
    for (size_t i = 0; status == OK && i < results->scalar_count; i++) {
        if (strcmp(results->scalars[i].stage, name) != 0) continue;
        status = write_scalar(group, results, &results->scalars[i]);
    }
    image_end(group);
    return status;
}

static Status write_stage(hid_t stages, const Results *results, const char *name) {
    hid_t stage;
    TRY(image_group(stages, name, &stage));
    Status status = write_quantities(stage, results, name);
    for (size_t i = 0; status == OK && i < results->series_count; i++) {
        if (strcmp(results->series[i].stage, name) != 0) continue;
        status = write_series(stage, results, &results->series[i]);
    }
    image_end(stage);
    return status;
}

static Status write_new_stage(hid_t stages, const Results *results, const char *name) {
    if (H5Lexists(stages, name, H5P_DEFAULT) > 0) return OK;
    return write_stage(stages, results, name);
}

static Status write_stages(hid_t file, const Results *results) {
    hid_t stages;
    TRY(image_group(file, "stages", &stages));
    Status status = OK;
    for (size_t i = 0; status == OK && i < results->series_count; i++) {
        status = write_new_stage(stages, results, results->series[i].stage);
    }
    for (size_t i = 0; status == OK && i < results->scalar_count; i++) {
        status = write_new_stage(stages, results, results->scalars[i].stage);
    }
    image_end(stages);
    return status;
}

static Status write_counter(hid_t health, const ResultCounter *counter) {
    const ImageShape number = {.type = H5T_IEEE_F64LE, .rank = 0};
    hid_t set;
    TRY(image_numbers(health, counter->name, &number, &counter->value, &set));
    Status status = image_number_attribute(set, "limit", counter->limit);
    if (status == OK) status = image_text_attribute(set, "description", counter->about);
    image_end(set);
    return status;
}

static Status write_health(hid_t provenance, const Results *results) {
    hid_t health;
    TRY(image_group(provenance, "health", &health));
    Status status = OK;
    for (size_t i = 0; status == OK && i < results->health_count; i++) {
        status = write_counter(health, &results->health[i]);
    }
    image_end(health);
    return status;
}

static Status write_provenance(hid_t group, const Results *results) {
    for (size_t i = 0; i < results->fact_count; i++) {
        const ResultFact *fact = &results->facts[i];
        if (strlen(fact->text) > ATTRIBUTE_MOST || strcmp(fact->name, "plan") == 0) {
            TRY(image_text(group, fact->name, fact->text));
        } else {
            TRY(image_text_attribute(group, fact->name, fact->text));
        }
    }
    return write_health(group, results);
}

static Status write_contents(hid_t file, const Results *results) {
    const int64_t version = SEAL_VERSION, replicas = (int64_t)results->replicas;
    hid_t group;
    TRY(image_integers_attribute(file, "format_version", &version, 1));
    TRY(image_integers_attribute(file, "replicas", &replicas, 1));
    TRY(write_stages(file, results));
    TRY(image_group(file, "perrin", &group));
    const Status status = write_provenance(group, results);
    image_end(group);
    return status;
}

static Status build(Image *image, const Results *results) {
    TRY(image_create(image));
    TRY(write_contents(image->file, results));
    TRY(image_close(image));
    Seal seal = seal_new(SEAL_RESULTS, image->end + sizeof seal);
    TRY(image_complete(image, sizeof seal));
    seal.contents_crc = crc32c(0, image->bytes, image->end);
    seal_finish(&seal);
    memcpy(image->bytes + image->end, &seal, sizeof seal);
    return OK;
}

Status store_write_results(Store *store, const Results *results) {
    Image image;
    store_take_hdf5();
    Status status = build(&image, results);
    store_give_hdf5();
    if (status == OK) {
        status = disk_replace(&store->folder, "results.h5", image.bytes, image.size);
    }
    image_free(&image);
    return status;
}
