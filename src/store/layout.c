// SPDX-License-Identifier: GPL-3.0-or-later
// The H5MD 1.1 file of a trajectory, built in memory. What readers of H5MD insist on: three
// columns even in two dimensions, the edges of the box as a matrix per frame, steps and times as
// arrays, no unit attributes; everything of our own lies under /perrin.
#include "store/layout.h"

#include "base/crc32c.h"
#include "base/version.h"

#include <stdlib.h>
#include <string.h>

#define INTEGERS H5T_STD_I32LE
#define LONG_INTEGERS H5T_STD_I64LE
#define REALS H5T_IEEE_F64LE

static Status write_h5md(hid_t file) {
    static const int64_t version[2] = {1, 1};
    hid_t h5md, author, creator;
    TRY(image_group(file, "h5md", &h5md));
    TRY(image_integers_attribute(h5md, "version", version, 2));
    TRY(image_group(h5md, "author", &author));
    TRY(image_text_attribute(author, "name", "unknown"));
    TRY(image_group(h5md, "creator", &creator));
    TRY(image_text_attribute(creator, "name", "perrin"));
    TRY(image_text_attribute(creator, "version", version_number()));
    image_end(creator);
    image_end(author);
    image_end(h5md);
    return OK;
}

// An element of H5MD: a group with value, step and time, the last two shared by all elements.
static Status write_element(hid_t parent, const char *name, hid_t *element, const ImageShape *shape,
                            uint64_t *place) {
    TRY(image_group(parent, name, element));
    return image_room(*element, "value", shape, place);
}

static Status share_times(hid_t from, hid_t to) {
    static const char *const names[2] = {"step", "time"};
    for (int i = 0; i < 2; i++) {
        if (H5Lcreate_hard(from, names[i], to, names[i], H5P_DEFAULT, H5P_DEFAULT) < 0) {
            return status_fail(NO_MEMORY, "cannot build a trajectory in memory");
        }
    }
    return OK;
}

static Status write_times(hid_t position, Layout *layout) {
    const ImageShape steps = {LONG_INTEGERS, 1, {layout->frames}};
    const ImageShape times = {REALS, 1, {layout->frames}};
    TRY(image_room(position, "step", &steps, &layout->step));
    return image_room(position, "time", &times, &layout->time);
}

static Status write_box(hid_t particles, hid_t position, Layout *layout) {
    static const char *const periodic[3] = {"periodic", "periodic", "periodic"};
    static const int64_t columns = 3;
    const ImageShape edges = {REALS, 3, {layout->frames, 3, 3}};
    hid_t box, element;
    TRY(image_group(particles, "box", &box));
    TRY(image_integers_attribute(box, "dimension", &columns, 1));
    TRY(image_texts_attribute(box, "boundary", periodic, 3));
    TRY(write_element(box, "edges", &element, &edges, &layout->edges));
    TRY(share_times(position, element));
    image_end(element);
    image_end(box);
    return OK;
}

// Unit vectors along the body axes, an element of our own; only where a species has one.
static Status write_orientation(hid_t particles, hid_t position, Layout *layout) {
    const ImageShape vectors = {REALS, 3, {layout->frames, layout->particles, 3}};
    hid_t orientation;
    TRY(write_element(particles, "orientation", &orientation, &vectors, &layout->orientation));
    TRY(share_times(position, orientation));
    image_end(orientation);
    return OK;
}

// What moves: position, image, body axes and box of each frame.
static Status write_moving(hid_t particles, Layout *layout, const State *state) {
    const ImageShape vectors = {REALS, 3, {layout->frames, layout->particles, 3}};
    const ImageShape images = {INTEGERS, 3, {layout->frames, layout->particles, 3}};
    hid_t position, image;
    TRY(write_element(particles, "position", &position, &vectors, &layout->position));
    TRY(write_times(position, layout));
    TRY(write_element(particles, "image", &image, &images, &layout->image));
    TRY(share_times(position, image));
    if (state->oriented) TRY(write_orientation(particles, position, layout));
    TRY(write_box(particles, position, layout));
    image_end(image);
    image_end(position);
    return OK;
}

// How far the box was sheared: an observable in the sense of H5MD.
static Status write_strain(hid_t file, hid_t particles, Layout *layout) {
    const ImageShape numbers = {REALS, 1, {layout->frames}};
    hid_t observables, strain, position;
    TRY(image_group(file, "observables", &observables));
    TRY(write_element(observables, "strain", &strain, &numbers, &layout->strain));
    position = H5Gopen2(particles, "position", H5P_DEFAULT);
    if (position < 0) return status_fail(NO_MEMORY, "cannot build a trajectory in memory");
    TRY(share_times(position, strain));
    image_end(position);
    image_end(strain);
    image_end(observables);
    return OK;
}

static Status write_fixed(hid_t group, const char *name, hid_t type, const Layout *layout,
                          const void *values, uint64_t *place) {
    const ImageShape shape = {type, 1, {layout->particles}};
    hid_t set;
    TRY(image_numbers(group, name, &shape, values, &set));
    *place = H5Dget_offset(set);
    image_end(set);
    return OK;
}

static Status write_species(hid_t particles, Layout *layout, const State *state) {
    int32_t *species = calloc(state->count + 1, sizeof *species);
    if (!species) return status_fail(NO_MEMORY, "out of memory: a trajectory");
    for (size_t i = 0; i < state->count; i++) species[i] = state->species_of[i];
    const Status status =
        write_fixed(particles, "species", INTEGERS, layout, species, &layout->species);
    free(species);
    return status;
}

static Status write_species_names(hid_t perrin, const System *system) {
    const char *names[SPECIES_MOST];
    for (size_t i = 0; i < system->species_count; i++) names[i] = system->species[i].name;
    return image_labels(perrin, "species_names", names, system->species_count, NULL);
}

static Status write_species_bodies(hid_t perrin, const System *system) {
    const ImageShape shape = {REALS, 1, {system->species_count}};
    const char *shapes[SPECIES_MOST];
    double lengths[SPECIES_MOST];
    for (size_t i = 0; i < system->species_count; i++) {
        shapes[i] = shape_names[system->species[i].shape];
        lengths[i] = system->species[i].length;
    }
    TRY(image_labels(perrin, "species_shapes", shapes, system->species_count, NULL));
    return image_numbers(perrin, "species_lengths", &shape, lengths, NULL);
}

static Status write_own(hid_t perrin, Layout *layout, const State *state) {
    const int64_t version = SEAL_VERSION, dimension = (int64_t)layout->dimension;
    TRY(image_integers_attribute(perrin, "format_version", &version, 1));
    TRY(image_integers_attribute(perrin, "dimension", &dimension, 1));
    TRY(write_species_names(perrin, &state->system));
    TRY(write_species_bodies(perrin, &state->system));
    TRY(write_fixed(perrin, "diameter", REALS, layout, state->diameter, &layout->diameter));
    return write_fixed(perrin, "mass", REALS, layout, state->mass, &layout->mass);
}

// First all that stays, then the room for the frames: so it lies behind.
static Status write_contents(hid_t file, Layout *layout, const State *state) {
    const ImageShape crcs = {H5T_STD_U32LE, 1, {layout->frames}};
    hid_t group, particles, perrin;
    TRY(write_h5md(file));
    TRY(image_group(file, "perrin", &perrin));
    TRY(write_own(perrin, layout, state));
    TRY(image_group(file, "particles", &group));
    TRY(image_group(group, "trajectory", &particles));
    TRY(write_species(particles, layout, state));
    TRY(write_moving(particles, layout, state));
    TRY(write_strain(file, particles, layout));
    TRY(image_room(perrin, "crc32c", &crcs, &layout->crc));
    image_end(particles);
    image_end(group);
    image_end(perrin);
    return OK;
}

static uint64_t first_room(const Layout *layout) {
    const uint64_t places[] = {layout->position,    layout->image, layout->edges,
                               layout->step,        layout->time,  layout->crc,
                               layout->orientation, layout->strain};
    uint64_t first = places[0];
    for (size_t i = 1; i < sizeof places / sizeof *places; i++) {
        if (places[i] && places[i] < first) first = places[i];
    }
    return first;
}

// All that HDF5 wrote lies before the frames: what is known of the rest must be empty.
static Status check_header_first(const Layout *layout, const Image *image) {
    bool empty = layout->header <= image->size;
    for (uint64_t i = layout->header; empty && i < image->size; i++) empty = image->bytes[i] == 0;
    return empty ? OK : status_fail(UNHEALTHY, "HDF5 does not put a trajectory's frames last");
}

Status layout_build(Layout *layout, Image *image, const State *state) {
    layout->dimension = (uint64_t)state->box.dimension;
    layout->particles = state->count;
    TRY(image_create(image));
    TRY(write_contents(image->file, layout, state));
    TRY(image_close(image));
    layout->header = first_room(layout);
    return check_header_first(layout, image);
}

Seal layout_seal(const Layout *layout, const Image *image) {
    _Static_assert(sizeof *layout <= sizeof((Seal *)0)->words, "the layout fits into the seal");
    Seal seal = seal_new(SEAL_TRAJECTORY, image->end + sizeof seal);
    memcpy(seal.words, layout, sizeof *layout);
    seal.contents_crc = crc32c(0, image->bytes, layout->header);
    seal_finish(&seal);
    return seal;
}

// `count` times `each` bytes at `place` lie within the file.
static bool inside(uint64_t place, uint64_t count, uint64_t each, uint64_t file_size) {
    uint64_t bytes, end;
    return !__builtin_mul_overflow(count, each, &bytes) &&
           !__builtin_add_overflow(place, bytes, &end) && end <= file_size;
}

Status layout_check(Layout *layout, const Seal *seal, const char *path) {
    memcpy(layout, seal->words, sizeof *layout);
    const uint64_t n = layout->particles, frames = layout->frames, size = seal->size;
    uint64_t all;
    const bool fits =
        (layout->dimension == 2 || layout->dimension == 3) &&
        !__builtin_mul_overflow(n, frames, &all) && inside(0, layout->header, 1, size) &&
        inside(layout->species, n, 4, size) && inside(layout->diameter, n, 8, size) &&
        inside(layout->mass, n, 8, size) && inside(layout->position, all, 24, size) &&
        inside(layout->image, all, 12, size) && inside(layout->edges, frames, 72, size) &&
        inside(layout->step, frames, 8, size) && inside(layout->time, frames, 8, size) &&
        inside(layout->crc, frames, 4, size) && inside(layout->orientation, all, 24, size) &&
        inside(layout->strain, frames, 8, size);
    if (fits) return OK;
    return status_fail(BAD_DATA, "'%s' is damaged: it claims more than it holds", path);
}
