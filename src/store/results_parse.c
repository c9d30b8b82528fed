// SPDX-License-Identifier: GPL-3.0-or-later
// From the HDF5 of a results.h5 to Results, believing nothing: hard links, contiguous datasets
// inside the file and without filters only, sizes checked before memory is asked for.
#include "store/results_parse.h"

#include "base/memory.h"

#include <hdf5.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Status strange(const char *name) {
    return status_fail(BAD_DATA, "'%s' in it is not what perrin writes", name);
}

// Every dataset of ours is contiguous, in the file itself and unfiltered.
static bool plain_storage(hid_t set) {
    const hid_t creation = H5Dget_create_plist(set);
    const bool plain = H5Pget_layout(creation) == H5D_CONTIGUOUS &&
                       H5Pget_external_count(creation) == 0 && H5Pget_nfilters(creation) == 0;
    H5Pclose(creation);
    return plain;
}

// Opens a dataset that a hard link leads to; H5I_INVALID_HID if it is none.
static hid_t open_set(hid_t group, const char *name) {
    H5L_info_t link;
    if (H5Lget_info(group, name, &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) {
        return H5I_INVALID_HID;
    }
    const hid_t set = H5Dopen2(group, name, H5P_DEFAULT);
    if (set < 0 || plain_storage(set)) return set;
    H5Dclose(set);
    return H5I_INVALID_HID;
}

static size_t set_size(hid_t set) {
    const hid_t space = H5Dget_space(set);
    const hssize_t size = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
    return size < 0 ? SIZE_MAX : (size_t)size;
}

// All numbers of a dataset, to be freed with memory_free. A dataset that claims to be larger than
// what it has in the file is refused before memory is asked for.
static Status read_doubles(hid_t group, const char *name, size_t *count, double **values) {
    *values = NULL;
    const hid_t set = open_set(group, name);
    if (set < 0) return strange(name);
    *count = set_size(set);
    Status status = OK;
    if (*count > H5Dget_storage_size(set) / sizeof **values) status = strange(name);
    if (status == OK) status = NEW_ARRAY(*values, *count);
    if (status == OK && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, *values) < 0)
        status = strange(name);
    H5Dclose(set);
    return status;
}

// A text in an attribute or (`set`) in a dataset of one text, yours to free().
static Status read_text(hid_t object, const char *name, bool set, char **text) {
    char *found = NULL;
    const hid_t source = set ? open_set(object, name) : H5Aopen(object, name, H5P_DEFAULT);
    if (source < 0) return strange(name);
    const hid_t type = set ? H5Dget_type(source) : H5Aget_type(source);
    const hid_t space = set ? H5Dget_space(source) : H5Aget_space(source);
    herr_t result = -1;
    if (H5Tis_variable_str(type) > 0 && H5Sget_simple_extent_npoints(space) == 1) {
        result = set ? H5Dread(source, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &found)
                     : H5Aread(source, type, &found);
    }
    H5Sclose(space);
    H5Tclose(type);
    if (set)
        H5Dclose(source);
    else
        H5Aclose(source);
    if (result < 0) return strange(name);
    *text = found ? found : calloc(1, 1);
    return *text ? OK : status_fail(NO_MEMORY, "out of memory: '%s'", name);
}

static Status read_field(hid_t object, const char *name, char *field, size_t size) {
    char *text = NULL;
    TRY(read_text(object, name, false, &text));
    const size_t length = strlen(text);
    if (length < size) memcpy(field, text, length + 1);
    free(text);
    return length < size ? OK : strange(name);
}

// One number in an attribute, as `type` in memory.
static Status read_number(hid_t object, const char *name, hid_t type, void *value) {
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    if (attribute < 0) return strange(name);
    const hid_t space = H5Aget_space(attribute);
    herr_t result = -1;
    if (H5Sget_simple_extent_npoints(space) == 1) {
        result = H5Aread(attribute, type, value);
    }
    H5Sclose(space);
    H5Aclose(attribute);
    return result < 0 ? strange(name) : OK;
}

// The labels of an axis: fixed-length texts, cut out of one table.
static Status read_labels(hid_t set, ResultAxis *axis) {
    const hid_t type = H5Dget_type(set);
    const size_t width = H5Tget_size(type), count = set_size(set);
    const bool variable = H5Tis_variable_str(type) != 0;
    if (variable || width == 0 || count > H5Dget_storage_size(set) / width) {
        H5Tclose(type);
        return strange(axis->name);
    }
    char *table = memory_new(count, width);
    char **labels = memory_new(count, sizeof *labels);
    const bool read =
        table && labels && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, table) >= 0;
    H5Tclose(type);
    axis->labels = (const char *const *)labels;
    for (size_t i = 0; read && i < count; i++) {
        labels[i] = strndup(table + i * width, width);
        if (labels[i]) axis->count++;
    }
    memory_free(table);
    return axis->count == count && labels ? OK : strange(axis->name);
}

static Status read_axis(hid_t group, ResultAxis *axis) {
    const hid_t set = open_set(group, axis->name);
    if (set < 0) return strange(axis->name);
    Status status = read_text(set, "unit", false, (char **)&axis->unit);
    const hid_t type = H5Dget_type(set);
    const bool labelled = H5Tget_class(type) == H5T_STRING;
    H5Tclose(type);
    if (status == OK && labelled) status = read_labels(set, axis);
    H5Dclose(set);
    if (status != OK || labelled) return status;
    return read_doubles(group, axis->name, &axis->count, (double **)&axis->values);
}

static Status read_axis_names(hid_t group, ResultSeries *series) {
    char *names[RESULT_AXES] = {NULL};
    const hid_t attribute = H5Aopen(group, "axes", H5P_DEFAULT);
    if (attribute < 0) return strange("axes");
    const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    herr_t result = -1;
    if (H5Tis_variable_str(type) > 0 && count >= 0 && count <= RESULT_AXES) {
        result = H5Aread(attribute, type, names);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(attribute);
    if (result < 0) return strange("axes");
    series->axes = (size_t)count;
    Status status = OK;
    for (size_t a = 0; a < series->axes; a++) {
        series->axis[a].name = names[a];
        if (!names[a]) status = strange("axes");
    }
    return status;
}

static void free_axes(ResultSeries *series) {
    for (size_t a = 0; a < series->axes; a++) {
        ResultAxis *axis = &series->axis[a];
        for (size_t i = 0; axis->labels && i < axis->count; i++) free((char *)axis->labels[i]);
        memory_free((void *)axis->labels);
        memory_free((double *)axis->values);
        free((char *)axis->name);
        free((char *)axis->unit);
    }
}

static Status put_replicas(Results *results, hid_t group, const ResultSeries *series) {
    size_t size = 1, count;
    for (size_t a = 0; a < series->axes; a++) {
        if (__builtin_mul_overflow(size, series->axis[a].count, &size)) return strange("axes");
    }
    double *values = NULL;
    Status status = read_doubles(group, "replicas", &count, &values);
    size_t wanted;
    if (status == OK &&
        (__builtin_mul_overflow(size, results->replicas, &wanted) || wanted != count)) {
        status = strange("replicas");
    }
    for (size_t r = 0; status == OK && r < results->replicas; r++) {
        status = results_put_series(results, series, r, values + r * size);
    }
    memory_free(values);
    return status;
}

static Status read_series(Results *results, hid_t group, const char *stage, const char *name) {
    ResultSeries series = {.axes = 0};
    snprintf(series.stage, sizeof series.stage, "%s", stage);
    snprintf(series.observable, sizeof series.observable, "%s", name);
    TRY(read_field(group, "unit", series.unit, sizeof series.unit));
    TRY(read_field(group, "description", series.about, sizeof series.about));
    Status status = read_axis_names(group, &series);
    for (size_t a = 0; status == OK && a < series.axes; a++) {
        status = read_axis(group, &series.axis[a]);
    }
    if (status == OK) status = put_replicas(results, group, &series);
    free_axes(&series);
    return status;
}

static Status read_scalar(Results *results, hid_t group, const char *stage, const char *name) {
    char unit[RESULT_NAME], about[RESULT_TEXT];
    const hid_t set = open_set(group, name);
    if (set < 0) return strange(name);
    Status status = read_field(set, "unit", unit, sizeof unit);
    if (status == OK) status = read_field(set, "description", about, sizeof about);
    H5Dclose(set);
    TRY(status);
    size_t count;
    double *values = NULL;
    status = read_doubles(group, name, &count, &values);
    if (status == OK && count != results->replicas) status = strange(name);
    for (size_t r = 0; status == OK && r < count; r++) {
        status = results_put_scalar(results, stage, name, unit, about, r, values[r]);
    }
    memory_free(values);
    return status;
}

// The name of the link at `index`, in the order in which they were made; false if there is none.
static bool link_name(hid_t group, hsize_t index, char name[RESULT_NAME]) {
    const ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, index,
                                              name, RESULT_NAME, H5P_DEFAULT);
    return length > 0 && length < RESULT_NAME;
}

static hsize_t link_count(hid_t group) {
    H5G_info_t info;
    return H5Gget_info(group, &info) < 0 ? 0 : info.nlinks;
}

// Opens a group that a hard link leads to.
static Status open_group(hid_t parent, const char *name, hid_t *group) {
    H5L_info_t link;
    const bool hard =
        H5Lget_info(parent, name, &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
    *group = hard ? H5Gopen2(parent, name, H5P_DEFAULT) : H5I_INVALID_HID;
    return *group < 0 ? strange(name) : OK;
}

static Status read_quantities(Results *results, hid_t group, const char *stage) {
    const hsize_t count = link_count(group);
    for (hsize_t i = 0; i < count; i++) {
        char name[RESULT_NAME];
        if (!link_name(group, i, name)) return strange("quantities");
        TRY(read_scalar(results, group, stage, name));
    }
    return OK;
}

static Status read_stage(Results *results, hid_t group, const char *stage) {
    const hsize_t count = link_count(group);
    for (hsize_t i = 0; i < count; i++) {
        char name[RESULT_NAME];
        hid_t member;
        if (!link_name(group, i, name)) return strange(stage);
        TRY(open_group(group, name, &member));
        const bool scalars = strcmp(name, "quantities") == 0;
        const Status status = scalars ? read_quantities(results, member, stage)
                                      : read_series(results, member, stage, name);
        H5Gclose(member);
        TRY(status);
    }
    return OK;
}

static Status read_stages(Results *results, hid_t stages) {
    const hsize_t count = link_count(stages);
    for (hsize_t i = 0; i < count; i++) {
        char name[RESULT_NAME];
        hid_t stage;
        if (!link_name(stages, i, name)) return strange("stages");
        TRY(open_group(stages, name, &stage));
        const Status status = read_stage(results, stage, name);
        H5Gclose(stage);
        TRY(status);
    }
    return OK;
}

static Status read_counter(Results *results, hid_t health, const char *name) {
    char about[RESULT_TEXT];
    double value = 0, bound = 0;
    const hid_t set = open_set(health, name);
    if (set < 0) return strange(name);
    Status status = read_field(set, "description", about, sizeof about);
    if (status == OK) status = read_number(set, "limit", H5T_NATIVE_DOUBLE, &bound);
    if (set_size(set) != 1 ||
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) < 0) {
        status = strange(name);
    }
    H5Dclose(set);
    return status == OK ? results_put_health(results, name, about, bound, value) : status;
}

static Status read_health(Results *results, hid_t health) {
    const hsize_t count = link_count(health);
    for (hsize_t i = 0; i < count; i++) {
        char name[RESULT_NAME];
        if (!link_name(health, i, name)) return strange("health");
        TRY(read_counter(results, health, name));
    }
    return OK;
}

static Status put_fact(Results *results, hid_t group, const char *name, bool set) {
    char *text = NULL;
    TRY(read_text(group, name, set, &text));
    const Status status = results_put_fact(results, name, text);
    free(text);
    return status;
}

// The short facts: attributes in the order in which they were made.
static Status read_short_facts(Results *results, hid_t group) {
    H5O_info_t info;
    if (H5Oget_info2(group, &info, H5O_INFO_NUM_ATTRS) < 0) return strange("perrin");
    for (hsize_t i = 0; i < info.num_attrs; i++) {
        char name[RESULT_NAME];
        const ssize_t length = H5Aget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i,
                                                  name, sizeof name, H5P_DEFAULT);
        if (length <= 0 || length >= RESULT_NAME) return strange("perrin");
        TRY(put_fact(results, group, name, false));
    }
    return OK;
}

static Status read_long_facts(Results *results, hid_t group) {
    const hsize_t count = link_count(group);
    for (hsize_t i = 0; i < count; i++) {
        char name[RESULT_NAME];
        if (!link_name(group, i, name)) return strange("perrin");
        if (strcmp(name, "health") == 0) continue;
        TRY(put_fact(results, group, name, true));
    }
    return OK;
}

static Status read_provenance(Results *results, hid_t group) {
    TRY(read_short_facts(results, group));
    TRY(read_long_facts(results, group));
    hid_t health;
    TRY(open_group(group, "health", &health));
    const Status status = read_health(results, health);
    H5Gclose(health);
    return status;
}

static Status read_contents(Results **results, hid_t file) {
    int64_t replicas;
    TRY(read_number(file, "replicas", H5T_NATIVE_INT64, &replicas));
    if (replicas < 0) return strange("replicas");
    TRY(results_create(results, (size_t)replicas));
    hid_t group;
    TRY(open_group(file, "perrin", &group));
    Status status = read_provenance(*results, group);
    H5Gclose(group);
    TRY(status);
    TRY(open_group(file, "stages", &group));
    status = read_stages(*results, group);
    H5Gclose(group);
    return status;
}

// Opens the bytes, not the path: what was checked is what is read.
Status store_parse_results(Results **results, void *bytes, size_t size) {
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    hid_t file = H5I_INVALID_HID;
    if (H5PLset_loading_state(0) >= 0 && H5Pset_fapl_core(access, 1 << 16, 0) >= 0 &&
        H5Pset_file_image(access, bytes, size) >= 0)
        file = H5Fopen("perrin in memory", H5F_ACC_RDONLY, access);
    H5Pclose(access);
    if (file < 0) return status_fail(BAD_DATA, "HDF5 cannot open it");
    const Status status = read_contents(results, file);
    H5Fclose(file);
    return status;
}
