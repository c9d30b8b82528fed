// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5's core driver without a file behind it. The driver grows its buffer only as far as
// something is written, and at closing hands the buffer back through the callbacks set here.
#include "store/image.h"

#include <stdlib.h>
#include <string.h>

// All small pieces of HDF5's own lie in one block at the beginning, before the reserved room.
static const hsize_t METADATA_BLOCK = 1 << 16;
static const size_t BUFFER_STEP = 1 << 16;
// Groups keep the order in which things were made: it is the order of the run file.
static const unsigned IN_ORDER = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

static Status failed(const char *what, const char *name) {
    return status_fail(NO_MEMORY, "cannot build an HDF5 file in memory: %s '%s' failed", what,
                       name);
}

static Status done(herr_t result, const char *what, const char *name) {
    return result < 0 ? failed(what, name) : OK;
}

static void *take_buffer(size_t size, H5FD_file_image_op_t op, void *image) {
    (void)op, (void)image;
    return malloc(size);
}

static void *copy_buffer(void *to, const void *from, size_t size, H5FD_file_image_op_t op,
                         void *image) {
    (void)op, (void)image;
    return memcpy(to, from, size);
}

static void *resize_buffer(void *buffer, size_t size, H5FD_file_image_op_t op, void *data) {
    (void)op;
    void *longer = realloc(buffer, size);
    if (longer) ((Image *)data)->size = size;
    return longer;
}

static herr_t keep_buffer(void *buffer, H5FD_file_image_op_t op, void *data) {
    if (op == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
        ((Image *)data)->bytes = buffer;
    else
        free(buffer);
    return 0;
}

static void *share(void *image) {
    return image;
}
static herr_t unshare(void *image) {
    (void)image;
    return 0;
}

static hid_t memory_access(Image *image) {
    H5FD_file_image_callbacks_t callbacks = {
        .image_malloc = take_buffer,
        .image_memcpy = copy_buffer,
        .image_realloc = resize_buffer,
        .image_free = keep_buffer,
        .udata_copy = share,
        .udata_free = unshare,
        .udata = image,
    };
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (H5Pset_fapl_core(access, BUFFER_STEP, 0) >= 0 &&
        H5Pset_file_image_callbacks(access, &callbacks) >= 0 &&
        H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0 &&
        H5Pset_meta_block_size(access, METADATA_BLOCK) >= 0 &&
        H5Pset_small_data_block_size(access, 0) >= 0) {
        return access;
    }
    H5Pclose(access);
    return H5I_INVALID_HID;
}

Status image_create(Image *image) {
    *image = (Image){.file = H5I_INVALID_HID};
    H5dont_atexit(); // after a failure, its clean-up at exit would crash
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t access = memory_access(image);
    if (access < 0) return failed("the file", "");
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    if (H5Pset_obj_track_times(creation, 0) >= 0 &&
        H5Pset_link_creation_order(creation, IN_ORDER) >= 0)
        image->file = H5Fcreate("perrin in memory", H5F_ACC_TRUNC, creation, access);
    H5Pclose(creation);
    H5Pclose(access);
    return done(image->file < 0 ? -1 : 0, "the file", "");
}

// The superblock, version 0: signature and versions first, then three addresses, of which the last
// is the end of the file.
static Status find_end(Image *image) {
    enum { VERSION = 8, END = 40 };
    if (!image->bytes || image->size < END + sizeof image->end || image->bytes[VERSION] != 0) {
        return failed("the superblock of", "the file");
    }
    memcpy(&image->end, image->bytes + END, sizeof image->end);
    if (image->size > image->end) image->size = image->end;
    return OK;
}

Status image_close(Image *image) {
    const herr_t result = H5Fclose(image->file);
    image->file = H5I_INVALID_HID;
    TRY(done(result, "the closing of", "the file"));
    return find_end(image);
}

Status image_complete(Image *image, size_t more) {
    const size_t whole = image->end + more;
    unsigned char *bytes = realloc(image->bytes, whole);
    if (!bytes) return status_fail(NO_MEMORY, "out of memory: a file of %zu bytes", whole);
    memset(bytes + image->size, 0, whole - image->size);
    image->bytes = bytes;
    image->size = whole;
    return OK;
}

void image_free(Image *image) {
    if (image->file >= 0) H5Fclose(image->file);
    free(image->bytes);
    *image = (Image){.file = H5I_INVALID_HID};
}

Status image_group(hid_t parent, const char *name, hid_t *group) {
    const hid_t creation = H5Pcreate(H5P_GROUP_CREATE);
    *group = H5I_INVALID_HID;
    if (H5Pset_obj_track_times(creation, 0) >= 0 &&
        H5Pset_link_creation_order(creation, IN_ORDER) >= 0 &&
        H5Pset_attr_creation_order(creation, IN_ORDER) >= 0)
        *group = H5Gcreate2(parent, name, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    return done(*group < 0 ? -1 : 0, "the group", name);
}

void image_end(hid_t object) {
    H5Oclose(object);
}

// Contiguous, given its place at once, without times that would differ from run to run.
static hid_t dataset(hid_t parent, const char *name, hid_t type, hid_t space) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    // Of a text of any length the file holds a reference, which HDF5 insists on clearing.
    const H5D_fill_time_t fill =
        H5Tis_variable_str(type) > 0 ? H5D_FILL_TIME_IFSET : H5D_FILL_TIME_NEVER;
    hid_t set = H5I_INVALID_HID;
    if (H5Pset_layout(creation, H5D_CONTIGUOUS) >= 0 &&
        H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY) >= 0 &&
        H5Pset_fill_time(creation, fill) >= 0 && H5Pset_obj_track_times(creation, 0) >= 0)
        set = H5Dcreate2(parent, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    return set;
}

static hid_t new_space(int rank, const hsize_t *extent) {
    return rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, extent, NULL);
}

static Status shaped(hid_t parent, const char *name, const ImageShape *shape, hid_t *set) {
    const hid_t space = new_space(shape->rank, shape->extent);
    *set = dataset(parent, name, shape->type, space);
    H5Sclose(space);
    return done(*set < 0 ? -1 : 0, "the dataset", name);
}

// Hands the dataset on, or closes it when nobody wants it or something failed.
static Status hand_on(Status status, hid_t set, hid_t *out) {
    if (out && status == OK)
        *out = set;
    else
        H5Dclose(set);
    return status;
}

static hid_t type_in_memory(hid_t type) {
    return H5Tget_native_type(type, H5T_DIR_ASCEND);
}

Status image_numbers(hid_t parent, const char *name, const ImageShape *shape, const void *values,
                     hid_t *out) {
    hid_t set;
    TRY(shaped(parent, name, shape, &set));
    const hid_t type = type_in_memory(shape->type);
    const herr_t result = H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Tclose(type);
    return hand_on(done(result, "the dataset", name), set, out);
}

Status image_room(hid_t parent, const char *name, const ImageShape *shape, uint64_t *place) {
    hid_t set;
    TRY(shaped(parent, name, shape, &set));
    *place = H5Dget_offset(set);
    return hand_on(done(*place == HADDR_UNDEF ? -1 : 0, "the place of", name), set, NULL);
}

// Where it cannot be made it is invalid, and so is what is made of it.
static hid_t text_type(size_t size) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (H5Tset_size(type, size) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0) return type;
    H5Tclose(type);
    return H5I_INVALID_HID;
}

Status image_text(hid_t parent, const char *name, const char *text) {
    const hid_t type = text_type(H5T_VARIABLE), space = H5Screate(H5S_SCALAR);
    const hid_t set = dataset(parent, name, type, space);
    herr_t result = set < 0 ? -1 : 0;
    if (set >= 0) result = H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text);
    if (set >= 0) H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
    return done(result, "the text", name);
}

static Status write_labels(hid_t set, size_t width, const char *const *labels, size_t count,
                           const char *name) {
    char *table = calloc(count + 1, width);
    if (!table) return status_fail(NO_MEMORY, "out of memory: the labels of '%s'", name);
    for (size_t i = 0; i < count; i++) memcpy(table + i * width, labels[i], strlen(labels[i]));
    const hid_t type = text_type(width);
    const herr_t result = H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, table);
    H5Tclose(type);
    free(table);
    return done(result, "the labels", name);
}

Status image_labels(hid_t parent, const char *name, const char *const *labels, size_t count,
                    hid_t *out) {
    size_t width = 1;
    for (size_t i = 0; i < count; i++) {
        if (strlen(labels[i]) + 1 > width) width = strlen(labels[i]) + 1;
    }
    ImageShape shape = {.type = text_type(width), .rank = 1, .extent = {count}};
    hid_t set;
    const Status status = shaped(parent, name, &shape, &set);
    H5Tclose(shape.type);
    TRY(status);
    return hand_on(write_labels(set, width, labels, count, name), set, out);
}

static Status attribute(hid_t object, const char *name, hid_t type, int rank, size_t count,
                        const void *values) {
    const hsize_t extent = count;
    const hid_t space = new_space(rank, &extent);
    const hid_t made = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    herr_t result = -1;
    if (made >= 0) {
        const hid_t memory = type_in_memory(type);
        result = H5Awrite(made, memory, values);
        H5Tclose(memory);
        H5Aclose(made);
    }
    H5Sclose(space);
    return done(result, "the attribute", name);
}

Status image_text_attribute(hid_t object, const char *name, const char *text) {
    const hid_t type = text_type(H5T_VARIABLE);
    const Status status = attribute(object, name, type, 0, 1, &text);
    H5Tclose(type);
    return status;
}

Status image_texts_attribute(hid_t object, const char *name, const char *const *texts,
                             size_t count) {
    const hid_t type = text_type(H5T_VARIABLE);
    const Status status = attribute(object, name, type, 1, count, texts);
    H5Tclose(type);
    return status;
}

Status image_number_attribute(hid_t object, const char *name, double value) {
    return attribute(object, name, H5T_IEEE_F64LE, 0, 1, &value);
}

Status image_integers_attribute(hid_t object, const char *name, const int64_t *values,
                                size_t count) {
    return attribute(object, name, H5T_STD_I64LE, count > 1, count, values);
}
