// SPDX-License-Identifier: GPL-3.0-or-later
// An HDF5 file built in memory: the same calls give the same bytes, no failure of a disk can hit
// HDF5, and what is written to the disk is ours to write. Room that is reserved and not filled
// takes no memory. Internal to the store.
#pragma once

#include "results/results.h"

#include <hdf5.h>
#include <stdint.h>

enum { IMAGE_RANK = RESULT_AXES + 1 }; // a series of all replicas

typedef struct Image {
    hid_t file;
    unsigned char *bytes; // once closed: [0, size) of the file; what lies behind was reserved
    size_t size;
    uint64_t end; // once closed: of the file, in bytes
} Image;

Status image_create(Image *image);
Status image_close(Image *image);
// Of a closed image: zeros in all reserved room, and room for `more` bytes behind the end.
Status image_complete(Image *image, size_t more);
void image_free(Image *image); // closes without success, too

Status image_group(hid_t parent, const char *name, hid_t *group);
void image_end(hid_t object); // closes a group or dataset

typedef struct ImageShape {
    hid_t type; // in the file: H5T_IEEE_F64LE, H5T_STD_I32LE, ...
    int rank;
    hsize_t extent[IMAGE_RANK];
} ImageShape;

// A dataset of numbers; `set`, if not NULL, stays open for attributes.
Status image_numbers(hid_t parent, const char *name, const ImageShape *shape, const void *values,
                     hid_t *set);
// The same without values: the place in the file where they are to be written.
Status image_room(hid_t parent, const char *name, const ImageShape *shape, uint64_t *place);
Status image_text(hid_t parent, const char *name, const char *text); // a text as a dataset
Status image_labels(hid_t parent, const char *name, const char *const *labels, size_t count,
                    hid_t *set);

Status image_text_attribute(hid_t object, const char *name, const char *text);
Status image_texts_attribute(hid_t object, const char *name, const char *const *texts,
                             size_t count);
Status image_number_attribute(hid_t object, const char *name, double value);
Status image_integers_attribute(hid_t object, const char *name, const int64_t *values,
                                size_t count);
