// SPDX-License-Identifier: GPL-3.0-or-later
// The half plane of wave vectors.
#include "itt/plane.h"

#include "base/constants.h"
#include "base/memory.h"

#include <math.h>

enum { MARGIN = 3 }; // zeros at each end of a column: cubic interpolation reads that far

static Status fill_columns(Plane *plane) {
    size_t at = 0;
    for (int i = 0; i <= plane->last; i++) {
        const double rest = pow(plane->cutoff / plane->spacing, 2) - (double)i * i;
        plane->half[i] = (int)floor(sqrt(fmax(0, rest)) + 1e-9);
        plane->start[i] = at + MARGIN + (size_t)plane->half[i];
        at = plane->start[i] + (size_t)plane->half[i] + 1 + MARGIN;
    }
    plane->size = at;
    TRY(NEW_ARRAY(plane->x, at));
    TRY(NEW_ARRAY(plane->y, at));
    TRY(NEW_ARRAY(plane->area, at));
    for (int i = 0; i <= plane->last; i++) {
        for (int j = -plane->half[i]; j <= plane->half[i]; j++) {
            const size_t k = plane_place(plane, i, j);
            plane->x[k] = i * plane->spacing;
            plane->y[k] = j * plane->spacing;
            plane->area[k] = (i == 0 ? 1 : 2) * pow(plane->spacing / (2 * PI), 2);
        }
    }
    return OK;
}

static Status fill(Plane *plane) {
    TRY(NEW_ARRAY(plane->half, (size_t)plane->last + 1));
    TRY(NEW_ARRAY(plane->start, (size_t)plane->last + 1));
    return fill_columns(plane);
}

Status plane_create(Plane **out, double cutoff, double spacing) {
    Plane *plane = NULL;
    *out = NULL;
    TRY(NEW(plane));
    plane->spacing = spacing;
    plane->cutoff = cutoff;
    plane->last = (int)floor(cutoff / spacing + 1e-9);
    const Status status = fill(plane);
    if (status == OK)
        *out = plane;
    else
        plane_free(plane);
    return status;
}

void plane_free(Plane *plane) {
    if (!plane) return;
    memory_free(plane->half);
    memory_free(plane->start);
    memory_free(plane->x);
    memory_free(plane->y);
    memory_free(plane->area);
    memory_free(plane);
}

size_t plane_place(const Plane *plane, int i, int j) {
    return (size_t)((ptrdiff_t)plane->start[i] + j);
}

// Rows of a column of `half` for which row + whole, or a neighbour that weights reach, is there.
typedef struct Rows {
    int first, last;
} Rows;

static Rows rows_reached(int half, double whole) {
    const double first = fmax(-half, -half - 2 - whole), last = fmin(half, half + 1 - whole);
    return first > last ? (Rows){1, 0} : (Rows){(int)first, (int)last};
}

void plane_add_advected(const Plane *plane, double strain, const double *field, const double *part,
                        double *sum) {
    for (int i = 0; i <= plane->last; i++) {
        const double way = -strain * i, whole = floor(way), u = way - whole;
        const Rows rows = rows_reached(plane->half[i], whole);
        if (rows.first > rows.last) continue;
        // Lagrange's polynomial through rows -1, 0, 1, 2 at 0 <= u < 1.
        const double w0 = -u * (u - 1) * (u - 2) / 6, w1 = (u + 1) * (u - 1) * (u - 2) / 2;
        const double w2 = -(u + 1) * u * (u - 2) / 2, w3 = (u + 1) * u * (u - 1) / 6;
        const size_t to = plane_place(plane, i, rows.first);
        const double *from = field + plane_place(plane, i, rows.first + (int)whole);
        const size_t count = (size_t)(rows.last - rows.first + 1);
        for (size_t k = 0; k < count; k++) {
            const double *f = from + k;
            sum[to + k] += part[to + k] * (w0 * f[-1] + w1 * f[0] + w2 * f[1] + w3 * f[2]);
        }
    }
}
