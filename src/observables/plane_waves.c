// SPDX-License-Identifier: GPL-3.0-or-later
// A walk over the half plane of the lattice, and where its vectors lie.
#include "observables/plane_waves.h"

#include "base/constants.h"
#include "base/memory.h"

#include <math.h>

const char *const plane_cut_names[PLANE_CUTS + 1] = {"x", "y", "xy", "-xy", NULL};

double plane_spacing_least(const Box *box) {
    return 2 * PI / fmin(box->edge[0], box->edge[1]);
}

PlaneShape plane_shape(const Box *box, double last, double spacing, double cut_spacing,
                       double cut_degrees) {
    PlaneShape shape = {.spacing = spacing > 0 ? spacing : 3 * plane_spacing_least(box),
                        .cut_last = last,
                        .cut_spacing = cut_spacing,
                        .cut_bins = (size_t)ceil(last / cut_spacing - 1e-9),
                        .cut_cosine = cos(cut_degrees * PI / 180)};
    shape.side = 2 * (size_t)floor(last / shape.spacing + 1e-9) + 1;
    return shape;
}

// Largest |q_x| and |q_y| of the picture and the cuts.
static double reach(const PlaneShape *shape) {
    return fmax((double)shape->side / 2 * shape->spacing, shape->cut_last);
}

// Largest |n[1]| with which a vector of this n[0] can be of use: the lattice is tilted by at most
// half a cell to either side.
static int32_t most_along_y(const Box *box, const PlaneShape *shape, int32_t along_x) {
    return (int32_t)floor(reach(shape) * box->edge[1] / (2 * PI) + 0.5 * along_x);
}

static int32_t most_along_x(const Box *box, const PlaneShape *shape) {
    return (int32_t)floor(reach(shape) * box->edge[0] / (2 * PI));
}

size_t plane_waves_count(const Box *box, const PlaneShape *shape) {
    size_t count = (size_t)most_along_y(box, shape, 0); // with n[0] = 0 half of them
    for (int32_t x = 1; x <= most_along_x(box, shape); x++) {
        count += 2 * (size_t)most_along_y(box, shape, x) + 1;
    }
    return count;
}

Status plane_waves_make(PlaneWaves *waves, const Box *box, const PlaneShape *shape) {
    waves->shape = *shape;
    TRY(NEW_ARRAY(waves->vector, plane_waves_count(box, shape)));
    for (int32_t x = 0; x <= most_along_x(box, shape); x++) {
        const int32_t most = most_along_y(box, shape, x);
        for (int32_t y = x == 0 ? 1 : -most; y <= most; y++) {
            waves->vector[waves->count++] = (LatticeVector){.n = {x, y, 0}};
        }
    }
    return OK;
}

void plane_waves_clear(PlaneWaves *waves) {
    memory_free(waves->vector);
}

size_t plane_waves_memory(const Box *box, const PlaneShape *shape) {
    const int32_t x = most_along_x(box, shape);
    const int32_t most[3] = {x, most_along_y(box, shape, x), 0};
    return plane_waves_count(box, shape) * sizeof(LatticeVector) +
           density_modes_memory(most, box->dimension);
}

static uint32_t pixel_of(const PlaneShape *shape, const double q[3]) {
    const double x = floor(q[0] / shape->spacing + (double)shape->side / 2);
    const double y = floor(q[1] / shape->spacing + (double)shape->side / 2);
    const double side = (double)shape->side;
    if (x < 0 || y < 0 || x >= side || y >= side) return (uint32_t)plane_pixels(shape);
    return (uint32_t)x * (uint32_t)shape->side + (uint32_t)y;
}

// No two cuts overlap.
static uint32_t cut_bin_of(const PlaneShape *shape, const double q[3]) {
    const double half = sqrt(0.5), length = sqrt(q[0] * q[0] + q[1] * q[1]);
    const double along[PLANE_CUTS] = {q[0], q[1], half * (q[0] + q[1]), half * (q[0] - q[1])};
    for (uint32_t cut = 0; cut < PLANE_CUTS && length < shape->cut_last; cut++) {
        if (fabs(along[cut]) < length * shape->cut_cosine) continue;
        const double bin = fmin(length / shape->cut_spacing, (double)shape->cut_bins - 0.5);
        return cut * (uint32_t)shape->cut_bins + (uint32_t)bin;
    }
    return PLANE_CUTS * (uint32_t)shape->cut_bins;
}

void plane_waves_place(const PlaneWaves *waves, const Box *box, uint32_t *pixel, uint32_t *bin) {
    for (size_t v = 0; v < waves->count; v++) {
        double q[3];
        wave_vector_of(box, &waves->vector[v], q);
        pixel[v] = pixel_of(&waves->shape, q);
        bin[v] = cut_bin_of(&waves->shape, q);
    }
}
